//! Every pair of features measured once: L = M Π with Π = I − 11ᵀ/M, the projection off the mean.
//!
//! The reflection I − κ uuᵀ with u = (1 + √M, 1, …, 1), κ = 1/(M + √M) is orthogonal and turns the mean
//! into the first coordinate. Its other M − 1 rows, the contrasts, then hold all that is measured,
//! each axis of each with independent noise of variance σ²/M, and can be taken block by block:
//! P Hᵀ = P_B − κ G of B's columns, with G = P(u ⊗ I₃) computed once and carried along. The covariance
//! itself is never rotated.

use std::ops::Range;

use adslam_models::POSE_DIM;
use nalgebra::{Matrix3, Vector3};

use super::STRUCTURE;
use crate::digits::Stages;
use crate::workspace::{Workspace, add_scaled, blocks};
use crate::{Covariance, EstimatorError, Parallelism};

/// The numbers of the reflection for M features.
struct Reflection {
    count: f64,
    /// u of the first feature; all others have 1.
    first: f64,
    kappa: f64,
}

impl Reflection {
    fn new(count: usize) -> Self {
        let count = count as f64;
        Self {
            count,
            first: 1.0 + count.sqrt(),
            kappa: 1.0 / (count + count.sqrt()),
        }
    }

    /// (u ⊗ I₃)ᵀ of a vector with three numbers for each feature.
    fn along_u(&self, features: impl Iterator<Item = Vector3<f64>>) -> Vector3<f64> {
        let mut weight = self.first;
        features.fold(Vector3::zeros(), |sum, x| {
            sum + x * std::mem::replace(&mut weight, 1.0)
        })
    }
}

/// Conditions the covariance, its lower triangle, on all pairs of features. `residual` is Hᵀ(z − Hχ̂), cm,
/// empty where it is zero; the correction of the state is left in the workspace.
pub(crate) fn condition_on_all_pairs(
    covariance: &mut Covariance,
    residual: &[Vector3<f64>],
    sigma: f64,
    workspace: &mut Workspace,
    parallelism: Parallelism,
) -> Result<(), EstimatorError> {
    let (dim, count) = (covariance.dim(), covariance.feature_count());
    // The correction and G.
    workspace.prepare(dim, 4);
    if count < 2 {
        return Ok(());
    }
    let reflection = Reflection::new(count);
    let mut stages = Stages::new(STRUCTURE, dim);
    while let Some(weight) = stages.next(gain(covariance, sigma))? {
        sum_columns(covariance, &reflection, workspace, parallelism);
        for block in blocks(1..count, dim) {
            workspace.start_block(3 * block.len());
            let columns = workspace.products.as_mut();
            covariance.copy_columns(POSE_DIM + 3 * block.start, columns, parallelism);
            let variance = sigma * sigma / weight;
            lay_out(&reflection, block, residual, variance, workspace);
            workspace.condition(
                covariance,
                "innovation covariance of the structure measurements",
                parallelism,
            )?;
        }
    }
    Ok(())
}

/// How many times smaller all pairs can make a variance: each contrast is known with σ²/M.
fn gain(covariance: &Covariance, sigma: f64) -> f64 {
    let count = covariance.feature_count();
    count as f64 * covariance.largest_feature_variance(0..count) / (sigma * sigma)
}

/// G = P(u ⊗ I₃), into the carried vectors after the first.
fn sum_columns(
    covariance: &Covariance,
    reflection: &Reflection,
    workspace: &mut Workspace,
    parallelism: Parallelism,
) {
    let u = &mut workspace.selection;
    u.reshape(covariance.dim(), 3);
    u.fill(0.0);
    for axis in 0..3 {
        let features = &mut u.col_as_slice_mut(axis)[POSE_DIM + axis..];
        for (feature, entry) in features.iter_mut().step_by(3).enumerate() {
            *entry = if feature == 0 { reflection.first } else { 1.0 };
        }
    }
    let sums = workspace.carried.as_mut().subcols_mut(1, 3);
    covariance.times(workspace.selection.as_ref(), sums, parallelism);
}

/// P Hᵀ from P's columns, S, the innovation and G's growth for the contrasts of the features `block`.
fn lay_out(
    reflection: &Reflection,
    block: Range<usize>,
    residual: &[Vector3<f64>],
    variance: f64,
    workspace: &mut Workspace,
) {
    let kappa = reflection.kappa;
    let (offset, rows) = (POSE_DIM + 3 * block.start, 3 * block.len());
    let [correction, gram @ ..] = [0, 1, 2, 3].map(|column| {
        let (features, _) = workspace.carried.col_as_slice(column)[POSE_DIM..].as_chunks::<3>();
        reflection.along_u(features.iter().copied().map(Vector3::from))
    });
    let gram = Matrix3::from_columns(&gram);
    let residual_along_u = reflection.along_u(residual.iter().copied());
    let variance = variance / reflection.count;
    for column in 0..rows {
        let axis = column % 3;
        let sums = workspace.carried.col_as_slice(1 + axis);
        add_scaled(workspace.products.col_as_slice_mut(column), -kappa, sums);
        // (u ⊗ I₃)ᵀ P Hᵀ, this column.
        let along_u = Vector3::from_fn(|a, _| {
            workspace.carried[(offset + column, 1 + a)] - kappa * gram[(a, axis)]
        });
        for row in column..rows {
            workspace.innovation_covariance[(row, column)] =
                workspace.products[(offset + row, column)] - kappa * along_u[row % 3];
        }
        workspace.innovation_covariance[(column, column)] += variance;
        let measured = residual
            .get(block.start + column / 3)
            .map_or(0.0, |r| r[axis] - kappa * residual_along_u[axis]);
        let corrected = workspace.carried[(offset + column, 0)] - kappa * correction[axis];
        workspace.growth[(column, 0)] = measured / reflection.count - corrected;
        for a in 0..3 {
            // G falls with P.
            workspace.growth[(column, 1 + a)] = -along_u[a];
        }
    }
}
