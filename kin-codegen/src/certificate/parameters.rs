//! Values of locked joints to try: anywhere, at quarter turns, where the other joints
//! may be aligned, and next to these.

use crate::model::{JointKind, Model};
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
    let size = crate::geometry::size(model);
    let value = |joint: usize, place: f64| match model.joints[joint].kind {
        JointKind::Revolute => place,
        JointKind::Prismatic => place / PI * size,
    };
    let at = |i: usize| -> Vec<f64> {
        let joints = locked.iter().enumerate();
        joints
            .map(|(k, &joint)| value(joint, PLACES[place(i, k)]))
            .collect()
    };
    (0..PLACES.len()).map(at).collect()
}

/// The i-th place of the k-th joint: each joint is at all of them, and no two are together at more
/// than one, so that not all are aligned at once.
fn place(i: usize, k: usize) -> usize {
    let all = PLACES.len();
    (i * (1 + k % (all - 1)) + k * k) % all
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn each_joint_is_at_all_places_and_never_at_those_of_others() {
        let all: Vec<usize> = (0..PLACES.len()).collect();
        for k in 0..PLACES.len() - 1 {
            let seen: BTreeSet<usize> = all.iter().map(|&i| place(i, k)).collect();
            assert_eq!(seen.len(), all.len());
            for other in 0..k {
                let together = all.iter().filter(|&&i| place(i, k) == place(i, other));
                assert_eq!(together.count(), 1, "{k} {other}");
            }
        }
    }
}
