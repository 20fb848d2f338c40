//! Any graph of measured pairs: with the eigenvectors of its Laplacian L = U Λ Uᵀ, the rows Uᵀ with
//! Λ > 0 hold all that is measured, each axis of each with independent noise of variance σ²/λ.

use std::ops::Range;

use adslam_models::POSE_DIM;
use faer::Side;
use nalgebra::Vector3;

use crate::buffer::Buffer;
use crate::linear_algebra::set_product;
use crate::workspace::{Workspace, blocks};
use crate::{Covariance, EstimatorError, PairMeasurement, Parallelism};

/// Eigenvalues of a Laplacian are zero or at least about 1/M²; rounding leaves M·ε.
const ZERO_EIGENVALUE: f64 = 1e-10;

/// The graph of the pairs measured last, kept because the next ones are often the same.
#[derive(Clone, Debug, Default)]
pub(super) struct PairGraph {
    /// L of the pairs whose eigenvectors are kept.
    laplacian: Buffer,
    /// L of the pairs read last.
    candidate: Buffer,
    /// Eigenvectors with eigenvalues above zero, a column each.
    vectors: Buffer,
    values: Vec<f64>,
}

impl PairGraph {
    /// Takes in the pairs of a step; true where they are all pairs, each once.
    pub(super) fn read(
        &mut self,
        pairs: &[PairMeasurement],
        count: usize,
    ) -> Result<bool, EstimatorError> {
        self.candidate.reshape(count, count);
        self.candidate.fill(0.0);
        for pair in pairs {
            let (from, to) = (pair.from.0, pair.to.0);
            self.candidate[(from, from)] += 1.0;
            self.candidate[(to, to)] += 1.0;
            self.candidate[(from, to)] -= 1.0;
            self.candidate[(to, from)] -= 1.0;
        }
        let candidate = &self.candidate;
        if (0..count).all(|j| (0..j).all(|i| candidate[(i, j)] == -1.0)) {
            return Ok(true);
        }
        if *self.candidate != *self.laplacian {
            self.factorise(count)?;
        }
        Ok(false)
    }

    /// How many independent differences the pairs read last measure.
    pub(super) fn rank(&self) -> usize {
        self.values.len()
    }

    fn factorise(&mut self, count: usize) -> Result<(), EstimatorError> {
        let eigen = self
            .candidate
            .self_adjoint_eigen(Side::Lower)
            .map_err(|_| EstimatorError::NotPositiveDefinite {
                matrix: "graph of measured pairs",
                dim: count,
            })?;
        let (values, vectors) = (eigen.S().column_vector(), eigen.U());
        let kept: Vec<usize> = (0..count)
            .filter(|&k| values[k] > ZERO_EIGENVALUE)
            .collect();
        self.values = kept.iter().map(|&k| values[k]).collect();
        self.vectors.reshape(count, kept.len());
        for (column, &k) in kept.iter().enumerate() {
            self.vectors.col_mut(column).copy_from(vectors.col(k));
        }
        self.laplacian.reshape(count, count);
        self.laplacian.copy_from(&*self.candidate);
        Ok(())
    }

    /// Conditions the covariance, its lower triangle, on the pairs read last. `residual` is Hᵀ(z − Hχ̂),
    /// cm; the correction of the state is left in the workspace.
    pub(super) fn condition(
        &self,
        covariance: &mut Covariance,
        residual: &[Vector3<f64>],
        sigma: f64,
        workspace: &mut Workspace,
        parallelism: Parallelism,
    ) -> Result<(), EstimatorError> {
        let dim = covariance.dim();
        workspace.prepare(dim, 1);
        for block in blocks(0..self.values.len(), dim) {
            workspace.start_block(3 * block.len());
            self.set_products(covariance, block.clone(), workspace, parallelism);
            self.set_innovations(block, residual, sigma, workspace);
            workspace.condition(
                covariance,
                "innovation covariance of the structure measurements",
                parallelism,
            )?;
        }
        Ok(())
    }

    /// Hᵀ, P Hᵀ and H P Hᵀ for some eigenvectors.
    fn set_products(
        &self,
        covariance: &Covariance,
        block: Range<usize>,
        workspace: &mut Workspace,
        parallelism: Parallelism,
    ) {
        workspace
            .selection
            .reshape(covariance.dim(), 3 * block.len());
        workspace.selection.fill(0.0);
        for (column, k) in block.enumerate() {
            for (i, &entry) in self.vectors.col_as_slice(k).iter().enumerate() {
                for a in 0..3 {
                    workspace.selection[(POSE_DIM + 3 * i + a, 3 * column + a)] = entry;
                }
            }
        }
        let selection = workspace.selection.as_ref();
        covariance.times(selection, workspace.products.as_mut(), parallelism);
        set_product(
            workspace.innovation_covariance.as_mut(),
            selection.transpose(),
            workspace.products.as_ref(),
        );
    }

    /// O and the innovation for some eigenvectors.
    fn set_innovations(
        &self,
        block: Range<usize>,
        residual: &[Vector3<f64>],
        sigma: f64,
        workspace: &mut Workspace,
    ) {
        for (column, k) in block.enumerate() {
            let value = self.values[k];
            for a in 0..3 {
                let row = 3 * column + a;
                workspace.innovation_covariance[(row, row)] += sigma * sigma / value;
                workspace.growth[(row, 0)] = residual
                    .iter()
                    .zip(self.vectors.col_as_slice(k))
                    .enumerate()
                    .map(|(i, (r, entry))| {
                        let corrected = workspace.correction(POSE_DIM + 3 * i + a);
                        entry * (r[a] / value - corrected)
                    })
                    .sum();
            }
        }
    }
}
