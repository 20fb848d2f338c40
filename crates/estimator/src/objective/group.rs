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

use super::shared::{Matrix12, SharedBlocks};
use super::workspace::SetWorkspace;
use crate::EstimatorError;
use crate::digits::check_gain;

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

impl SharedBlocks {
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
