//! Tests of configurations: the shipped ones, overrides, and what is said about wrong ones.

use std::fs;
use std::path::PathBuf;

use tempfile::TempDir;

use super::*;
use crate::scenario::tests::{HEART, POLYGON, assert_error, repository};
use crate::scenario::{DeformationNoise, Nearest, Translation, Viewpoints};

/// A folder with scenarios, published results and one configuration.
struct Folder(TempDir);

impl Folder {
    fn with(config: &str) -> Self {
        let folder = Self(tempfile::tempdir().expect("a folder"));
        let published = fs::read_to_string(repository("configs/published.toml")).expect("tables");
        for (name, text) in [
            ("polygon.toml", POLYGON),
            ("heart.toml", HEART),
            ("published.toml", &published),
            ("config.toml", config),
        ] {
            fs::write(folder.path(name), text).expect("a file");
        }
        folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }
}

fn loaded(config: &str) -> Result<Config, InputError> {
    Config::load(&Folder::with(config).path("config.toml"))
}

/// One experiment on the polygon with these overrides.
fn overridden(set: &str) -> Result<Config, InputError> {
    loaded(&format!("{ONE}[experiments.set]\n{set}\n"))
}

const ONE: &str =
    "title = \"one\"\n[[experiments]]\nscenario = \"polygon.toml\"\nplanners = [\"global\"]\n";

/// The polygon with these overrides is refused, and the configuration blamed.
#[track_caller]
fn refused(set: &str, message: &str, pointed_at: &str, remedy: &str) {
    let result = overridden(set);
    let error = result.as_ref().err().expect("an error");
    assert!(
        error.path().ends_with("config.toml"),
        "{}",
        error.path().display()
    );
    assert_error(result, message, pointed_at, remedy);
}

#[test]
fn the_shipped_configurations_load() {
    for (name, experiments) in [
        ("paper", 2),
        ("public_code", 2),
        ("accumulating", 2),
        ("stored_viewpoints", 2),
    ] {
        let config = Config::load(&repository(&format!("configs/{name}.toml"))).unwrap();
        assert_eq!(config.experiments.len(), experiments, "{name}");
        assert_eq!((config.runs, config.first_seed), (5, 1), "{name}");
        for plan in &config.experiments {
            assert_eq!(plan.planners, PlannerName::ALL, "{name}");
            assert!(plan.published.is_some(), "{name}");
        }
    }
}

#[test]
fn the_variants_change_what_they_say() {
    let load = |name: &str| Config::load(&repository(&format!("configs/{name}.toml"))).unwrap();
    let [polygon, heart] = &load("stored_viewpoints").experiments[..] else {
        panic!("two")
    };
    for (plan, count) in [(polygon, 3), (heart, 7)] {
        let Viewpoints::Fixed(fixed) = &plan.scenario.viewpoints else {
            panic!("not fixed")
        };
        assert_eq!(fixed.positions_cm.len(), count);
    }
    for plan in load("accumulating").experiments {
        assert_eq!(
            plan.scenario.noise.deformation_noise,
            DeformationNoise::Accumulating
        );
    }
    let public = &load("public_code").experiments[0].scenario;
    assert_eq!(public.motion.translation, Translation::None);
    assert_eq!(public.local_planning_sigma_cm(), 0.05);
    assert_eq!(*public.noise.truncate_at_sigmas.unwrap(), 2.0);
    let rest: Vec<_> = match &public.object {
        crate::scenario::Object::Points(points) => {
            points.positions_cm.iter().map(|p| p.point()).collect()
        }
        _ => panic!("no points"),
    };
    let motion = public.true_motion(&rest).unwrap();
    assert!((motion.feature_motion(&rest[1], 1).y + 0.2).abs() < 1e-12);
    assert!(motion.feature_motion(&rest[1], 3).norm() < 1e-12);
}

#[test]
fn the_published_tables_are_the_papers() {
    let published = Published::load(&repository("configs/published.toml")).unwrap();
    let mean = |column: &PublishedPlanner| {
        let sum: usize = column.observed.iter().map(|count| count.get()).sum();
        sum as f64 / column.observed.len() as f64
    };
    // The means that reference.md gives in brackets.
    let expected = [
        ("polygon", "I", "II", [347.0, 695.0, 278.0, 541.0]),
        ("heart", "III", "IV", [1236.0, 2080.0, 1041.0, 1598.0]),
    ];
    for (scenario, coverage, errors, means) in expected {
        let tables = &published.tables[&Name::new(scenario).unwrap()];
        assert_eq!(
            (&*tables.coverage_table, &*tables.error_table),
            (coverage, errors)
        );
        for (planner, expected) in PlannerName::ALL.into_iter().zip(means) {
            let column = &tables.planners[&planner];
            assert_eq!(column.observed.len(), 5);
            assert!(
                (mean(column) - expected).abs() < 1.0,
                "{planner}: {}",
                mean(column)
            );
        }
    }
    let polygon = &published.tables[&Name::new("polygon").unwrap()];
    assert!(
        polygon.planners[&PlannerName::Local]
            .steps
            .iter()
            .all(|steps| steps.0.is_none())
    );
}

