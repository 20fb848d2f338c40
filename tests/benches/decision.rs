//! Decisions of the local and the combined planner, on situations from runs of the shipped scenarios.
//!
//! `local_decision` and `combined_decision` time the scoring alone, of candidates whose visible sets are
//! known; `whole_decision` all that a planner does for one step, and `decision_parts` what is in it besides.
//! Variants: `fast`, the objective by visible sets; `direct`, an ordinary dense update of the
//! whole covariance for each action; `textbook`, every row stacked and S inverted. Elements are the
//! operations of `fast`.
#![allow(
    clippy::unwrap_used,
    reason = "a failed preparation is a failed benchmark"
)]

#[path = "../../crates/estimator/tests/common/mod.rs"]
mod textbook;

use std::sync::{LazyLock, OnceLock};
use std::time::Duration;

use adslam_diagnostics::{Failure, Interrupt};
use adslam_estimator::{
    Belief, DirectTrace, FeatureMeasurement, FilterNoise, PairMeasurement, PlannedMeasurement,
};
use adslam_experiment::run::simulate;
use adslam_models::FeatureId;
use adslam_names::PlannerName;
use adslam_planning::{
    ActionScorer, Candidate, ObjectSurfaces, PlanningNoise, SafeActions, Situation, VisibleSets,
};
use adslam_record::Observer;
use adslam_setup::{Setup, build_planner};
use adslam_simulation::StepView;
use adslam_tests::setup;
use criterion::{
    BenchmarkId, Criterion, SamplingMode, Throughput, criterion_group, criterion_main,
};
use nalgebra::{Point3, Vector3};

/// Steps of a run whose decisions are timed.
const STEPS: [usize; 5] = [5, 10, 15, 20, 25];
const SEED: u64 = 1;

/// A scenario and moments of runs of it, made when first asked for.
struct Case {
    name: &'static str,
    file: &'static str,
    features: Option<usize>,
    setup: OnceLock<Setup>,
    moments: [OnceLock<Vec<Moment>>; 4],
}

static CASES: LazyLock<[Case; 4]> = LazyLock::new(|| {
    let case = |name, file, features| Case {
        name,
        file,
        features,
        setup: OnceLock::new(),
        moments: Default::default(),
    };
    [
        case("polygon", "polygon.toml", None),
        case("heart50", "heart.toml", None),
        case("heart200", "heart.toml", Some(200)),
        case("heart500", "heart.toml", Some(500)),
    ]
});

/// What a planner knew at one step.
struct Moment {
    belief: Belief,
    feature_motion: Vec<Vector3<f64>>,
    goal: Option<Point3<f64>>,
}

struct Recorder<'a> {
    setup: &'a Setup,
    moments: Vec<Moment>,
}

impl Observer for Recorder<'_> {
    fn step(&mut self, view: &StepView<'_>) -> Result<(), Failure> {
        if STEPS.contains(&view.step) {
            let goal = view.decision.and_then(|(decision, _)| decision.goal);
            self.moments.push(Moment {
                belief: view.belief.clone(),
                feature_motion: self.setup.model.known_feature_motion(view.step),
                goal: goal.map(|(_, viewpoint)| viewpoint),
            });
        }
        if Some(&view.step) == STEPS.last() {
            return Err(Failure::Interrupted);
        }
        Ok(())
    }
}

impl Case {
    fn setup(&self) -> &Setup {
        self.setup.get_or_init(|| {
            let features = self.features.map(|count| format!("features = {count}"));
            let features = features.iter().map(|text| ("features = 50", text.as_str()));
            setup(self.file, &features.collect::<Vec<_>>())
        })
    }

    fn moments(&self, planner: PlannerName) -> &[Moment] {
        let place = PlannerName::PAPER
            .iter()
            .position(|known| *known == planner);
        self.moments[place.expect("one of the paper's")].get_or_init(|| {
            let mut recorder = Recorder {
                setup: self.setup(),
                moments: Vec::new(),
            };
            let interrupt = Interrupt::new();
            // The recorder ends it after the last of the steps.
            let _ = simulate(self.setup(), planner, SEED, &interrupt, &mut recorder);
            assert_eq!(recorder.moments.len(), STEPS.len());
            recorder.moments
        })
    }

