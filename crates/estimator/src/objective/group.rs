//! What depends on the set of visible features alone.
//!
//! Let r be the pose's error before the motion, r = L s with s ~ N(0, I), LLᵀ = `P_rr`, and f the
//! features' error, f = f̂ + J s with f̂ independent of s. After a motion with Jacobian F and noise
//! √q e the pose's error is r' = F L s + √q e. Measurements turned into the world have the same
//! Jacobians for every action: with r' seen from the object's centre c as ρ = Γ r',
//! Γ = `[[W, 0], [[x − c]× W, I]]`, a feature at p is measured as z = A ρ + f + ε, A = `[[p − c]×, −I]`. So, with the
//! twelve unknowns ξ = (e, s) and T = `[[Γ√q, ΓFL], [0, I]]`, the set S is measured as
//!
//! `z_S` = U T ξ + f̂_S + ε,  U = [`A_S`, `J_S`],  f̂_S + ε ~ N(0, B),  B = `P̂_SS` + σ² I.
//!
//! Conditioning leaves Cov(ξ) = C = (I + TᵀKT)⁻¹ with K = UᵀB⁻¹U, and
//! Cov(f) = P̂ − `P̂_fS` B⁻¹ `P̂_Sf` + M C Mᵀ with M = ([0, J] − `P̂_fS` B⁻¹ U) T. Hence
//!
//! trace(P⁺) = tr P̂ − tr(B⁻¹ `(P̂²)_SS`) + tr(C (TᵀNT + RᵀR)),  R = [√q, FL],
//!
//! where N, the Gram matrix of [0, J] − `P̂_fS` B⁻¹ U, and K have size 12 and belong to the set.

use adslam_models::{FeatureId, POSE_DIM, feature_offset};
use faer::prelude::{Reborrow, ReborrowMut};
use nalgebra::{Matrix6, SMatrix};

use super::pose_factor::set_cross_factor;
use super::workspace::SetWorkspace;
use crate::buffer::Buffer;
use crate::digits::check_gain;
use crate::ekf::check_feature;
use crate::linear_algebra::{add_product, set_gram, set_product};
use crate::{Covariance, EstimatorError, Parallelism};

/// A 12 × 12 matrix over ξ.
pub(super) type Matrix12 = SMatrix<f64, 12, 12>;

/// The constants of one visible set.
#[derive(Clone, Copy, Debug)]
pub(super) struct VisibleSet {
    /// K = UᵀB⁻¹U.
    pub(super) k: Matrix12,
    /// N.
    pub(super) n: Matrix12,
    /// tr P̂ − tr(B⁻¹ `(P̂²)_SS`).
    pub(super) constant: f64,
    /// How large the terms are that the trace is summed from.
    pub(super) magnitude: f64,
    /// m, with no entry of what N is summed from larger than that of m mᵀ.
    pub(super) root_of_n: [f64; 12],
}

/// What all sets of a decision share, over the features that any of them sees, in memory that is kept.
#[derive(Clone, Debug, Default)]
pub(super) struct SharedBlocks {
    /// For each feature its place among the `seen`, or none.
    place: Vec<Option<usize>>,
    /// `P̂_VV` + σ²I, V the features seen.
    pub(super) b: Buffer,
    /// `(P̂²)_VV`.
    pub(super) squared: Buffer,
    /// U over V, 3v × 12.
    pub(super) u: Buffer,
    /// `(P̂J)_V`, 3v × 6.
    pub(super) pj: Buffer,
    /// P's columns of V, n × 3v, then P̂'s in the rows of the features.
    columns: Buffer,
    /// J, 3M × 6.
    j: Buffer,
    /// `J_V`, 3v × 6.
    j_seen: Buffer,
    /// JᵀJ, 6 × 6.
    jj: Matrix6<f64>,
    /// tr P̂.
    trace: f64,
    /// How large the terms of tr P̂ are.
    magnitude: f64,
    /// What B's diagonal is computed from, `P_VV` + σ² I.
    scale: Vec<f64>,
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

    /// The constants of the set `visible`, a part of the features seen.
    ///
    /// # Errors
    /// An unknown feature, B not positive definite, or with less than six right digits.
    pub(super) fn set(
        &self,
        visible: &[FeatureId],
        work: &mut SetWorkspace,
    ) -> Result<VisibleSet, EstimatorError> {
        let mut n = Matrix12::zeros();
        n.fixed_view_mut::<6, 6>(6, 6).copy_from(&self.jj);
        let mut root_of_n = [0.0; 12];
        for (root, squared) in root_of_n[6..].iter_mut().zip(self.jj.diagonal().iter()) {
            *root = squared.sqrt();
        }
        if visible.is_empty() {
            return Ok(VisibleSet {
                k: Matrix12::zeros(),
                n,
                constant: self.trace,
                magnitude: self.magnitude,
                root_of_n,
            });
        }
        work.gather(self, visible)?;
        work.factorise()?;
        work.invert();
        check_gain(work.condition(&self.scale), self.columns.nrows())?;
        // K = (L⁻¹U)ᵀ(L⁻¹U), X = B⁻¹U.
        let k = work.gram_of_whitened();
        work.finish_solve();
        work.add_sizes(&mut root_of_n);
        // N = [0, J]ᵀ[0, J] − [0, PJ]ᵀX − Xᵀ[0, PJ] + XᵀP̂²X.
        let cross = work.pj_times_x();
        for row in 0..6 {
            for column in 0..12 {
                n[(6 + row, column)] -= cross[(row, column)];
                n[(column, 6 + row)] -= cross[(row, column)];
            }
        }
        n += work.squared_between_x();
        Ok(VisibleSet {
            k,
            n,
            constant: self.trace - work.trace_of_inverse_times_squared(),
            magnitude: self.magnitude + work.magnitude_of_inverse_times_squared(),
            root_of_n,
        })
    }
}
