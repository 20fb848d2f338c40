//! `ObjectMotion` against the public code's recorded run, by hand, and in general.

use std::sync::Arc;

use adslam_deformation::{
    Amount, AnchoredDeformation, AxisRotation, BackAndForth, Direction, ObjectMotion, Schedule,
    Sinusoid, SinusoidalTranslation,
};
use approx::assert_relative_eq;
use nalgebra::{Point3, Vector3};
use proptest::prelude::*;

const ANCHOR: Point3<f64> = Point3::new(1.5, 0.0, 0.0);

fn schedule(in_fifths: [f64; 6]) -> Schedule {
    Schedule::new(in_fifths.map(|amount| 0.2 * amount).to_vec()).expect("finite amounts")
}

fn anchored(amount: Schedule) -> ObjectMotion {
    let deformation = AnchoredDeformation::new(ANCHOR, Direction::Horizontal, amount);
    ObjectMotion {
        deformation: Arc::new(deformation),
        ..ObjectMotion::default()
    }
}

/// `feature_motion` of polygon.log.jsonl, steps 2 to 9: the line of step k holds the motion from
/// k − 1 to k. Every feature moves by a multiple of its direction, which these sum up.
#[test]
fn the_public_schedule_gives_the_recorded_motion() {
    let motion = anchored(schedule([1.0, 2.0, 3.0, 3.0, 2.0, 1.0]));
    let diagonal = 0.1414213562373095;
    let features = [
        (ANCHOR, Vector3::zeros()),
        (Point3::new(1.5, -1.0, 1.0), Vector3::new(0.0, -0.2, 0.0)),
        (
            Point3::new(2.0, -0.5, 1.0),
            Vector3::new(diagonal, -diagonal, 0.0),
        ),
        (
            Point3::new(1.0, 0.5, 3.0),
            Vector3::new(-diagonal, diagonal, 0.0),
        ),
        (Point3::new(1.5, 0.0, 4.0), Vector3::new(0.0, 0.0, 0.2)),
    ];
    for (n, factor) in (1..).zip([1.0, 1.0, 0.0, -1.0, -1.0, 0.0, 1.0, 1.0]) {
        for (rest, direction) in &features {
            let moved = motion.feature_motion(rest, n);
            assert_relative_eq!(moved, direction * factor, epsilon = 1e-15);
        }
    }
}

#[test]
fn a_turning_r_d_carries_the_displacement_along() {
    let quarter = std::f64::consts::FRAC_PI_2;
    let motion = ObjectMotion {
        translation: Arc::new(BackAndForth::new(Vector3::x())),
        r_t: Arc::new(AxisRotation::new(Vector3::y(), -quarter, 0.0).unwrap()),
        r_d: Arc::new(AxisRotation::new(Vector3::z(), 0.0, quarter).unwrap()),
        ..anchored(schedule([1.0, 1.0, 1.0, 1.0, 1.0, 1.0]))
    };
    let rest = ANCHOR + Vector3::x();
    // r_t turns x up to z; D = (0.2, 0, 0) stays, but r_d turns it from x to y.
    assert_relative_eq!(motion.translation_step(1), Vector3::z(), epsilon = 1e-12);
    assert_relative_eq!(motion.offset(&rest, 2), Vector3::y() * 0.2, epsilon = 1e-12);
    let moved = motion.feature_motion(&rest, 1);
    assert_relative_eq!(moved, Vector3::new(-0.2, 0.2, 1.0), epsilon = 1e-12);
}

#[test]
fn the_default_is_at_rest() {
    assert_eq!(
        ObjectMotion::default().feature_motion(&ANCHOR, 5),
        Vector3::zeros()
    );
}

fn vector(size: f64) -> impl Strategy<Value = Vector3<f64>> {
    [-size..size, -size..size, -size..size].prop_map(Vector3::from)
}

fn rotation(largest_rate: f64) -> impl Strategy<Value = AxisRotation> {
    (vector(1.0), -3.0..3.0, -largest_rate..=largest_rate)
        .prop_filter_map("an axis", |(axis, angle, rate)| {
            AxisRotation::new(axis, angle, rate).ok()
        })
}

