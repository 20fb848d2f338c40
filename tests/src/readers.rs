//! Everything that reads a file, as functions of the file's bytes: what `fuzz/` feeds with mutated bytes,
//! and the tests with all that was worth keeping of them.
//!
//! Each goes as far as the command would with a file of this kind, and asks of the result what its users
//! would. A reader may refuse anything; what it must not do is panic, hang, or take memory that the bytes
//! do not pay for.

use std::path::Path;
use std::sync::Arc;

use adslam_agent::{Estimators, GateProbability};
use adslam_diagnostics::{Failure, InputError};
use adslam_experiment::sweep::SweepPlan;
use adslam_names::{EstimatorName, LengthUnit};
use adslam_record::RunHistory;
use adslam_record::log::{EstimateLine, FilterChoice, GateChoice, Replay};
use adslam_scenario::config::{Config, Published};
use adslam_scenario::sweep::Sweep;
use adslam_scenario::values::NonNegative;
use adslam_scenario::{Object, Scenario};
use adslam_setup::{MeshReport, MeshUse, Setup};
use adslam_surface::{Clearance, Fan, MeshFile, MeshFormat, Surface, Topology, pick_features};
use nalgebra::Point3;

use crate::repository;

/// A reader under the name of its corpus, the folder `fuzz/corpus/NAME`.
#[derive(Clone, Copy)]
pub struct Reader {
    /// Its name.
    pub name: &'static str,
    read: fn(&[u8]),
    /// Bytes that it may have allocated at any time, whatever the input.
    base: u64,
}

/// Bytes that a reader may have allocated for each byte of its input.
const BYTES_FOR_A_BYTE: u64 = 1 << 10;

/// All of them.
pub const READERS: [Reader; 9] = [
    // The heart phantom is built, at any spacing that is allowed.
    Reader::new("scenario", scenario, 64 << 20),
    // What is said of an unknown key comes from the schema, a megabyte or two.
    Reader::new("config", config, 8 << 20),
    // Every point of a sweep is a scenario, and of the first few the objects are built.
    Reader::new("sweep", sweep, 256 << 20),
    Reader::new("published", published, 8 << 20),
    // A covariance grows with the square of the features, of which eight bytes make one.
    Reader::new("log", log, 128 << 20),
    Reader::new("stl", stl, 1 << 20),
    Reader::new("obj", obj, 1 << 20),
    Reader::new("ply", ply, 1 << 20),
    Reader::new("history", history, 1 << 20),
];

impl Reader {
    /// A reader that may allocate `base` bytes whatever its input.
    #[must_use]
    pub const fn new(name: &'static str, read: fn(&[u8]), base: u64) -> Self {
        Self { name, read, base }
    }

    /// The reader of this name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        READERS.into_iter().find(|reader| reader.name == name)
    }

    /// Reads `bytes`.
    ///
    /// # Panics
    /// If the reader panics, or takes more memory than such an input may.
    pub fn read(&self, bytes: &[u8]) {
        let memory = allocation_counter::measure(|| (self.read)(bytes));
        let most = self.base + BYTES_FOR_A_BYTE * bytes.len() as u64;
        assert!(
            memory.bytes_max <= most,
            "{} of {} bytes took {} bytes of memory, more than {most}",
            self.name,
            bytes.len(),
            memory.bytes_max
        );
    }
}

/// Reads `bytes` with the reader of this name.
///
/// # Panics
/// As [`Reader::read`], and if there is no such reader.
pub fn read(name: &str, bytes: &[u8]) {
    Reader::named(name)
        .expect("the name of a reader")
        .read(bytes);
}

/// Looks at an error as the command does when it shows it to people and to machines.
fn shown(error: InputError) {
    let _ = (error.line_and_column(), error.pointed_at());
    drop(error.to_string());
    drop(format!("{:?}", miette::Report::new(error)));
}

fn scenario(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else {
        return;
    };
    let path = repository("scenarios/fuzzed.toml");
    let built = Scenario::parse(text, &path).and_then(|scenario| match scenario.object {
        // What lies on the disk is not a part of the input.
        Object::Mesh(_) => Ok(None),
        _ => Setup::new(&scenario).map(Some),
    });
    match built {
        Ok(Some(setup)) => drop(setup.model.known_feature_motion(setup.model.steps)),
        Ok(None) => {}
        Err(error) => shown(error),
    }
}

fn config(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else {
        return;
    };
    // Its scenarios are the shipped ones.
    if let Err(error) = Config::parse(text, &repository("configs/fuzzed.toml")) {
        shown(error);
    }
}

fn sweep(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else {
        return;
    };
    let path = repository("sweeps/fuzzed.toml");
    let built = Sweep::parse(text, &path).and_then(|mut sweep| {
        sweep.points.truncate(POINTS_BUILT);
        let is_mesh = |object: &Object| matches!(object, Object::Mesh(_));
        // What lies on the disk is not a part of the input.
        if sweep
            .points
            .iter()
            .any(|point| is_mesh(&point.scenario.object))
        {
            return Ok(None);
        }
        SweepPlan::new(sweep, None).map(Some)
    });
    match built {
        Ok(Some(plan)) => drop((plan.warnings(), plan.total_runs())),
        Ok(None) => {}
        Err(error) => shown(error),
    }
}

