//! A replay in a few numbers.

use adslam_agent::GateProbability;
use adslam_diagnostics::InputError;
use adslam_estimator::UpdateReport;
use adslam_names::{EstimatorName, LengthUnit, Named};
use adslam_simulation::{GateWatch, RunSummary, StepMetrics, SummaryBuilder};
use serde::Serialize;

use super::format::LogHeader;

/// How far a replay came, and what it found.
#[derive(Debug)]
pub struct ReplaySummary {
    /// Estimates made.
    pub steps: usize,
    /// M.
    pub features: usize,
    /// The unit of the log's lengths.
    pub length_unit: LengthUnit,
    /// The estimator that was taken.
    pub estimator: EstimatorName,
    /// The part of good feature measurements that passed its gate; absent where it had none.
    pub gate_probability: Option<GateProbability>,
    /// Consistency, and errors where the log has a truth.
    pub numbers: ReplayNumbers,
    /// What the user should know of it.
    pub warnings: Vec<String>,
    /// Why it ended before the end of the log, with [`TailPolicy::KeepComplete`](super::TailPolicy).
    pub stopped_by: Option<InputError>,
}

/// The numbers of a replay under the names that they have in `summary.json`; lengths in the log's unit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ReplayNumbers {
    /// NIS of the feature measurements that were used, over their numbers; 1 is consistent.
    pub feature_nis_per_dof: Option<f64>,
    /// NIS of the structure measurements, over their numbers; 1 is consistent.
    pub structure_nis_per_dof: Option<f64>,
    /// Feature measurements that the gate kept out.
    pub rejected_measurements: usize,
    /// Over the steps of which the log has the truth; absent where there are none.
    #[serde(flatten)]
    pub errors: Option<ReplayErrors>,
}

/// The errors of a replay; see [`RunSummary`], whose numbers of the same names they are.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the same as in RunSummary")]
pub struct ReplayErrors {
    pub pose_error_mean: f64,
    pub pose_error_max: f64,
    pub geodesic_orientation_error_mean: Option<f64>,
    pub position_error_mean: Option<f64>,
    pub feature_error_mean: f64,
    pub feature_error_max: f64,
    pub relative_pose_error_mean: f64,
    pub relative_geodesic_orientation_error_mean: Option<f64>,
    pub relative_position_error_mean: Option<f64>,
    pub relative_feature_error_mean: f64,
    pub pose_nees_mean: Option<f64>,
    pub feature_nees_mean: Option<f64>,
    pub joint_nees_per_dof_mean: Option<f64>,
}

/// Adds up a replay, step by step.
pub(super) struct SummingUp {
    builder: SummaryBuilder,
    has_truth: bool,
    summary: ReplaySummary,
    gate_watch: GateWatch,
}

impl SummingUp {
    pub(super) fn new(
        header: &LogHeader,
        (estimator, gate_probability): (EstimatorName, Option<GateProbability>),
    ) -> Self {
        Self {
            builder: SummaryBuilder::new(header.features),
            has_truth: false,
            summary: ReplaySummary {
                steps: 0,
                features: header.features,
                // It has been checked.
                length_unit: LengthUnit::named(&header.length_unit).unwrap_or_default(),
                estimator,
                gate_probability,
                numbers: ReplayNumbers {
                    feature_nis_per_dof: None,
                    structure_nis_per_dof: None,
                    rejected_measurements: 0,
                    errors: None,
                },
                warnings: Vec::new(),
                stopped_by: None,
            },
            gate_watch: GateWatch::default(),
        }
    }

    /// Adds the errors at a step of which the truth is known.
    pub(super) fn add_metrics(&mut self, metrics: Option<&StepMetrics>) {
        if let Some(metrics) = metrics {
            self.has_truth = true;
            // What a robot sees and how near it comes is not in a log.
            self.builder
                .add_step(1, [], metrics, f64::INFINITY, f64::NEG_INFINITY);
        }
    }

    /// Adds what the update at a step said about the filter.
    pub(super) fn add_update(&mut self, step: u64, report: &UpdateReport) {
        self.summary.steps += 1;
        self.gate_watch.add(step, report);
        self.builder.add_update(report);
    }

    /// The replay as a whole.
    pub(super) fn finish(self, stopped_by: Option<InputError>) -> ReplaySummary {
        let run = self.builder.finish(0);
        ReplaySummary {
            numbers: ReplayNumbers {
                feature_nis_per_dof: run.feature_nis_per_dof,
                structure_nis_per_dof: run.structure_nis_per_dof,
                rejected_measurements: run.rejected_measurements,
                errors: self.has_truth.then(|| ReplayErrors::from(&run)),
            },
            warnings: self.gate_watch.warning().into_iter().collect(),
            stopped_by,
            ..self.summary
        }
    }
}

impl From<&RunSummary> for ReplayErrors {
    fn from(run: &RunSummary) -> Self {
        Self {
            pose_error_mean: run.pose_error_mean,
            pose_error_max: run.pose_error_max,
            geodesic_orientation_error_mean: run.geodesic_orientation_error_mean,
            position_error_mean: run.position_error_mean,
            feature_error_mean: run.feature_error_mean,
            feature_error_max: run.feature_error_max,
            relative_pose_error_mean: run.relative_pose_error_mean,
            relative_geodesic_orientation_error_mean: run.relative_geodesic_orientation_error_mean,
            relative_position_error_mean: run.relative_position_error_mean,
            relative_feature_error_mean: run.relative_feature_error_mean,
            pose_nees_mean: run.pose_nees_mean,
            feature_nees_mean: run.feature_nees_mean,
            joint_nees_per_dof_mean: run.joint_nees_per_dof_mean,
        }
    }
}
