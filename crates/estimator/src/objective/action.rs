//! What is left to do for each action: algebra of size 12, written for vector registers.
//!
//! The formulas are in [`super::group`]. With Γ = `[[A, 0], [Λ, I]]`, F = `[[I, 0], [D, I]]` and
//! Y = FL, both TᵀKT and TᵀNT come from G = ΓᵀM₁₁Γ and H = ΓᵀM₁₂ of a symmetric 12 × 12 matrix M as
//!
//! `[[√q G √q, √q (GY + H)], [·, Yᵀ(GY + H) + HᵀY + M₂₂]]`,
//!
//! and RᵀR adds the identity to the G of N.

use pulp::{Arch, Simd, WithSimd};

use super::group::VisibleSet;

/// Additions and multiplications of [`ActionTerms::trace`]: two congruences, an elimination of 12 rows of
/// 24 numbers, the product of the inverse factors, and the trace.
pub(super) const ACTION_OPERATIONS: usize =
    2 * (2 * (8 * 27 + 108 + 3 * 216) + 66 * 24 + 78 * 12 + 144);

/// A matrix, row by row.
type Rows<const R: usize, const C: usize> = [[f64; C]; R];

/// What the trace needs to know of an action.
#[derive(Clone, Copy, Debug)]
pub(super) struct ActionTerms {
    /// A, the axes about which the angles of the predicted pose turn it.
    pub(super) axes: Rows<3, 3>,
    /// Λ = [x − c]× A, x the predicted position.
    pub(super) lever: Rows<3, 3>,
    /// Y = FL.
    pub(super) moved_root: Rows<6, 6>,
    /// √q.
    pub(super) noise: [f64; 6],
}

impl ActionTerms {
    /// The trace of the covariance after the action with this set.
    pub(super) fn trace(&self, set: &VisibleSet) -> ActionTrace {
        Arch::new().dispatch(Trace { action: self, set })
    }
}

/// A trace and what tells how many of its digits are right.
#[derive(Clone, Copy, Debug)]
pub(super) struct ActionTrace {
    /// `None` if the information of the unknowns has no inverse.
    pub(super) value: Option<f64>,
    /// The largest information that the set has of one of the unknowns.
    pub(super) information: f64,
    /// How large the terms of tr(C TᵀNT) are.
    pub(super) magnitude: f64,
}

struct Trace<'a> {
    action: &'a ActionTerms,
    set: &'a VisibleSet,
}

impl WithSimd for Trace<'_> {
    type Output = ActionTrace;

    /// Plain loops: compiled here, they use the vectors that the machine has, and give the same
    /// numbers on any.
    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> ActionTrace {
        let mut information = congruence(&self.set.k.data.0, self.action, 0.0);
        let mut largest = 0.0_f64;
        for (i, row) in information.iter_mut().enumerate() {
            row[i] += 1.0;
            largest = largest.max(row[i]);
        }
        let weight = congruence(&self.set.n.data.0, self.action, 1.0);
        let Some(inverse) = inverse(information) else {
            return ActionTrace {
                value: None,
                information: largest,
                magnitude: f64::INFINITY,
            };
        };
        let mut trace = self.set.constant;
        for (inverse, weight) in inverse.iter().zip(&weight) {
            let mut products = [0.0; 12];
            for k in 0..12 {
                products[k] = inverse[k] * weight[k];
            }
            for product in products {
                trace += product;
            }
        }
        let mut magnitude = 0.0;
        for (i, size) in sizes(&self.set.root_of_n, self.action).iter().enumerate() {
            magnitude += inverse[i][i] * size * size;
        }
        ActionTrace {
            value: Some(trace),
            information: largest,
            magnitude,
        }
    }
}

/// |T|ᵀ m.
#[inline(always)]
fn sizes(m: &[f64; 12], action: &ActionTerms) -> [f64; 12] {
    let mut out = [0.0; 12];
    let mut turned = [0.0, 0.0, 0.0, m[3], m[4], m[5]];
    for i in 0..3 {
        let (axes, lever) = (&action.axes[i], &action.lever[i]);
        for j in 0..3 {
            turned[j] += axes[j].abs() * m[i] + lever[j].abs() * m[3 + i];
        }
    }
    for j in 0..6 {
        out[j] = action.noise[j] * turned[j];
        out[6 + j] = m[6 + j];
    }
    for (row, size) in action.moved_root.iter().zip(&turned) {
        for j in 0..6 {
            out[6 + j] += row[j].abs() * size;
        }
    }
    out
}

