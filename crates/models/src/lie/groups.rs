//! An orientation and K points, composed in two ways.

use nalgebra::{DMatrix, DVector, Rotation3, Vector3};

use super::{LieGroup, so3};
use crate::State;

/// SE_K(3): an orientation and K points that turn with it.
#[derive(Clone, Debug, PartialEq)]
pub struct SeK3 {
    /// R, to the frame on the left.
    pub rotation: Rotation3<f64>,
    /// p¹ … pᴷ, cm.
    pub points: Vec<Vector3<f64>>,
}

/// SO(3) × R³ᴷ: an orientation and K points that do not turn with it.
#[derive(Clone, Debug, PartialEq)]
pub struct So3TimesPoints {
    /// R, to the frame on the left.
    pub rotation: Rotation3<f64>,
    /// p¹ … pᴷ, cm.
    pub points: Vec<Vector3<f64>>,
}

/// R, and x before the features.
fn parts(state: &State) -> (Rotation3<f64>, Vec<Vector3<f64>>) {
    let positions = std::iter::once(&state.pose.position).chain(&state.features);
    (
        state.pose.orientation.rotation(),
        positions.map(|p| p.coords).collect(),
    )
}

impl From<&State> for SeK3 {
    /// The whole state, K = 1 + M: x, then the features.
    fn from(state: &State) -> Self {
        let (rotation, points) = parts(state);
        Self { rotation, points }
    }
}

impl From<&State> for So3TimesPoints {
    /// The whole state, K = 1 + M: x, then the features.
    fn from(state: &State) -> Self {
        let (rotation, points) = parts(state);
        Self { rotation, points }
    }
}

/// θ and ξ¹ … ξᴷ of a tangent.
fn split(tangent: &DVector<f64>) -> (Vector3<f64>, Vec<Vector3<f64>>) {
    let (vectors, _) = tangent.as_slice().as_chunks::<3>();
    let mut vectors = vectors.iter().copied().map(Vector3::from);
    let theta = vectors.next().unwrap_or_default();
    (theta, vectors.collect())
}

fn joined(theta: Vector3<f64>, points: impl Iterator<Item = Vector3<f64>>) -> DVector<f64> {
    let entries: Vec<f64> = std::iter::once(theta)
        .chain(points)
        .flat_map(|v| [v.x, v.y, v.z])
        .collect();
    DVector::from_vec(entries)
}

impl LieGroup for SeK3 {
    fn compose(&self, other: &Self) -> Self {
        let both = self.points.iter().zip(&other.points);
        Self {
            rotation: self.rotation * other.rotation,
            points: both.map(|(a, b)| a + self.rotation * b).collect(),
        }
    }

    fn inverse(&self) -> Self {
        let rotation = self.rotation.inverse();
        Self {
            points: self.points.iter().map(|p| -(rotation * p)).collect(),
            rotation,
        }
    }

    fn exp(tangent: &DVector<f64>) -> Self {
        let (theta, xi) = split(tangent);
        let jacobian = so3::left_jacobian(&theta);
        Self {
            rotation: so3::exp(&theta),
            points: xi.iter().map(|xi| jacobian * xi).collect(),
        }
    }

    fn log(&self) -> DVector<f64> {
        let theta = so3::log(&self.rotation);
        let inverse = so3::left_jacobian_inverse(&theta);
        joined(theta, self.points.iter().map(|p| inverse * p))
    }

    fn adjoint(&self) -> DMatrix<f64> {
        let mut adjoint = rotations(&self.rotation, self.points.len());
        for (k, p) in self.points.iter().enumerate() {
            adjoint
                .fixed_view_mut::<3, 3>(3 + 3 * k, 0)
                .copy_from(&(p.cross_matrix() * self.rotation.matrix()));
        }
        adjoint
    }

    /// By its series Σ adⁿ/(n + 1)!, which ends with rounding.
    fn left_jacobian(tangent: &DVector<f64>) -> DMatrix<f64> {
        let (theta, xi) = split(tangent);
        let size = 3 + 3 * xi.len();
        let mut ad = DMatrix::zeros(size, size);
        for block in 0..=xi.len() {
            ad.fixed_view_mut::<3, 3>(3 * block, 3 * block)
                .copy_from(&theta.cross_matrix());
        }
        for (k, xi) in xi.iter().enumerate() {
            ad.fixed_view_mut::<3, 3>(3 + 3 * k, 0)
                .copy_from(&xi.cross_matrix());
        }
        let mut term = DMatrix::identity(size, size);
        let mut sum = term.clone();
        for n in 1..100 {
            term = &ad * term / f64::from(n + 1);
            sum += &term;
            if term.amax() <= f64::EPSILON * sum.amax() {
                break;
            }
        }
        sum
    }
}

impl LieGroup for So3TimesPoints {
    fn compose(&self, other: &Self) -> Self {
        let both = self.points.iter().zip(&other.points);
        Self {
            rotation: self.rotation * other.rotation,
            points: both.map(|(a, b)| a + b).collect(),
        }
    }

    fn inverse(&self) -> Self {
        Self {
            rotation: self.rotation.inverse(),
            points: self.points.iter().map(|p| -p).collect(),
        }
    }

    fn exp(tangent: &DVector<f64>) -> Self {
        let (theta, points) = split(tangent);
        Self {
            rotation: so3::exp(&theta),
            points,
        }
    }

    fn log(&self) -> DVector<f64> {
        joined(so3::log(&self.rotation), self.points.iter().copied())
    }

    fn adjoint(&self) -> DMatrix<f64> {
        let size = 3 + 3 * self.points.len();
        let mut adjoint = DMatrix::identity(size, size);
        adjoint
            .fixed_view_mut::<3, 3>(0, 0)
            .copy_from(self.rotation.matrix());
        adjoint
    }

    fn left_jacobian(tangent: &DVector<f64>) -> DMatrix<f64> {
        let (theta, _) = split(tangent);
        let mut jacobian = DMatrix::identity(tangent.len(), tangent.len());
        jacobian
            .fixed_view_mut::<3, 3>(0, 0)
            .copy_from(&so3::left_jacobian(&theta));
        jacobian
    }
}

/// R in each of the 1 + K blocks of the diagonal.
fn rotations(rotation: &Rotation3<f64>, points: usize) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(3 + 3 * points, 3 + 3 * points);
    for block in 0..=points {
        matrix
            .fixed_view_mut::<3, 3>(3 * block, 3 * block)
            .copy_from(rotation.matrix());
    }
    matrix
}