    fn situation<'a>(&'a self, moment: &'a Moment) -> Situation<'a> {
        Situation {
            belief: &moment.belief,
            feature_motion: &moment.feature_motion,
            model: &self.setup().model.planning,
            time_is_up: None,
        }
    }

    fn noise(&self, planner: PlannerName) -> PlanningNoise {
        let scenario = &self.setup().scenario;
        PlanningNoise {
            feature_measurement_sigma: Some(match planner {
                PlannerName::COMBINED => scenario.combined_planning_sigma_cm(),
                _ => scenario.local_planning_sigma_cm(),
            }),
        }
    }
}

/// The candidates of one moment and what they see.
struct Candidates {
    safe: SafeActions,
    sets: VisibleSets,
    seen: Vec<Vec<FeatureId>>,
}

impl Candidates {
    fn of(case: &Case, planner: PlannerName, moment: &Moment) -> Self {
        let situation = case.situation(moment);
        let (mut surfaces, mut safe) = (ObjectSurfaces::default(), SafeActions::default());
        let [now, after] = surfaces.place(&situation).unwrap();
        safe.find(&situation, [now, after]).unwrap();
        if let Some(goal) = &moment.goal {
            let nearest = case.setup().scenario.planners.combined.nearest();
            safe.keep_nearest(goal, nearest.of(safe.candidates().len()));
        } else {
            assert_eq!(planner, PlannerName::LOCAL);
        }
        let model = &case.setup().model.planning;
        let mut sets = VisibleSets::default();
        sets.find(safe.candidates(), &model.actions, &model.sensor, after);
        let seen = (0..safe.candidates().len())
            .map(|candidate| {
                let mut ids = Vec::new();
                VisibleSets::features(sets.set(candidate), &mut ids);
                ids
            })
            .collect();
        Self { safe, sets, seen }
    }
}

fn direct(
    objective: &mut DirectTrace,
    moment: &Moment,
    noise: &FilterNoise,
    candidates: &Candidates,
    planned: &mut Vec<PlannedMeasurement>,
) -> f64 {
    objective
        .prepare(&moment.belief, &moment.feature_motion, noise, true)
        .unwrap();
    let mut best = f64::INFINITY;
    for (candidate, seen) in candidates.safe.candidates().iter().zip(&candidates.seen) {
        planned.clear();
        let sigma = noise.feature_measurement_sigma;
        planned.extend(
            seen.iter()
                .map(|&id| PlannedMeasurement::isotropic(id, sigma).unwrap()),
        );
        best = best.min(objective.after(&candidate.control, planned).unwrap());
    }
    best
}

fn textbook(moment: &Moment, noise: &FilterNoise, candidates: &Candidates) -> f64 {
    let belief = &moment.belief;
    let p = textbook::covariance_matrix(belief);
    let pairs: Vec<PairMeasurement> = textbook::every_pair(belief.state.features.len())
        .into_iter()
        .map(|(from, to)| PairMeasurement {
            from: FeatureId(from),
            to: FeatureId(to),
            z: Vector3::zeros(),
        })
        .collect();
    let trace = |(candidate, seen): (&Candidate, &Vec<FeatureId>)| {
        let z = Vector3::zeros();
        let features: Vec<FeatureMeasurement> = seen
            .iter()
            .map(|&feature| FeatureMeasurement { feature, z })
            .collect();
        let motion = &moment.feature_motion;
        let (state, p) = textbook::propagate(&belief.state, &p, &candidate.control, motion, noise);
        textbook::update(&state, &p, &features, &pairs, noise)
            .1
            .trace()
    };
    let all = candidates.safe.candidates().iter().zip(&candidates.seen);
    all.map(trace).fold(f64::INFINITY, f64::min)
}

/// Runs through the moments, one each time it is called.
fn in_turn<'a, T>(all: &'a [T]) -> impl FnMut() -> &'a T {
    let mut turn = all.iter().cycle();
    move || turn.next().unwrap()
}

