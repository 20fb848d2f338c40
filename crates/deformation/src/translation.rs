//! Translations that all points of the object share: t of eq. (2).

use std::fmt::Debug;

use nalgebra::Vector3;

use crate::MotionError;
use crate::amount::Wave;

/// How the whole object shifts over time.
pub trait Translation: Debug + Send + Sync {
    /// T(to) − T(from): the translation from one time to another (in steps, 1 at the start), in cm,
    /// before r_t turns it; t_n is that from n to n + 1.
    fn between(&self, from: f64, to: f64) -> Vector3<f64>;
}

/// The object stays where it is: t_n = 0.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct NoTranslation;

impl Translation for NoTranslation {
    fn between(&self, _from: f64, _to: f64) -> Vector3<f64> {
        Vector3::zeros()
    }
}

/// Forth by a fixed vector from every odd step, back from every even one (section IV-A of the
/// paper: 0.1 cm along x), at a constant speed between two steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BackAndForth {
    step_cm: Vector3<f64>,
}

impl BackAndForth {
    /// t_n = `step_cm` for odd n, its opposite for even n.
    pub fn new(step_cm: Vector3<f64>) -> Self {
        Self { step_cm }
    }

    /// How much of the way forth is behind it, from 0 to 1.
    fn part(time: f64) -> f64 {
        1.0 - ((time - 1.0).rem_euclid(2.0) - 1.0).abs()
    }
}

impl Translation for BackAndForth {
    fn between(&self, from: f64, to: f64) -> Vector3<f64> {
        self.step_cm * (Self::part(to) - Self::part(from))
    }
}

/// The object swings: its place is T(τ) = amplitude · sin(2π (τ − 1) / period + phase).
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
    fn between(&self, from: f64, to: f64) -> Vector3<f64> {
        self.amplitude_cm * (self.wave.at(to) - self.wave.at(from))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// t_n for n = 1, 2, …
    fn steps(translation: &impl Translation, count: u32) -> Vec<Vector3<f64>> {
        let of_step = |n: u32| translation.between(f64::from(n), f64::from(n + 1));
        (1..=count).map(of_step).collect()
    }

    #[test]
    fn the_paper_moves_forth_and_then_back() {
        let paper = BackAndForth::new(Vector3::new(0.1, 0.0, 0.0));
        let x: Vec<f64> = steps(&paper, 4).iter().map(|t| t.x).collect();
        assert_eq!(x, [0.1, -0.1, 0.1, -0.1]);
    }

    #[test]
    fn back_and_forth_is_linear_between_steps_and_goes_back_without_end() {
        let paper = BackAndForth::new(Vector3::new(1.0, 0.0, 0.0));
        for (from, to, expected) in [
            (1.0, 1.25, 0.25),
            (1.5, 2.5, 0.0),
            (2.0, 2.25, -0.25),
            (0.0, 1.0, -1.0),
            (-1.0, -0.5, 0.5),
        ] {
            assert_relative_eq!(paper.between(from, to).x, expected, epsilon = 1e-12);
        }
    }

    #[test]
    fn sinusoid_by_hand() {
        // A quarter period a step: T = 0, 1, 0, −1, 0, …
        let swing = SinusoidalTranslation::new(Vector3::new(0.0, 2.0, 0.0), 4.0, 0.0).unwrap();
        let y: Vec<f64> = steps(&swing, 5).iter().map(|t| t.y).collect();
        for (got, expected) in y.iter().zip([2.0, -2.0, -2.0, 2.0, 2.0]) {
            assert_relative_eq!(*got, expected, epsilon = 1e-12);
        }
    }

    #[test]
    fn none_is_none() {
        assert_eq!(NoTranslation.between(1.0, 7.5), Vector3::zeros());
    }
}
