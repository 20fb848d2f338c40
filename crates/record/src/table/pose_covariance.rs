//! pose_covariance.csv: what the filter believes of the pose's errors, a row a step.

use std::iter;
use std::path::{Path, PathBuf};

use adslam_diagnostics::Failure;
use adslam_models::POSE_DIM;
use adslam_simulation::StepView;

use crate::AtomicFile;

/// The components of the pose, and the unit of each.
pub const POSE_COMPONENTS: [(&str, &str); POSE_DIM] = [
    ("roll", "rad"),
    ("pitch", "rad"),
    ("yaw", "rad"),
    ("x", "cm"),
    ("y", "cm"),
    ("z", "cm"),
];

/// The covariance of the estimated pose at each step, all of its digits: its upper triangle row by row.
#[derive(Debug)]
pub struct PoseCovarianceFile {
    writer: csv::Writer<AtomicFile>,
    path: PathBuf,
}

impl PoseCovarianceFile {
    /// Starts the table at `path`.
    ///
    /// # Errors
    /// [`Failure::Output`].
    pub fn create(path: &Path) -> Result<Self, Failure> {
        let file = AtomicFile::create(path)?;
        let mut writer = csv::WriterBuilder::new()
            .has_headers(false)
            .from_writer(file);
        let heads = upper_triangle().map(|(i, j)| head(i, j));
        let heads: Vec<String> = iter::once("step".to_owned()).chain(heads).collect();
        writer.write_record(heads).map_err(Failure::output(path))?;
        Ok(Self {
            writer,
            path: path.to_owned(),
        })
    }

    /// Adds a step.
    ///
    /// # Errors
    /// [`Failure::Output`].
    pub fn add(&mut self, view: &StepView<'_>) -> Result<(), Failure> {
        let covariance = view.belief.covariance.pose();
        let entries: Vec<f64> = upper_triangle().map(|at| covariance[at]).collect();
        self.writer
            .serialize((view.step, entries))
            .map_err(Failure::output(&self.path))
    }

    /// Ends the table; the file still has to be committed.
    ///
    /// # Errors
    /// [`Failure::Output`].
    pub fn finish(self) -> Result<AtomicFile, Failure> {
        let Self { writer, path } = self;
        writer
            .into_inner()
            .map_err(|error| Failure::output(&path)(error.into_error()))
    }
}

fn upper_triangle() -> impl Iterator<Item = (usize, usize)> {
    (0..POSE_DIM).flat_map(|i| (i..POSE_DIM).map(move |j| (i, j)))
}

/// The head of a column, such as `roll_x_rad_times_cm`, or `x_y_cm2`.
fn head(i: usize, j: usize) -> String {
    let ((one, its_unit), (other, unit)) = (POSE_COMPONENTS[i], POSE_COMPONENTS[j]);
    if unit == its_unit {
        format!("{one}_{other}_{unit}2")
    } else {
        format!("{one}_{other}_{its_unit}_times_{unit}")
    }
}
