//! A run as a picture or a replay needs it: every step with truth, belief and decision, in one file.

mod action_runs;
mod compact;
mod drawing;
mod file;
mod record;

use nalgebra::Rotation3;
use serde::{Deserialize, Serialize};

pub use action_runs::ActionRuns;
pub use drawing::Candidate;
pub use record::HistoryRecorder;

use adslam_names::{Look, PlannerName};

/// What `format` says in a history file.
pub const HISTORY_FORMAT: &str = "adslam-history";

/// The version of history files that this code writes. It reads those before as well: version 2 has
/// added the turn of the object and the drift floor.
pub const HISTORY_VERSION: u32 = 2;

/// The name of the history file in a run's folder.
pub const HISTORY_FILE: &str = "history.json";

/// Everything of one run that can be drawn.
///
/// Lengths are cm, angles rad, everything in the world frame. Numbers are rounded to what a drawing
/// shows: positions to 10⁻⁵, the drawn mesh to 10⁻⁴ cm, covariances to four digits of their largest
/// entry, traces to seven digits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RunHistory {
    /// [`HISTORY_FORMAT`].
    pub format: String,
    /// [`HISTORY_VERSION`], or a smaller one.
    pub version: u32,
    /// The scenario's name.
    pub scenario: String,
    /// The planner.
    pub planner: PlannerName,
    /// What it looks like; absent where all know it by its name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub planner_look: Option<Look>,
    /// The seed of all noise.
    pub seed: u64,
    /// Features nearer than this are not seen, cm.
    pub sensor_min_cm: f64,
    /// Features farther than this are not seen, cm.
    pub sensor_max_cm: f64,
    /// Distance that the planners keep from the surface, cm.
    pub clearance_cm: f64,
    /// The occluding surface: triangles over the features, anticlockwise seen from outside.
    pub topology: Vec<[usize; 3]>,
    /// The surface that is drawn.
    pub drawn: DrawnSurface,
    /// The action set: rotation (rad) and translation (cm) of each.
    pub actions: Vec<[f64; 6]>,
    /// The viewpoints of the planner's path in order, cm; none for planners without.
    pub viewpoints_cm: Vec<[f64; 3]>,
    /// The steps, step 1 first.
    pub steps: Vec<HistoryStep>,
}

/// The surface that is drawn.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum DrawnSurface {
    /// That of the features themselves: the topology over the true features.
    Features,
    /// A mesh that moves as the scenario says, without noise. At step n the vertex that rests at p
    /// is at base(n) + turn(n) (p + r_d(n) Σₖ aₖ(n) mₖ), with [`ObjectStep`] and the vertex's modes
    /// mₖ.
    Mesh {
        /// Where the vertices rest, cm.
        rest_cm: Vec<[f64; 3]>,
        /// Triangles over them.
        faces: Vec<[usize; 3]>,
        /// For each mode of the deformation its value at each vertex.
        modes: Vec<Vec<[f64; 3]>>,
    },
}

/// How far the object has moved at a step, noise apart.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ObjectStep {
    /// The sum of r_t t over the steps before, and what the turn adds where it is not about the
    /// origin, cm.
    pub base_cm: [f64; 3],
    /// The rotation of the object as a whole, row by row; absent where it does not turn.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub turn: Option<[f64; 9]>,
    /// r_d, row by row.
    pub r_d: [f64; 9],
    /// aₖ for each mode of the deformation.
    pub amounts: Vec<f64>,
}

/// One step as it stands after the filter's update.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HistoryStep {
    /// The true pose: roll, pitch, yaw (rad), x, y, z (cm).
    pub pose: [f64; 6],
    /// The estimated pose, in the same order.
    pub estimated_pose: [f64; 6],
    /// The estimate's standard deviations, in the same order.
    pub pose_sigma: [f64; 6],
    /// The true features, cm.
    pub features: Vec<[f64; 3]>,
    /// The estimated features, cm.
    pub estimated_features: Vec<[f64; 3]>,
    /// Their covariances xx, xy, xz, yy, yz, zz, cm².
    pub feature_covariances: Vec<[f64; 6]>,
    /// Numbers of the features that the robot sees.
    pub visible: Vec<usize>,
    /// The motion of the object.
    pub object: ObjectStep,
    /// The decision that led here; none at the start.
    pub decision: Option<HistoryDecision>,
    /// What the curves show.
    pub metrics: HistoryMetrics,
}

/// A decision taken at the step before.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HistoryDecision {
    /// The control that was taken: rotation (rad) and translation (cm).
    pub control: [f64; 6],
    /// Its place in the action set; none for a control that is not in it.
    pub action: Option<usize>,
    /// The viewpoint that the robot is heading for, from 0.
    pub goal: Option<usize>,
    /// Actions within the limits of roll and pitch.
    pub admissible: usize,
    /// Of those, the safe ones.
    pub safe: usize,
    /// Whether no action was safe.
    pub compromised: bool,
    /// trace(Pₙ₊₁) of the chosen action where it was computed, rad² + cm².
    pub predicted_trace: Option<f64>,
    /// How long it took, ms.
    pub milliseconds: f64,
    /// The actions that were scored, in ascending order.
    pub scored: ActionRuns,
    /// trace(Pₙ₊₁) after each of them, rad² + cm².
    pub traces: Vec<f64>,
}

/// The numbers of a step that its curves show.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HistoryMetrics {
    /// Eq. (11), rad and cm together.
    pub pose_error: f64,
    /// The orientation's part of it, rad.
    pub orientation_error_rad: f64,
    /// The position's part of it, cm.
    pub position_error_cm: f64,
    /// The error of the position that the noise alone is expected to cost, see
    /// [`DriftFloor`](adslam_simulation::DriftFloor), cm; none in files of version 1.
    #[serde(default)]
    pub drift_floor_cm: Option<f64>,
    /// Eq. (11) relative to the object.
    pub relative_pose_error: f64,
    /// Mean of eq. (12) over the features, cm.
    pub feature_error_mean_cm: f64,
    /// Maximum of eq. (12), cm.
    pub feature_error_max_cm: f64,
    /// Mean of eq. (12) relative to the object, cm.
    pub relative_feature_error_cm: f64,
    /// Normalised squared error of the pose, 6 degrees of freedom; none while it is known exactly.
    pub pose_nees: Option<f64>,
    /// Mean over the features of theirs, 3 degrees of freedom.
    pub feature_nees: Option<f64>,
    /// trace(P), rad² + cm².
    pub trace: f64,
    /// Features seen so far, the start included.
    pub covered: usize,
    /// Signed distance of the true robot from the true surface, cm, negative inside.
    pub surface_distance_cm: f64,
}

impl ObjectStep {
    /// A rotation as a row-major array.
    fn rows(rotation: &Rotation3<f64>) -> [f64; 9] {
        let m = rotation.matrix();
        std::array::from_fn(|i| m[(i / 3, i % 3)])
    }
}
