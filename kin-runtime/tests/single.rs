//! Elementary functions and conversions of single precision, against double precision.

use kin_runtime::single::__private::{lanes, math};
use kin_runtime::{Pose, single};
use std::f64::consts::{PI, TAU};

/// Numbers between two, at steps that share no digits with them.
fn between(low: f64, high: f64) -> impl Iterator<Item = f32> {
    (0..400_000)
        .map(move |k| (low + (high - low) * ((f64::from(k) * 0.618_033_988_749_895) % 1.0)) as f32)
}

fn worst(errors: impl Iterator<Item = f64>) -> f64 {
    errors.fold(0.0, |worst, error| {
        assert!(!error.is_nan());
        worst.max(error.abs())
    })
}

#[test]
fn sines_and_cosines_have_the_digits_that_are_stated() {
    for range in [PI / 4.0, 2.0 * PI, 1.2e4] {
        let error = worst(between(-range, range).flat_map(|x| {
            let (sine, cosine) = math::sin_cos(x);
            let exact = f64::from(x).sin_cos();
            [f64::from(sine) - exact.0, f64::from(cosine) - exact.1]
        }));
        assert!(error < 1.0e-7, "{range} {error:e}");
    }
    for x in [1e7, 1e20, f32::MAX] {
        assert!(math::sin_cos(x).0.abs() <= 1.0 + f32::EPSILON);
    }
    assert!(math::sin_cos(f32::NAN).0.is_nan() && math::sin_cos(f32::INFINITY).1.is_nan());
}

#[test]
fn angles_have_the_digits_that_are_stated() {
    for scale in [1e-30, 1.0, 1e30] {
        let error = worst(between(-PI, PI).map(|turn| {
            let (sine, cosine) = turn.sin_cos();
            let (y, x) = (scale * sine, scale * cosine);
            let exact = f64::from(y).atan2(f64::from(x));
            f64::from(lanes::angle(y, x)) - exact
        }));
        assert!(error < 2.5e-7, "{scale} {error:e}");
    }
    let pi = std::f32::consts::PI;
    let eighths = [(0.0, 1.0), (1.0, 1.0), (1.0, 0.0), (1.0, -1.0), (0.0, -1.0)];
    for (k, (y, x)) in eighths.into_iter().enumerate() {
        assert_eq!(lanes::angle(y, x), 0.25 * k as f32 * pi);
    }
    assert_eq!(
        (lanes::angle(-0.0, -1.0), math::atan2(-0.0, -1.0)),
        (pi, -pi)
    );
    assert_eq!(lanes::angle(0.0, 0.0), 0.0);
    assert!(lanes::angle(f32::NAN, 1.0).is_nan());
}

#[test]
fn wrapped_angles_are_the_same_and_inside() {
    let pi = std::f32::consts::PI;
    let error = worst(between(-1e3, 1e3).map(|x| {
        let wrapped = math::wrap(x);
        assert!(-pi < wrapped && wrapped <= pi);
        let apart = f64::from(wrapped) - f64::from(x);
        apart - TAU * (apart / TAU).round()
    }));
    assert!(error < 3e-7, "{error:e}");
    assert_eq!([-pi, pi, 0.25].map(math::wrap), [pi, pi, 0.25]);
    assert_eq!([2.4, 2.5, -0.6].map(math::round), [2.0, 2.0, -1.0]);
    assert_eq!([2.1, 2.0, -0.6].map(math::ceil), [3.0, 2.0, 0.0]);
}

/// The matrix that was rounded is taken as a rotation, and one that is further off is not.
#[test]
fn poses_are_rounded_and_come_back() {
    let exact = Pose::from_axis_angle([0.0, 0.6, 0.8], 1.1, [0.1, -0.2, 1e6]);
    let rounded = single::Pose::from(exact);
    assert!(rounded.rotation_error() < 1e-6);
    let back = Pose::from(rounded);
    assert_eq!(single::Pose::from(back), rounded);
    let isometry: nalgebra::Isometry3<f32> = rounded.into();
    assert!(single::Pose::from(isometry).rotation_distance(&rounded) < 1e-6);
    assert!(back.rotation_distance(&exact) < 1e-7);
    assert!(back.translation_distance(&exact) < 0.05);
}
