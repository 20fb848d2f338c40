//! Files of results: whole or not at all.

mod atomic;
mod features;
mod steps;
mod tum;

pub(crate) use atomic::remove_leftovers;
pub use atomic::{AtomicFile, prepare_folder};
pub use features::{FeaturesFile, LastFeatures};
pub use steps::StepsFile;
pub use tum::TumFile;
