//! One run in a few numbers: RUN of tables.json.

use adslam_estimator::{Nis, UpdateReport};
use adslam_planning::Decision;
use adslam_statistics::mean;
use serde::{Deserialize, Serialize};

use super::DecisionTimes;
use super::step::StepMetrics;
use crate::FaultCounts;

/// The result of one run. Pose errors mix radians and cm as eq. (11) does; lengths are cm.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RunSummary {
    /// The seed of all its noise.
    pub seed: u64,
    /// Observed feature times: visible features summed over the steps after the first.
    pub observed: usize,
    /// The first step (the start is step 1) by which every feature has been seen.
    pub steps_to_full_coverage: Option<usize>,
    /// Mean over all steps of eq. (11).
    pub pose_error_mean: f64,
    /// Mean over all steps of the drift floor: the error of the position that the noise alone is
    /// expected to cost, see [`DriftFloor`](super::DriftFloor), cm.
    pub drift_floor_mean: f64,
    /// Maximum over all steps of eq. (11).
    pub pose_error_max: f64,
    /// Mean over all steps of the geodesic distance of the estimated from the true orientation, rad.
    #[serde(default)]
    pub geodesic_orientation_error_mean: Option<f64>,
    /// Mean over all steps of the distance of the estimated from the true position, cm.
    #[serde(default)]
    pub position_error_mean: Option<f64>,
    /// Mean over the features of eq. (12) at the last step.
    pub feature_error_mean: f64,
    /// Maximum over the features of eq. (12) at the last step.
    pub feature_error_max: f64,
    /// Mean over all steps of the object-relative pose error.
    pub relative_pose_error_mean: f64,
    /// Mean over all steps of the object-relative geodesic orientation error, rad.
    #[serde(default)]
    pub relative_geodesic_orientation_error_mean: Option<f64>,
    /// Mean over all steps of the object-relative position error, cm.
    #[serde(default)]
    pub relative_position_error_mean: Option<f64>,
    /// Mean over all steps of the mean object-relative feature error.
    pub relative_feature_error_mean: f64,
    /// Mean pose NEES over the steps that have one; 6 is consistent.
    pub pose_nees_mean: Option<f64>,
    /// Mean feature NEES over the steps that have one; 3 is consistent.
    pub feature_nees_mean: Option<f64>,
    /// Mean NEES of the whole state over its dimension, over the steps that have one; 1 is consistent.
    #[serde(default)]
    pub joint_nees_per_dof_mean: Option<f64>,
    /// NIS of all feature measurements that were used, over their numbers; 1 is consistent.
    #[serde(default)]
    pub feature_nis_per_dof: Option<f64>,
    /// NIS of all structure measurements, over their numbers; 1 is consistent.
    #[serde(default)]
    pub structure_nis_per_dof: Option<f64>,
    /// Feature measurements that the filter's gate kept out.
    #[serde(default)]
    pub rejected_measurements: usize,
    /// Steps with the true robot inside the true object.
    pub steps_inside_object: usize,
    /// Steps with the true robot nearer to the true surface than the clearance, or inside.
    pub steps_below_clearance: usize,
    /// Decisions for which no action was safe.
    pub compromised_decisions: usize,
    /// Decisions for controls beyond the limits of roll and pitch, as no action kept them.
    #[serde(default)]
    pub limits_waived_decisions: usize,
    /// How often a viewpoint was given up, as the robot came no nearer to it.
    #[serde(default)]
    pub abandoned_viewpoints: usize,
    /// What went wrong with measurements; absent where the scenario lets nothing go wrong.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub faults: Option<FaultCounts>,
    /// Time to choose an action; absent where there was no decision.
    pub decision_ms: Option<DecisionTimes>,
}

/// Adds up a run, step by step.
#[derive(Clone, Debug, Default)]
pub struct SummaryBuilder {
    pose_errors: Vec<f64>,
    drift_floors: Vec<f64>,
    geodesic_orientation_errors: Vec<f64>,
    position_errors: Vec<f64>,
    relative_pose_errors: Vec<f64>,
    relative_geodesic_orientation_errors: Vec<f64>,
    relative_position_errors: Vec<f64>,
    relative_feature_errors: Vec<f64>,
    pose_nees: Vec<f64>,
    feature_nees: Vec<f64>,
    joint_nees: Vec<f64>,
    feature_nis: Nis,
    structure_nis: Nis,
    rejected: usize,
    last_feature_errors: Vec<f64>,
    seen: Vec<bool>,
    observed: usize,
    coverage_step: Option<usize>,
    inside: usize,
    below_clearance: usize,
    compromised: usize,
    limits_waived: usize,
    abandoned: usize,
    faults: Option<FaultCounts>,
    decision_ms: Vec<f64>,
}

impl SummaryBuilder {
    /// For a run with this many features.
    #[must_use]
    pub fn new(feature_count: usize) -> Self {
        Self {
            seen: vec![false; feature_count],
            ..Self::default()
        }
    }

