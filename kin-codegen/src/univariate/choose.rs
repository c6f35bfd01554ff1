//! Which joints to keep.

use super::eliminate::eliminate;
use super::frames::forward;
use crate::random::Random;
use kin_runtime::__private::univariate::{Elimination, Univariate};
use kin_runtime::Pose;
use std::f64::consts::PI;

/// Targets that every joint is tried on.
const TARGETS: usize = 64;
/// Eliminations at most: the second and third are asked where the first is not
/// sure of its answer.
const MOST: usize = 6;

/// An elimination, and how it did on random targets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kept {
    /// Its constants.
    pub elimination: Elimination,
    /// On how many targets of a hundred it was not sure to have all solutions.
    pub unsure: f64,
    /// The noise of its polynomial, relative to the largest coefficient, at 95 of
    /// a hundred targets.
    pub noise: f64,
}

/// The joints to keep, the one that separates solutions best first; empty where no
/// joint will do.
pub fn choose(frames: &[Pose; 7]) -> Vec<Kept> {
    let mut random = Random(0x2545_f491_4f6c_dd1d);
    let target = |_| forward(frames, &std::array::from_fn(|_| random.between(-PI, PI)));
    let targets: Vec<Pose> = (0..TARGETS).map(target).collect();
    let eliminations = (0..6).filter_map(|joint| eliminate(frames, joint));
    let mut kept: Vec<Kept> = eliminations
        .map(|elimination| tried(frames, elimination, &targets))
        .filter(|kept| kept.unsure < 100.0)
        .collect();
    let by_quality = |a: &Kept, b: &Kept| {
        a.unsure
            .total_cmp(&b.unsure)
            .then(a.noise.total_cmp(&b.noise))
    };
    kept.sort_by(by_quality);
    kept.truncate(MOST);
    kept
}

fn tried(frames: &[Pose; 7], elimination: Elimination, targets: &[Pose]) -> Kept {
    let arm = Univariate {
        frames: *frames,
        size: 2.0,
        eliminations: &[],
    };
    let told = targets.iter().map(|target| arm.told(&elimination, target));
    let told: Vec<_> = told.collect();
    let unsure = told.iter().filter(|told| !told.certain).count();
    let mut noises: Vec<f64> = told.iter().map(|told| told.noise).collect();
    noises.sort_by(f64::total_cmp);
    Kept {
        elimination,
        unsure: 100.0 * unsure as f64 / targets.len() as f64,
        noise: noises[noises.len() * 95 / 100],
    }
}
