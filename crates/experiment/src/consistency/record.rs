//! What is kept of a run: every measure of consistency at every step.

use adslam_diagnostics::Failure;
use adslam_estimator::Nis;
use adslam_record::Observer;
use adslam_simulation::{RunSummary, StepView};
use serde::{Deserialize, Serialize};

use super::Measure;

/// The consistency of one run. The lists have an entry for each step, step 1 first.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ConsistencyRecord {
    /// Its numbers as a whole.
    pub summary: Option<RunSummary>,
    /// What the user should know of it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
    /// n, the dimension of the state.
    pub dimension: usize,
    /// NEES of the pose.
    pub pose_nees: Vec<Option<f64>>,
    /// Mean NEES of the features.
    pub feature_nees: Vec<Option<f64>>,
    /// NEES of each feature, summed over the steps, and how many steps that are.
    pub nees_of_features: Vec<(f64, usize)>,
    /// NEES of the state over n.
    pub joint_nees_per_dof: Vec<Option<f64>>,
    /// NIS of the feature measurements, and how many numbers were measured.
    pub feature_nis: Vec<(f64, usize)>,
    /// NIS of the structure measurements, and how many independent numbers were measured.
    pub structure_nis: Vec<(f64, usize)>,
}

impl Observer for ConsistencyRecord {
    fn step(&mut self, view: &StepView<'_>) -> Result<(), Failure> {
        let metrics = view.metrics;
        let numbers = |nis: Nis| (nis.value, nis.dof);
        let update = view.update.copied().unwrap_or_default();
        self.dimension = view.belief.state.dim();
        self.pose_nees.push(metrics.pose_nees);
        self.feature_nees.push(metrics.feature_nees_mean());
        self.nees_of_features
            .resize(metrics.feature_nees.len(), (0.0, 0));
        for (sum, nees) in self.nees_of_features.iter_mut().zip(&metrics.feature_nees) {
            if let Some(nees) = nees {
                *sum = (sum.0 + nees, sum.1 + 1);
            }
        }
        self.joint_nees_per_dof.push(metrics.joint_nees_per_dof);
        self.feature_nis.push(numbers(update.features));
        self.structure_nis.push(numbers(update.structure));
        Ok(())
    }
}

impl ConsistencyRecord {
    /// Steps of the run.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.pose_nees.len()
    }

    /// The squared error or innovation at a step, by its index, and its degrees of freedom; `None` where
    /// there was none.
    #[must_use]
    pub fn value(&self, measure: Measure, index: usize) -> Option<(f64, usize)> {
        let nees = |list: &[Option<f64>], dof: usize| Some((*list.get(index)?.as_ref()?, dof));
        let nis = |list: &[(f64, usize)]| list.get(index).copied().filter(|(_, dof)| *dof > 0);
        match measure {
            Measure::PoseNees => nees(&self.pose_nees, 6),
            Measure::FeatureNees => nees(&self.feature_nees, 3),
            Measure::JointNees => nees(&self.joint_nees_per_dof, self.dimension)
                .map(|(value, dof)| (value * dof as f64, dof)),
            Measure::FeatureNis => nis(&self.feature_nis),
            Measure::StructureNis => nis(&self.structure_nis),
        }
    }
}
