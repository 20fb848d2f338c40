//! The messages, in the form of Foxglove's schemas. Lengths are metres here.

use adslam_record::{HistoryMetrics, HistoryStep};
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use nalgebra::{Isometry3, Vector3};
use serde::Serialize;
use serde_json::Value;

use super::geometry::{METRES, Placed, Quaternion, Xyz, at_origin, metres, placed, quaternion};
use crate::ellipsoid::ellipsoid;

/// The fixed frame.
const WORLD: &str = "world";

/// How large ellipsoids are drawn.
const SIGMAS: f64 = 3.0;

/// A time since the start.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct Stamp {
    sec: u64,
    nsec: u64,
}

impl Stamp {
    const SECOND: u64 = 1_000_000_000;

    pub(super) const fn new(nanoseconds: u64) -> Self {
        Self {
            sec: nanoseconds / Self::SECOND,
            nsec: nanoseconds % Self::SECOND,
        }
    }

    pub(super) const fn nanoseconds(self) -> u64 {
        self.sec * Self::SECOND + self.nsec
    }
}

#[derive(Clone, Copy, Serialize)]
struct Colour {
    r: f64,
    g: f64,
    b: f64,
    a: f64,
}

const SURFACE: Colour = Colour {
    r: 0.66,
    g: 0.78,
    b: 0.87,
    a: 0.8,
};
const ELLIPSOID: Colour = Colour {
    r: 0.84,
    g: 0.37,
    b: 0.0,
    a: 0.35,
};

#[derive(Serialize)]
pub(super) struct FrameTransform {
    timestamp: Stamp,
    parent_frame_id: &'static str,
    child_frame_id: &'static str,
    translation: Xyz,
    rotation: Quaternion,
}

#[derive(Serialize)]
pub(super) struct PoseInFrame {
    timestamp: Stamp,
    frame_id: &'static str,
    pose: Placed,
}

#[derive(Serialize)]
pub(super) struct PosesInFrame {
    timestamp: Stamp,
    frame_id: &'static str,
    poses: Vec<Placed>,
}

#[derive(Serialize)]
pub(super) struct PointCloud {
    timestamp: Stamp,
    frame_id: &'static str,
    pose: Placed,
    point_stride: usize,
    fields: Vec<Field>,
    data: String,
}

/// A number of each point, where it lies in the point's bytes, and of what type it is.
#[derive(Serialize)]
struct Field {
    name: &'static str,
    offset: usize,
    #[serde(rename = "type")]
    kind: u8,
}

#[derive(Serialize)]
pub(super) struct SceneUpdate {
    deletions: [(); 0],
    entities: Vec<Entity>,
}

#[derive(Serialize)]
struct Entity {
    timestamp: Stamp,
    frame_id: &'static str,
    id: &'static str,
    lifetime: Stamp,
    frame_locked: bool,
    metadata: [(); 0],
    arrows: [(); 0],
    cubes: [(); 0],
    spheres: Vec<Sphere>,
    cylinders: [(); 0],
    lines: [(); 0],
    triangles: Vec<Triangles>,
    texts: [(); 0],
    models: [(); 0],
}

#[derive(Serialize)]
struct Sphere {
    pose: Placed,
    size: Xyz,
    color: Colour,
}

#[derive(Serialize)]
struct Triangles {
    pose: Placed,
    points: Vec<Xyz>,
    color: Colour,
    colors: [(); 0],
    indices: Vec<usize>,
}

/// The frame `name`, which moves with the robot, in the world.
pub(super) fn frame(
    timestamp: Stamp,
    name: &'static str,
    robot: &Isometry3<f64>,
) -> FrameTransform {
    let Placed {
        position,
        orientation,
    } = placed(robot);
    FrameTransform {
        timestamp,
        parent_frame_id: WORLD,
        child_frame_id: name,
        translation: position,
        rotation: orientation,
    }
}

