//! `[object]`: what is mapped, and `[mesh_placement]`.

use std::path::PathBuf;

use adslam_surface::DEFAULT_PHANTOM_SPACING_CM;
use serde::Deserialize;

use super::values::{FeatureCount, FeatureNumber, List, Seed, Spacing, Triple, Vec3};

/// Features picked from a mesh or a phantom unless the file says otherwise, as in the paper.
const FEATURES: FeatureCount = FeatureCount::default_of(50);
/// The seed of that picking unless the file says otherwise.
const FEATURE_SEED: Seed = Seed::default_of(1);

/// The object at rest, in world coordinates.
#[derive(Debug, Clone, PartialEq, Deserialize)]
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

/// `[object.points]`
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Points {
    /// Where each feature rests (world frame, cm).
    pub positions_cm: List<Vec3>,
    /// The triangles between the features, by their numbers, counterclockwise seen from outside;
    /// default: their convex hull. Needed where the surface is not convex, and where several
    /// features of the hull lie in one plane, whose diagonals are a choice.
    pub faces: Option<List<Triple<FeatureNumber>>>,
}

/// `[object.mesh]`
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mesh {
    /// The STL file. In a file it counts from the scenario's folder; here it is ready to open.
    pub file: PathBuf,
    /// The unit of its coordinates; default mm.
    #[serde(default)]
    pub unit: LengthUnit,
    /// Added to every vertex after scaling (world frame, cm); default none.
    #[serde(default)]
    pub offset_cm: Vec3,
    /// Features to pick from its vertices; default 50.
    #[serde(default = "features")]
    pub features: FeatureCount,
    /// Seed of the picking; default 1.
    #[serde(default = "feature_seed")]
    pub feature_seed: Seed,
}

/// `[object.phantom]`
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Phantom {
    /// Features to pick from its vertices; default 50.
    #[serde(default = "features")]
    pub features: FeatureCount,
    /// Seed of the picking; default 1.
    #[serde(default = "feature_seed")]
    pub feature_seed: Seed,
    /// Distance between neighbouring vertices, about; default
    /// [`DEFAULT_PHANTOM_SPACING_CM`].
    #[serde(default = "spacing")]
    pub spacing_cm: Spacing,
}

/// `[mesh_placement]`: how a mesh given with `--mesh` is brought into this world.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct MeshPlacement {
    /// The unit of its coordinates; default mm.
    pub unit: LengthUnit,
    /// Added to every vertex after scaling (world frame, cm); default none.
    pub offset_cm: Vec3,
}

/// The unit of a mesh file's coordinates.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LengthUnit {
    /// Millimetres, the default: what medical images use.
    #[default]
    Mm,
    /// Centimetres.
    Cm,
    /// Metres.
    M,
}

impl LengthUnit {
    /// Centimetres in one of this unit.
    pub fn in_cm(self) -> f64 {
        match self {
            Self::Mm => 0.1,
            Self::Cm => 1.0,
            Self::M => 100.0,
        }
    }
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
                    offset_cm: m.offset_cm,
                };
                (m.features, m.feature_seed, own)
            }
        };
        let MeshPlacement { unit, offset_cm } = placement.cloned().unwrap_or(own);
        Self::Mesh(Mesh {
            file,
            unit,
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
