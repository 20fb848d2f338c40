//! A configuration with several estimators, made ready to run.

use std::path::Path;

use adslam_diagnostics::{Failure, InputError, Interrupt};
use adslam_names::{EstimatorName, PlannerName};
use adslam_scenario::config::{Config, ExperimentPlan, Selection};
use adslam_scenario::registry::Registry;
use adslam_setup::Setup;

use super::ConsistencyRecord;
use crate::run::simulate;
use crate::study::{OtherBuilds, Study, StudyPlan, StudyPoint, StudyUnit, points};

/// Every planner of every experiment with each of the estimators.
#[derive(Debug)]
pub struct ConsistencyPlan {
    /// The configuration's title.
    pub title: String,
    pub(super) runs: usize,
    pub(super) first_seed: u64,
    pub(super) points: Vec<Point>,
}

/// An experiment with one estimator.
#[derive(Debug)]
pub(super) struct Point {
    pub(super) plan: ExperimentPlan,
    pub(super) estimator: EstimatorName,
    pub(super) setup: Setup,
}

/// Runs with the same experiment, estimator and planner.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell<'a> {
    pub(super) point: &'a Point,
    pub(super) planner: PlannerName,
}

impl ConsistencyPlan {
    /// Reads the configuration at `path`, builds what is selected of it, and sets each of the estimators in
    /// place of the scenarios' own; one that is named twice counts once.
    ///
    /// # Errors
    /// Anything wrong with a file, an unknown label, no runs to do, or too many.
    pub fn load(
        path: &Path,
        selection: &Selection,
        estimators: &[EstimatorName],
    ) -> Result<Self, InputError> {
        Self::load_with(path, selection, estimators, &Registry::standard())
    }

    /// The same for a program with planners of its own.
    ///
    /// # Errors
    /// As [`ConsistencyPlan::load`].
    pub fn load_with(
        path: &Path,
        selection: &Selection,
        estimators: &[EstimatorName],
        registry: &Registry,
    ) -> Result<Self, InputError> {
        let mut each_once: Vec<EstimatorName> = Vec::new();
        for estimator in estimators {
            if !each_once.contains(estimator) {
                each_once.push(*estimator);
            }
        }
        let config = Config::load_with(path, registry)?.select_times(selection, each_once.len())?;
        let mut points = Vec::new();
        let setups = Setup::of_all(config.experiments.iter().map(|plan| &plan.scenario))?;
        for (plan, setup) in config.experiments.iter().zip(setups) {
            for &estimator in &each_once {
                let setup = setup.with_estimator(estimator);
                points.push(Point {
                    plan: plan.clone(),
                    estimator,
                    setup: setup.map_err(|unknown| InputError::about_file(path, unknown))?,
                });
            }
        }
        Ok(Self {
            title: config.title,
            runs: config.runs,
            first_seed: config.first_seed,
            points,
        })
    }

    /// How many runs there are in all.
    #[must_use]
    pub fn total_runs(&self) -> usize {
        self.cells().count() * self.runs
    }

    /// What the user should know before running.
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        points::warnings(self.points())
    }

    /// Every point with its planners.
    fn points(&self) -> impl Iterator<Item = StudyPoint<'_>> + Clone {
        self.points.iter().map(|point| StudyPoint {
            setup: &point.setup,
            planners: &point.plan.planners,
            label: None,
        })
    }

    /// Begins the study in `folder`, resumes it, or lets it grow.
    ///
    /// # Errors
    /// As [`Study::open`].
    pub fn open(
        &self,
        folder: &Path,
        other_builds: OtherBuilds,
    ) -> Result<Study<'_, ConsistencyRecord>, Failure> {
        Study::open(folder, &self.study(), other_builds)
    }

    /// Does one run: the work of the study.
    ///
    /// # Errors
    /// As [`simulate`].
    pub fn run(unit: &StudyUnit<'_>, interrupt: &Interrupt) -> Result<ConsistencyRecord, Failure> {
        let mut record = ConsistencyRecord::default();
        let outcome = simulate(unit.setup, unit.planner, unit.seed, interrupt, &mut record)?;
        record.summary = Some(outcome.summary);
        record.warnings = outcome.warnings;
        Ok(record)
    }

    /// Experiment by experiment, estimator by estimator, planner by planner.
    pub(super) fn cells(&self) -> impl Iterator<Item = Cell<'_>> {
        self.points.iter().flat_map(|point| {
            let planners = point.plan.planners.iter();
            planners.map(move |&planner| Cell { point, planner })
        })
    }

    fn study(&self) -> StudyPlan<'_> {
        StudyPlan {
            kind: "consistency study",
            points: self.points().collect(),
            first_seed: self.first_seed,
            runs: self.runs,
        }
    }
}
