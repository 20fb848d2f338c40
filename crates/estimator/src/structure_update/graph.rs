//! Any graph of measured pairs. Its Laplacian L = C Cᵀ has a Cholesky factor C with a column for each feature
//! but one of each connected part; the rows Cᵀ hold all that is measured, each axis of each with independent
//! noise of variance σ².
//!
//! The features with the fewest neighbours are eliminated first. A pair that shares no feature with others is
//! then a row by itself, as is every pair of a tree, and few pairs cost little, whatever the number
//! of features. Eliminating a feature joins its neighbours with pairs of their own, w ← w + w₁w₂/d: only positive
//! numbers are added, so that C is exact to rounding and what is not connected stays exactly zero.

#[cfg(test)]
mod tests;

use std::ops::Range;

use adslam_models::POSE_DIM;
use nalgebra::Vector3;

use super::STRUCTURE;
use crate::buffer::Buffer;
use crate::digits::Stages;
use crate::linear_algebra::set_product;
use crate::workspace::{Workspace, add_scaled, blocks};
use crate::{Covariance, EstimatorError, PairMeasurement, Parallelism};

/// An operation on numbers that lie apart takes about as long as this many on numbers that lie together.
const APART: usize = 4;

/// The graph of the pairs measured last, kept because the next ones are often the same.
#[derive(Clone, Debug, Default)]
pub(super) struct PairGraph {
    /// L of the pairs that are factored.
    laplacian: Buffer,
    /// L of the pairs read last.
    candidate: Buffer,
    /// C: the column of each feature that was eliminated. The others are zero.
    factor: Buffer,
    /// The features in the order of their elimination, one for each column of C.
    order: Vec<usize>,
    /// How many neighbours each feature has that are not eliminated.
    degrees: Vec<usize>,
    /// The neighbours of the feature that is being eliminated.
    neighbours: Vec<usize>,
    /// Its weights.
    weights: Vec<f64>,
    /// What the rows measured, C m = Hᵀ(z − Hχ̂), cm.
    measured: Vec<Vector3<f64>>,
    /// What of that is not yet accounted for, cm.
    rest: Vec<Vector3<f64>>,
}

