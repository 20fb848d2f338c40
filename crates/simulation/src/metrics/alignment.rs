//! Rigid alignment of two point sets.

use nalgebra::{Isometry3, Matrix3, Point3, Rotation3, Translation3, UnitQuaternion, Vector3};

/// The rotation and translation that bring `from` closest to `to` in the least-squares sense, without
/// scale: Umeyama, 1991. Points beyond the shorter list are ignored.
///
/// `None` if there are no points, a coordinate is not finite, or the decomposition fails.
#[must_use]
pub fn align(from: &[Point3<f64>], to: &[Point3<f64>]) -> Option<Isometry3<f64>> {
    let pairs = || from.iter().zip(to);
    let count = pairs().count();
    if count == 0 {
        return None;
    }
    let mean = |points: &mut dyn Iterator<Item = &Point3<f64>>| -> Vector3<f64> {
        points.map(|p| p.coords).sum::<Vector3<f64>>() / count as f64
    };
    let mean_from = mean(&mut pairs().map(|(a, _)| a));
    let mean_to = mean(&mut pairs().map(|(_, b)| b));
    let covariance: Matrix3<f64> = pairs()
        .map(|(a, b)| (b.coords - mean_to) * (a.coords - mean_from).transpose())
        .sum();
    if !covariance.iter().all(|x| x.is_finite()) {
        return None;
    }
    let svd = covariance.try_svd(true, true, f64::EPSILON, 1000)?;
    let (u, v_t) = (svd.u?, svd.v_t?);
    // The best orthogonal matrix may be a reflection; the best rotation then flips the axis of
    // the smallest singular value, which nalgebra sorts last.
    let sign = (u * v_t).determinant().signum();
    let flip = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, sign));
    let rotation = Rotation3::from_matrix_unchecked(u * flip * v_t);
    let rotation = UnitQuaternion::from_rotation_matrix(&rotation);
    let translation = Translation3::from(mean_to - rotation * mean_from);
    Some(Isometry3::from_parts(translation, rotation))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn sum_of_squares(a: &[Point3<f64>], b: &[Point3<f64>], t: &Isometry3<f64>) -> f64 {
        a.iter()
            .zip(b)
            .map(|(a, b)| (t * a - b).norm_squared())
            .sum()
    }

    proptest! {
        #[test]
        fn finds_the_motion_and_nothing_nearby_is_better(
            points in prop::collection::vec(prop::array::uniform3(-5.0..5.0), 4..12),
            noise in prop::collection::vec(prop::array::uniform3(-0.3..0.3), 12),
            angles in prop::array::uniform3(-3.0..3.0),
            shift in prop::array::uniform3(-3.0..3.0),
            nudge in prop::array::uniform6(-0.01..0.01),
        ) {
            let from: Vec<Point3<f64>> = points.into_iter().map(Point3::from).collect();
            let motion = Isometry3::from_parts(
                Translation3::from(Vector3::from(shift)),
                UnitQuaternion::from_euler_angles(angles[0], angles[1], angles[2]),
            );
            let exact: Vec<Point3<f64>> = from.iter().map(|p| motion * p).collect();
            let found = align(&from, &exact).unwrap();
            prop_assert!(sum_of_squares(&from, &exact, &found) < 1e-18);

            let noisy: Vec<Point3<f64>> =
                exact.iter().zip(&noise).map(|(p, w)| p + Vector3::from(*w)).collect();
            let found = align(&from, &noisy).unwrap();
            let nearby = Isometry3::new(
                Vector3::new(nudge[0], nudge[1], nudge[2]),
                Vector3::new(nudge[3], nudge[4], nudge[5]),
            ) * found;
            let (best, other) =
                (sum_of_squares(&from, &noisy, &found), sum_of_squares(&from, &noisy, &nearby));
            prop_assert!(best <= other + 1e-12);
        }
    }

    #[test]
    fn degenerate_input_gives_a_rotation_or_nothing() {
        assert!(align(&[], &[]).is_none());
        let p = [Point3::new(f64::NAN, 0.0, 0.0)];
        assert!(align(&p, &p).is_none());
        let flat = [
            Point3::origin(),
            Point3::new(1.0, 0.0, 0.0),
            Point3::new(0.0, 1.0, 0.0),
        ];
        let mirrored = flat.map(|p| Point3::new(-p.x, p.y, p.z));
        let t = align(&flat, &mirrored).unwrap();
        assert!((t.rotation.to_rotation_matrix().matrix().determinant() - 1.0).abs() < 1e-12);
        assert!(
            sum_of_squares(&flat, &mirrored, &t) < 1e-18,
            "a flip about the y axis does it"
        );
    }
}
