//! `adslam mesh`

use adslam_diagnostics::Failure;
use adslam_setup::{MeshReport, MeshUse};

use crate::MeshArgs;
use crate::answer::Answer;

/// Says what a mesh file holds and whether it will serve as an object.
///
/// # Errors
/// A file that cannot be read as a mesh, or a mesh that will not serve, after it has been described.
pub fn mesh(args: &MeshArgs) -> Result<(), Failure> {
    Answer::give(args.json, |answer| {
        let wanted = MeshUse {
            unit: args.unit,
            join_within_cm: args.join_within,
            features: args.features,
        };
        let report = MeshReport::read(&args.file, wanted)?;
        answer.set("mesh", &report);
        answer.say(&report);
        Ok(report.into_result()?)
    })
}
