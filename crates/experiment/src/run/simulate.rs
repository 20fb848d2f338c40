//! The loop of one run.

use std::time::Instant;

use adslam_estimator::{
    Belief, Estimator, EstimatorError, FeatureMeasurement, Measurements, StructureMeasurements,
    UpdateReport,
};
use adslam_models::{Control, FeatureId, State};
use adslam_planning::{Decision, Planner, Situation, features_seen_in_pose};
use adslam_surface::Surface;
use nalgebra::{Matrix6, Vector3};

use super::name::RunName;
use super::watch::RunWatch;
use super::{FilterInput, Interrupt, Observer, RunHistory, Setup, StepView, build_planner};
use crate::ExperimentError;
use crate::metrics::{DriftFloor, RunSummary, SummaryBuilder, measure_step};
use crate::scenario::PlannerName;
use crate::world::World;

/// The result of a run.
#[derive(Clone, Debug)]
pub struct RunOutcome {
    /// Its numbers.
    pub summary: RunSummary,
    /// What its user should know, such as features that no viewpoint sees. What stands in brackets at the end of a
    /// warning may differ from run to run.
    pub warnings: Vec<String>,
    /// Every step of it, where a [`Batch`](super::Batch) was to record it.
    pub history: Option<RunHistory>,
}

/// Runs one planner at one seed.
///
/// # Errors
/// [`ExperimentError::Interrupted`] when asked to stop, or a failure of planner or filter, with
/// its step.
pub fn simulate(
    setup: &Setup,
    planner: PlannerName,
    seed: u64,
    interrupt: &Interrupt,
    observer: &mut dyn Observer,
) -> Result<RunOutcome, ExperimentError> {
    let name = RunName(format!("{}, {planner}, seed {seed}", setup.name));
    let (mut run, mut warnings) = Run::start(setup, name, planner, seed)?;
    run.observe(None, observer)?;
    for _ in 1..setup.steps {
        if interrupt.requested() {
            return Err(ExperimentError::Interrupted);
        }
        let decided = run.advance()?;
        run.observe(Some(&decided), observer)?;
    }
    warnings.extend(run.watch.warnings());
    Ok(RunOutcome {
        summary: run.builder.finish(seed),
        warnings,
        history: None,
    })
}

/// A run between two steps.
struct Run<'a> {
    setup: &'a Setup,
    name: RunName,
    world: World<'a>,
    sight: Sight,
    estimator: Box<dyn Estimator>,
    belief: Belief,
    planner: Box<dyn Planner>,
    builder: SummaryBuilder,
    watch: RunWatch,
    drift_floor: DriftFloor,
    deadline_ms: Option<f64>,
}

/// The true robot against the true object.
struct Sight {
    visible: Vec<FeatureId>,
    surface_distance: f64,
}

/// A decision, how long it took in ms, and what came of it.
struct Decided {
    decision: Decision,
    milliseconds: f64,
    feature_motion: Vec<Vector3<f64>>,
    measured: Measured,
    update: UpdateReport,
}

/// What the filter is let know of a step's measurements.
struct Measured {
    features: Vec<FeatureMeasurement>,
    structure_sums: Option<Vec<Vector3<f64>>>,
}

impl Measured {
    fn measurements(&self) -> Measurements<'_> {
        Measurements {
            features: &self.features,
            structure: match &self.structure_sums {
                Some(sums) => StructureMeasurements::AllPairsSummed(sums),
                None => StructureMeasurements::None,
            },
        }
    }
}

impl<'a> Run<'a> {
    /// Step 1, and what the user should know.
    fn start(
        setup: &'a Setup,
        name: RunName,
        planner: PlannerName,
        seed: u64,
    ) -> Result<(Self, Vec<String>), ExperimentError> {
        let mut world = World::new(&setup.world, seed);
        let features = world.first_estimate();
        let sigma = setup.initial_feature_sigma;
        let estimator = setup.build_estimator().map_err(name.filter_failed(1))?;
        let belief = Belief::initial(setup.world.start, features, &Matrix6::zeros(), sigma)
            .map_err(name.filter_failed(1))?;
        let deadline_ms = setup.scenario.deadline_ms(planner);
        let watch = RunWatch::new(setup, planner);
        let (planner, warnings) =
            build_planner(setup, planner, &belief, seed).map_err(name.planner_failed(1))?;
        let run = Self {
            setup,
            sight: Sight::of(&world, setup, &name)?,
            builder: SummaryBuilder::new(world.features().len())
                .with_faults(setup.world.faults.can_happen()),
            watch,
            drift_floor: DriftFloor::at_start(&setup.world.noise, world.features().len()),
            name,
            world,
            estimator,
            belief,
            planner,
            deadline_ms,
        };
        Ok((run, warnings))
    }

