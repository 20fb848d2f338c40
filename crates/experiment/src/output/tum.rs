//! Trajectories in the TUM format, which the evo tools read.

use std::io::Write;
use std::path::Path;

use adslam_models::Pose;

use super::AtomicFile;
use crate::ExperimentError;

/// A trajectory: a line a pose, `timestamp tx ty tz qx qy qz qw`. The timestamp is the step; positions
/// are in cm, the unit of everything here, and the quaternion takes body to world.
#[derive(Debug)]
pub struct TumFile {
    file: AtomicFile,
}

impl TumFile {
    /// Starts a trajectory at `path`.
    ///
    /// # Errors
    /// [`ExperimentError::Output`].
    pub fn create(path: &Path) -> Result<Self, ExperimentError> {
        let mut file = AtomicFile::create(path)?;
        writeln!(
            file,
            "# timestamp[step] tx[cm] ty[cm] tz[cm] qx qy qz qw (world from body)"
        )
        .map_err(ExperimentError::output(path))?;
        Ok(Self { file })
    }

    /// Adds the pose at a step.
    ///
    /// # Errors
    /// [`ExperimentError::Output`].
    pub fn add(&mut self, step: usize, pose: &Pose) -> Result<(), ExperimentError> {
        let p = pose.position;
        let q = pose.orientation.quaternion().into_inner();
        writeln!(
            self.file,
            "{step} {:e} {:e} {:e} {:e} {:e} {:e} {:e}",
            p.x, p.y, p.z, q.i, q.j, q.k, q.w
        )
        .map_err(ExperimentError::output(self.file.path()))
    }

    /// Ends the trajectory; the file still has to be committed.
    #[must_use]
    pub fn finish(self) -> AtomicFile {
        self.file
    }
}
