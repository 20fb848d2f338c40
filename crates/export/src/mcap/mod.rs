//! A run as an MCAP file for Foxglove: poses, features, surface and curves against time.

mod geometry;
mod messages;
mod schemas;

use std::collections::BTreeMap;
use std::io;
use std::num::NonZeroU64;
use std::path::Path;

use adslam_diagnostics::Failure;
use adslam_record::{AtomicFile, HistoryStep, RunHistory};
use geometry::{Xyz, surface_points};
use mcap::records::MessageHeader;
use mcap::{Compression, McapError, WriteOptions, Writer};
use messages::{Stamp, cloud, frame, metrics, path, pose, scene, uncertainty};
use nalgebra::{Isometry3, Translation3, UnitQuaternion};
use schemas::Schema;
use serde::Serialize;

use crate::failed;

/// Messages that are packed together: some steps of a large surface, whose triangles are then written once.
const CHUNK_BYTES: u64 = 4 << 20;

/// Poses of a path that are written at each step: the size of a file grows with its steps, not their square.
const LONGEST_PATH: usize = 500;

/// The time between two steps, which have none of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Period {
    nanoseconds: NonZeroU64,
}

impl Period {
    /// From 1 ns to 1 hour.
    #[must_use]
    pub fn from_seconds(seconds: f64) -> Option<Self> {
        const HOUR: f64 = 3600.0;
        let nanoseconds = (seconds * 1e9).round();
        if !(1.0..=HOUR * 1e9).contains(&nanoseconds) {
            return None;
        }
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a whole number within the bounds"
        )]
        let nanoseconds = NonZeroU64::new(nanoseconds as u64)?;
        Some(Self { nanoseconds })
    }

    /// When a step is, step 1 being at one period.
    fn at(self, step: u64) -> Stamp {
        Stamp::new(self.nanoseconds.get().saturating_mul(step))
    }
}

/// Writes a run as MCAP, steps `period` apart; lengths in metres, as Foxglove expects.
///
/// Messages are JSON with Foxglove's well-known schemas, so that its panels show them as they are:
/// frames, poses and paths of the robot, true and estimated, viewpoints, clouds of features, the surface where
/// it has changed, and the ellipsoids of three sigmas; and `/metrics`, with a schema of its own, of numbers to
/// plot. They are packed with zstd.
///
/// # Errors
/// A file that cannot be written; what lay at `out` is then unchanged.
pub fn write_mcap(history: &RunHistory, period: Period, out: &Path) -> Result<(), Failure> {
    let said = |error: McapError| {
        failed(out)(match error {
            McapError::Io(cause) => cause,
            other => io::Error::other(other),
        })
    };
    let options = WriteOptions::new()
        .compression(Some(Compression::Zstd))
        .chunk_size(Some(CHUNK_BYTES))
        .library(concat!("adslam ", env!("CARGO_PKG_VERSION")));
    let mut file = AtomicFile::create(out)?;
    let mut log = Log {
        writer: options.create(&mut file).map_err(said)?,
        channels: BTreeMap::new(),
        surface: Vec::new(),
    };
    log.viewpoints(history, period).map_err(said)?;
    for (index, sequence) in (0..history.steps.len()).zip(1..) {
        log.step(history, index, sequence, period).map_err(said)?;
    }
    log.writer.finish().map_err(said)?;
    drop(log);
    file.commit()
}

/// An open file.
struct Log<'a> {
    writer: Writer<&'a mut AtomicFile>,
    channels: BTreeMap<&'static str, u16>,
    /// The vertices of the surface as they were written last.
    surface: Vec<Xyz>,
}

