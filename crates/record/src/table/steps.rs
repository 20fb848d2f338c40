//! steps.csv: a row a step, with everything that a plot of a run needs.

use std::path::{Path, PathBuf};

use adslam_diagnostics::Failure;
use adslam_simulation::StepView;
use serde::Serialize;

use crate::AtomicFile;

/// The table of steps of a run. Its header names the unit of each column.
#[derive(Debug)]
pub struct StepsFile {
    writer: csv::Writer<AtomicFile>,
    path: PathBuf,
    coverage: Vec<bool>,
}

#[derive(Serialize)]
struct Row {
    step: usize,
    true_roll_rad: f64,
    true_pitch_rad: f64,
    true_yaw_rad: f64,
    true_x_cm: f64,
    true_y_cm: f64,
    true_z_cm: f64,
    estimated_roll_rad: f64,
    estimated_pitch_rad: f64,
    estimated_yaw_rad: f64,
    estimated_x_cm: f64,
    estimated_y_cm: f64,
    estimated_z_cm: f64,
    sigma_roll_rad: f64,
    sigma_pitch_rad: f64,
    sigma_yaw_rad: f64,
    sigma_x_cm: f64,
    sigma_y_cm: f64,
    sigma_z_cm: f64,
    /// Eq. (11): radians and cm together.
    pose_error_rad_cm: f64,
    orientation_error_rad: f64,
    geodesic_orientation_error_rad: f64,
    position_error_cm: f64,
    drift_floor_cm: f64,
    relative_pose_error_rad_cm: f64,
    relative_geodesic_orientation_error_rad: f64,
    relative_position_error_cm: f64,
    feature_error_mean_cm: f64,
    feature_error_max_cm: f64,
    relative_feature_error_mean_cm: f64,
    pose_nees: Option<f64>,
    feature_nees: Option<f64>,
    joint_nees_per_dof: Option<f64>,
    feature_nis: Option<f64>,
    feature_nis_dof: Option<usize>,
    structure_nis: Option<f64>,
    structure_nis_dof: Option<usize>,
    rejected_measurements: Option<usize>,
    covariance_trace_rad2_cm2: f64,
    predicted_trace_rad2_cm2: Option<f64>,
    visible_features: usize,
    features_seen_so_far: usize,
    surface_distance_cm: f64,
    control_roll_rad: Option<f64>,
    control_pitch_rad: Option<f64>,
    control_yaw_rad: Option<f64>,
    control_x_cm: Option<f64>,
    control_y_cm: Option<f64>,
    control_z_cm: Option<f64>,
    goal_number: Option<usize>,
    goal_x_cm: Option<f64>,
    goal_y_cm: Option<f64>,
    goal_z_cm: Option<f64>,
    admissible_actions: Option<usize>,
    safe_actions: Option<usize>,
    scored_actions: Option<usize>,
    compromised: Option<u8>,
    limits_waived: Option<u8>,
    abandoned_goal_number: Option<usize>,
    decision_time_ms: Option<f64>,
}

impl StepsFile {
    /// Starts the table at `path`.
    ///
    /// # Errors
    /// [`Failure::Output`].
    pub fn create(path: &Path, feature_count: usize) -> Result<Self, Failure> {
        let writer = csv::Writer::from_writer(AtomicFile::create(path)?);
        Ok(Self {
            writer,
            path: path.to_owned(),
            coverage: vec![false; feature_count],
        })
    }

    /// Adds a step.
    ///
    /// # Errors
    /// [`Failure::Output`].
    pub fn add(&mut self, view: &StepView<'_>) -> Result<(), Failure> {
        for feature in view.visible {
            if let Some(seen) = self.coverage.get_mut(feature.0) {
                *seen = true;
            }
        }
        let row = self.row(view);
        self.writer
            .serialize(row)
            .map_err(Failure::output(&self.path))
    }