    /// Decides, moves the world and updates the belief: from step n to n + 1.
    fn advance(&mut self) -> Result<Decided, ExperimentError> {
        let n = self.world.step();
        let feature_motion = self.setup.known_feature_motion(n);
        let start = Instant::now();
        let time_is_up = self
            .deadline_ms
            .map(|limit| move || milliseconds_since(start) >= limit);
        let situation = Situation {
            belief: &self.belief,
            feature_motion: &feature_motion,
            model: &self.setup.planning,
            time_is_up: time_is_up.as_ref().map(|late| late as &dyn Fn() -> bool),
        };
        let decision = self
            .planner
            .decide(&situation)
            .map_err(self.name.planner_failed(n))?;
        let milliseconds = milliseconds_since(start);

        self.world.advance(&decision.control);
        self.drift_floor.advance();
        self.sight = Sight::of(&self.world, self.setup, &self.name)?;
        let measured = self.measure();
        let update = self
            .filter(&decision.control, &feature_motion, &measured)
            .map_err(self.name.filter_failed(n + 1))?;
        Ok(Decided {
            decision,
            milliseconds,
            feature_motion,
            measured,
            update,
        })
    }

    /// What the world lets the robot measure, as far as the scenario lets the filter know it.
    fn measure(&mut self) -> Measured {
        let simulated = self.world.measure(&self.sight.visible);
        let features: Vec<FeatureMeasurement> = simulated
            .features
            .iter()
            .map(|&(feature, z)| FeatureMeasurement { feature, z })
            .collect();
        self.sight.visible = features.iter().map(|measured| measured.feature).collect();
        let takes_structure = self.setup.planning.measures_structure;
        let mut faults = simulated.faults;
        if !takes_structure {
            faults.dropped_structures = 0;
        }
        self.builder.add_faults(faults);
        let structure_sums = simulated.structure_sums.filter(|_| takes_structure);
        Measured {
            features,
            structure_sums,
        }
    }

    /// Algorithm 1.
    fn filter(
        &mut self,
        control: &Control,
        feature_motion: &[Vector3<f64>],
        measured: &Measured,
    ) -> Result<UpdateReport, EstimatorError> {
        self.estimator
            .predict(&mut self.belief, control, feature_motion)?;
        self.estimator
            .update(&mut self.belief, &measured.measurements())
    }

    /// Adds the present step to the summary and shows it to the observer.
    fn observe(
        &mut self,
        decided: Option<&Decided>,
        observer: &mut dyn Observer,
    ) -> Result<(), ExperimentError> {
        let (world, belief, sight) = (&self.world, &self.belief, &self.sight);
        let step = world.step();
        let truth = State {
            pose: *world.pose(),
            features: world.features().to_vec(),
        };
        let error = self.estimator.error(&belief.state, &truth);
        let metrics = measure_step(belief, &truth, &error).ok_or_else(|| {
            self.name
                .not_simulated(step, "the estimate is not finite".to_owned())
        })?;
        let clearance = self.setup.planning.clearance;
        let seen = sight.visible.iter().map(|feature| feature.0);
        self.builder
            .add_step(step, seen, &metrics, sight.surface_distance, clearance);
        let drift_floor = self.drift_floor.expected_error();
        self.builder.add_drift_floor(drift_floor);
        if let Some(decided) = decided {
            self.builder
                .add_decision(decided.milliseconds, &decided.decision);
            self.builder.add_update(&decided.update);
        }
        let view = StepView {
            step,
            pose: world.pose(),
            features: world.features(),
            belief,
            visible: &sight.visible,
            metrics: &metrics,
            input: decided.map(|decided| FilterInput {
                control: &decided.decision.control,
                feature_motion: &decided.feature_motion,
                measurements: decided.measured.measurements(),
            }),
            update: decided.map(|decided| &decided.update),
            drift_floor,
            surface_distance: sight.surface_distance,
            decision: decided.map(|decided| (&decided.decision, decided.milliseconds)),
            scores: self.planner.scores(),
            viewpoints: self.planner.viewpoints(),
        };
        self.watch.step(&view);
        observer.step(&view)
    }
}

impl Sight {
    fn of(world: &World<'_>, setup: &Setup, name: &RunName) -> Result<Self, ExperimentError> {
        let model = &setup.planning;
        let surface = Surface::new(&model.topology, world.features())
            .map_err(|error| name.not_simulated(world.step(), error.to_string()))?;
        Ok(Self {
            visible: features_seen_in_pose(&model.sensor, world.pose(), &surface),
            surface_distance: surface.signed_distance(&world.pose().position),
        })
    }
}

fn milliseconds_since(start: Instant) -> f64 {
    start.elapsed().as_secs_f64() * 1e3
}
