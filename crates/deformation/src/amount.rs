//! Periodic amounts: how far something has moved at a step.

use std::f64::consts::TAU;
use std::fmt::Debug;

use crate::MotionError;

/// A signed length that depends on time alone.
pub trait Amount: Debug + Send + Sync {
    /// The amount at `time` (in steps, 1 at the start), in cm.
    fn at(&self, time: f64) -> f64;
}

/// A list of amounts, gone through again and again: step n has number (n − 1) mod period. Between
/// two steps the amount changes linearly.
#[derive(Debug, Clone, PartialEq)]
pub struct Schedule {
    amounts_cm: Vec<f64>,
}

impl Schedule {
    /// A schedule of amounts in cm, the first of which holds at step 1.
    ///
    /// # Errors
    /// When there is no amount, or one is not finite.
    pub fn new(amounts_cm: Vec<f64>) -> Result<Self, MotionError> {
        if amounts_cm.is_empty() {
            return Err(MotionError::EmptySchedule);
        }
        let not_finite = amounts_cm
            .iter()
            .copied()
            .enumerate()
            .find(|(_, a)| !a.is_finite());
        match not_finite {
            Some((index, value)) => Err(MotionError::AmountNotFinite { index, value }),
            None => Ok(Self { amounts_cm }),
        }
    }

    /// Steps after which the schedule starts again.
    pub fn period(&self) -> usize {
        self.amounts_cm.len()
    }
}

impl Amount for Schedule {
    fn at(&self, time: f64) -> f64 {
        let elapsed = (time - 1.0).rem_euclid(self.period() as f64);
        let fraction = elapsed.fract();
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a place in the list, or one past it where rounding led there"
        )]
        let before = elapsed as usize;
        let number = |k: usize| self.amounts_cm[k % self.period()];
        number(before) * (1.0 - fraction) + number(before + 1) * fraction
    }
}

/// amplitude · sin(2π (time − 1) / period + phase).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sinusoid {
    amplitude_cm: f64,
    wave: Wave,
}

impl Sinusoid {
    /// A sinusoid of the given amplitude (cm), period (steps, need not be whole) and phase at
    /// step 1 (rad).
    ///
    /// # Errors
    /// When the period is not a finite number above 0.
    pub fn new(amplitude_cm: f64, period_steps: f64, phase_rad: f64) -> Result<Self, MotionError> {
        Ok(Self {
            amplitude_cm,
            wave: Wave::new(period_steps, phase_rad)?,
        })
    }
}

impl Amount for Sinusoid {
    fn at(&self, time: f64) -> f64 {
        self.amplitude_cm * self.wave.at(time)
    }
}

/// A sine of unit amplitude over time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Wave {
    period_steps: f64,
    phase_rad: f64,
}

impl Wave {
    pub(crate) fn new(period_steps: f64, phase_rad: f64) -> Result<Self, MotionError> {
        if period_steps.is_finite() && period_steps > 0.0 {
            Ok(Self {
                period_steps,
                phase_rad,
            })
        } else {
            Err(MotionError::BadPeriod(period_steps))
        }
    }

    pub(crate) fn at(&self, time: f64) -> f64 {
        (TAU * (time - 1.0) / self.period_steps + self.phase_rad).sin()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn schedule_starts_at_step_one_and_repeats() {
        let paper = Schedule::new(vec![0.0, 0.2, 0.4, 0.6, 0.4, 0.2]).unwrap();
        let seen: Vec<f64> = (1..=8).map(|n| paper.at(f64::from(n))).collect();
        assert_eq!(seen, [0.0, 0.2, 0.4, 0.6, 0.4, 0.2, 0.0, 0.2]);
        assert_eq!(paper.period(), 6);
    }

    #[test]
    fn a_schedule_needs_finite_amounts() {
        assert_eq!(Schedule::new(vec![]), Err(MotionError::EmptySchedule));
        let error = Schedule::new(vec![0.1, f64::INFINITY]).unwrap_err();
        assert!(matches!(
            error,
            MotionError::AmountNotFinite { index: 1, .. }
        ));
    }

    #[test]
    fn sinusoid_has_its_phase_at_step_one() {
        let wave = Sinusoid::new(2.0, 8.0, std::f64::consts::FRAC_PI_6).unwrap();
        assert_relative_eq!(wave.at(1.0), 1.0, epsilon = 1e-12);
        assert_relative_eq!(wave.at(5.0), -1.0, epsilon = 1e-12);
        assert_relative_eq!(wave.at(9.0), 1.0, epsilon = 1e-12);
    }

    #[test]
    fn a_sinusoid_needs_a_period() {
        for period in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(
                Sinusoid::new(1.0, period, 0.0),
                Err(MotionError::BadPeriod(_))
            ));
        }
    }

    #[test]
    fn a_schedule_is_linear_between_steps_and_goes_back_without_end() {
        let schedule = Schedule::new(vec![0.0, 0.4, 0.2]).unwrap();
        for (time, expected) in [
            (1.25, 0.1),
            (2.5, 0.3),
            (3.5, 0.1),
            (0.5, 0.1),
            (0.0, 0.2),
            (-0.5, 0.3),
            (-2.0, 0.0),
        ] {
            assert_relative_eq!(schedule.at(time), expected, epsilon = 1e-12);
        }
        // So little before the start that the remainder rounds to a whole period.
        let before_the_start = 1.0 - 1e-17 - f64::EPSILON / 4.0;
        assert_relative_eq!(schedule.at(before_the_start), 0.0, epsilon = 1e-12);
    }
}
