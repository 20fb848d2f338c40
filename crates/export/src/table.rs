//! Every component of the state at each step, a row each.

use std::path::Path;

use adslam_diagnostics::Failure;
use adslam_record::{AtomicFile, HistoryStep, POSE_COMPONENTS, RunHistory};
use serde::Serialize;

use crate::failed;

/// A component of the state at a step.
#[derive(Serialize)]
struct Row {
    step: usize,
    /// Empty for the pose.
    feature: Option<usize>,
    component: &'static str,
    unit: &'static str,
    truth: f64,
    estimate: f64,
    sigma: f64,
    /// Whether the robot sees the feature; empty for the pose.
    visible: Option<u8>,
}

/// The components of a feature, with the places of their variances in a covariance.
const FEATURE: [(&str, usize); 3] = [("x", 0), ("y", 3), ("z", 5)];

/// Writes a table of truth, estimate and standard deviation of every component of pose and
/// features at each step, world frame, cm and rad.
///
/// # Errors
/// A file that cannot be written; what lay at `out` is then unchanged.
pub fn write_csv(history: &RunHistory, out: &Path) -> Result<(), Failure> {
    let mut writer = csv::Writer::from_writer(AtomicFile::create(out)?);
    for (step, number) in history.steps.iter().zip(1..) {
        for row in pose_rows(step, number).chain(feature_rows(step, number)) {
            writer.serialize(row).map_err(failed(out))?;
        }
    }
    let file = writer
        .into_inner()
        .map_err(|error| failed(out)(error.into_error()))?;
    file.commit()
}

fn pose_rows(step: &HistoryStep, number: usize) -> impl Iterator<Item = Row> {
    POSE_COMPONENTS
        .iter()
        .enumerate()
        .map(move |(i, &(component, unit))| Row {
            step: number,
            feature: None,
            component,
            unit,
            truth: step.pose[i],
            estimate: step.estimated_pose[i],
            sigma: step.pose_sigma[i],
            visible: None,
        })
}

fn feature_rows(step: &HistoryStep, number: usize) -> impl Iterator<Item = Row> {
    let features = step.features.iter().zip(&step.estimated_features);
    let features = features.zip(&step.feature_covariances).enumerate();
    features.flat_map(move |(feature, ((truth, estimate), covariance))| {
        let visible = u8::from(step.visible.contains(&feature));
        let components = FEATURE.iter().enumerate();
        components.map(move |(i, &(component, variance))| Row {
            step: number,
            feature: Some(feature),
            component,
            unit: "cm",
            truth: truth[i],
            estimate: estimate[i],
            sigma: covariance[variance].max(0.0).sqrt(),
            visible: Some(visible),
        })
    })
}
