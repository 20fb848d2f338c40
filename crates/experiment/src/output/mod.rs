//! Files of results: whole or not at all.

mod atomic;
mod features;
#[cfg(feature = "parquet")]
mod parquet_file;
mod steps;
mod table_file;
mod tum;

pub(crate) use atomic::remove_leftovers;
pub use atomic::{AtomicFile, prepare_folder};
pub use features::{FeaturesFile, LastFeatures};
pub use steps::StepsFile;
pub use table_file::{Column, ColumnKind, TableFile};
pub use tum::TumFile;