impl PairGraph {
    /// Takes in the pairs of a step; true where they are all pairs, each once.
    pub(super) fn read(&mut self, pairs: &[PairMeasurement], count: usize) -> bool {
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
            return true;
        }
        if *self.candidate != *self.laplacian {
            self.factorise(count);
        }
        false
    }

    /// How many independent differences the pairs read last measure.
    pub(super) fn rank(&self) -> usize {
        self.order.len()
    }

    fn factorise(&mut self, count: usize) {
        self.order.clear();
        self.order.reserve(count);
        self.neighbours.clear();
        self.neighbours.reserve(count);
        self.factor.reshape(count, count);
        self.degrees.clear();
        for j in 0..count {
            let weights = self.candidate.col_as_slice(j);
            let column = self.factor.col_as_slice_mut(j);
            for (i, (weight, entry)) in column.iter_mut().zip(weights).enumerate() {
                *weight = if i == j { 0.0 } else { -entry };
            }
            self.degrees.push(nonzeros(column));
        }
        let fewest = |degrees: &[usize]| {
            let joined = degrees
                .iter()
                .enumerate()
                .filter(|(_, degree)| **degree > 0);
            joined.min_by_key(|(_, degree)| **degree).map(|(v, _)| v)
        };
        while let Some(feature) = fewest(&self.degrees) {
            self.eliminate(feature);
        }
        self.laplacian.reshape(count, count);
        self.laplacian.copy_from(&*self.candidate);
    }

    /// Turns the weights of a feature into a column of C and joins its neighbours.
    fn eliminate(&mut self, feature: usize) {
        let count = self.degrees.len();
        self.neighbours.clear();
        self.weights.clear();
        self.weights
            .extend_from_slice(self.factor.col_as_slice(feature));
        let weights = &self.weights;
        self.neighbours
            .extend((0..count).filter(|&i| weights[i] != 0.0));
        let pivot: f64 = self.neighbours.iter().map(|&i| weights[i]).sum();
        let few = APART * self.neighbours.len() < count;
        for &to in &self.neighbours {
            let scale = weights[to] / pivot;
            let column = self.factor.col_as_slice_mut(to);
            if few {
                for &i in &self.neighbours {
                    column[i] += scale * weights[i];
                }
            } else {
                add_scaled(column, scale, weights);
            }
            column[to] = 0.0;
            column[feature] = 0.0;
            self.degrees[to] = nonzeros(column);
        }
        let root = pivot.sqrt();
        for weight in self.factor.col_as_slice_mut(feature) {
            *weight /= -root;
        }
        self.factor[(feature, feature)] = root;
        self.degrees[feature] = 0;
        self.order.push(feature);
    }

    /// How many times smaller the pairs read last can make a variance.
    fn gain(&self, covariance: &Covariance, sigma: f64) -> f64 {
        let of_feature = |i| self.laplacian[(i, i)] * covariance.largest_feature_variance(i..i + 1);
        let largest = (0..covariance.feature_count())
            .map(of_feature)
            .fold(0.0, f64::max);
        largest / (sigma * sigma)
    }

    /// Conditions the covariance, its lower triangle, on the pairs read last. `residual` is Hᵀ(z − Hχ̂),
    /// cm; the correction of the state is left in the workspace.
    pub(super) fn condition(
        &mut self,
        covariance: &mut Covariance,
        residual: &[Vector3<f64>],
        sigma: f64,
        workspace: &mut Workspace,
        parallelism: Parallelism,
    ) -> Result<(), EstimatorError> {
        let dim = covariance.dim();
        workspace.prepare(dim, 1);
        self.set_measured(residual);
        let mut stages = Stages::new(STRUCTURE, dim);
        while let Some(weight) = stages.next(self.gain(covariance, sigma))? {
            for block in blocks(0..self.rank(), dim) {
                workspace.start_block(3 * block.len());
                self.set_products(covariance, block.clone(), workspace, parallelism);
                self.set_innovations(block, sigma * sigma / weight, workspace);
                workspace.condition(
                    covariance,
                    "innovation covariance of the structure measurements",
                    parallelism,
                )?;
            }
        }
        Ok(())
    }

    /// m, with C m = Hᵀ(z − Hχ̂).
    fn set_measured(&mut self, residual: &[Vector3<f64>]) {
        self.rest.clear();
        self.rest.extend_from_slice(residual);
        self.measured.clear();
        self.measured.reserve(residual.len());
        for &feature in &self.order {
            let column = self.factor.col_as_slice(feature);
            let measured = self.rest[feature] / column[feature];
            for (rest, entry) in self.rest.iter_mut().zip(column) {
                *rest -= measured * *entry;
            }
            self.measured.push(measured);
        }
    }

    /// The entries of a row of Cᵀ that are not zero.
    fn entries(&self, row: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let column = self.factor.col_as_slice(self.order[row]);
        let entries = column.iter().copied().enumerate();
        entries.filter(|(_, entry)| *entry != 0.0)
    }

    /// P Hᵀ and H P Hᵀ for some rows.
    fn set_products(
        &self,
        covariance: &Covariance,
        block: Range<usize>,
        workspace: &mut Workspace,
        parallelism: Parallelism,
    ) {
        // Each entry takes three columns of P apart, a full product all of them together.
        let entries: usize = block.clone().map(|row| self.entries(row).count()).sum();
        if APART * entries < covariance.dim() * block.len() {
            self.set_few_products(covariance, block, workspace);
        } else {
            self.set_all_products(covariance, block, workspace, parallelism);
        }
    }

    /// From the columns of P that the rows need.
    fn set_few_products(
        &self,
        covariance: &Covariance,
        block: Range<usize>,
        workspace: &mut Workspace,
    ) {
        workspace.columns.reshape(covariance.dim(), 3);
        workspace.products.fill(0.0);
        for (column, row) in block.clone().enumerate() {
            for (feature, entry) in self.entries(row) {
                let columns = workspace.columns.as_mut();
                covariance.copy_columns(POSE_DIM + 3 * feature, columns, Parallelism::Sequential);
                for a in 0..3 {
                    let product = workspace.products.col_as_slice_mut(3 * column + a);
                    add_scaled(product, entry, workspace.columns.col_as_slice(a));
                }
            }
        }
        let (products, s) = (&workspace.products, &mut workspace.innovation_covariance);
        for column in 0..s.ncols() {
            let product = products.col_as_slice(column);
            for (at, row) in block.clone().enumerate() {
                for a in 0..3 {
                    let terms = self
                        .entries(row)
                        .map(|(feature, entry)| entry * product[POSE_DIM + 3 * feature + a]);
                    s[(3 * at + a, column)] = terms.sum();
                }
            }
        }
    }

    /// From all of P.
    fn set_all_products(
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
        for (column, row) in block.enumerate() {
            for (i, entry) in self.entries(row) {
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

    /// O and the innovation for some rows.
    fn set_innovations(&self, block: Range<usize>, variance: f64, workspace: &mut Workspace) {
        for (column, row) in block.enumerate() {
            for a in 0..3 {
                let corrected: f64 = self
                    .entries(row)
                    .map(|(i, entry)| entry * workspace.correction(POSE_DIM + 3 * i + a))
                    .sum();
                let number = 3 * column + a;
                workspace.innovation_covariance[(number, number)] += variance;
                workspace.growth[(number, 0)] = self.measured[row][a] - corrected;
            }
        }
    }
}

fn nonzeros(values: &[f64]) -> usize {
    values.iter().filter(|value| **value != 0.0).count()
}