fn scoring(c: &mut Criterion, name: &str, planner: PlannerName) {
    let mut group = c.benchmark_group(name);
    // Every sample runs through the moments equally often.
    group.sampling_mode(SamplingMode::Flat);
    for case in &*CASES {
        let noise = case.noise(planner);
        let candidates: Vec<(&Moment, Candidates)> = case
            .moments(planner)
            .iter()
            .map(|moment| (moment, Candidates::of(case, planner, moment)))
            .collect();

        let mut scorer = ActionScorer::new(noise);
        let mut score = |(moment, candidates): &(&Moment, Candidates)| {
            let safe = candidates.safe.candidates();
            let best = scorer.best(&case.situation(moment), safe, &candidates.sets);
            (best.unwrap().unwrap().trace, scorer.operations())
        };
        let operations: usize = candidates.iter().map(|moment| score(moment).1).sum();
        let mean = operations / candidates.len();
        group.throughput(Throughput::Elements(mean as u64));
        group.bench_function(BenchmarkId::new("fast", case.name), |b| {
            let mut next = in_turn(&candidates);
            b.iter(|| score(next()));
        });

        group.bench_function(BenchmarkId::new("direct", case.name), |b| {
            let mut next = in_turn(&candidates);
            let noise = noise.over(&case.setup().model.planning.noise);
            let (mut objective, mut planned) = (DirectTrace::default(), Vec::new());
            b.iter(|| {
                let (moment, candidates) = next();
                direct(&mut objective, moment, &noise, candidates, &mut planned)
            });
        });

        if case.name == "polygon" {
            group.bench_function(BenchmarkId::new("textbook", case.name), |b| {
                let mut next = in_turn(&candidates);
                let noise = noise.over(&case.setup().model.planning.noise);
                b.iter(|| {
                    let (moment, candidates) = next();
                    textbook(moment, &noise, candidates)
                });
            });
        }
    }
    group.finish();
}

fn local_decision(c: &mut Criterion) {
    scoring(c, "local_decision", PlannerName::LOCAL);
}

fn combined_decision(c: &mut Criterion) {
    scoring(c, "combined_decision", PlannerName::COMBINED);
}

fn whole_decision(c: &mut Criterion) {
    let mut group = c.benchmark_group("whole_decision");
    // Every sample runs through the moments equally often.
    group.sampling_mode(SamplingMode::Flat);
    for case in &*CASES {
        for planner in [
            PlannerName::LOCAL,
            PlannerName::COMBINED,
            PlannerName::GLOBAL,
        ] {
            group.bench_function(BenchmarkId::new(planner.to_string(), case.name), |b| {
                let moments = case.moments(planner);
                let mut next = in_turn(moments);
                let belief = &moments[0].belief;
                let (mut decider, _) = build_planner(case.setup(), planner, belief, SEED).unwrap();
                b.iter(|| decider.decide(&case.situation(next())).unwrap());
            });
        }
    }
    group.finish();
}

fn decision_parts(c: &mut Criterion) {
    let mut group = c.benchmark_group("decision_parts");
    // Every sample runs through the moments equally often.
    group.sampling_mode(SamplingMode::Flat);
    for case in &*CASES {
        group.bench_function(BenchmarkId::new("clearance", case.name), |b| {
            let mut next = in_turn(case.moments(PlannerName::LOCAL));
            let (mut surfaces, mut safe) = (ObjectSurfaces::default(), SafeActions::default());
            b.iter(|| {
                let situation = case.situation(next());
                let placed = surfaces.place(&situation).unwrap();
                safe.find(&situation, placed).unwrap();
                safe.safe()
            });
        });

        group.bench_function(BenchmarkId::new("visibility", case.name), |b| {
            let moments = case.moments(PlannerName::LOCAL);
            let candidates: Vec<(&Moment, Candidates)> = moments
                .iter()
                .map(|moment| (moment, Candidates::of(case, PlannerName::LOCAL, moment)))
                .collect();
            let mut next = in_turn(&candidates);
            let model = &case.setup().model.planning;
            let (mut surfaces, mut sets) = (ObjectSurfaces::default(), VisibleSets::default());
            b.iter(|| {
                let (moment, candidates) = next();
                let [_, after] = surfaces.place(&case.situation(moment)).unwrap();
                let safe = candidates.safe.candidates();
                sets.find(safe, &model.actions, &model.sensor, after);
                sets.set(0).len()
            });
        });
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(1000));
    targets = local_decision, combined_decision, whole_decision, decision_parts
}
criterion_main!(benches);
