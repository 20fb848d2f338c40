//! `[noise]` and `[filter]`: the noise of the world, and the noise that the filter assumes.

use adslam_names::EstimatorName;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::values::{AngleSigma, GateProbability, NonNegative, Positive, Truncation};

/// The noise of the world: Gaussian, independent in each component. 0 is no noise.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Noise {
    /// Of each Euler angle of a motion of the robot, each step: w^Ω of eq. (2) (rad).
    pub rotation_sigma_rad: AngleSigma,
    /// Of each coordinate of a motion of the robot, each step: w^v of eq. (2) (cm).
    pub translation_sigma_cm: NonNegative,
    /// σ_t, of the object's translation, for each feature; adds up from step to step (cm).
    pub feature_translation_sigma_cm: NonNegative,
    /// σ_d, of the deformation, for each feature (cm).
    pub feature_deformation_sigma_cm: NonNegative,
    /// Of each coordinate of a measured feature: ε^f of eq. (10) (cm).
    pub feature_measurement_sigma_cm: NonNegative,
    /// Of each coordinate of a measured difference between two features: ε^c of eq. (4) (cm).
    pub structure_measurement_sigma_cm: NonNegative,
    /// What becomes of σ_d from step to step.
    #[serde(default)]
    pub deformation_noise: DeformationNoise,
    /// Cuts off every noise at this multiple of its sigma; the public code has 2. Default: never.
    pub truncate_at_sigmas: Option<Truncation>,
}

/// What becomes of the noise of a deformation.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DeformationNoise {
    /// Drawn anew around the deformed shape at each step, as in the public code.
    #[default]
    Fresh,
    /// Adds up like the translation's, which is eq. (2) read literally.
    Accumulating,
}

/// Where the filter assumes another noise than the world has.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Filter {
    /// Of each Euler angle of a motion of the robot, each step (rad). Default: that of `noise`.
    pub rotation_sigma_rad: Option<AngleSigma>,
    /// Of each coordinate of a motion of the robot, each step (cm). Default: that of `noise`.
    pub translation_sigma_cm: Option<NonNegative>,
    /// σ_t, of the object's translation, for each feature (cm). Default: that of `noise`.
    pub feature_translation_sigma_cm: Option<NonNegative>,
    /// σ_d, of the deformation, for each feature (cm). Default: that of `noise`.
    pub feature_deformation_sigma_cm: Option<NonNegative>,
    /// Of each coordinate of a measured feature (cm). Default: that of `noise`, which has to be above
    /// 0 then.
    pub feature_measurement_sigma_cm: Option<Positive>,
    /// Of each coordinate of a measured difference between two features (cm). Default: that of
    /// `noise`, which has to be above 0 then.
    pub structure_measurement_sigma_cm: Option<Positive>,
    /// Of each coordinate of each feature at the start; the first estimate is drawn with it (cm).
    /// Default: the filter's feature measurement's.
    pub initial_feature_sigma_cm: Option<NonNegative>,
    /// Between which features differences are measured and used.
    pub structure: Structure,
    /// What the filter takes for the error of a state.
    pub estimator: EstimatorName,
    /// The part of good feature measurements that pass the filter's χ² gate; one that is farther from what is
    /// expected is not used. 0.999 is usual. Default: no gate, all are used.
    pub gate_probability: Option<GateProbability>,
}

/// Which pairs of features structure measurements connect.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Structure {
    /// Every pair, at every step.
    #[default]
    AllPairs,
    /// No pair.
    None,
}

/// The filter's assumptions with every default resolved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilterNoise {
    /// See [`Noise::rotation_sigma_rad`].
    pub rotation_sigma_rad: f64,
    /// See [`Noise::translation_sigma_cm`].
    pub translation_sigma_cm: f64,
    /// See [`Noise::feature_translation_sigma_cm`].
    pub feature_translation_sigma_cm: f64,
    /// See [`Noise::feature_deformation_sigma_cm`].
    pub feature_deformation_sigma_cm: f64,
    /// See [`Noise::feature_measurement_sigma_cm`].
    pub feature_measurement_sigma_cm: f64,
    /// See [`Noise::structure_measurement_sigma_cm`].
    pub structure_measurement_sigma_cm: f64,
    /// See [`Filter::initial_feature_sigma_cm`].
    pub initial_feature_sigma_cm: f64,
}

impl FilterNoise {
    /// √(σ_t² + σ_d²): the noise of each coordinate of a feature's motion, each step (cm).
    pub fn feature_motion_sigma_cm(&self) -> f64 {
        self.feature_translation_sigma_cm
            .hypot(self.feature_deformation_sigma_cm)
    }
}

impl Filter {
    /// The assumptions in a world with the given noise.
    pub fn resolved(&self, noise: &Noise) -> FilterNoise {
        let or = |own: Option<NonNegative>, world: NonNegative| *own.unwrap_or(world);
        let measured = |own: Option<Positive>, world: NonNegative| own.map_or(*world, |own| *own);
        let feature_measurement_sigma_cm = measured(
            self.feature_measurement_sigma_cm,
            noise.feature_measurement_sigma_cm,
        );
        FilterNoise {
            rotation_sigma_rad: *self.rotation_sigma_rad.unwrap_or(noise.rotation_sigma_rad),
            translation_sigma_cm: or(self.translation_sigma_cm, noise.translation_sigma_cm),
            feature_translation_sigma_cm: or(
                self.feature_translation_sigma_cm,
                noise.feature_translation_sigma_cm,
            ),
            feature_deformation_sigma_cm: or(
                self.feature_deformation_sigma_cm,
                noise.feature_deformation_sigma_cm,
            ),
            feature_measurement_sigma_cm,
            structure_measurement_sigma_cm: measured(
                self.structure_measurement_sigma_cm,
                noise.structure_measurement_sigma_cm,
            ),
            initial_feature_sigma_cm: self
                .initial_feature_sigma_cm
                .map_or(feature_measurement_sigma_cm, |sigma| *sigma),
        }
    }
}
