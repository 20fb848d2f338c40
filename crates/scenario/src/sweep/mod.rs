//! Sweep files: keys of a scenario varied.

mod file;
mod places;
#[cfg(test)]
mod tests;

pub(crate) use file::SweepFile;
pub use file::{Sweep, SweepPoint};
pub use places::MOST_POINTS;
