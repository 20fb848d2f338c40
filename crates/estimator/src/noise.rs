//! The noise that the filter assumes.

use crate::EstimatorError;

/// Standard deviations of all noise, as the filter believes them: Q and O of Algorithm 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilterNoise {
    /// Of each angle of `w_Ω`, radians a step.
    pub rotation_sigma: f64,
    /// Of each axis of `w_v`, cm a step.
    pub translation_sigma: f64,
    /// Of each axis of a feature's motion wʲ, cm a step: √(σ_t² + σ_d²).
    pub feature_motion_sigma: f64,
    /// Of each axis of a feature measurement, cm.
    pub feature_measurement_sigma: f64,
    /// Of each axis of a structure measurement, cm.
    pub structure_measurement_sigma: f64,
}

impl FilterNoise {
    /// Checks that motion sigmas are finite and ≥ 0 and that measurement sigmas are finite and > 0.
    ///
    /// # Errors
    /// [`EstimatorError::BadSigma`] names the first that is not.
    pub fn validate(&self) -> Result<(), EstimatorError> {
        let motion = [
            ("the robot's rotation", self.rotation_sigma),
            ("the robot's translation", self.translation_sigma),
            ("the features' motion", self.feature_motion_sigma),
        ];
        let measurement = [
            ("the feature measurements", self.feature_measurement_sigma),
            (
                "the structure measurements",
                self.structure_measurement_sigma,
            ),
        ];
        for (what, value) in motion {
            if !(value.is_finite() && value >= 0.0) {
                let requirement = "finite and not negative";
                return Err(EstimatorError::BadSigma {
                    what,
                    value,
                    requirement,
                });
            }
        }
        for (what, value) in measurement {
            // Its square is divided by, so it must not underflow.
            if !(value.is_finite() && value * value > f64::MIN_POSITIVE) {
                let requirement = "finite and greater than zero";
                return Err(EstimatorError::BadSigma {
                    what,
                    value,
                    requirement,
                });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refuses_what_cannot_be_used() {
        let good = FilterNoise {
            rotation_sigma: 0.0,
            translation_sigma: 0.03,
            feature_motion_sigma: 0.05,
            feature_measurement_sigma: 0.02,
            structure_measurement_sigma: 0.5,
        };
        assert!(good.validate().is_ok());
        for bad in [
            FilterNoise {
                rotation_sigma: -0.1,
                ..good
            },
            FilterNoise {
                translation_sigma: f64::NAN,
                ..good
            },
            FilterNoise {
                feature_measurement_sigma: 0.0,
                ..good
            },
            FilterNoise {
                structure_measurement_sigma: f64::INFINITY,
                ..good
            },
        ] {
            assert!(matches!(
                bad.validate(),
                Err(EstimatorError::BadSigma { .. })
            ));
        }
    }
}
