//! Algorithm 1: propagation and update.

use std::marker::PhantomData;

use adslam_models::{Control, FeatureId, State, motion_jacobian, predicted_pose};
use nalgebra::{Matrix3, Vector3};

use crate::digits::check_motion_resolved;
use crate::error_state::check_conversion;
use crate::feature_update::FeatureUpdate;
use crate::input::check_motion;
use crate::structure_update::StructureUpdate;
use crate::workspace::Workspace;
use crate::{
    Belief, ErrorState, Estimator, EstimatorError, EulerError, FilterNoise, Measurements,
    Parallelism, UpdateReport,
};

/// The extended Kalman filter of Algorithm 1, with the error coordinates `E`.
///
/// It keeps the memory that its steps need: from the second step on, states of the same size on one
/// thread allocate nothing, whichever pairs their structure measurements are of. For a state of n
/// entries that is room for about 200 n numbers, less than a tenth of a covariance for 1000
/// features, and for a graph of some of the pairs three M × M matrices more.
#[derive(Clone, Debug)]
pub struct Ekf<E = EulerError> {
    noise: FilterNoise,
    gate: Option<f64>,
    parallelism: Parallelism,
    workspace: Workspace,
    features: FeatureUpdate,
    structure: StructureUpdate,
    /// K y, in the paper's coordinates.
    delta: Vec<f64>,
    /// χ̂ before the correction.
    predicted: State,
    /// D − I.
    reset: Vec<Matrix3<f64>>,
    coordinates: PhantomData<E>,
}

impl Ekf {
    /// The paper's filter, with errors of Euler angles, that assumes this noise.
    ///
    /// # Errors
    /// A sigma that cannot be used, see [`FilterNoise::validate`].
    pub fn new(noise: FilterNoise) -> Result<Self, EstimatorError> {
        Self::in_coordinates(noise)
    }
}

impl<E: ErrorState> Ekf<E> {
    /// A filter with the errors of `E` that assumes this noise.
    ///
    /// # Errors
    /// A sigma that cannot be used, see [`FilterNoise::validate`].
    pub fn in_coordinates(noise: FilterNoise) -> Result<Self, EstimatorError> {
        noise.validate()?;
        Ok(Self {
            noise,
            gate: None,
            parallelism: Parallelism::default(),
            workspace: Workspace::default(),
            features: FeatureUpdate::default(),
            structure: StructureUpdate::default(),
            delta: Vec::new(),
            predicted: State::default(),
            reset: Vec::new(),
            coordinates: PhantomData,
        })
    }

    /// The same filter on other threads; its results stay the same to the last bit.
    #[must_use]
    pub fn with_parallelism(self, parallelism: Parallelism) -> Self {
        Self {
            parallelism,
            ..self
        }
    }

    /// The same filter with a gate: a feature measurement is used only if its squared distance from what
    /// is expected, yᵀS⁻¹y with S its covariance given the prediction, is at most this; χ² with 3
    /// degrees of freedom if all is well. Without one all are used.
    ///
    /// # Errors
    /// [`EstimatorError::BadGate`] if it is not a number above zero.
    pub fn with_gate(self, gate: Option<f64>) -> Result<Self, EstimatorError> {
        if let Some(gate) = gate.filter(|gate| gate.is_nan() || *gate <= 0.0) {
            return Err(EstimatorError::BadGate(gate));
        }
        Ok(Self { gate, ..self })
    }

    /// The noise that the filter assumes.
    #[must_use]
    pub fn noise(&self) -> &FilterNoise {
        &self.noise
    }

