//! The trajectory that a log's estimates make.

use std::path::Path;

use adslam_diagnostics::Failure;
use adslam_models::Pose;
use adslam_names::LengthUnit;

use super::EstimateLine;
use crate::{AtomicFile, TumFile, TumTime};

/// The estimated poses with their steps and times.
#[derive(Clone, Debug, Default)]
pub struct Trajectory {
    poses: Vec<(u64, Option<f64>, Pose)>,
}

impl Trajectory {
    /// Adds the pose of a line.
    pub fn add(&mut self, line: &EstimateLine) {
        let pose = Pose::from_vector(&line.pose.into());
        self.poses.push((line.step, line.time, pose));
    }

    /// The trajectory as a TUM file, which still has to be committed, and what its user should know. Its time
    /// stamps are the times of the log, or the steps where the log has none. Positions are `given` in one unit
    /// and `written` in another.
    ///
    /// # Errors
    /// [`Failure::Output`].
    pub fn write(
        &self,
        path: &Path,
        given: LengthUnit,
        written: LengthUnit,
    ) -> Result<(AtomicFile, Option<String>), Failure> {
        let timeless = self.poses.iter().filter(|(_, time, _)| time.is_none());
        let timeless = timeless.count();
        if timeless == self.poses.len() {
            let mut file = TumFile::create(path, TumTime::Step, given, written)?;
            for (step, _, pose) in &self.poses {
                file.add(step, pose)?;
            }
            return Ok((file.finish(), None));
        }
        let mut file = TumFile::create(path, TumTime::Seconds, given, written)?;
        for (_, time, pose) in &self.poses {
            if let Some(time) = time {
                file.add(time, pose)?;
            }
        }
        let warning = (timeless > 0).then(|| {
            format!(
                "{timeless} of {} steps have no time in the log and are left out of {}",
                self.poses.len(),
                path.display()
            )
        });
        Ok((file.finish(), warning))
    }
}
