//! When a motion shows what: its own time against the steps.

use crate::MotionError;

/// No motion may run more times as fast as the steps than this.
pub const MAX_CLOCK_FACTOR: f64 = 1000.0;

/// The time of a motion at each step, in steps: τ(n) = 1 + factor · (n − 1 − delay).
///
/// The default is the time of the steps themselves, τ(n) = n.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clock {
    factor: f64,
    delay_steps: f64,
}

impl Default for Clock {
    fn default() -> Self {
        Self {
            factor: 1.0,
            delay_steps: 0.0,
        }
    }
}

impl Clock {
    /// A clock that runs `factor` times as fast as the steps and lags `delay_steps` behind them;
    /// below 0 it is ahead.
    ///
    /// # Errors
    /// When the factor is not between 0 and [`MAX_CLOCK_FACTOR`], or the delay is not finite.
    pub fn new(factor: f64, delay_steps: f64) -> Result<Self, MotionError> {
        if (0.0..=MAX_CLOCK_FACTOR).contains(&factor) && delay_steps.is_finite() {
            Ok(Self {
                factor,
                delay_steps,
            })
        } else {
            Err(MotionError::BadClock {
                factor,
                delay_steps,
            })
        }
    }

    /// τ(n). Step 0 does not exist and is taken as step 1.
    pub fn time(&self, n: usize) -> f64 {
        1.0 + self.factor * (n.max(1) as f64 - 1.0 - self.delay_steps)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_is_the_step_exactly() {
        for n in [1, 2, 3, 77, 1_000_000] {
            assert_eq!(Clock::default().time(n), n as f64);
        }
        assert_eq!(Clock::default().time(0), 1.0);
    }

    #[test]
    fn runs_faster_and_lags_behind() {
        let clock = Clock::new(2.0, 1.5).unwrap();
        let times = [1, 2, 3, 4].map(|n| clock.time(n));
        assert_eq!(times, [-2.0, 0.0, 2.0, 4.0], "it begins at step 2.5");
        assert_eq!(Clock::new(0.0, 3.0).unwrap().time(9), 1.0, "it stands");
    }

    #[test]
    fn refuses_what_is_no_speed_or_no_delay() {
        for (factor, delay) in [
            (-0.1, 0.0),
            (1000.1, 0.0),
            (f64::NAN, 0.0),
            (1.0, f64::INFINITY),
        ] {
            assert!(matches!(
                Clock::new(factor, delay),
                Err(MotionError::BadClock { .. })
            ));
        }
    }
}
