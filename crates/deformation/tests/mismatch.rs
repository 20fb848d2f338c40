//! A motion with another clock, scaled, or turned as a whole, against the motion itself.

#![allow(
    clippy::unwrap_used,
    reason = "a helper that fails is a test that fails"
)]

use std::sync::Arc;

use adslam_deformation::{
    AnchoredDeformation, AxisRotation, BackAndForth, Clock, Direction, ObjectMotion, Rotation,
    ScaledDeformation, Schedule, Sinusoid, SinusoidalTranslation, Turn,
};
use approx::assert_relative_eq;
use nalgebra::{Point3, Vector3};
use proptest::prelude::*;

const ANCHOR: Point3<f64> = Point3::new(1.5, 0.0, 0.0);

/// Everything turns, swings and breathes.
fn motion() -> ObjectMotion {
    let schedule = Schedule::new(vec![0.0, 0.2, 0.4, 0.6, 0.4, 0.2]).unwrap();
    ObjectMotion {
        translation: Arc::new(BackAndForth::new(Vector3::new(0.1, 0.2, -0.3))),
        deformation: Arc::new(AnchoredDeformation::new(
            ANCHOR,
            Direction::Horizontal,
            schedule,
        )),
        r_t: Arc::new(AxisRotation::new(Vector3::new(1.0, 2.0, 0.5), 0.3, 0.2).unwrap()),
        r_d: Arc::new(AxisRotation::new(Vector3::new(0.0, 1.0, 1.0), 0.0, -0.1).unwrap()),
        ..ObjectMotion::default()
    }
}

fn with_clock(factor: f64, delay_steps: f64) -> ObjectMotion {
    ObjectMotion {
        clock: Clock::new(factor, delay_steps).unwrap(),
        ..motion()
    }
}

const REST: Point3<f64> = Point3::new(2.0, -0.5, 1.0);

/// How far the base has moved from step `from` to step `to`.
fn way(motion: &ObjectMotion, from: usize, to: usize) -> Vector3<f64> {
    (from..to).map(|n| motion.translation_step(n)).sum()
}

#[test]
fn a_delayed_motion_does_the_same_later() {
    let (plain, late) = (motion(), with_clock(1.0, 3.0));
    for n in 4..40 {
        assert_relative_eq!(late.offset(&REST, n), plain.offset(&REST, n - 3));
        let (late, plain) = (late.translation_step(n), plain.translation_step(n - 3));
        assert_relative_eq!(late, plain, epsilon = 1e-15);
    }
}

#[test]
fn a_motion_ahead_does_the_same_earlier() {
    let (plain, early) = (motion(), with_clock(1.0, -2.0));
    for n in 1..20 {
        assert_relative_eq!(
            early.feature_motion(&REST, n),
            plain.feature_motion(&REST, n + 2),
            epsilon = 1e-14
        );
    }
}

#[test]
fn a_fast_motion_does_in_a_step_what_the_other_does_in_several() {
    let (plain, fast) = (motion(), with_clock(3.0, 0.0));
    for n in 1..20 {
        let at = 3 * (n - 1) + 1;
        assert_relative_eq!(fast.offset(&REST, n), plain.offset(&REST, at));
        let steps = way(&plain, at, at + 3);
        assert_relative_eq!(fast.translation_step(n), steps, epsilon = 1e-14);
    }
}

/// Whatever the factor, two steps at half of it make one.
#[test]
fn ways_add_up_between_whole_times() {
    for factor in [0.2, 0.7, 1.0, 1.3, 4.1] {
        let (whole, half) = (with_clock(factor, 0.25), with_clock(factor / 2.0, 0.5));
        for n in 1..30 {
            let steps = way(&half, 2 * n - 1, 2 * n + 1);
            assert_relative_eq!(whole.translation_step(n), steps, epsilon = 1e-13);
        }
    }
}

