//! Covariances as ellipsoids.

use nalgebra::{Matrix3, Rotation3, SymmetricEigen, UnitQuaternion, Vector3};

/// The ellipsoid of one sigma: its half axes, and the rotation that takes x, y and z to them. A
/// covariance that is slightly indefinite from rounding is flat there; none if it is not finite.
pub(crate) fn ellipsoid(covariance: &Matrix3<f64>) -> Option<(Vector3<f64>, UnitQuaternion<f64>)> {
    // The decomposition does not end on what is not a number.
    if !covariance.iter().all(|x| x.is_finite()) {
        return None;
    }
    let SymmetricEigen {
        eigenvalues,
        mut eigenvectors,
    } = covariance.symmetric_eigen();
    if eigenvectors.determinant() < 0.0 {
        let flipped = -eigenvectors.column(2);
        eigenvectors.set_column(2, &flipped);
    }
    let rotation = Rotation3::from_matrix_unchecked(eigenvectors);
    let axes = eigenvalues.map(|variance| variance.max(0.0).sqrt());
    Some((axes, UnitQuaternion::from_rotation_matrix(&rotation)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ellipsoid_gives_the_covariance_back() {
        let c = Matrix3::new(4.0, 1.0, 0.5, 1.0, 3.0, -0.2, 0.5, -0.2, 1.0);
        let (axes, rotation) = ellipsoid(&c).unwrap();
        let r = rotation.to_rotation_matrix();
        let back = r.matrix()
            * Matrix3::from_diagonal(&axes.component_mul(&axes))
            * r.matrix().transpose();
        assert!((back - c).norm() < 1e-12, "{back}");
        assert!((r.matrix().determinant() - 1.0).abs() < 1e-12);
        assert!(ellipsoid(&Matrix3::from_element(f64::NAN)).is_none());
    }
}
