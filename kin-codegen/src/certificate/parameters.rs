//! Values of locked joints to try: anywhere, at quarter turns, where the other joints
//! may be aligned, and next to these.

use crate::model::{JointKind, Model};
use crate::random::Random;
use std::f64::consts::{FRAC_PI_2, PI};

/// How many places, the first, are anywhere.
pub(super) const ANYWHERE: usize = 2;
/// The first of them, at which nothing is aligned.
pub(crate) const SOMEWHERE: f64 = 0.83;
/// The places of a joint, as angles.
const PLACES: [f64; 7] = [
    SOMEWHERE,
    -2.17,
    0.0,
    FRAC_PI_2,
    -FRAC_PI_2 + 1e-9,
    PI,
    1e-6,
];

/// The values of all locked joints at once, radians and metres: a single answer, and
/// that empty, where none is locked.
pub(super) fn tried(model: &Model, locked: &[usize]) -> Vec<Vec<f64>> {
    if locked.is_empty() {
        return vec![Vec::new()];
    }
    let mut random = Random(0xa409_3822_299f_31d0);
    let size = crate::geometry::size(model);
    let value = |joint: usize, place: f64| match model.joints[joint].kind {
        JointKind::Revolute => place,
        JointKind::Prismatic => place / PI * size,
    };
    let mut at = |place: f64| -> Vec<f64> {
        let mut places = vec![place; locked.len()];
        // The others anywhere among the places, so that not all are aligned at once.
        for other in places.iter_mut().skip(1) {
            *other = PLACES[random.below(PLACES.len() as u64)];
        }
        let pairs = locked.iter().zip(places);
        pairs.map(|(&joint, place)| value(joint, place)).collect()
    };
    PLACES.into_iter().map(&mut at).collect()
}
