//! The update with measurements of the object's structure, eqs. (4), (5), without ever stacking the
//! pairs.
//!
//! With L the Laplacian of the graph of measured pairs, all rows together give
//! HᵀH/σ² = (L ⊗ I₃)/σ², and all that the measured values say is in Hᵀ(z − Hχ̂), for which the pairs only
//! have to be summed. Fewer rows with independent noise say the same: see [`all_pairs`] and [`graph`].

mod all_pairs;
mod graph;

use adslam_models::{FeatureId, structure_measurement};
use nalgebra::{Point3, Vector3};

use crate::input::check_feature;
use crate::workspace::Workspace;
use crate::{Belief, EstimatorError, Nis, Parallelism};
pub(crate) use all_pairs::condition_on_all_pairs;
use graph::PairGraph;

/// What is measured here, in errors.
const STRUCTURE: &str = "structure measurements";

/// One measured relative position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairMeasurement {
    /// Where it starts.
    pub from: FeatureId,
    /// Where it ends.
    pub to: FeatureId,
    /// z = `p_to` − `p_from` + ε, cm, world axes.
    pub z: Vector3<f64>,
}

/// The structure measurements of one step, each with the same sigma on each axis.
#[derive(Clone, Copy, Debug)]
pub enum StructureMeasurements<'a> {
    /// Nothing was measured.
    None,
    /// Any list of pairs.
    Pairs(&'a [PairMeasurement]),
    /// Every pair once, summed: for each feature i the sum over all j of the measured p_i − p_j, cm.
    /// It holds all the information of the M(M−1)/2 pairs.
    AllPairsSummed(&'a [Vector3<f64>]),
}

/// The update with structure measurements, in memory that is kept.
#[derive(Clone, Debug, Default)]
pub(crate) struct StructureUpdate {
    /// Hᵀ(z − Hχ̂), cm.
    residual: Vec<Vector3<f64>>,
    graph: PairGraph,
}

impl StructureUpdate {
    /// Conditions the covariance on the measurements and leaves the correction in `delta`. Of the covariance
    /// only the lower triangle is brought up to date.
    pub(crate) fn apply(
        &mut self,
        belief: &mut Belief,
        delta: &mut Vec<f64>,
        measurements: &StructureMeasurements<'_>,
        sigma: f64,
        workspace: &mut Workspace,
        parallelism: Parallelism,
    ) -> Result<Nis, EstimatorError> {
        let count = belief.state.features.len();
        let (residual, features) = (&mut self.residual, &belief.state.features);
        let all_pairs = match measurements {
            StructureMeasurements::None | StructureMeasurements::Pairs([]) => {
                return Ok(Nis::default());
            }
            StructureMeasurements::AllPairsSummed(sums) => {
                check_sums(sums, count)?;
                set_summed_residual(residual, features, sums);
                true
            }
            StructureMeasurements::Pairs(pairs) => {
                check_pairs(pairs, count)?;
                set_pair_residual(residual, features, pairs);
                self.graph.read(pairs, count)
            }
        };
        let (covariance, residual) = (&mut belief.covariance, &self.residual);
        if all_pairs {
            condition_on_all_pairs(covariance, residual, sigma, workspace, parallelism)?;
        } else {
            self.graph
                .condition(covariance, residual, sigma, workspace, parallelism)?;
        }
        workspace.copy_correction(delta);
        Ok(Nis {
            value: workspace.nis(),
            dof: 3 * if all_pairs {
                count.saturating_sub(1)
            } else {
                self.graph.rank()
            },
        })
    }
}

/// Hᵀ(z − Hχ̂) from the sums over all pairs.
fn set_summed_residual(
    residual: &mut Vec<Vector3<f64>>,
    features: &[Point3<f64>],
    sums: &[Vector3<f64>],
) {
    let count = features.len() as f64;
    let total: Vector3<f64> = features.iter().map(|p| p.coords).sum();
    residual.clear();
    residual.extend(
        sums.iter()
            .zip(features)
            .map(|(sum, p)| sum - (p.coords * count - total)),
    );
}

/// Hᵀ(z − Hχ̂) from a list of pairs.
fn set_pair_residual(
    residual: &mut Vec<Vector3<f64>>,
    features: &[Point3<f64>],
    pairs: &[PairMeasurement],
) {
    residual.clear();
    residual.resize(features.len(), Vector3::zeros());
    for pair in pairs {
        let y = pair.z - structure_measurement(&features[pair.from.0], &features[pair.to.0]);
        residual[pair.to.0] += y;
        residual[pair.from.0] -= y;
    }
}

fn check_sums(sums: &[Vector3<f64>], count: usize) -> Result<(), EstimatorError> {
    if sums.len() != count {
        return Err(EstimatorError::WrongCount {
            what: "the summed structure measurement",
            found: sums.len(),
            expected: count,
        });
    }
    if sums.iter().all(|v| v.iter().all(|x| x.is_finite())) {
        return Ok(());
    }
    Err(EstimatorError::NotFinite {
        what: "summed structure measurement",
    })
}

fn check_pairs(pairs: &[PairMeasurement], count: usize) -> Result<(), EstimatorError> {
    for pair in pairs {
        check_feature(pair.from, count)?;
        check_feature(pair.to, count)?;
        if pair.from == pair.to {
            return Err(EstimatorError::SelfPair(pair.from));
        }
        if !pair.z.iter().all(|x| x.is_finite()) {
            return Err(EstimatorError::NotFinite {
                what: "structure measurement",
            });
        }
    }
    Ok(())
}
