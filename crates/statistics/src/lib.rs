//! What many runs say: means with confidence intervals, and paired tests between planners.
//!
//! Nothing here assumes a distribution. All random draws come from generators with fixed seeds of their own,
//! so the same numbers always give the same result; no seed of a run is touched.
//!
//! ```
//! use adslam_statistics::PairedComparison;
//!
//! // The errors of one planner less those of another, at the same seeds.
//! let differences = [-0.3, -0.1, -0.2, -0.4, 0.1, -0.2, -0.3, -0.1];
//! let compared = PairedComparison::of(&differences).ok_or("no pairs")?;
//! assert!(compared.difference.mean < 0.0 && compared.p < 0.05);
//! # Ok::<(), &str>(())
//! ```

mod bootstrap;
pub mod chi_squared;
mod few_runs;
mod holm;
mod paired;
mod ranks;
mod share;

use rand::SeedableRng;
use rand_chacha::ChaCha12Rng;

pub use bootstrap::{BOOTSTRAP_CONFIDENCE, Interval, MeanEstimate, RESAMPLES};
pub use few_runs::{Statistic, interval_of_few};
pub use holm::holm;
pub use paired::{MOST_ENUMERATED, PairedComparison, SIGN_FLIPS, sign_flip_p};
pub use ranks::RankComparison;
pub use share::interval_of_share;

/// What random numbers are for in the statistics; each purpose has a stream of its own.
#[derive(Clone, Copy)]
enum Draws {
    Bootstrap = 0,
    SignFlips = 1,
    FewRuns = 2,
}

/// The generator of one purpose, always from its start.
fn generator(purpose: Draws) -> ChaCha12Rng {
    const SEED: u64 = 0x6164_736c_616d;
    let mut generator = ChaCha12Rng::seed_from_u64(SEED);
    generator.set_stream(purpose as u64);
    generator
}

/// The arithmetic mean; NaN of nothing.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}
