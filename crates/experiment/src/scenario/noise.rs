//! `[noise]` and `[filter]`: the noise of the world, and the noise that the filter assumes.

use serde::Deserialize;

use super::values::{NonNegative, Positive, Truncation};

/// `[noise]`: the true noise, Gaussian, independent in every component.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Noise {
    /// w^Ω of eq. (2): each Euler angle, each step (rad).
    pub rotation_sigma_rad: NonNegative,
    /// w^v of eq. (2): each coordinate of the robot, each step (cm).
    pub translation_sigma_cm: NonNegative,
    /// σ_t: the noise of each feature's translation, each step (cm).
    pub feature_translation_sigma_cm: NonNegative,
    /// σ_d: the noise of each feature's deformation, each step (cm).
    pub feature_deformation_sigma_cm: NonNegative,
    /// ε^f of eq. (10): each coordinate of a measured feature (cm).
    pub feature_measurement_sigma_cm: NonNegative,
    /// ε^c of eq. (4): each coordinate of a measured difference of two features (cm).
    pub structure_measurement_sigma_cm: NonNegative,
    /// Whether the deformation's noise accumulates; default fresh.
    #[serde(default)]
    pub deformation_noise: DeformationNoise,
    /// Cuts every noise off at this multiple of its sigma; default not at all.
    pub truncate_at_sigmas: Option<Truncation>,
}

/// What becomes of the noise of a deformation.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DeformationNoise {
    /// Drawn anew around the deformed shape at every step, as in the public code. The default.
    #[default]
    Fresh,
    /// Added up from step to step like the translation's: eq. (2), read literally.
    Accumulating,
}

/// `[filter]`: where the filter's assumptions differ from the world.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Filter {
    /// Default: the one of `[noise]`, as for the five below.
    pub rotation_sigma_rad: Option<NonNegative>,
    /// See [`Noise::translation_sigma_cm`].
    pub translation_sigma_cm: Option<NonNegative>,
    /// See [`Noise::feature_translation_sigma_cm`].
    pub feature_translation_sigma_cm: Option<NonNegative>,
    /// See [`Noise::feature_deformation_sigma_cm`].
    pub feature_deformation_sigma_cm: Option<NonNegative>,
    /// See [`Noise::feature_measurement_sigma_cm`]; above 0.
    pub feature_measurement_sigma_cm: Option<Positive>,
    /// See [`Noise::structure_measurement_sigma_cm`]; above 0.
    pub structure_measurement_sigma_cm: Option<Positive>,
    /// Of each coordinate of a feature at the start; default the feature measurement's (cm). The
    /// first estimate is drawn with it.
    pub initial_feature_sigma_cm: Option<NonNegative>,
    /// Which structure measurements are made and used; default all pairs.
    pub structure: Structure,
}

/// Which pairs of features structure measurements connect.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Structure {
    /// Every pair, at every step. The default.
    #[default]
    AllPairs,
    /// No pair: there are no structure measurements.
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
            rotation_sigma_rad: or(self.rotation_sigma_rad, noise.rotation_sigma_rad),
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
