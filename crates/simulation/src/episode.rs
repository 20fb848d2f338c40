//! One run, a step at a time.

use std::sync::Arc;
use std::time::Instant;

use adslam_agent::{Agent, StepInput};
use adslam_estimator::{Belief, FeatureMeasurement, Measurements, StructureMeasurements};
use adslam_models::{Control, FeatureId, State};
use adslam_planning::{Decision, Planner, Situation, features_seen_in_pose};
use adslam_surface::Surface;
use nalgebra::{Matrix6, Vector3};

use crate::{
    DriftFloor, EpisodeError, EpisodeModel, RunSummary, RunWatch, StepMetrics, StepView,
    SummaryBuilder, World, measure_step,
};

/// A run between two steps: the world, the agent in it, and how well it does.
pub struct Episode {
    model: EpisodeModel,
    seed: u64,
    world: World,
    sight: Sight,
    agent: Agent,
    deadline_ms: Option<f64>,
    known_motion: Vec<Vector3<f64>>,
    metrics: StepMetrics,
    drift_floor: DriftFloor,
    builder: SummaryBuilder,
    watch: RunWatch,
    /// A decision that has not been taken yet, and how long it took, ms.
    pending: Option<(Decision, f64)>,
    taken: Option<Taken>,
}

/// The true robot against the true object.
struct Sight {
    visible: Vec<FeatureId>,
    surface_distance: f64,
}

/// What led to the present step.
struct Taken {
    control: Control,
    feature_motion: Vec<Vector3<f64>>,
    measured: Measured,
    decision: Option<(Decision, f64)>,
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

impl Episode {
    /// Step 1, without a planner. All noise comes from the streams of `seed`.
    ///
    /// # Errors
    /// Sigmas that cannot be used, or features that make no surface.
    pub fn start(model: &EpisodeModel, seed: u64) -> Result<Self, EpisodeError> {
        let model = model.clone();
        let mut world = World::new(Arc::clone(&model.world), seed);
        let features = world.first_estimate();
        let count = features.len();
        let failed = |cause| EpisodeError::Filter { step: 1, cause };
        let estimator = model.build_estimator().map_err(failed)?;
        let sigma = model.initial_feature_sigma;
        let belief = Belief::initial(model.world.start, features, &Matrix6::zeros(), sigma)
            .map_err(failed)?;
        let agent = Agent::new(estimator, belief);
        let mut episode = Self {
            seed,
            sight: Sight::of(&world, &model)?,
            metrics: measured(&agent, &world)?,
            agent,
            deadline_ms: None,
            known_motion: model.known_feature_motion(1),
            drift_floor: DriftFloor::at_start(&model.world.noise, count),
            builder: SummaryBuilder::new(count).with_faults(model.world.faults.can_happen()),
            watch: RunWatch::new(model.viewpoint_reached_within),
            pending: None,
            taken: None,
            world,
            model,
        };
        episode.count();
        Ok(episode)
    }

    /// Has `planner` decide from now on; with a deadline, in ms, it takes the best that it has found by then.
    pub fn set_planner(&mut self, planner: Box<dyn Planner>, deadline_ms: Option<f64>) {
        self.agent
            .set_planner(planner, Arc::clone(&self.model.planning));
        self.deadline_ms = deadline_ms;
    }

    /// What a planner is shown at the present step.
    #[must_use]
    pub fn situation(&self) -> Situation<'_> {
        Situation {
            belief: self.agent.belief(),
            feature_motion: &self.known_motion,
            model: &self.model.planning,
            time_is_up: None,
        }
    }

    /// What the planner would do now. The decision counts once its control is taken.
    ///
    /// # Errors
    /// [`EpisodeError::Planning`], [`EpisodeError::NoPlanner`].
    pub fn decide(&mut self) -> Result<Decision, EpisodeError> {
        let step = self.world.step();
        let start = Instant::now();
        let time_is_up = self
            .deadline_ms
            .map(|limit| move || milliseconds_since(start) >= limit);
        let time_is_up = time_is_up
            .as_ref()
            .map(|late| late as &(dyn Fn() -> bool + Sync));
        let decision = self
            .agent
            .decide(&self.known_motion, time_is_up)
            .map_err(|cause| EpisodeError::Planning { step, cause })?
            .ok_or(EpisodeError::NoPlanner)?;
        self.pending = Some((decision.clone(), milliseconds_since(start)));
        Ok(decision)
    }