#[test]
fn defaults() {
    let config = loaded(ONE).unwrap();
    assert_eq!((config.runs, config.first_seed), (5, 1));
    let [plan] = &config.experiments[..] else {
        panic!("one")
    };
    assert_eq!(plan.label, "polygon");
    assert_eq!(plan.published, None);
}

#[test]
fn an_override_changes_one_key() {
    let config = overridden("\"planners.combined.nearest_fraction\" = 0.2\nsteps = 7").unwrap();
    let scenario = &config.experiments[0].scenario;
    assert_eq!(scenario.planners.combined.nearest(), Nearest::Fraction(0.2));
    assert_eq!(scenario.steps.get(), 7);
    assert_eq!(*scenario.sensor.range_cm, 3.0);
}

#[test]
fn an_override_reaches_into_lists_and_makes_missing_tables() {
    let set = "\"object.points.positions_cm[13]\" = [1.5, 0, 5]\n\"filter.structure\" = \"none\"";
    let config = overridden(set).unwrap();
    let scenario = &config.experiments[0].scenario;
    assert_eq!(scenario.filter.structure, crate::scenario::Structure::None);
    let crate::scenario::Object::Points(points) = &scenario.object else {
        panic!("no points")
    };
    assert_eq!(points.positions_cm[13].z, 5.0);
}

#[test]
fn an_override_of_a_choice_chooses_anew() {
    for set in [
        "\"viewpoints\" = { fixed = { positions_cm = [[1, 2, 3]] } }",
        "\"viewpoints.fixed\" = { positions_cm = [[1, 2, 3]] }",
        "\"viewpoints.fixed.positions_cm\" = [[1, 2, 3]]",
    ] {
        let config = overridden(set).unwrap();
        let Viewpoints::Fixed(fixed) = &config.experiments[0].scenario.viewpoints else {
            panic!("{set}")
        };
        assert_eq!(fixed.positions_cm.len(), 1);
    }
    let count = "\"planners.combined\" = { nearest_count = 1 }";
    let scenario = &overridden(count).unwrap().experiments[0].scenario;
    assert_eq!(scenario.planners.combined.nearest(), Nearest::Count(1));
    let phantom = overridden("\"object.phantom\" = {}").unwrap();
    assert_eq!(phantom.experiments[0].scenario.object.feature_count(), 50);
}

#[test]
fn a_wrong_override_is_shown_in_the_configuration() {
    refused(
        "\"noise.rotatoin_sigma_rad\" = 0.1",
        "unknown key `rotatoin_sigma_rad`",
        "\"noise.rotatoin_sigma_rad\"",
        "did you mean `rotation_sigma_rad`?",
    );
    refused(
        "\"noisy.x\" = 0.1",
        "unknown key `noisy`",
        "\"noisy.x\"",
        "did you mean `noise`?",
    );
    refused(
        "\"noise.rotation_sigma_rad\" = -1.0",
        "-1 is below 0",
        "-1.0",
        "0 or a number",
    );
    refused(
        "\"steps.of.run\" = 1",
        "there is no `steps.of.run`",
        "\"steps.of.run\"",
        "`steps` in",
    );
    refused(
        "\"robot.start_cm[0]\" = 1",
        "there is no `robot.start_cm[0]`",
        "\"robot.start_cm[0]\"",
        "no such part",
    );
}

#[test]
fn an_override_that_clashes_with_the_scenario_is_blamed() {
    refused(
        "\"sensor.min_range_cm\" = 4.0\nsteps = 5",
        "with this override, the sensor sees from 4 cm",
        "\"sensor.min_range_cm\" = 4.0",
        "above 4",
    );
    refused(
        "\"planners.combined.nearest_count\" = 3",
        "both",
        "3",
        "keep one",
    );
    refused(
        "\"motion.deformation.anchored.anchor\" = 20",
        "no feature 20",
        "20",
        "0 to 13",
    );
    refused(
        "noise.rotation_sigma_rad = 0.1",
        "not in quotes",
        "noise",
        "in quotes",
    );
}