    /// Moves the estimate by the correction in the coordinates of `E`, and the covariance with it.
    fn correct(
        &mut self,
        belief: &mut Belief,
        parallelism: Parallelism,
    ) -> Result<(), EstimatorError> {
        check_correction(&self.delta)?;
        self.predicted.pose = belief.state.pose;
        self.predicted.features.clone_from(&belief.state.features);
        E::retract(&mut belief.state, &self.delta);
        E::reset(&self.predicted, &belief.state, &mut self.reset);
        if self.reset.is_empty() {
            return Ok(());
        }
        check_conversion(
            self.predicted.pose.orientation,
            belief.state.pose.orientation,
        )?;
        let Workspace {
            selection, columns, ..
        } = &mut self.workspace;
        belief
            .covariance
            .reset(&self.reset, [selection, columns], parallelism);
        Ok(())
    }
}

impl<E: ErrorState> Estimator for Ekf<E> {
    // The chain rule makes it the same in any coordinates, so it is done in the paper's, where F touches the
    // pose alone.
    fn predict(
        &self,
        belief: &mut Belief,
        control: &Control,
        feature_motion: &[Vector3<f64>],
    ) -> Result<(), EstimatorError> {
        check_motion(belief, control, feature_motion)?;
        let jacobian = motion_jacobian(&belief.state.pose, control);
        let before = belief.covariance.pose();
        belief.state.pose = predicted_pose(&belief.state.pose, control);
        belief.state.move_features(feature_motion);
        belief.covariance.propagate(&jacobian, &self.noise);
        let after = belief.covariance.pose();
        check_motion_resolved(&before, &after, self.noise.translation_sigma)?;
        if E::CONVERTS_ANGLES {
            let orientation = belief.state.pose.orientation;
            check_conversion(orientation, orientation)?;
        }
        Ok(())
    }

    // Equal to Algorithm 1 with all rows stacked where errors are the paper's: the feature measurements are
    // linearised at the predicted state, and the structure measurements may follow, as they are linear in
    // positions in the world. For that reason their correction is exact where positions are subtracted, in
    // the paper's coordinates, whatever those of `E` are.
    fn update(
        &mut self,
        belief: &mut Belief,
        measurements: &Measurements<'_>,
    ) -> Result<UpdateReport, EstimatorError> {
        belief.check_sizes()?;
        let parallelism = self.parallelism.for_dim(belief.covariance.dim());
        let features = self.features.apply(
            belief,
            &mut self.delta,
            measurements.features,
            (self.noise.feature_measurement_sigma, self.gate),
            &mut self.workspace,
            parallelism,
        )?;
        if features.dof > 0 {
            self.correct(belief, parallelism)?;
        }
        let structure = self.structure.apply(
            belief,
            &mut self.delta,
            &measurements.structure,
            self.noise.structure_measurement_sigma,
            &mut self.workspace,
            parallelism,
        )?;
        if structure.dof > 0 {
            check_correction(&self.delta)?;
            EulerError::retract(&mut belief.state, &self.delta);
        }
        belief.covariance.complete(parallelism)?;
        Ok(UpdateReport {
            features,
            structure,
            rejected: self.rejected().len(),
        })
    }

    fn rejected(&self) -> &[FeatureId] {
        self.features.rejected()
    }

    fn error(&self, estimate: &State, truth: &State) -> Vec<f64> {
        E::error(estimate, truth)
    }
}

fn check_correction(delta: &[f64]) -> Result<(), EstimatorError> {
    if delta.iter().all(|x| x.is_finite()) {
        return Ok(());
    }
    Err(EstimatorError::NotFinite {
        what: "correction of the state",
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Threads change no result, so that only this can tell whether they are used.
    #[test]
    fn a_filter_keeps_its_gate_and_its_threads() -> Result<(), EstimatorError> {
        let noise = FilterNoise {
            rotation_sigma: 0.02,
            translation_sigma: 0.03,
            feature_motion_sigma: 0.058,
            feature_measurement_sigma: 0.02,
            structure_measurement_sigma: 0.5,
        };
        let ekf = Ekf::new(noise)?
            .with_parallelism(Parallelism::Rayon)
            .with_gate(Some(16.0))?;
        assert_eq!(ekf.parallelism, Parallelism::Rayon);
        assert_eq!(ekf.gate, Some(16.0));
        Ok(())
    }
}