#[test]
fn a_motion_that_stands_still_keeps_its_deformation() {
    let still = with_clock(0.0, 0.0);
    assert_eq!(still.feature_motion(&REST, 5), Vector3::zeros());
    assert_eq!(still.offset(&REST, 5), motion().offset(&REST, 1));
}

#[test]
fn a_turned_object_is_turned_as_one_body() {
    let rotation = AxisRotation::new(Vector3::new(1.0, -1.0, 2.0), 0.0, 0.15).unwrap();
    let centre = Point3::new(1.5, 0.1, 2.0);
    let turned = ObjectMotion {
        turn: Some(Turn { centre, rotation }),
        ..motion()
    };
    let plain = motion();
    let others = [Point3::new(1.0, 0.5, 3.0), Point3::new(1.5, -1.0, 1.0)];
    assert_eq!(turned.offset(&REST, 1), plain.offset(&REST, 1));
    for n in 2..12 {
        let shown = |m: &ObjectMotion, rest: &Point3<f64>| rest + m.offset(rest, n);
        let r = rotation.at(n as f64);
        for p in &others {
            let distance = shown(&plain, p) - shown(&plain, &REST);
            let seen = shown(&turned, p) - shown(&turned, &REST);
            assert_relative_eq!(seen, r * distance, epsilon = 1e-12);
        }
        let from_centre = shown(&turned, &REST) - centre;
        let expected = r * (shown(&plain, &REST) - centre);
        assert_relative_eq!(from_centre, expected, epsilon = 1e-12);
        assert_eq!(turned.translation_step(n), plain.translation_step(n));
    }
}

#[test]
fn modes_amounts_and_the_turn_make_what_is_shown() {
    let rotation = AxisRotation::new(Vector3::z(), 0.0, 0.2).unwrap();
    let motion = ObjectMotion {
        turn: Some(Turn {
            centre: ANCHOR,
            rotation,
        }),
        deformation: Arc::new(ScaledDeformation::new(motion().deformation, 1.5)),
        ..with_clock(1.3, 0.4)
    };
    for n in 1..10 {
        let mode = motion.deformation.mode(0, &REST) * motion.amount(0, n);
        let shown = motion.turn_at(n) * (REST + motion.r_d_at(n) * mode);
        assert_relative_eq!(shown, REST + motion.offset(&REST, n), epsilon = 1e-12);
    }
}

proptest! {
    /// Between whole steps all is continuous: no jump where one amount gives way to the next.
    #[test]
    fn a_motion_is_continuous_in_its_delay(
        amplitude in -1.0..1.0, period in 2.0..20.0, factor in 0.0..5.0, delay in -10.0..10.0, n in 1_usize..50,
    ) {
        let wave = Sinusoid::new(amplitude, period, 0.3).unwrap();
        let swing = SinusoidalTranslation::new(Vector3::x() * amplitude, period, 0.3).unwrap();
        for motion in [motion(), ObjectMotion {
            translation: Arc::new(swing),
            deformation: Arc::new(AnchoredDeformation::new(ANCHOR, Direction::Radial, wave)),
            ..ObjectMotion::default()
        }] {
            let at = |delay| ObjectMotion { clock: Clock::new(factor, delay).unwrap(), ..motion.clone() };
            let (a, b) = (at(delay), at(delay + 1e-7));
            let moved = |m: &ObjectMotion| m.offset(&REST, n);
            prop_assert!((moved(&a) - moved(&b)).norm() < 1e-5);
            prop_assert!((a.translation_step(n) - b.translation_step(n)).norm() < 1e-5);
        }
    }

    #[test]
    fn no_step_of_any_clock_panics_or_takes_forever(
        factor in 0.0..=1000.0, delay in -1e300..1e300_f64, n in any::<usize>(),
    ) {
        for delay in [delay, 0.0, delay.signum() * 1e6] {
            let motion = with_clock(factor, delay);
            prop_assert!(motion.feature_motion(&REST, n).iter().all(|x| x.is_finite()));
        }
    }
}
