//! The update with measurements of the object's structure, eqs. (4), (5), without ever stacking the
//! pairs.
//!
//! With L the Laplacian of the graph of measured pairs, all rows together give
//! HᵀH/σ² = (L ⊗ I₃)/σ². Any C with C Cᵀ = L/σ² then serves as the transpose of an equivalent measurement
//! matrix with unit noise: S = I + Cᵀ P C, W = S^(−½) Cᵀ P, P⁺ = P − WᵀW, and the correction is
//! P⁺ HᵀR⁻¹(z − Hχ̂), for which the pairs only have to be summed. For all pairs L = M Π with
//! Π = I − 11ᵀ/M a projection, so C = √M/σ · Π: subtracting the mean.

use adslam_models::{FeatureId, POSE_DIM, structure_measurement};
use faer::{Mat, MatRef, Side};
use nalgebra::Vector3;

use crate::ekf::check_feature;
use crate::linear_algebra::{cholesky, solve_lower};
use crate::{Belief, Covariance, EstimatorError};

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

/// Conditions the belief on the structure measurements.
pub(crate) fn update_with_structure(
    belief: &mut Belief,
    measurements: &StructureMeasurements<'_>,
    sigma: f64,
) -> Result<(), EstimatorError> {
    let count = belief.state.features.len();
    let information = 1.0 / (sigma * sigma);
    let (root, mut residual) = match measurements {
        StructureMeasurements::None => return Ok(()),
        StructureMeasurements::AllPairsSummed(sums) => {
            check_sums(sums, count)?;
            (
                Some(PairRoot::all_pairs(count, information)),
                summed_residual(belief, sums),
            )
        }
        StructureMeasurements::Pairs(pairs) => {
            check_pairs(pairs, count)?;
            (
                PairRoot::of(pairs, count, information)?,
                pair_residual(belief, pairs),
            )
        }
    };
    let Some(root) = root else { return Ok(()) };
    for r in &mut residual {
        *r *= information;
    }
    root.condition(&mut belief.covariance)?;
    let p = belief.covariance.matrix();
    let gain_of = |i: usize| -> f64 {
        residual
            .iter()
            .enumerate()
            .map(|(j, r)| {
                (0..3)
                    .map(|a| p[(i, POSE_DIM + 3 * j + a)] * r[a])
                    .sum::<f64>()
            })
            .sum()
    };
    let correction: Vec<f64> = (0..p.nrows()).map(gain_of).collect();
    belief.correct(|i| correction[i])
}

/// C with C Cᵀ = L/σ², applied to each axis alike.
pub(crate) enum PairRoot {
    /// √M/σ · Π.
    AllPairs { scale: f64 },
    /// M × r, r the rank of L.
    Dense(Mat<f64>),
}