    /// In a world where measurements may go wrong, or not.
    #[must_use]
    pub fn with_faults(self, can_happen: bool) -> Self {
        Self {
            faults: can_happen.then(FaultCounts::default),
            ..self
        }
    }

    /// Adds what went wrong with the measurements of a step.
    pub fn add_faults(&mut self, faults: FaultCounts) {
        if let Some(sum) = &mut self.faults {
            *sum += faults;
        }
    }

    /// Adds the drift floor at a step, cm.
    pub fn add_drift_floor(&mut self, expected_error: f64) {
        self.drift_floors.push(expected_error);
    }

    /// Adds what happened at `step` (from 1): the features then visible (by number), the errors, and the
    /// true robot's signed distance from the true surface against the clearance, cm.
    pub fn add_step(
        &mut self,
        step: usize,
        visible: impl IntoIterator<Item = usize>,
        metrics: &StepMetrics,
        signed_distance: f64,
        clearance: f64,
    ) {
        for feature in visible {
            if let Some(seen) = self.seen.get_mut(feature) {
                *seen = true;
            }
            if step > 1 {
                self.observed += 1;
            }
        }
        if self.coverage_step.is_none() && self.seen.iter().all(|seen| *seen) {
            self.coverage_step = Some(step);
        }
        self.pose_errors.push(metrics.pose_error);
        self.geodesic_orientation_errors
            .push(metrics.geodesic_orientation_error);
        self.position_errors.push(metrics.position_error);
        self.relative_pose_errors.push(metrics.relative_pose_error);
        self.relative_geodesic_orientation_errors
            .push(metrics.relative_geodesic_orientation_error);
        self.relative_position_errors
            .push(metrics.relative_position_error);
        self.relative_feature_errors
            .push(metrics.relative_feature_error);
        self.pose_nees.extend(metrics.pose_nees);
        self.feature_nees.extend(metrics.feature_nees_mean());
        self.joint_nees.extend(metrics.joint_nees_per_dof);
        self.last_feature_errors.clone_from(&metrics.feature_errors);
        self.inside += usize::from(signed_distance < 0.0);
        self.below_clearance += usize::from(signed_distance < clearance);
    }

    /// Adds a decision that took this long.
    pub fn add_decision(&mut self, milliseconds: f64, decision: &Decision) {
        self.decision_ms.push(milliseconds);
        self.compromised += usize::from(decision.compromised);
        self.limits_waived += usize::from(decision.limits_waived);
        self.abandoned += usize::from(decision.abandoned.is_some());
    }

    /// Adds what an update said about the filter.
    pub fn add_update(&mut self, report: &UpdateReport) {
        for (sum, nis) in [
            (&mut self.feature_nis, report.features),
            (&mut self.structure_nis, report.structure),
        ] {
            sum.value += nis.value;
            sum.dof += nis.dof;
        }
        self.rejected += report.rejected;
    }

    /// The run as a whole.
    #[must_use]
    pub fn finish(self, seed: u64) -> RunSummary {
        let largest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
        let mean_of_some = |values: &[f64]| (!values.is_empty()).then(|| mean(values));
        RunSummary {
            seed,
            observed: self.observed,
            steps_to_full_coverage: self.coverage_step,
            pose_error_mean: mean(&self.pose_errors),
            drift_floor_mean: mean(&self.drift_floors),
            pose_error_max: largest(&self.pose_errors),
            geodesic_orientation_error_mean: mean_of_some(&self.geodesic_orientation_errors),
            position_error_mean: mean_of_some(&self.position_errors),
            feature_error_mean: mean(&self.last_feature_errors),
            feature_error_max: largest(&self.last_feature_errors),
            relative_pose_error_mean: mean(&self.relative_pose_errors),
            relative_geodesic_orientation_error_mean: mean_of_some(
                &self.relative_geodesic_orientation_errors,
            ),
            relative_position_error_mean: mean_of_some(&self.relative_position_errors),
            relative_feature_error_mean: mean(&self.relative_feature_errors),
            pose_nees_mean: mean_of_some(&self.pose_nees),
            feature_nees_mean: mean_of_some(&self.feature_nees),
            joint_nees_per_dof_mean: mean_of_some(&self.joint_nees),
            feature_nis_per_dof: per_dof(self.feature_nis),
            structure_nis_per_dof: per_dof(self.structure_nis),
            rejected_measurements: self.rejected,
            steps_inside_object: self.inside,
            steps_below_clearance: self.below_clearance,
            compromised_decisions: self.compromised,
            limits_waived_decisions: self.limits_waived,
            abandoned_viewpoints: self.abandoned,
            faults: self.faults,
            decision_ms: DecisionTimes::of(self.decision_ms),
        }
    }
}

/// Nothing where nothing was measured.
fn per_dof(nis: Nis) -> Option<f64> {
    (nis.dof > 0).then(|| nis.value / nis.dof as f64)
}

#[cfg(test)]
mod tests;