/// Points of a sweep whose object is built: one more takes as long as one scenario more.
const POINTS_BUILT: usize = 4;

fn published(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else {
        return;
    };
    if let Err(error) = Published::parse(text, Path::new("published.toml")) {
        shown(error);
    }
}

fn log(bytes: &[u8]) {
    for estimator in EstimatorName::OURS {
        filter(
            bytes,
            FilterChoice {
                estimator: Some(estimator),
                gate: GateProbability::new(0.99).map_or(GateChoice::All, GateChoice::Probability),
            },
        );
    }
    filter(bytes, FilterChoice::default());
}

fn filter(bytes: &[u8], choice: FilterChoice) {
    let mut replay = match Replay::new(
        bytes,
        Path::new("log.jsonl"),
        choice,
        &Estimators::standard(),
    ) {
        Ok(replay) => replay,
        Err(error) => return shown(error),
    };
    loop {
        match replay.advance() {
            Ok(Some(step)) => {
                let line = replay.estimates(step);
                let json = serde_json::to_string(&line).expect("an estimate as JSON");
                let again: EstimateLine =
                    serde_json::from_str(&json).expect("an estimate of numbers alone");
                assert_eq!(line, again);
            }
            Ok(None) => return,
            Err(Failure::Input(error)) => return shown(error),
            Err(error) => return drop(error.to_string()),
        }
    }
}

fn stl(bytes: &[u8]) {
    mesh(MeshFormat::Stl, bytes);
}

fn obj(bytes: &[u8]) {
    mesh(MeshFormat::Obj, bytes);
}

fn ply(bytes: &[u8]) {
    mesh(MeshFormat::Ply, bytes);
}

fn mesh(format: MeshFormat, bytes: &[u8]) {
    drop(MeshFormat::of_content(bytes).map(|found| found.to_string()));
    let file = match MeshFile::parse(format, bytes) {
        Ok(file) => file,
        Err(error) => return drop(error.to_string()),
    };
    let mesh = file.mesh.clone();
    let wanted = MeshUse {
        unit: LengthUnit::Cm,
        join_within_cm: NonNegative::default(),
        features: FEATURES,
    };
    let report = MeshReport::of(file, Path::new("mesh"), wanted);
    drop(report.to_string());
    let picked = pick_features(&mesh, FEATURES, 1).unwrap_or_default();
    if report.serves {
        assert_eq!(picked.len(), FEATURES);
        let points: Vec<Point3<f64>> = picked.iter().map(|&i| mesh.vertices[i]).collect();
        let hull = Topology::convex_hull(&points).expect("the hull of its own corners");
        assert!(hull.points_off_surface().is_empty());
        questions(&Surface::new(&Arc::new(hull), &points).expect("a surface"));
    }
    if let Err(error) = report.into_result() {
        shown(error);
    }
    if let Ok(topology) = Topology::from_faces(&mesh.vertices, &mesh.faces) {
        questions(&Surface::new(&Arc::new(topology), &mesh.vertices).expect("a surface"));
    }
}

/// Features that are looked for in a mesh.
const FEATURES: usize = 5;

/// What planners ask, in bulk; the answers are those to each question alone.
fn questions(surface: &Surface) {
    let points = surface.points();
    let Some(first) = points.first() else { return };
    let (low, high) = points
        .iter()
        .fold((*first, *first), |(low, high), p| (low.inf(p), high.sup(p)));
    let middle = nalgebra::center(&low, &high);
    let ends = [*first, low, middle, high + (high - low), Point3::origin()];
    let (mut fan, mut clearance) = (Fan::default(), Clearance::default());
    for from in &ends {
        let seen = fan.seen(surface, from, 0..points.len());
        let seen: Vec<bool> = (0..points.len()).map(|i| seen.contains(&i)).collect();
        assert!(
            seen.iter()
                .enumerate()
                .all(|(i, seen)| *seen == surface.sees(from, i))
        );
        let clear = clearance.clear_ways(surface, from, ends, 0.0);
        // A place may be so near that its distance is rounded to 0, and be outside nevertheless.
        let outside = surface.signed_distance(from).is_sign_positive();
        let is_clear = |end: &Point3<f64>| {
            outside && surface.signed_distance(end) > 0.0 && !surface.crosses(from, end)
        };
        assert!((0..ends.len()).all(|i| clear.contains(&i) == is_clear(&ends[i])));
    }
}

fn history(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else {
        return;
    };
    let history = match RunHistory::parse(Path::new("history.json"), text) {
        Ok(history) => history,
        Err(error) => return shown(error),
    };
    for step in 0..history.steps.len() {
        drop((history.drawn_vertices(step), history.candidates(step)));
    }
    // What was read is written in the same words.
    let json = serde_json::to_string(&history).expect("a history as JSON");
    let again = RunHistory::parse(Path::new("history.json"), &json);
    assert!(again.is_ok(), "a history that cannot be read back");
}
