//! What every group must keep to.

use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use proptest::test_runner::TestCaseError;

use super::{LieGroup, SeK3, So3TimesPoints};

const STEP: f64 = 1e-6;

/// Tangents of 3 + 3K entries whose rotation stays below π.
fn tangent(points: usize) -> impl Strategy<Value = DVector<f64>> {
    let entry = |k| if k < 3 { 1.7 } else { 6.0 };
    let entries: Vec<_> = (0..3 + 3 * points).map(|k| -entry(k)..entry(k)).collect();
    entries.prop_map(DVector::from_vec)
}

/// The distance of two elements, in the tangent between them.
fn apart<G: LieGroup>(a: &G, b: &G) -> f64 {
    a.compose(&b.inverse()).log().amax()
}

fn group_laws<G: LieGroup>(a: &G, b: &G, c: &G) -> Result<(), TestCaseError> {
    let left = a.compose(b).compose(c);
    prop_assert!(
        apart(&left, &a.compose(&b.compose(c))) < 1e-12,
        "associative"
    );
    prop_assert!(
        a.compose(&a.inverse()).log().amax() < 1e-12,
        "inverse on the right"
    );
    prop_assert!(
        a.inverse().compose(a).log().amax() < 1e-12,
        "inverse on the left"
    );
    Ok(())
}

fn exponential_laws<G: LieGroup>(tau: &DVector<f64>) -> Result<(), TestCaseError> {
    let element = G::exp(tau);
    prop_assert!((element.log() - tau).amax() < 1e-9, "log undoes exp");
    let halves = G::exp(&(tau * 0.3)).compose(&G::exp(&(tau * 0.7)));
    prop_assert!(apart(&element, &halves) < 1e-11, "one-parameter subgroup");
    prop_assert!(
        apart(&element.inverse(), &G::exp(&-tau)) < 1e-11,
        "exp(−τ) is the inverse"
    );
    Ok(())
}

fn adjoint_laws<G: LieGroup>(a: &G, b: &G, tau: &DVector<f64>) -> Result<(), TestCaseError> {
    let conjugate = a.compose(&G::exp(tau)).compose(&a.inverse());
    let adjoint = G::exp(&(a.adjoint() * tau));
    prop_assert!(
        apart(&conjugate, &adjoint) < 1e-9,
        "X exp(τ) X⁻¹ = exp(Ad τ)"
    );
    let product = a.adjoint() * b.adjoint();
    prop_assert!(
        (a.compose(b).adjoint() - product).amax() < 1e-9,
        "Ad of a product"
    );
    Ok(())
}

/// Column by column, by central differences.
fn jacobian_law<G: LieGroup>(tau: &DVector<f64>) -> Result<(), TestCaseError> {
    let back = G::exp(tau).inverse();
    let size = tau.len();
    let mut numeric = DMatrix::zeros(size, size);
    for k in 0..size {
        let mut delta = DVector::zeros(size);
        delta[k] = STEP;
        let at = |tau: DVector<f64>| G::exp(&tau).compose(&back).log();
        let column = (at(tau + &delta) - at(tau - &delta)) / (2.0 * STEP);
        numeric.set_column(k, &column);
    }
    let difference = G::left_jacobian(tau) - numeric;
    prop_assert!(
        difference.amax() < 1e-7,
        "left Jacobian, off by {}",
        difference.amax()
    );
    Ok(())
}

fn laws<G: LieGroup>(tangents: &[DVector<f64>; 3]) -> Result<(), TestCaseError> {
    let [a, b, c] = tangents.each_ref().map(G::exp);
    group_laws(&a, &b, &c)?;
    for tau in tangents {
        exponential_laws::<G>(tau)?;
        jacobian_law::<G>(tau)?;
    }
    adjoint_laws(&a, &b, &tangents[2])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// SO(3), SE(3), and a robot with five features.
    #[test]
    fn se_k_3(
        none in prop::array::uniform3(tangent(0)),
        one in prop::array::uniform3(tangent(1)),
        six in prop::array::uniform3(tangent(6)),
    ) {
        for tangents in [&none, &one, &six] {
            laws::<SeK3>(tangents)?;
        }
    }

    #[test]
    fn so_3_times_points(
        none in prop::array::uniform3(tangent(0)),
        one in prop::array::uniform3(tangent(1)),
        six in prop::array::uniform3(tangent(6)),
    ) {
        for tangents in [&none, &one, &six] {
            laws::<So3TimesPoints>(tangents)?;
        }
    }
}
