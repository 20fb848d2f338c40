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

use adslam_models::FeatureId;
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatRef, Par};
use nalgebra::SMatrix;

use super::workspace::SetWorkspace;
use crate::EstimatorError;
use crate::ekf::check_feature;

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
}

/// What all sets of a decision share, over the features that any of them sees.
#[derive(Clone, Debug)]
pub(super) struct SharedBlocks {
    /// For each feature its place among the `seen`, or none.
    place: Vec<Option<usize>>,
    /// `P̂_VV` + σ²I, V the features seen.
    pub(super) b: Mat<f64>,
    /// `(P̂²)_VV`.
    pub(super) squared: Mat<f64>,
    /// U over V, 3v × 12.
    pub(super) u: Mat<f64>,
    /// `(P̂J)_V`, 3v × 6.
    pub(super) pj: Mat<f64>,
    /// JᵀJ, 6 × 6.
    jj: SMatrix<f64, 6, 6>,
    /// tr P̂.
    trace: f64,
}

impl SharedBlocks {
    /// Gathers the blocks over the features `seen` (each once): P over all features, J (3M × 6), and
    /// A for each feature.
    pub(super) fn new(
        p_ff: MatRef<'_, f64>,
        j: MatRef<'_, f64>,
        seen: &[FeatureId],
        jacobian: impl Fn(FeatureId) -> SMatrix<f64, 3, 6>,
        measurement_variance: f64,
    ) -> Self {
        let all = p_ff.nrows();
        let mut place = vec![None; all / 3];
        let mut u = Mat::zeros(3 * seen.len(), 12);
        let mut p_hat = Mat::zeros(3 * seen.len(), all);
        let mut j_seen = Mat::zeros(3 * seen.len(), 6);
        for (at, &feature) in seen.iter().enumerate() {
            place[feature.0] = Some(at);
            let (row, from) = (3 * at, 3 * feature.0);
            let a = jacobian(feature);
            for axis in 0..3 {
                for column in 0..6 {
                    u[(row + axis, column)] = a[(axis, column)];
                    u[(row + axis, 6 + column)] = j[(from + axis, column)];
                    j_seen[(row + axis, column)] = j[(from + axis, column)];
                }
            }
            for column in 0..all {
                for axis in 0..3 {
                    // Symmetric: a column is contiguous where a row is not.
                    p_hat[(row + axis, column)] = p_ff[(column, from + axis)];
                }
            }
        }
        matmul(
            &mut p_hat,
            Accum::Add,
            &j_seen,
            j.transpose(),
            -1.0,
            Par::Seq,
        );
        let squared = &p_hat * p_hat.transpose();
        let pj = &p_hat * j;
        let mut b = Mat::zeros(3 * seen.len(), 3 * seen.len());
        for (at, &feature) in seen.iter().enumerate() {
            for axis in 0..3 {
                for row in 0..b.nrows() {
                    b[(row, 3 * at + axis)] = p_hat[(row, 3 * feature.0 + axis)];
                }
                b[(3 * at + axis, 3 * at + axis)] += measurement_variance;
            }
        }
        let jj = j.transpose() * j;
        let diagonal: f64 = (0..all).map(|i| p_ff[(i, i)]).sum();
        let trace = diagonal - (0..6).map(|i| jj[(i, i)]).sum::<f64>();
        Self {
            place,
            b,
            squared,
            u,
            pj,
            jj: SMatrix::from_fn(|r, c| jj[(r, c)]),
            trace,
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
    /// An unknown feature, or B not positive definite.
    pub(super) fn set(
        &self,
        visible: &[FeatureId],
        work: &mut SetWorkspace,
    ) -> Result<VisibleSet, EstimatorError> {
        let mut n = Matrix12::zeros();
        n.fixed_view_mut::<6, 6>(6, 6).copy_from(&self.jj);
        if visible.is_empty() {
            return Ok(VisibleSet {
                k: Matrix12::zeros(),
                n,
                constant: self.trace,
            });
        }
        work.gather(self, visible)?;
        work.factorise()?;
        // K = (L⁻¹U)ᵀ(L⁻¹U), X = B⁻¹U.
        let k = work.gram_of_whitened();
        work.finish_solve();
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
        })
    }
}
