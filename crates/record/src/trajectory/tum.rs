//! Trajectories in the TUM format, which the evo tools read.

use std::fmt::Display;
use std::io::Write;
use std::path::Path;

use adslam_diagnostics::Failure;
use adslam_models::Pose;
use adslam_names::LengthUnit;

use crate::AtomicFile;

/// A trajectory: a line a pose, `timestamp tx ty tz qx qy qz qw`. The quaternion takes body to world.
#[derive(Debug)]
pub struct TumFile {
    file: AtomicFile,
    /// What one unit of the poses is in the file.
    scale: f64,
}

/// What the time stamps of a trajectory are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TumTime {
    /// Numbers of steps.
    Step,
    /// Seconds.
    Seconds,
}

impl TumFile {
    /// The unit in which the evo tools expect positions.
    pub const USUAL_UNIT: LengthUnit = LengthUnit::M;

    /// Starts a trajectory at `path` of poses whose positions are in the unit `given`; they are written in
    /// `written`.
    ///
    /// # Errors
    /// [`Failure::Output`].
    pub fn create(
        path: &Path,
        time: TumTime,
        given: LengthUnit,
        written: LengthUnit,
    ) -> Result<Self, Failure> {
        let mut file = AtomicFile::create(path)?;
        let time = match time {
            TumTime::Step => "step",
            TumTime::Seconds => "s",
        };
        file.add(&format!(
            "# timestamp[{time}] tx[{written}] ty[{written}] tz[{written}] qx qy qz qw (world from \
             body)\n"
        ))?;
        Ok(Self {
            file,
            scale: given.in_cm() / written.in_cm(),
        })
    }

    /// Adds the pose at a time.
    ///
    /// # Errors
    /// [`Failure::Output`].
    pub fn add(&mut self, time: impl Display, pose: &Pose) -> Result<(), Failure> {
        let p = pose.position.coords * self.scale;
        let q = pose.orientation.quaternion().into_inner();
        writeln!(
            self.file,
            "{time} {:e} {:e} {:e} {:e} {:e} {:e} {:e}",
            p.x, p.y, p.z, q.i, q.j, q.k, q.w
        )
        .map_err(Failure::output(self.file.path()))
    }

    /// Ends the trajectory; the file still has to be committed.
    #[must_use]
    pub fn finish(self) -> AtomicFile {
        self.file
    }
}
