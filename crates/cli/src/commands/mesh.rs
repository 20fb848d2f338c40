//! `adslam mesh`

use adslam_experiment::{ExperimentError, MeshReport};

use crate::MeshArgs;
use crate::print::say;

/// Says what a mesh file holds and whether it will serve as an object.
///
/// # Errors
/// A file that cannot be read as a mesh, or a mesh that will not serve, after it has been described.
pub fn mesh(args: &MeshArgs) -> Result<(), ExperimentError> {
    let report = MeshReport::read(&args.file, args.unit, args.features)?;
    if args.json {
        say(report.to_json().map_err(|cause| ExperimentError::Output {
            path: "the standard output".into(),
            cause: cause.into(),
        })?);
    } else {
        say(&report);
    }
    Ok(report.into_result()?)
}
