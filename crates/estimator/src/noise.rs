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
    /// Checks that motion sigmas are at least 0 and measurement sigmas above it, and that the squares of those that
    /// are not 0 are numbers that can be computed with.
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
            check_sigma(what, value, Zero::Allowed)?;
        }
        for (what, value) in measurement {
            check_sigma(what, value, Zero::Refused)?;
        }
        Ok(())
    }
}

/// Whether a sigma may be zero.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Zero {
    Allowed,
    /// Its square is divided by.
    Refused,
}

/// A sigma must not be negative, and its square must be a number that can be computed with.
pub(crate) fn check_sigma(
    what: &'static str,
    value: f64,
    zero: Zero,
) -> Result<(), EstimatorError> {
    let squares = f64::MIN_POSITIVE..f64::MAX;
    let allowed = value == 0.0 && zero == Zero::Allowed;
    if allowed || (value > 0.0 && squares.contains(&(value * value))) {
        return Ok(());
    }
    let requirement = match zero {
        Zero::Allowed => "0, or a number above it from about 1e-153 to 1e154",
        Zero::Refused => "a number above 0, from about 1e-153 to 1e154",
    };
    Err(EstimatorError::BadSigma {
        what,
        value,
        requirement,
    })
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
                feature_measurement_sigma: -0.1,
                ..good
            },
            FilterNoise {
                structure_measurement_sigma: -0.5,
                ..good
            },
            FilterNoise {
                structure_measurement_sigma: 1e-170,
                ..good
            },
            FilterNoise {
                feature_motion_sigma: 1e160,
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
