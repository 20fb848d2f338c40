//! The schemas of the messages, as JSON schemas under Foxglove's names.

use serde_json::{Value, json};

/// What a topic carries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Schema {
    FrameTransform,
    PoseInFrame,
    PosesInFrame,
    PointCloud,
    SceneUpdate,
    /// Ours: the numbers of a step.
    Metrics,
}

impl Schema {
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::FrameTransform => "foxglove.FrameTransform",
            Self::PoseInFrame => "foxglove.PoseInFrame",
            Self::PosesInFrame => "foxglove.PosesInFrame",
            Self::PointCloud => "foxglove.PointCloud",
            Self::SceneUpdate => "foxglove.SceneUpdate",
            Self::Metrics => "adslam.Metrics",
        }
    }

    pub(super) fn json(self) -> Value {
        let fields = match self {
            Self::FrameTransform => vec![
                ("timestamp", stamp("time")),
                ("parent_frame_id", text()),
                ("child_frame_id", text()),
                ("translation", xyz()),
                ("rotation", quaternion()),
            ],
            Self::PoseInFrame => vec![
                ("timestamp", stamp("time")),
                ("frame_id", text()),
                ("pose", placed()),
            ],
            Self::PosesInFrame => vec![
                ("timestamp", stamp("time")),
                ("frame_id", text()),
                ("poses", list(&placed())),
            ],
            Self::PointCloud => vec![
                ("timestamp", stamp("time")),
                ("frame_id", text()),
                ("pose", placed()),
                ("point_stride", integer()),
                (
                    "fields",
                    list(&object(
                        "foxglove.PackedElementField",
                        vec![("name", text()), ("offset", integer()), ("type", integer())],
                    )),
                ),
                (
                    "data",
                    json!({"type": "string", "contentEncoding": "base64"}),
                ),
            ],
            Self::SceneUpdate => vec![
                ("deletions", list(&json!({"type": "object"}))),
                ("entities", list(&entity())),
            ],
            Self::Metrics => METRICS.map(|(name, what)| (name, metric(what))).into(),
        };
        object(self.name(), fields)
    }
}

/// The numbers of a step, in the order of the message, and what they are. One that a step lacks is left out.
const METRICS: [(&str, &str); 13] = [
    ("pose_error", "pose error, eq. (11), rad and cm together"),
    ("orientation_error_rad", "its part of the orientation, rad"),
    ("position_error_cm", "its part of the position, cm"),
    (
        "drift_floor_cm",
        "position error that the noise alone is expected to cost, cm",
    ),
    (
        "relative_pose_error",
        "pose error relative to the object, rad and cm together",
    ),
    (
        "feature_error_mean_cm",
        "feature error, eq. (12), mean over the features, cm",
    ),
    (
        "feature_error_max_cm",
        "feature error, largest of the features, cm",
    ),
    (
        "relative_feature_error_cm",
        "feature error relative to the object, mean, cm",
    ),
    ("pose_nees", "NEES of the pose, 6 degrees of freedom"),
    (
        "feature_nees",
        "NEES of a feature, 3 degrees of freedom, mean over the features",
    ),
    (
        "trace",
        "trace of the covariance of the whole state, rad² + cm²",
    ),
    ("covered", "features seen so far"),
    (
        "surface_distance_cm",
        "signed distance of the robot from the surface, negative inside, cm",
    ),
];

fn metric(what: &str) -> Value {
    json!({"type": "number", "description": what})
}

fn entity() -> Value {
    let nothing = || list(&json!({"type": "object"}));
    let sphere = vec![("pose", placed()), ("size", xyz()), ("color", colour())];
    let triangles = vec![
        ("pose", placed()),
        ("points", list(&xyz())),
        ("color", colour()),
        ("colors", list(&colour())),
        ("indices", list(&integer())),
    ];
    object(
        "foxglove.SceneEntity",
        vec![
            ("timestamp", stamp("time")),
            ("frame_id", text()),
            ("id", text()),
            ("lifetime", stamp("duration")),
            ("frame_locked", json!({"type": "boolean"})),
            ("metadata", nothing()),
            ("arrows", nothing()),
            ("cubes", nothing()),
            ("spheres", list(&object("foxglove.SpherePrimitive", sphere))),
            ("cylinders", nothing()),
            ("lines", nothing()),
            (
                "triangles",
                list(&object("foxglove.TriangleListPrimitive", triangles)),
            ),
            ("texts", nothing()),
            ("models", nothing()),
        ],
    )
}

fn object(title: &str, fields: Vec<(&str, Value)>) -> Value {
    let fields: serde_json::Map<String, Value> = fields
        .into_iter()
        .map(|(name, schema)| (name.to_owned(), schema))
        .collect();
    json!({"title": title, "type": "object", "properties": fields})
}

fn list(of: &Value) -> Value {
    json!({"type": "array", "items": of})
}

fn number() -> Value {
    json!({"type": "number"})
}

fn integer() -> Value {
    json!({"type": "integer", "minimum": 0})
}

fn text() -> Value {
    json!({"type": "string"})
}

/// A time or a duration, which readers tell by the title.
fn stamp(title: &str) -> Value {
    object(title, vec![("sec", integer()), ("nsec", integer())])
}

fn numbers(title: &str, names: &[&str]) -> Value {
    object(title, names.iter().map(|name| (*name, number())).collect())
}

fn xyz() -> Value {
    numbers("foxglove.Vector3", &["x", "y", "z"])
}

fn quaternion() -> Value {
    numbers("foxglove.Quaternion", &["x", "y", "z", "w"])
}

fn colour() -> Value {
    numbers("foxglove.Color", &["r", "g", "b", "a"])
}

fn placed() -> Value {
    object(
        "foxglove.Pose",
        vec![("position", xyz()), ("orientation", quaternion())],
    )
}
