//! `[motion]` and `[known_motion]`: how the object moves, and what the filter believes of it.

use std::sync::Arc;

use adslam_deformation::{
    AnchoredDeformation, AxisRotation, BackAndForth, MotionError, ObjectMotion, Schedule, Sinusoid,
    SinusoidalTranslation,
};
use nalgebra::Point3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::values::{FeatureNumber, Finite, List, Positive, Vec3};

/// How the object moves: t, d, r_t and r_d of eq. (2). What is not given is not there.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Motion {
    /// t, which all features share. Default: `"none"`.
    pub translation: Translation,
    /// The displacement of each feature from its rest position, whose change is d. Default:
    /// `"none"`.
    pub deformation: Deformation,
    /// r_t, which turns the translation. Default: identity.
    pub translation_rotation: Option<Rotation>,
    /// r_d, which turns the displacement along with it. Default: identity.
    pub deformation_rotation: Option<Rotation>,
}

/// What shifts all features alike.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Translation {
    /// No translation.
    #[default]
    None,
    /// Forth from every odd step, back from every even one.
    BackAndForth(BackAndForthStep),
    /// T(n) = amplitude · sin(2π (n − 1) / period + phase); t is its change.
    Sinusoid(Swing),
}

/// Forth from every odd step, back from every even one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BackAndForthStep {
    /// The way forth; the paper has `[0.1, 0, 0]` (world frame, cm).
    pub step_cm: Vec3,
}

/// T(n) = amplitude · sin(2π (n − 1) / period + phase); t = T(n + 1) − T(n).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Swing {
    /// Farthest point of the swing (world frame, cm).
    pub amplitude_cm: Vec3,
    /// Steps of a whole swing; not always a whole number.
    pub period_steps: Positive,
    /// Phase at step 1 (degrees).
    #[serde(default = "zero")]
    pub phase_deg: Finite,
}

/// What displaces each feature from its rest position.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Deformation {
    /// No deformation.
    #[default]
    None,
    /// Expansion and shrinkage around an anchor by listed amounts.
    Anchored(Anchored),
    /// Expansion and shrinkage around an anchor by a sinusoid.
    AnchoredSinusoid(AnchoredSinusoid),
}

/// Every feature is displaced away from an anchor by the same amount, from a list.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Anchored {
    /// The number of the feature that stays.
    #[serde(default = "first")]
    pub anchor: FeatureNumber,
    /// Which way the others move.
    #[serde(default)]
    pub direction: Direction,
    /// How far each is from its rest position, step by step from step 1, again and again (cm). The
    /// paper has 0, 0.2, 0.4, 0.6, 0.4, 0.2, the public code 0.2, 0.4, 0.6, 0.6, 0.4, 0.2.
    pub amounts_cm: List<Finite>,
}

/// Every feature is displaced away from an anchor by the same amount, from a sinusoid.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AnchoredSinusoid {
    /// The number of the feature that stays.
    #[serde(default = "first")]
    pub anchor: FeatureNumber,
    /// Which way the others move.
    #[serde(default)]
    pub direction: Direction,
    /// Farthest displacement; the features go both ways (cm).
    pub amplitude_cm: Finite,
    /// Steps of a whole breath; not always a whole number.
    pub period_steps: Positive,
    /// Phase at step 1 (degrees).
    #[serde(default = "zero")]
    pub phase_deg: Finite,
}

/// Which way an anchored deformation moves a feature.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Direction {
    /// Away from the vertical line through the anchor, and along z on that line.
    #[default]
    Horizontal,
    /// Straight away from the anchor.
    Radial,
}

/// A rotation about a fixed axis: exp(axis · (angle + rate · (n − 1))) at step n.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Rotation {
    /// The axis, a vector other than zero whose length is of no matter (world frame).
    pub axis: Vec3,
    /// The angle at step 1 (degrees).
    #[serde(default = "zero")]
    pub angle_deg: Finite,
    /// What each step adds to it (degrees).
    #[serde(default = "zero")]
    pub rate_deg_per_step: Finite,
}