proptest! {
    #[test]
    fn feature_motion_telescopes(
        rest in vector(5.0), swing in vector(1.0), amplitude in -1.0..1.0, period in 0.5..20.0,
        phase in -4.0..4.0, r_t in rotation(0.0), r_d in rotation(1.0), steps in 1_usize..40,
    ) {
        let rest = Point3::from(rest);
        let wave = Sinusoid::new(amplitude, period, phase).unwrap();
        let motion = ObjectMotion {
            translation: Arc::new(SinusoidalTranslation::new(swing, period, phase).unwrap()),
            deformation: Arc::new(AnchoredDeformation::new(ANCHOR, Direction::Radial, wave)),
            r_t: Arc::new(r_t),
            r_d: Arc::new(r_d),
            ..ObjectMotion::default()
        };
        let last = steps + 1;
        let moved: Vector3<f64> = (1..last).map(|n| motion.feature_motion(&rest, n)).sum();
        let translated: Vector3<f64> = (1..last).map(|n| motion.translation_step(n)).sum();
        let deformed = motion.offset(&rest, last) - motion.offset(&rest, 1);
        prop_assert!((moved - translated - deformed).norm() < 1e-10);
    }

    #[test]
    fn back_and_forth_returns_after_two_steps(step in vector(1.0), n in 1_usize..1000) {
        let motion = ObjectMotion {
            translation: Arc::new(BackAndForth::new(step)),
            ..ObjectMotion::default()
        };
        prop_assert_eq!(motion.translation_step(n) + motion.translation_step(n + 1), Vector3::zeros());
    }

    #[test]
    fn an_anchored_object_returns_after_a_period_when_r_d_is_constant(
        rest in vector(5.0), amounts in prop::collection::vec(-1.0..1.0, 1..9),
        r_d in rotation(0.0), start in 1_usize..50,
    ) {
        let rest = Point3::from(rest);
        let period = amounts.len();
        let motion = ObjectMotion {
            r_d: Arc::new(r_d),
            ..anchored(Schedule::new(amounts).unwrap())
        };
        let moved: Vector3<f64> =
            (start..start + period).map(|n| motion.feature_motion(&rest, n)).sum();
        prop_assert!(moved.norm() < 1e-12);
    }

    #[test]
    fn d_of_the_paper_is_the_change_of_the_displacement(rest in vector(5.0), n in 1_usize..50) {
        let rest = Point3::from(rest);
        let motion = anchored(schedule([0.0, 1.0, 2.0, 3.0, 2.0, 1.0]));
        let d = motion.deformation.displacement(&rest, n as f64 + 1.0) - motion.deformation.displacement(&rest, n as f64);
        prop_assert_eq!(motion.feature_motion(&rest, n), d);
    }

    #[test]
    fn modes_and_amounts_make_the_offset(
        rest in vector(5.0), amplitude in -1.0..1.0, period in 0.5..20.0, phase in -4.0..4.0,
        r_d in rotation(1.0), horizontal in any::<bool>(), n in 1_usize..300,
    ) {
        let rest = Point3::from(rest);
        let direction = if horizontal { Direction::Horizontal } else { Direction::Radial };
        let wave = Sinusoid::new(amplitude, period, phase).unwrap();
        let motion = ObjectMotion {
            deformation: Arc::new(AnchoredDeformation::new(ANCHOR, direction, wave)),
            r_d: Arc::new(r_d),
            ..ObjectMotion::default()
        };
        let deformation = &motion.deformation;
        let mut displacement = Vector3::zeros();
        for k in 0..deformation.mode_count() {
            displacement += deformation.mode(k, &rest) * deformation.amount(k, n as f64);
        }
        let offset = motion.r_d_at(n) * displacement;
        prop_assert!((offset - motion.offset(&rest, n)).norm() < 1e-12);
        // The plain formula of the paper's deformation.
        let plain = direction.from_anchor(&ANCHOR, &rest) * wave.at(n as f64);
        prop_assert!((displacement - plain).norm() < 1e-12);
        // A mode that does not exist moves nothing.
        let beyond = deformation.mode_count();
        prop_assert_eq!(deformation.mode(beyond, &rest) * deformation.amount(beyond, n as f64), Vector3::zeros());
    }

    #[test]
    fn no_step_panics(rest in vector(1e6), n in any::<usize>()) {
        let motion = anchored(schedule([0.0, 1.0, 2.0, 3.0, 2.0, 1.0]));
        prop_assert!(motion.feature_motion(&Point3::from(rest), n).iter().all(|x| x.is_finite()));
    }
}
