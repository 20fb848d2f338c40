//! Tables: those of a run, and any others.

mod column;
mod features;
#[cfg(feature = "parquet")]
mod parquet_file;
mod pose_covariance;
mod steps;
mod table_file;

pub use column::{Column, ColumnKind};
pub use features::{FeaturesFile, LastFeatures};
pub use pose_covariance::{POSE_COMPONENTS, PoseCovarianceFile};
pub use steps::StepsFile;
pub use table_file::TableFile;