impl Log<'_> {
    fn step(
        &mut self,
        history: &RunHistory,
        index: usize,
        sequence: u32,
        period: Period,
    ) -> Result<(), McapError> {
        let Some(step) = history.steps.get(index) else {
            return Ok(());
        };
        let at = period.at(u64::from(sequence));
        let [truth, estimate] = [step.pose, step.estimated_pose].map(placement);
        for (name, robot) in [("robot", &truth), ("robot_estimate", &estimate)] {
            let message = frame(at, name, robot);
            self.add("/tf", Schema::FrameTransform, sequence, at, &message)?;
        }
        for (topic, robot) in [("/pose/truth", &truth), ("/pose/estimate", &estimate)] {
            self.add(topic, Schema::PoseInFrame, sequence, at, &pose(at, robot))?;
        }
        let so_far = thinned(&history.steps[..=index]);
        let message = path(at, so_far.clone().map(|step| placement(step.pose)));
        self.add("/path/truth", Schema::PosesInFrame, sequence, at, &message)?;
        let message = path(at, so_far.map(|step| placement(step.estimated_pose)));
        self.add(
            "/path/estimate",
            Schema::PosesInFrame,
            sequence,
            at,
            &message,
        )?;
        for (topic, places) in [
            ("/features/truth", &step.features),
            ("/features/estimate", &step.estimated_features),
        ] {
            let message = cloud(at, places, &step.visible);
            self.add(topic, Schema::PointCloud, sequence, at, &message)?;
        }
        let vertices = surface_points(&history.drawn_vertices(index));
        if vertices != self.surface {
            let surface = scene(at, &vertices, history.drawn_faces());
            self.add("/surface", Schema::SceneUpdate, sequence, at, &surface)?;
            self.surface = vertices;
        }
        let message = uncertainty(at, step);
        self.add("/uncertainty", Schema::SceneUpdate, sequence, at, &message)?;
        let message = metrics(&step.metrics).map_err(io::Error::from)?;
        self.add("/metrics", Schema::Metrics, sequence, at, &message)
    }

    /// The viewpoints, which stay where they are: once, at the first step.
    fn viewpoints(&mut self, history: &RunHistory, period: Period) -> Result<(), McapError> {
        if history.viewpoints_cm.is_empty() {
            return Ok(());
        }
        let at = period.at(1);
        let places = history.viewpoints_cm.iter();
        let message = path(at, places.map(|&[x, y, z]| Isometry3::translation(x, y, z)));
        self.add("/viewpoints", Schema::PosesInFrame, 1, at, &message)
    }

    fn add(
        &mut self,
        topic: &'static str,
        schema: Schema,
        sequence: u32,
        at: Stamp,
        message: &impl Serialize,
    ) -> Result<(), McapError> {
        let channel_id = match self.channels.get(topic) {
            Some(id) => *id,
            None => {
                let data = schema.json().to_string();
                let schema =
                    self.writer
                        .add_schema(schema.name(), "jsonschema", data.as_bytes())?;
                let id = self
                    .writer
                    .add_channel(schema, topic, "json", &BTreeMap::new())?;
                self.channels.insert(topic, id);
                id
            }
        };
        let data = serde_json::to_vec(message).map_err(io::Error::from)?;
        let header = MessageHeader {
            channel_id,
            sequence,
            log_time: at.nanoseconds(),
            publish_time: at.nanoseconds(),
        };
        self.writer.write_to_known_channel(&header, &data)
    }
}

/// A pose of a history as what takes body to world.
fn placement([roll, pitch, yaw, x, y, z]: [f64; 6]) -> Isometry3<f64> {
    let rotation = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
    Isometry3::from_parts(Translation3::new(x, y, z), rotation)
}

/// Steps of a path, evenly thinned where they are many, the last of them always.
fn thinned(steps: &[HistoryStep]) -> impl Iterator<Item = &HistoryStep> + Clone {
    let apart = steps.len().div_ceil(LONGEST_PATH).max(1);
    // Counted from the last.
    let first = steps.len().saturating_sub(1) % apart;
    steps.iter().skip(first).step_by(apart)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn periods_have_bounds() {
        for wrong in [0.0, -1.0, 1e-10, 3601.0, f64::NAN, f64::INFINITY] {
            assert_eq!(Period::from_seconds(wrong), None, "{wrong}");
        }
        let period = Period::from_seconds(0.1).unwrap();
        assert_eq!(period.at(15).nanoseconds(), 1_500_000_000);
    }
}
