//! What all visible sets of a decision share.

use adslam_models::{FeatureId, POSE_DIM, feature_offset};
use faer::prelude::{Reborrow, ReborrowMut};
use nalgebra::{Matrix6, SMatrix};

use super::pose_factor::set_cross_factor;
use crate::buffer::Buffer;
use crate::input::check_feature;
use crate::linear_algebra::{add_product, set_gram, set_product};
use crate::{Covariance, EstimatorError, Parallelism};

/// A 12 × 12 matrix over ξ.
pub(super) type Matrix12 = SMatrix<f64, 12, 12>;

/// What all sets of a decision share, over the features that any of them sees, in memory that is kept.
#[derive(Clone, Debug, Default)]
pub(super) struct SharedBlocks {
    /// For each feature its place among the `seen`, or none.
    pub(super) place: Vec<Option<usize>>,
    /// `P̂_VV` + σ²I, V the features seen.
    pub(super) b: Buffer,
    /// `(P̂²)_VV`.
    pub(super) squared: Buffer,
    /// U over V, 3v × 12.
    pub(super) u: Buffer,
    /// `(P̂J)_V`, 3v × 6.
    pub(super) pj: Buffer,
    /// P's columns of V, n × 3v, then P̂'s in the rows of the features.
    pub(super) columns: Buffer,
    /// J, 3M × 6.
    pub(super) j: Buffer,
    /// `J_V`, 3v × 6.
    pub(super) j_seen: Buffer,
    /// JᵀJ, 6 × 6.
    pub(super) jj: Matrix6<f64>,
    /// tr P̂.
    pub(super) trace: f64,
    /// How large the terms of tr P̂ are.
    pub(super) magnitude: f64,
    /// What B's diagonal is computed from, `P_VV` + σ² I.
    pub(super) scale: Vec<f64>,
}

impl SharedBlocks {
    /// Gathers the blocks over the features `seen` (each once): P's lower triangle, L, A for each
    /// feature, and σ².
    pub(super) fn prepare(
        &mut self,
        covariance: &Covariance,
        root: &Matrix6<f64>,
        seen: &[FeatureId],
        jacobian: impl Fn(FeatureId) -> SMatrix<f64, 3, 6>,
        measurement_variance: f64,
    ) {
        set_cross_factor(&mut self.j, covariance, root);
        let (all, rows) = (self.j.nrows(), 3 * seen.len());
        self.place.clear();
        self.place.resize(covariance.feature_count(), None);
        self.u.reshape(rows, 12);
        self.j_seen.reshape(rows, 6);
        self.columns.reshape(covariance.dim(), rows);
        for (at, &feature) in seen.iter().enumerate() {
            self.place[feature.0] = Some(at);
            let (row, from) = (3 * at, 3 * feature.0);
            let a = jacobian(feature);
            for axis in 0..3 {
                for column in 0..6 {
                    let j = self.j[(from + axis, column)];
                    self.u[(row + axis, column)] = a[(axis, column)];
                    self.u[(row + axis, 6 + column)] = j;
                    self.j_seen[(row + axis, column)] = j;
                }
            }
            covariance.copy_columns(
                feature_offset(feature),
                self.columns.subcols_mut(row, 3),
                Parallelism::Sequential,
            );
        }
        let mut p_hat = self.columns.subrows_mut(POSE_DIM, all);
        add_product(
            p_hat.rb_mut(),
            -1.0,
            self.j.as_ref(),
            self.j_seen.as_ref(),
            Parallelism::Sequential,
        );
        let p_hat = p_hat.rb();
        self.squared.reshape(rows, rows);
        self.pj.reshape(rows, 6);
        set_gram(self.squared.as_mut(), p_hat);
        set_product(self.pj.as_mut(), p_hat.transpose(), self.j.as_ref());
        self.b.reshape(rows, rows);
        for (at, &feature) in seen.iter().enumerate() {
            for axis in 0..3 {
                for column in 0..rows {
                    self.b[(3 * at + axis, column)] = p_hat[(3 * feature.0 + axis, column)];
                }
                self.b[(3 * at + axis, 3 * at + axis)] += measurement_variance;
            }
        }
        self.jj = Matrix6::from_fn(|r, c| {
            let product = self.j.col(r).iter().zip(self.j.col(c).iter());
            product.map(|(a, b)| a * b).sum()
        });
        let variances: f64 = (POSE_DIM..covariance.dim())
            .map(|i| covariance.entry(i, i))
            .sum();
        self.trace = variances - self.jj.trace();
        self.magnitude = variances + self.jj.trace();
        self.scale.clear();
        self.scale.reserve(all);
        for &feature in seen {
            let variances = covariance.feature(feature).diagonal();
            let scale = variances.iter().map(|v| v + measurement_variance);
            self.scale.extend(scale);
        }
    }

    /// The place of a feature among those seen.
    pub(super) fn place(&self, feature: FeatureId) -> Result<usize, EstimatorError> {
        check_feature(feature, self.place.len())?;
        self.place[feature.0].ok_or(EstimatorError::NotPlanned(feature))
    }
}
