//! The loop of one run.

use std::time::Instant;

use adslam_estimator::{
    Belief, Ekf, EstimatorError, FeatureMeasurement, Measurements, StructureMeasurements,
};
use adslam_models::{FeatureId, Pose};
use adslam_planning::{Decision, Situation, features_seen_in_pose};
use adslam_surface::Surface;
use nalgebra::{Matrix6, Point3};

use super::{Interrupt, Setup, build_planner};
use crate::ExperimentError;
use crate::metrics::{RunSummary, StepMetrics, SummaryBuilder, measure_step};
use crate::scenario::PlannerName;
use crate::world::World;

/// Everything about one step, as it stands after the filter's update.
#[derive(Clone, Copy, Debug)]
pub struct StepView<'a> {
    /// n; the start is 1.
    pub step: usize,
    /// The true pose.
    pub pose: &'a Pose,
    /// The true features, cm, world.
    pub features: &'a [Point3<f64>],
    /// What the filter believes.
    pub belief: &'a Belief,
    /// The features that the robot really sees.
    pub visible: &'a [FeatureId],
    /// The errors.
    pub metrics: &'a StepMetrics,
    /// Signed distance of the true robot from the true surface, cm, negative inside.
    pub surface_distance: f64,
    /// The decision that led here, and how long it took in ms; none at the start.
    pub decision: Option<(&'a Decision, f64)>,
}

/// Watches a run: writes it down, draws it, or stops it with an error.
pub trait Observer {
    /// Called after every step, the start included.
    ///
    /// # Errors
    /// Whatever the observer cannot go on with; it ends the run.
    fn step(&mut self, view: &StepView<'_>) -> Result<(), ExperimentError>;
}

/// Watches nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoObserver;

impl Observer for NoObserver {
    fn step(&mut self, _: &StepView<'_>) -> Result<(), ExperimentError> {
        Ok(())
    }
}

/// The result of a run.
#[derive(Clone, Debug)]
pub struct RunOutcome {
    /// Its numbers.
    pub summary: RunSummary,
    /// What its user should know, such as features that no viewpoint sees.
    pub warnings: Vec<String>,
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
    let run = Run {
        setup,
        name: format!("{}, {planner}, seed {seed}", setup.name),
    };
    run.simulate(planner, seed, interrupt, observer)
}

/// The true robot against the true object.
struct Sight {
    visible: Vec<FeatureId>,
    surface_distance: f64,
}

struct Run<'a> {
    setup: &'a Setup,
    name: String,
}

impl Run<'_> {
    fn simulate(
        &self,
        planner: PlannerName,
        seed: u64,
        interrupt: &Interrupt,
        observer: &mut dyn Observer,
    ) -> Result<RunOutcome, ExperimentError> {
        let setup = self.setup;
        let mut world = World::new(&setup.world, seed);
        let filter_failed = |step| move |source| self.filter_failed(step, source);
        let ekf = Ekf::new(setup.planning.noise).map_err(filter_failed(1))?;
        let first = world.first_estimate();
        let sigma = setup.initial_feature_sigma;
        let mut belief = Belief::initial(setup.world.start, first, &Matrix6::zeros(), sigma)
            .map_err(filter_failed(1))?;
        let (mut planner, warnings) = build_planner(setup, planner, &belief, seed)
            .map_err(|source| self.planning_failed(1, source))?;

        let mut builder = SummaryBuilder::new(world.features().len());
        let sight = self.look(&world)?;
        self.finish_step(&world, &belief, &sight, None, &mut builder, observer)?;
        for step in 2..=setup.steps {
            if interrupt.requested() {
                return Err(ExperimentError::Interrupted);
            }
            let feature_motion = setup.known_feature_motion(step - 1);
            let situation = Situation {
                belief: &belief,
                feature_motion: &feature_motion,
                model: &setup.planning,
            };
            let start = Instant::now();
            let decision = planner
                .decide(&situation)
                .map_err(|source| self.planning_failed(step - 1, source))?;
            let milliseconds = start.elapsed().as_secs_f64() * 1e3;
            builder.add_decision(milliseconds, decision.compromised);

            world.advance(&decision.control);
            let sight = self.look(&world)?;
            let measured = world.measure(&sight.visible);
            let features: Vec<FeatureMeasurement> = measured
                .features
                .iter()
                .map(|&(feature, z)| FeatureMeasurement { feature, z })
                .collect();
            let structure = if setup.planning.measures_structure {
                StructureMeasurements::AllPairsSummed(&measured.structure_sums)
            } else {
                StructureMeasurements::None
            };
            ekf.predict(&mut belief, &decision.control, &feature_motion)
                .and_then(|()| {
                    ekf.update(
                        &mut belief,
                        &Measurements {
                            features: &features,
                            structure,
                        },
                    )
                })
                .map_err(filter_failed(step))?;
            let decision = Some((&decision, milliseconds));
            self.finish_step(&world, &belief, &sight, decision, &mut builder, observer)?;
        }
        Ok(RunOutcome {
            summary: builder.finish(seed),
            warnings,
        })
    }

    /// Where the true robot is to the true object, and what it sees of it.
    fn look(&self, world: &World<'_>) -> Result<Sight, ExperimentError> {
        let model = &self.setup.planning;
        let surface = Surface::new(&model.topology, world.features())
            .map_err(|error| self.not_simulated(world.step(), error.to_string()))?;
        Ok(Sight {
            visible: features_seen_in_pose(&model.sensor, world.pose(), &surface),
            surface_distance: surface.signed_distance(&world.pose().position),
        })
    }

    fn finish_step(
        &self,
        world: &World<'_>,
        belief: &Belief,
        sight: &Sight,
        decision: Option<(&Decision, f64)>,
        builder: &mut SummaryBuilder,
        observer: &mut dyn Observer,
    ) -> Result<(), ExperimentError> {
        let step = world.step();
        let metrics = measure_step(belief, world.pose(), world.features())
            .ok_or_else(|| self.not_simulated(step, "the estimate is not finite".to_owned()))?;
        let clearance = self.setup.planning.clearance;
        let seen = sight.visible.iter().map(|feature| feature.0);
        builder.add_step(step, seen, &metrics, sight.surface_distance, clearance);
        observer.step(&StepView {
            step,
            pose: world.pose(),
            features: world.features(),
            belief,
            visible: &sight.visible,
            metrics: &metrics,
            surface_distance: sight.surface_distance,
            decision,
        })
    }

    fn filter_failed(&self, step: usize, source: EstimatorError) -> ExperimentError {
        ExperimentError::Filter {
            run: self.name.clone(),
            step,
            source,
        }
    }

    fn planning_failed(
        &self,
        step: usize,
        source: adslam_planning::PlanningError,
    ) -> ExperimentError {
        ExperimentError::Planning {
            run: self.name.clone(),
            step,
            source,
        }
    }

    fn not_simulated(&self, step: usize, reason: String) -> ExperimentError {
        ExperimentError::Simulation {
            run: self.name.clone(),
            step,
            reason,
        }
    }
}
