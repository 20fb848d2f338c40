//! Files of results: whole or not at all.

mod atomic;
mod features;
mod folder_lock;
#[cfg(feature = "parquet")]
mod parquet_file;
mod pose_covariance;
mod steps;
mod table_file;
mod temporary;
mod tum;

pub use atomic::AtomicFile;
pub(crate) use atomic::checksum;
pub use features::{FeaturesFile, LastFeatures};
pub(crate) use folder_lock::FolderLock;
pub use pose_covariance::PoseCovarianceFile;
pub use steps::StepsFile;
pub use table_file::{Column, ColumnKind, TableFile};
pub use temporary::prepare_folder;
pub(crate) use temporary::{make_folder, not_writable};
pub use tum::{TumFile, TumTime};
