//! What can be wrong with the parameters of a generator.

use thiserror::Error;

/// A generator that cannot be built from the given parameters.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum MotionError {
    /// A schedule needs at least one amount, or there is nothing to repeat.
    #[error("the schedule is empty; give at least one amount in cm, such as 0.0")]
    EmptySchedule,
    /// An amount of a schedule is NaN or infinite.
    #[error("amount {index} of the schedule is {value}; it must be a finite number of cm")]
    AmountNotFinite {
        /// Where it stands in the schedule, from 0.
        index: usize,
        /// The amount.
        value: f64,
    },
    /// A sinusoid needs a finite period longer than nothing.
    #[error("the period is {0} steps; it must be a finite number above 0")]
    BadPeriod(f64),
    /// A rotation needs an axis of finite, non-zero length.
    #[error("the axis ({0}, {1}, {2}) has no direction; give a finite vector other than zero")]
    BadAxis(f64, f64, f64),
    /// A clock needs a speed between standstill and [`MAX_CLOCK_FACTOR`](crate::MAX_CLOCK_FACTOR),
    /// and a finite delay.
    #[error(
        "a motion cannot run {factor} times as fast and {delay_steps} steps late; give a factor \
         from 0 to 1000 and a finite delay"
    )]
    BadClock {
        /// How many times as fast.
        factor: f64,
        /// How many steps late.
        delay_steps: f64,
    },
}