/// The robot's pose.
pub(super) fn pose(timestamp: Stamp, robot: &Isometry3<f64>) -> PoseInFrame {
    PoseInFrame {
        timestamp,
        frame_id: WORLD,
        pose: placed(robot),
    }
}

/// Poses one after the other.
pub(super) fn path(timestamp: Stamp, poses: impl Iterator<Item = Isometry3<f64>>) -> PosesInFrame {
    PosesInFrame {
        timestamp,
        frame_id: WORLD,
        poses: poses.map(|pose| placed(&pose)).collect(),
    }
}

/// The numbers of a step; those that it lacks, such as the NEES of an exactly known pose, are left out, as
/// their schema has nothing but numbers.
pub(super) fn metrics(numbers: &HistoryMetrics) -> serde_json::Result<Value> {
    let mut value = serde_json::to_value(numbers)?;
    if let Value::Object(fields) = &mut value {
        fields.retain(|_, number| !number.is_null());
    }
    Ok(value)
}

/// Features with their numbers and whether they are seen.
pub(super) fn cloud(timestamp: Stamp, places: &[[f64; 3]], visible: &[usize]) -> PointCloud {
    // The types' numbers in Foxglove's enumeration.
    const UINT8: u8 = 1;
    const UINT32: u8 = 5;
    const FLOAT64: u8 = 8;
    let field = |name, offset, kind| Field { name, offset, kind };
    let mut data = Vec::new();
    for (number, place) in (0u32..).zip(places) {
        for c in place {
            data.extend((c * METRES).to_le_bytes());
        }
        data.extend(number.to_le_bytes());
        let is_seen = visible.iter().any(|&seen| seen as u64 == u64::from(number));
        data.push(u8::from(is_seen));
    }
    PointCloud {
        timestamp,
        frame_id: WORLD,
        pose: at_origin(),
        point_stride: 29,
        fields: vec![
            field("x", 0, FLOAT64),
            field("y", 8, FLOAT64),
            field("z", 16, FLOAT64),
            field("feature", 24, UINT32),
            field("visible", 28, UINT8),
        ],
        data: BASE64_STANDARD.encode(data),
    }
}

/// The surface.
pub(super) fn scene(timestamp: Stamp, vertices: &[Xyz], faces: &[[usize; 3]]) -> SceneUpdate {
    let triangles = Triangles {
        pose: at_origin(),
        points: vertices.to_vec(),
        color: SURFACE,
        colors: [],
        indices: faces.iter().flatten().copied().collect(),
    };
    entity(timestamp, "surface", Vec::new(), vec![triangles])
}

/// The ellipsoids of three sigmas around the estimated features.
pub(super) fn uncertainty(timestamp: Stamp, step: &HistoryStep) -> SceneUpdate {
    let spheres = step.estimated_features.iter().enumerate();
    let spheres = spheres.filter_map(|(i, place)| {
        let (half_axes, rotation) = ellipsoid(&step.feature_covariance(i)?)?;
        Some(Sphere {
            pose: Placed {
                position: metres(&Vector3::from(*place)),
                orientation: quaternion(&rotation),
            },
            size: metres(&(2.0 * SIGMAS * half_axes)),
            color: ELLIPSOID,
        })
    });
    entity(timestamp, "uncertainty", spheres.collect(), Vec::new())
}

/// An entity that takes the place of that of the step before.
fn entity(
    timestamp: Stamp,
    id: &'static str,
    spheres: Vec<Sphere>,
    triangles: Vec<Triangles>,
) -> SceneUpdate {
    let entity = Entity {
        timestamp,
        frame_id: WORLD,
        id,
        // For ever, that is until it is replaced.
        lifetime: Stamp::new(0),
        frame_locked: false,
        metadata: [],
        arrows: [],
        cubes: [],
        spheres,
        cylinders: [],
        lines: [],
        triangles,
        texts: [],
        models: [],
    };
    SceneUpdate {
        deletions: [],
        entities: vec![entity],
    }
}
