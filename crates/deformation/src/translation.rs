//! Translations that all points of the object share: t of eq. (2).

use std::fmt::Debug;

use nalgebra::Vector3;

use crate::amount::Wave;
use crate::{MotionError, elapsed};

/// How the whole object shifts from step to step.
pub trait Translation: Debug + Send + Sync {
    /// t_n: the translation from step `n` (from 1) to step `n + 1`, in cm, before r_t turns it.
    fn step(&self, n: usize) -> Vector3<f64>;
}

/// The object stays where it is: t_n = 0.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct NoTranslation;

impl Translation for NoTranslation {
    fn step(&self, _n: usize) -> Vector3<f64> {
        Vector3::zeros()
    }
}

/// Forth by a fixed vector from every odd step, back from every even one (section IV-A of the
/// paper: 0.1 cm along x).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BackAndForth {
    step_cm: Vector3<f64>,
}

impl BackAndForth {
    /// t_n = `step_cm` for odd n, its opposite for even n.
    pub fn new(step_cm: Vector3<f64>) -> Self {
        Self { step_cm }
    }
}

impl Translation for BackAndForth {
    fn step(&self, n: usize) -> Vector3<f64> {
        if elapsed(n).is_multiple_of(2) {
            self.step_cm
        } else {
            -self.step_cm
        }
    }
}

/// The object swings: its place is T(n) = amplitude · sin(2π (n − 1) / period + phase), and
/// t_n = T(n + 1) − T(n).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SinusoidalTranslation {
    amplitude_cm: Vector3<f64>,
    wave: Wave,
}

impl SinusoidalTranslation {
    /// A swing along `amplitude_cm` with the given period (steps) and phase at step 1 (rad).
    ///
    /// # Errors
    /// When the period is not a finite number above 0.
    pub fn new(
        amplitude_cm: Vector3<f64>,
        period_steps: f64,
        phase_rad: f64,
    ) -> Result<Self, MotionError> {
        Ok(Self {
            amplitude_cm,
            wave: Wave::new(period_steps, phase_rad)?,
        })
    }
}

impl Translation for SinusoidalTranslation {
    fn step(&self, n: usize) -> Vector3<f64> {
        self.amplitude_cm * (self.wave.at(n.saturating_add(1)) - self.wave.at(n))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn the_paper_moves_forth_and_then_back() {
        let paper = BackAndForth::new(Vector3::new(0.1, 0.0, 0.0));
        let x: Vec<f64> = (1..=4).map(|n| paper.step(n).x).collect();
        assert_eq!(x, [0.1, -0.1, 0.1, -0.1]);
    }

    #[test]
    fn sinusoid_by_hand() {
        // A quarter period a step: T = 0, 1, 0, −1, 0, …
        let swing = SinusoidalTranslation::new(Vector3::new(0.0, 2.0, 0.0), 4.0, 0.0).unwrap();
        let y: Vec<f64> = (1..=5).map(|n| swing.step(n).y).collect();
        for (got, expected) in y.iter().zip([2.0, -2.0, -2.0, 2.0, 2.0]) {
            assert_relative_eq!(*got, expected, epsilon = 1e-12);
        }
    }

    #[test]
    fn none_is_none() {
        assert_eq!(NoTranslation.step(7), Vector3::zeros());
    }
}
