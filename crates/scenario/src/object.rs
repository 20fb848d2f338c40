//! `[object]`: what is mapped, and `[mesh_placement]`.

use std::path::PathBuf;

use adslam_models::EulerAngles;
use adslam_names::LengthUnit;
use adslam_surface::DEFAULT_PHANTOM_SPACING_CM;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::values::{FeatureCount, FeatureNumber, List, NonNegative, Seed, Spacing, Triple, Vec3};

/// Features picked from a mesh or a phantom unless the file says otherwise, as in the paper.
const FEATURES: FeatureCount = FeatureCount::default_of(50);
/// The seed of that picking unless the file says otherwise.
const FEATURE_SEED: Seed = Seed::default_of(1);

/// The object at rest, in world coordinates.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Object {
    /// Features at given places.
    Points(Points),
    /// A mesh file, from which features are picked.
    Mesh(Mesh),
    /// The heart that the code generates, from which features are picked.
    Phantom(Phantom),
}

impl Object {
    /// How many features it has, or how many are to be picked; fewer may be found.
    pub fn feature_count(&self) -> usize {
        match self {
            Self::Points(points) => points.positions_cm.len(),
            Self::Mesh(mesh) => mesh.features.get(),
            Self::Phantom(phantom) => phantom.features.get(),
        }
    }
}

/// Features at given places.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Points {
    /// Where each feature rests (world frame, cm): 4 to 2000, all different, not all in one plane.
    #[schemars(length(min = 4, max = 2000))]
    pub positions_cm: List<Vec3>,
    /// The triangles between the features, by their numbers, counterclockwise seen from outside. Give
    /// them where the surface is not convex, or where more than three features of the hull lie in one
    /// plane, so that its diagonals are a choice. Default: convex hull.
    pub faces: Option<List<Triple<FeatureNumber>>>,
}

/// A mesh file, from whose vertices features are picked.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Mesh {
    /// An STL, OBJ or PLY file of a closed surface; its path counts from the scenario's folder.
    // Once the scenario is read, the folder is part of it.
    #[schemars(extend("format" = "path"))]
    pub file: PathBuf,
    /// Unit of the file's coordinates.
    #[serde(default)]
    pub unit: LengthUnit,
    /// Vertices that lie within this distance of each other are joined (cm); 0 joins equal ones only.
    #[serde(default)]
    pub join_within_cm: NonNegative,
    /// Roll, pitch and yaw by which the mesh is turned about its own origin (deg).
    #[serde(default)]
    pub rotation_deg: Vec3,
    /// Added to every vertex, after scaling and turning (world frame, cm).
    #[serde(default)]
    pub offset_cm: Vec3,
    /// Features to pick from the vertices on the convex hull.
    #[serde(default = "features")]
    pub features: FeatureCount,
    /// Seed of that picking.
    #[serde(default = "feature_seed")]
    pub feature_seed: Seed,
}

impl Mesh {
    /// `mesh`, read from the file, where it belongs in the world (cm).
    pub fn placed(&self, mesh: adslam_surface::Mesh) -> adslam_surface::Mesh {
        let turn = EulerAngles::from_vector(&self.rotation_deg.map(f64::to_radians));
        mesh.rotated(&turn.rotation())
            .scaled_and_moved(self.unit.in_cm(), *self.offset_cm)
    }
}

/// The heart that the code generates, from whose vertices features are picked.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Phantom {
    /// Features to pick from the vertices on the convex hull.
    #[serde(default = "features")]
    pub features: FeatureCount,
    /// Seed of that picking.
    #[serde(default = "feature_seed")]
    pub feature_seed: Seed,
    /// Distance between neighbouring vertices, about (cm).
    #[serde(default = "spacing")]
    pub spacing_cm: Spacing,
}

/// How a mesh given with `--mesh` is brought into this world.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct MeshPlacement {
    /// Unit of the file's coordinates.
    pub unit: LengthUnit,
    /// Vertices that lie within this distance of each other are joined (cm); 0 joins equal ones only.
    pub join_within_cm: NonNegative,
    /// Roll, pitch and yaw by which the mesh is turned about its own origin (deg).
    pub rotation_deg: Vec3,
    /// Added to every vertex, after scaling and turning (world frame, cm).
    pub offset_cm: Vec3,
}

impl Object {
    /// This object replaced by the mesh in `file`. The features to pick and their seed stay those
    /// of a mesh or phantom; the place is `placement`, or else that of a mesh, or else the file's
    /// own coordinates in mm.
    pub(super) fn replaced_by_mesh(
        &self,
        file: PathBuf,
        placement: Option<&MeshPlacement>,
    ) -> Self {
        let (features, feature_seed, own) = match self {
            Self::Points(_) => (FEATURES, FEATURE_SEED, MeshPlacement::default()),
            Self::Phantom(p) => (p.features, p.feature_seed, MeshPlacement::default()),
            Self::Mesh(m) => {
                let own = MeshPlacement {
                    unit: m.unit,
                    join_within_cm: m.join_within_cm,
                    rotation_deg: m.rotation_deg,
                    offset_cm: m.offset_cm,
                };
                (m.features, m.feature_seed, own)
            }
        };
        let MeshPlacement {
            unit,
            join_within_cm,
            rotation_deg,
            offset_cm,
        } = placement.cloned().unwrap_or(own);
        Self::Mesh(Mesh {
            file,
            unit,
            join_within_cm,
            rotation_deg,
            offset_cm,
            features,
            feature_seed,
        })
    }
}

fn features() -> FeatureCount {
    FEATURES
}

fn feature_seed() -> Seed {
    FEATURE_SEED
}

fn spacing() -> Spacing {
    Spacing::default_of(DEFAULT_PHANTOM_SPACING_CM)
}
