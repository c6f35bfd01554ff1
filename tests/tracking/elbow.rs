//! The elbow stretched.

use crate::follow::{By, Pair, Sample, follow, passes};
use crate::path::{STEPS, Vector, circle, cross, line, unit};
use crate::{Elbow, Ur5e};
use kinematics::Kinematics;
use nalgebra::DMatrix;

const STRETCHED: [f64; 6] = [0.3, -0.6, 0.0, 0.4, 0.7, -0.9];

/// The direction in which the stretched arm pulls: that of the force, with some
/// torque, that no joint feels. The tip cannot follow it.
fn outwards<K: Kinematics<6>>(arm: &K) -> Vector {
    let rows = arm.geometric_jacobian(&STRETCHED).rows;
    let transposed = DMatrix::from_fn(6, 6, |i, j| rows[j][i]);
    let felt = transposed.svd(false, true);
    let wrench = felt
        .v_t
        .unwrap()
        .row(felt.singular_values.imin())
        .into_owned();
    let force = unit([wrench[0], wrench[1], wrench[2]]);
    let tip = arm.fk(&STRETCHED).translation;
    let along: f64 = (0..3).map(|i| force[i] * tip[i]).sum();
    force.map(|x| x * along.signum())
}

/// A circle inside that touches the edge of the workspace.
fn touches_the_edge<K: Kinematics<6>>(arm: &K) {
    let outwards = outwards(arm);
    let along = unit(cross(outwards, [0.2, 0.5, 0.9]));
    let inside = circle(arm.fk(&STRETCHED), along, outwards.map(|x| -x));
    passes(arm, STRETCHED, inside, 25.0);
}

#[test]
fn touching_the_edge_of_the_workspace() {
    touches_the_edge(&Elbow);
    touches_the_edge(&Ur5e);
}

/// Straight out: answers to the edge, flagged there, and none near behind.
fn passes_the_edge<K: Kinematics<6>>(arm: &K) {
    let path = line(arm.fk(&STRETCHED), outwards(arm));
    for (step, half) in STEPS {
        let samples = follow(arm, STRETCHED, &path, [step, half, 0.0], By::Nearness);
        let edge = (half / step).round() as usize;
        let (within, behind) = samples.split_at(edge + 1);
        let within: Vec<&Sample> = within.iter().flatten().collect();
        assert_eq!(within.len(), edge + 1, "there are places without an answer");
        assert!(within[edge].answer.singular);
        assert!(within[..edge].iter().all(|sample| !sample.answer.singular));
        for pair in within.windows(2) {
            // The elbow bends as the root of the distance to the edge.
            let jump = Pair(pair[0], pair[1]).jump();
            assert!(jump < 5.0 * step.sqrt(), "{jump:e}");
        }
        for sample in behind.iter().flatten() {
            assert!(Pair(within[edge], sample).jump() > 0.5, "at {:e}", sample.s);
        }
    }
}

#[test]
fn passing_the_edge_of_the_workspace() {
    passes_the_edge(&Elbow);
    passes_the_edge(&Ur5e);
}