impl PairRoot {
    /// For every pair once.
    pub(crate) fn all_pairs(count: usize, information: f64) -> Self {
        #[allow(
            clippy::cast_precision_loss,
            reason = "counts of features are far below 2^52"
        )]
        let pairs_at_a_feature = count as f64;
        Self::AllPairs {
            scale: (pairs_at_a_feature * information).sqrt(),
        }
    }

    /// For any list of pairs; nothing where there are none.
    fn of(
        pairs: &[PairMeasurement],
        count: usize,
        information: f64,
    ) -> Result<Option<Self>, EstimatorError> {
        if pairs.is_empty() {
            return Ok(None);
        }
        let mut laplacian = Mat::<f64>::zeros(count, count);
        for pair in pairs {
            let (from, to) = (pair.from.0, pair.to.0);
            laplacian[(from, from)] += 1.0;
            laplacian[(to, to)] += 1.0;
            laplacian[(from, to)] -= 1.0;
            laplacian[(to, from)] -= 1.0;
        }
        let every_pair_once = (0..count).all(|j| (0..j).all(|i| laplacian[(i, j)] == -1.0));
        if every_pair_once {
            return Ok(Some(Self::all_pairs(count, information)));
        }
        let eigen = laplacian.self_adjoint_eigen(Side::Lower).map_err(|_| {
            EstimatorError::NotPositiveDefinite {
                matrix: "graph of measured pairs",
                dim: count,
            }
        })?;
        // Eigenvalues of a Laplacian are zero or at least about 1/M²; rounding leaves M·ε.
        let (values, vectors) = (eigen.S().column_vector(), eigen.U());
        let kept: Vec<usize> = (0..count).filter(|&k| values[k] > 1e-10).collect();
        Ok(Some(Self::Dense(Mat::from_fn(
            count,
            kept.len(),
            |i, k| vectors[(i, kept[k])] * (values[kept[k]] * information).sqrt(),
        ))))
    }

    /// (Cᵀ ⊗ I₃) times a matrix that has three rows for each feature.
    fn apply(&self, rows: MatRef<'_, f64>) -> Mat<f64> {
        let count = rows.nrows() / 3;
        match self {
            Self::AllPairs { scale } => {
                let share = 1.0 / count as f64;
                let mut out = rows.to_owned();
                for (column, centred) in rows.col_iter().zip(out.col_iter_mut()) {
                    let mut mean = Vector3::<f64>::zeros();
                    for (i, x) in column.iter().enumerate() {
                        mean[i % 3] += x * share;
                    }
                    for (i, x) in centred.iter_mut().enumerate() {
                        *x = (*x - mean[i % 3]) * scale;
                    }
                }
                out
            }
            Self::Dense(root) => {
                let mut out = Mat::zeros(3 * root.ncols(), rows.ncols());
                for axis in 0..3 {
                    let of_axis = Mat::from_fn(count, rows.ncols(), |i, j| rows[(3 * i + axis, j)]);
                    let product = root.transpose() * of_axis;
                    for j in 0..product.ncols() {
                        for i in 0..product.nrows() {
                            out[(3 * i + axis, j)] = product[(i, j)];
                        }
                    }
                }
                out
            }
        }
    }

    /// P ← P − P C S⁻¹ Cᵀ P with S = I + Cᵀ P C.
    pub(crate) fn condition(&self, covariance: &mut Covariance) -> Result<(), EstimatorError> {
        let features = covariance.dim() - POSE_DIM;
        let of_features = covariance.matrix().subrows(POSE_DIM, features);
        let mut whitened = self.apply(of_features);
        let projected = whitened.as_ref().subcols(POSE_DIM, features);
        let mut s = self.apply(projected.transpose());
        for i in 0..s.nrows() {
            s[(i, i)] += 1.0;
        }
        cholesky(
            s.as_mut(),
            "innovation covariance of the structure measurements",
        )?;
        solve_lower(s.as_ref(), whitened.as_mut());
        covariance.reduce_by(whitened.as_ref())
    }
}

/// Hᵀ(z − Hχ̂) from the sums over all pairs.
fn summed_residual(belief: &Belief, sums: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    let features = &belief.state.features;
    #[allow(
        clippy::cast_precision_loss,
        reason = "counts of features are far below 2^52"
    )]
    let count = features.len() as f64;
    let total: Vector3<f64> = features.iter().map(|p| p.coords).sum();
    sums.iter()
        .zip(features)
        .map(|(sum, p)| sum - (p.coords * count - total))
        .collect()
}

/// Hᵀ(z − Hχ̂) from a list of pairs.
fn pair_residual(belief: &Belief, pairs: &[PairMeasurement]) -> Vec<Vector3<f64>> {
    let features = &belief.state.features;
    let mut residual = vec![Vector3::zeros(); features.len()];
    for pair in pairs {
        let y = pair.z - structure_measurement(&features[pair.from.0], &features[pair.to.0]);
        residual[pair.to.0] += y;
        residual[pair.from.0] -= y;
    }
    residual
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