    fn row(&self, view: &StepView<'_>) -> Row {
        let (truth, estimate) = (view.pose.to_vector(), view.belief.state.pose.to_vector());
        let sigma = view
            .belief
            .covariance
            .pose()
            .diagonal()
            .map(|v| v.max(0.0).sqrt());
        let metrics = view.metrics;
        let errors = &metrics.feature_errors;
        let decision = view.decision.map(|(decision, _)| decision);
        let rotation = decision.map(|d| d.control.rotation);
        let translation = decision.map(|d| d.control.translation);
        let goal = decision.and_then(|d| d.goal);
        Row {
            step: view.step,
            true_roll_rad: truth[0],
            true_pitch_rad: truth[1],
            true_yaw_rad: truth[2],
            true_x_cm: truth[3],
            true_y_cm: truth[4],
            true_z_cm: truth[5],
            estimated_roll_rad: estimate[0],
            estimated_pitch_rad: estimate[1],
            estimated_yaw_rad: estimate[2],
            estimated_x_cm: estimate[3],
            estimated_y_cm: estimate[4],
            estimated_z_cm: estimate[5],
            sigma_roll_rad: sigma[0],
            sigma_pitch_rad: sigma[1],
            sigma_yaw_rad: sigma[2],
            sigma_x_cm: sigma[3],
            sigma_y_cm: sigma[4],
            sigma_z_cm: sigma[5],
            pose_error_rad_cm: metrics.pose_error,
            orientation_error_rad: metrics.orientation_error,
            geodesic_orientation_error_rad: metrics.geodesic_orientation_error,
            position_error_cm: metrics.position_error,
            drift_floor_cm: view.drift_floor,
            relative_pose_error_rad_cm: metrics.relative_pose_error,
            relative_geodesic_orientation_error_rad: metrics.relative_geodesic_orientation_error,
            relative_position_error_cm: metrics.relative_position_error,
            feature_error_mean_cm: errors.iter().sum::<f64>() / errors.len() as f64,
            feature_error_max_cm: errors.iter().copied().fold(0.0, f64::max),
            relative_feature_error_mean_cm: metrics.relative_feature_error,
            pose_nees: metrics.pose_nees,
            feature_nees: metrics.feature_nees_mean(),
            joint_nees_per_dof: metrics.joint_nees_per_dof,
            feature_nis: view.update.map(|update| update.features.value),
            feature_nis_dof: view.update.map(|update| update.features.dof),
            structure_nis: view.update.map(|update| update.structure.value),
            structure_nis_dof: view.update.map(|update| update.structure.dof),
            rejected_measurements: view.update.map(|update| update.rejected),
            covariance_trace_rad2_cm2: view.belief.covariance.trace(),
            predicted_trace_rad2_cm2: decision.and_then(|d| d.predicted_trace),
            visible_features: view.visible.len(),
            features_seen_so_far: self.coverage.iter().filter(|seen| **seen).count(),
            surface_distance_cm: view.surface_distance,
            control_roll_rad: rotation.map(|v| v.x),
            control_pitch_rad: rotation.map(|v| v.y),
            control_yaw_rad: rotation.map(|v| v.z),
            control_x_cm: translation.map(|v| v.x),
            control_y_cm: translation.map(|v| v.y),
            control_z_cm: translation.map(|v| v.z),
            goal_number: goal.map(|g| g.0),
            goal_x_cm: goal.map(|g| g.1.x),
            goal_y_cm: goal.map(|g| g.1.y),
            goal_z_cm: goal.map(|g| g.1.z),
            admissible_actions: decision.map(|d| d.admissible),
            safe_actions: decision.map(|d| d.safe),
            scored_actions: decision.map(|d| d.scored),
            compromised: decision.map(|d| u8::from(d.compromised)),
            limits_waived: decision.map(|d| u8::from(d.limits_waived)),
            abandoned_goal_number: decision.and_then(|d| Some(d.abandoned?.0)),
            decision_time_ms: view.decision.map(|(_, ms)| ms),
        }
    }

    /// Ends the table; the file still has to be committed.
    ///
    /// # Errors
    /// [`Failure::Output`].
    pub fn finish(self) -> Result<AtomicFile, Failure> {
        let Self { writer, path, .. } = self;
        writer
            .into_inner()
            .map_err(|error| Failure::output(&path)(error.into_error()))
    }
}