/// TᵀMT for a symmetric M, with `diagonal` I added to its G.
#[inline(always)]
fn congruence(m: &Rows<12, 12>, action: &ActionTerms, diagonal: f64) -> Rows<12, 12> {
    let ActionTerms {
        axes,
        lever,
        moved_root,
        noise,
    } = action;
    let (turn, cross, shift) = (
        block::<3, 3>(m, 0, 0),
        block::<3, 3>(m, 0, 3),
        block::<3, 3>(m, 3, 3),
    );
    // The columns of M₁₁Γ for the angles.
    let above = sum(product(&turn, axes), product(&cross, lever));
    let below = sum(transposed_product(&cross, axes), product(&shift, lever));
    let angles = sum(
        transposed_product(axes, &above),
        transposed_product(lever, &below),
    );
    let mixed = sum(
        transposed_product(axes, &cross),
        transposed_product(lever, &shift),
    );
    let mut g = [[0.0; 6]; 6];
    for i in 0..3 {
        for j in 0..3 {
            g[i][j] = angles[i][j];
            g[i][3 + j] = mixed[i][j];
            g[3 + j][i] = mixed[i][j];
            g[3 + i][3 + j] = shift[i][j];
        }
    }
    for (i, row) in g.iter_mut().enumerate() {
        row[i] += diagonal;
    }
    let lower = block::<3, 6>(m, 3, 6);
    let upper = sum(
        transposed_product(axes, &block::<3, 6>(m, 0, 6)),
        transposed_product(lever, &lower),
    );
    let h = [upper[0], upper[1], upper[2], lower[0], lower[1], lower[2]];

    let right = sum(product(&g, moved_root), h);
    let corner = sum(
        sum(
            transposed_product(moved_root, &right),
            transposed_product(&h, moved_root),
        ),
        block::<6, 6>(m, 6, 6),
    );
    let mut out = [[0.0; 12]; 12];
    for i in 0..6 {
        for j in 0..6 {
            out[i][j] = noise[i] * g[i][j] * noise[j];
            out[i][6 + j] = noise[i] * right[i][j];
            out[6 + j][i] = out[i][6 + j];
            out[6 + i][6 + j] = corner[i][j];
        }
    }
    out
}

/// A⁻¹ of a symmetric matrix; `None` if it is not positive definite.
#[inline(always)]
fn inverse(mut a: Rows<12, 12>) -> Option<Rows<12, 12>> {
    // A = RᵀR by elimination; the same on the identity gives V = R⁻ᵀ, and A⁻¹ = VᵀV. What is left
    // of A below the diagonal is not looked at.
    let mut v = [[0.0; 12]; 12];
    for (i, row) in v.iter_mut().enumerate() {
        row[i] = 1.0;
    }
    for i in 0..12 {
        let pivot = a[i][i];
        if !(pivot.is_finite() && pivot > 0.0) {
            return None;
        }
        let scale = 1.0 / pivot.sqrt();
        for k in 0..12 {
            a[i][k] *= scale;
            v[i][k] *= scale;
        }
        for j in i + 1..12 {
            let factor = a[i][j];
            for k in 0..12 {
                a[j][k] -= factor * a[i][k];
                v[j][k] -= factor * v[i][k];
            }
        }
    }
    let mut inverse = [[0.0; 12]; 12];
    for (last, row) in v.iter().enumerate() {
        for i in 0..=last {
            for k in 0..12 {
                inverse[i][k] += row[i] * row[k];
            }
        }
    }
    Some(inverse)
}

#[inline(always)]
fn block<const R: usize, const C: usize>(
    m: &Rows<12, 12>,
    row: usize,
    column: usize,
) -> Rows<R, C> {
    let mut out = [[0.0; C]; R];
    for i in 0..R {
        for j in 0..C {
            out[i][j] = m[row + i][column + j];
        }
    }
    out
}

#[inline(always)]
fn sum<const R: usize, const C: usize>(mut a: Rows<R, C>, b: Rows<R, C>) -> Rows<R, C> {
    for i in 0..R {
        for j in 0..C {
            a[i][j] += b[i][j];
        }
    }
    a
}

#[inline(always)]
fn product<const R: usize, const K: usize, const C: usize>(
    a: &Rows<R, K>,
    b: &Rows<K, C>,
) -> Rows<R, C> {
    let mut out = [[0.0; C]; R];
    for i in 0..R {
        for k in 0..K {
            for j in 0..C {
                out[i][j] += a[i][k] * b[k][j];
            }
        }
    }
    out
}

/// aᵀ b.
#[inline(always)]
fn transposed_product<const R: usize, const K: usize, const C: usize>(
    a: &Rows<K, R>,
    b: &Rows<K, C>,
) -> Rows<R, C> {
    let mut out = [[0.0; C]; R];
    for k in 0..K {
        for i in 0..R {
            for j in 0..C {
                out[i][j] += a[k][i] * b[k][j];
            }
        }
    }
    out
}