/// A motion that does not fit the object.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum MotionBuildError {
    /// The anchor is no feature of the object.
    #[error("the anchor is feature {anchor}, but the object has {features}, numbered from 0")]
    Anchor {
        /// The number given.
        anchor: usize,
        /// How many features there are.
        features: usize,
    },
    /// A parameter is not allowed.
    #[error(transparent)]
    Parameter(#[from] MotionError),
}

impl Motion {
    /// The motion of an object whose features rest at `rest` (world frame, cm).
    ///
    /// # Errors
    /// When the anchor is not among the features, or a parameter was set to what no file may hold.
    pub fn object_motion(&self, rest: &[Point3<f64>]) -> Result<ObjectMotion, MotionBuildError> {
        let mut motion = ObjectMotion::default();
        match &self.translation {
            Translation::None => {}
            Translation::BackAndForth(shift) => {
                motion.translation = Arc::new(BackAndForth::new(*shift.step_cm));
            }
            Translation::Sinusoid(Swing {
                amplitude_cm,
                period_steps,
                phase_deg,
            }) => {
                let phase = phase_deg.degrees_in_rad();
                let swing = SinusoidalTranslation::new(**amplitude_cm, **period_steps, phase)?;
                motion.translation = Arc::new(swing);
            }
        }
        match &self.deformation {
            Deformation::None => {}
            Deformation::Anchored(Anchored {
                anchor,
                direction,
                amounts_cm,
            }) => {
                let schedule = Schedule::new(amounts_cm.iter().map(|amount| **amount).collect())?;
                let anchor = anchor_in(rest, *anchor)?;
                motion.deformation = Arc::new(AnchoredDeformation::new(
                    anchor,
                    (*direction).into(),
                    schedule,
                ));
            }
            Deformation::AnchoredSinusoid(breath) => {
                let phase = breath.phase_deg.degrees_in_rad();
                let wave = Sinusoid::new(*breath.amplitude_cm, *breath.period_steps, phase)?;
                let anchor = anchor_in(rest, breath.anchor)?;
                motion.deformation = Arc::new(AnchoredDeformation::new(
                    anchor,
                    breath.direction.into(),
                    wave,
                ));
            }
        }
        if let Some(rotation) = &self.translation_rotation {
            motion.r_t = Arc::new(rotation.about_axis()?);
        }
        if let Some(rotation) = &self.deformation_rotation {
            motion.r_d = Arc::new(rotation.about_axis()?);
        }
        Ok(motion)
    }

    /// The anchor of the deformation, and the key that gives it, counted from the motion's table.
    pub(super) fn anchor(&self) -> Option<(usize, &'static str)> {
        match &self.deformation {
            Deformation::None => None,
            Deformation::Anchored(anchored) => {
                Some((anchored.anchor.get(), "deformation.anchored.anchor"))
            }
            Deformation::AnchoredSinusoid(breath) => {
                Some((breath.anchor.get(), "deformation.anchored_sinusoid.anchor"))
            }
        }
    }
}

impl Rotation {
    fn about_axis(&self) -> Result<AxisRotation, MotionError> {
        let (angle, rate) = (self.angle_deg, self.rate_deg_per_step);
        AxisRotation::new(*self.axis, angle.degrees_in_rad(), rate.degrees_in_rad())
    }
}

impl From<Direction> for adslam_deformation::Direction {
    fn from(direction: Direction) -> Self {
        match direction {
            Direction::Horizontal => Self::Horizontal,
            Direction::Radial => Self::Radial,
        }
    }
}

fn anchor_in(rest: &[Point3<f64>], anchor: FeatureNumber) -> Result<Point3<f64>, MotionBuildError> {
    let anchor = anchor.get();
    let missing = MotionBuildError::Anchor {
        anchor,
        features: rest.len(),
    };
    rest.get(anchor).copied().ok_or(missing)
}

fn zero() -> Finite {
    Finite::default_of(0.0)
}

fn first() -> FeatureNumber {
    FeatureNumber::default_of(0)
}
