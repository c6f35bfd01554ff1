//! r = 1, l = 3, e = 0.2: x = r cos q + √(l² − (r sin q − e)²).

use super::{CLOSED, SliderCrank};
use core::f64::consts::TAU;
use kinematics::Pose;

const R: f64 = 1.0;
const L: f64 = 3.0;
const E: f64 = 0.2;

fn root(q: f64) -> f64 {
    (L * L - (R * q.sin() - E).powi(2)).sqrt()
}

#[test]
fn golden_stroke_and_rate_at_50_degrees() {
    let q = 50_f64.to_radians();
    let found = SliderCrank.fk(&[q]);
    assert_eq!(found.len(), 2);
    let ahead = found.iter().map(|s| s.q);
    let ahead = ahead.max_by(|a, b| a[3].total_cmp(&b[3])).unwrap();
    let x = SliderCrank.platform(&ahead).translation[0];
    assert!((x - 3.588902626).abs() < 5e-10, "{x}");
    let rates = SliderCrank.joint_rates(&ahead, &[1.0]).unwrap();
    assert!((rates[3] + 0.889544833).abs() < 5e-10, "{rates:?}");
    let forward = SliderCrank.forward_jacobian(&ahead).unwrap();
    assert!((forward.rows[0][0] - rates[3]).abs() < 1e-14);
}

/// At dead centres the slider stands still while the crank moves on, though the platform's rod could
/// undo what the crank does.
#[test]
fn at_dead_centres_the_crank_moves_at_the_rate_it_is_given() {
    for (sine, rod) in [(E / (L + R), L + R), (-E / (L - R), L - R)] {
        let crank = sine.asin();
        for q in [crank, crank + 1e-10, crank - 1e-9, crank + 1e-6] {
            for assembly in SliderCrank.fk(&[q]).iter() {
                let q = assembly.q;
                assert!(SliderCrank.actuator_singularity(&q) > 0.1, "{rod}");
                let rates = SliderCrank.joint_rates(&q, &[1.0]).unwrap();
                assert!((rates[0] - 1.0).abs() < 1e-12, "{rates:?}");
                // By differences of the positions.
                let [ahead, behind] = [1e-5, -1e-5].map(|by| {
                    let near = SliderCrank.fk_near(&[q[0] + by], &q).unwrap();
                    near.q
                });
                for joint in 0..4 {
                    let turned = (ahead[joint] - behind[joint] + 3.0).rem_euclid(TAU) - 3.0;
                    assert!(
                        (rates[joint] - turned / 2e-5).abs() < 1e-8,
                        "{joint} {rates:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn both_strokes_follow_the_formula_for_the_whole_turn() {
    for degrees in 0..360 {
        let q = f64::from(degrees).to_radians();
        let found = SliderCrank.fk(&[q]);
        for sign in [1.0, -1.0] {
            let x = R * q.cos() + sign * root(q);
            let at = |s: &&kinematics::Solution<4>| {
                (SliderCrank.platform(&s.q).translation[0] - x).abs() < 1e-13
            };
            let assembly = found.iter().find(at).unwrap();
            assert!(assembly.residual < CLOSED * SliderCrank::LENGTH);
        }
    }
}

#[test]
fn a_stroke_has_two_cranks() {
    let x = 3.5;
    let postures = SliderCrank.ik(&Pose::from_translation([x, E, 0.0]));
    assert_eq!(postures.len(), 2);
    for q in postures.iter() {
        assert!((R * q[0].cos() + root(q[0]) - x).abs() < 1e-13);
    }
    // Off its line the slider cannot be.
    assert!(
        SliderCrank
            .ik(&Pose::from_translation([x, E + 0.1, 0.0]))
            .is_empty()
    );
}
