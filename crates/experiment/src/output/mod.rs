//! Files of results: whole or not at all.

mod atomic;
mod features;
#[cfg(feature = "parquet")]
mod parquet_file;
mod steps;
mod table_file;
mod temporary;
mod tum;

pub use atomic::AtomicFile;
pub use features::{FeaturesFile, LastFeatures};
pub use steps::StepsFile;
pub use table_file::{Column, ColumnKind, TableFile};
pub use temporary::prepare_folder;
pub(crate) use temporary::{make_folder, not_writable};
pub use tum::{TumFile, TumTime};
