//! A run as an MCAP file for Foxglove: poses, features, surface and curves against time.

mod messages;
mod schemas;

use std::collections::BTreeMap;
use std::io;
use std::num::NonZeroU64;
use std::path::Path;

use adslam_experiment::ExperimentError;
use adslam_experiment::output::AtomicFile;
use adslam_experiment::run::RunHistory;
use mcap::records::MessageHeader;
use mcap::{McapError, WriteOptions, Writer};
use nalgebra::Isometry3;
use serde::Serialize;

use crate::failed;
use messages::{Stamp, cloud, frame, pose, scene, uncertainty};
use schemas::Schema;

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
/// frames and poses of the robot, true and estimated, clouds of features, the surface, and the
/// ellipsoids of three sigmas; and `/metrics` with numbers to plot.
///
/// # Errors
/// A file that cannot be written; what lay at `out` is then unchanged.
pub fn write_mcap(history: &RunHistory, period: Period, out: &Path) -> Result<(), ExperimentError> {
    let said = |error: McapError| {
        failed(out)(match error {
            McapError::Io(cause) => cause,
            other => io::Error::other(other),
        })
    };
    let options = WriteOptions::new()
        .compression(None)
        .library(concat!("adslam ", env!("CARGO_PKG_VERSION")));
    let mut file = AtomicFile::create(out)?;
    let mut log = Log {
        writer: options.create(&mut file).map_err(said)?,
        channels: BTreeMap::new(),
    };
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
        let (truth, estimate) = (step.true_pose(), step.estimate());
        let [truth, estimate] = [truth, estimate].map(|pose| {
            let rotation = pose.orientation.quaternion();
            Isometry3::from_parts(pose.position.into(), rotation)
        });
        for (name, robot) in [("robot", &truth), ("robot_estimate", &estimate)] {
            let message = frame(at, name, robot);
            self.add("/tf", Schema::FrameTransform, sequence, at, &message)?;
        }
        for (topic, robot) in [("/pose/truth", &truth), ("/pose/estimate", &estimate)] {
            self.add(topic, Schema::PoseInFrame, sequence, at, &pose(at, robot))?;
        }
        for (topic, places) in [
            ("/features/truth", &step.features),
            ("/features/estimate", &step.estimated_features),
        ] {
            let message = cloud(at, places, &step.visible);
            self.add(topic, Schema::PointCloud, sequence, at, &message)?;
        }
        let surface = scene(at, &history.drawn_vertices(index), history.drawn_faces());
        self.add("/surface", Schema::SceneUpdate, sequence, at, &surface)?;
        let message = uncertainty(at, step);
        self.add("/uncertainty", Schema::SceneUpdate, sequence, at, &message)?;
        self.add("/metrics", Schema::Metrics, sequence, at, &step.metrics)
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