    /// Moves the robot by `control` and the object with it, measures, and has the filter take it in: from step n to
    /// n + 1. If it is the control that was decided, the decision is part of the step.
    ///
    /// # Errors
    /// [`EpisodeError::Filter`], [`EpisodeError::World`]; the episode is over then.
    pub fn take(&mut self, control: &Control) -> Result<(), EpisodeError> {
        self.world.advance(control);
        self.drift_floor.advance();
        self.sight = Sight::of(&self.world, &self.model)?;
        let measured_now = self.measure();
        let step = self.world.step();
        let feature_motion = std::mem::take(&mut self.known_motion);
        self.agent
            .step(&StepInput {
                control,
                feature_motion: &feature_motion,
                measurements: measured_now.measurements(),
            })
            .map_err(|cause| EpisodeError::Filter { step, cause })?;
        let decided = self.pending.take();
        self.taken = Some(Taken {
            control: *control,
            feature_motion,
            measured: measured_now,
            decision: decided.filter(|(decision, _)| decision.control == *control),
        });
        self.known_motion = self.model.known_feature_motion(step);
        self.metrics = measured(&self.agent, &self.world)?;
        self.count();
        Ok(())
    }

    /// Whether the last step has been taken. It may be gone beyond.
    #[must_use]
    pub fn is_over(&self) -> bool {
        self.world.step() >= self.model.steps
    }

    /// Everything about the present step.
    #[must_use]
    pub fn view(&self) -> StepView<'_> {
        let taken = self.taken.as_ref();
        StepView {
            step: self.world.step(),
            pose: self.world.pose(),
            features: self.world.features(),
            belief: self.agent.belief(),
            visible: &self.sight.visible,
            metrics: &self.metrics,
            input: taken.map(|taken| StepInput {
                control: &taken.control,
                feature_motion: &taken.feature_motion,
                measurements: taken.measured.measurements(),
            }),
            update: taken.map(|_| self.agent.report()),
            drift_floor: self.drift_floor.expected_error(),
            surface_distance: self.sight.surface_distance,
            decision: taken.and_then(|taken| {
                let (decision, milliseconds) = taken.decision.as_ref()?;
                Some((decision, *milliseconds))
            }),
            scores: self.agent.scores(),
            viewpoints: self.agent.viewpoints(),
        }
    }

    /// What the robot believes.
    #[must_use]
    pub fn belief(&self) -> &Belief {
        self.agent.belief()
    }

    /// The environment.
    #[must_use]
    pub fn model(&self) -> &EpisodeModel {
        &self.model
    }

    /// The run so far in numbers.
    #[must_use]
    pub fn summary(&self) -> RunSummary {
        self.builder.clone().finish(self.seed)
    }

    /// What the user should know of the run so far. What stands in brackets at the end of a warning may differ from run
    /// to run.
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        self.watch.warnings()
    }

    /// What the world lets the robot measure, as far as the filter is let know it.
    fn measure(&mut self) -> Measured {
        let simulated = self.world.measure(&self.sight.visible);
        let features: Vec<FeatureMeasurement> = simulated
            .features
            .iter()
            .map(|&(feature, z)| FeatureMeasurement { feature, z })
            .collect();
        self.sight.visible = features.iter().map(|measured| measured.feature).collect();
        let takes_structure = self.model.planning.measures_structure;
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

    /// Adds the present step to the summary and to what is watched.
    fn count(&mut self) {
        let step = self.world.step();
        let seen = self.sight.visible.iter().map(|feature| feature.0);
        let (distance, clearance) = (self.sight.surface_distance, self.model.planning.clearance);
        self.builder
            .add_step(step, seen, &self.metrics, distance, clearance);
        self.builder
            .add_drift_floor(self.drift_floor.expected_error());
        if let Some(taken) = &self.taken {
            if let Some((decision, milliseconds)) = &taken.decision {
                self.builder.add_decision(*milliseconds, decision);
            }
            self.builder.add_update(self.agent.report());
        }
        let mut watch = std::mem::take(&mut self.watch);
        watch.step(&self.view());
        self.watch = watch;
    }
}

/// How far the belief is from the truth.
fn measured(agent: &Agent, world: &World) -> Result<StepMetrics, EpisodeError> {
    let truth = State {
        pose: *world.pose(),
        features: world.features().to_vec(),
    };
    let belief = agent.belief();
    let error = agent.estimator().error(&belief.state, &truth);
    measure_step(belief, &truth, &error).ok_or_else(|| EpisodeError::World {
        step: world.step(),
        cause: "the estimate is not finite".into(),
    })
}

impl Sight {
    fn of(world: &World, model: &EpisodeModel) -> Result<Self, EpisodeError> {
        let planning = &model.planning;
        let surface = Surface::new(&planning.topology, world.features()).map_err(|error| {
            EpisodeError::World {
                step: world.step(),
                cause: error.into(),
            }
        })?;
        Ok(Self {
            visible: features_seen_in_pose(&planning.sensor, world.pose(), &surface),
            surface_distance: surface.signed_distance(&world.pose().position),
        })
    }
}

fn milliseconds_since(start: Instant) -> f64 {
    start.elapsed().as_secs_f64() * 1e3
}