#[test]
fn wrong_configurations() {
    let with = |from: &str, to: &str| {
        assert!(ONE.contains(from));
        loaded(&ONE.replacen(from, to, 1))
    };
    assert_error(
        with("global", "globel"),
        "`globel` is not one",
        "\"globel\"",
        "did you mean `global`?",
    );
    assert_error(
        with("\"global\"", "\"local\", \"local\""),
        "listed twice",
        "\"local\"",
        "once",
    );
    assert_error(
        with("\"global\"", ""),
        "the list is empty",
        "[]",
        "at least one",
    );
    assert_error(
        with("polygon.toml", "polygone.toml"),
        "does not exist",
        "\"polygone.toml\"",
        "paths count",
    );
    assert_error(
        with("polygon.toml", "."),
        "is not a file",
        "\".\"",
        "paths count",
    );
    assert_error(
        with("title = \"one\"\n", ""),
        "the key `title` is missing",
        "",
        "add `title",
    );
    assert_error(
        with("title = \"one\"", "title = \"one\"\nruns = 0"),
        "0 is too small",
        "0",
        "from 1",
    );
    assert_error(
        with(
            "title = \"one\"",
            "title = \"one\"\npublished = \"none.toml\"",
        ),
        "does not exist",
        "\"none.toml\"",
        "paths count",
    );
    assert_error(
        with("scenario =", "scenari ="),
        "unknown key `scenari`",
        "scenari",
        "did you mean `scenario`?",
    );
    assert_error(
        loaded("title = \"x\"\nexperiments = []"),
        "the list is empty",
        "[]",
        "at least one",
    );
    let twice = format!("{ONE}{}", ONE.replace("title = \"one\"\n", ""));
    assert_error(
        loaded(&twice),
        "both called \"polygon\"",
        "\"polygon.toml\"",
        "label = ",
    );
    let published = format!("{ONE}published = \"polygon\"\n");
    assert_error(
        loaded(&published),
        "no published tables",
        "\"polygon\"",
        "add `published",
    );
    let published = format!("published = \"published.toml\"\n{ONE}published = \"polygn\"\n");
    assert_error(
        loaded(&published),
        "have no \"polygn\"",
        "\"polygn\"",
        "did you mean \"polygon\"?",
    );
}

#[test]
fn a_fault_of_the_scenario_is_shown_in_the_scenario() {
    let folder = Folder::with(ONE);
    fs::write(
        folder.path("polygon.toml"),
        POLYGON.replace("range_cm = 3.0", "range_cm = -1"),
    )
    .unwrap();
    let error = Config::load(&folder.path("config.toml")).unwrap_err();
    assert!(error.path().ends_with("polygon.toml"));
    assert_eq!(error.pointed_at(), Some("-1"));
}

#[test]
fn wrong_published_tables() {
    let folder = Folder::with(ONE);
    let path = folder.path("published.toml");
    let text = fs::read_to_string(&path).unwrap();
    let with = |from: &str, to: &str| {
        assert!(text.contains(from));
        fs::write(&path, text.replacen(from, to, 1)).unwrap();
        Published::load(&path)
    };
    assert_error(
        with("[35, 24,", "[35,"),
        "5 runs in `observed`, 4 here",
        "[35, 24, 25, 24]",
        "each run",
    );
    assert_error(
        with("[35, 24,", "[35, 0,"),
        "integer `0`",
        "0",
        "\"-\" for never",
    );
    assert_error(
        with("[35, 24,", "[35, \"x\","),
        "string \"x\"",
        "\"x\"",
        "a step from 1",
    );
    assert_error(
        with("planners.global", "planners.golbal"),
        "`golbal` is not one",
        "golbal",
        "did you mean `global`?",
    );
}

#[test]
fn a_file_is_known_by_its_keys() {
    let folder = Folder::with(ONE);
    for (name, kind) in [
        ("polygon.toml", FileKind::Scenario),
        ("heart.toml", FileKind::Scenario),
        ("config.toml", FileKind::Configuration),
        ("published.toml", FileKind::Published),
    ] {
        assert_eq!(check_file(&folder.path(name)).unwrap(), kind, "{name}");
    }
    fs::write(folder.path("other.toml"), "colour = 3\n").unwrap();
    let error = check_file(&folder.path("other.toml")).unwrap_err();
    assert!(
        error
            .message()
            .contains("neither a scenario nor a configuration"),
        "{error}"
    );
    assert!(
        check_file(folder.0.path())
            .unwrap_err()
            .message()
            .contains("folder")
    );
    let mesh = HEART.replace("[object.phantom]", "[object.mesh]\nfile = \"none.stl\"");
    fs::write(folder.path("mesh.toml"), mesh).unwrap();
    assert_error(
        check_file(&folder.path("mesh.toml")),
        "there is no file",
        "\"none.stl\"",
        "folder",
    );
}

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig {
        cases: 128, failure_persistence: None, ..Default::default()
    })]

    #[test]
    fn no_override_panics(
        path in "[a-z_.\\[\\]0-9]{0,30}|(noise|object|motion|robot|steps)[a-z_.\\[\\]0-9]{0,20}",
        value in proptest::sample::select(vec!["1", "{}", "[]", "\"x\"", "{ a = [1] }", "nan"]),
    ) {
        let config = format!("{ONE}[experiments.set]\n\"{path}\" = {value}\n");
        if let Err(error) = loaded(&config) {
            drop(crate::scenario::tests::miette_report(&error));
        }
    }
}
