//! What holds for every mechanism, generated beside generic.

use super::{CLOSED, Delta, FiveBar, FourBar, Led, SliderCrank, Stewart, generic, same};
use crate::chapter3::random::Random;
use kinematics::ParallelKinematics;

/// Closed configurations on ways that the actuators go from home.
fn walks<const N: usize, const M: usize, const K: usize>(
    mechanism: &impl ParallelKinematics<N, M, K>,
    reach: f64,
) -> Vec<[f64; N]> {
    let mut random = Random::new(M as u64);
    let mut all = Vec::new();
    for _ in 0..8 {
        let goal: [f64; M] = random.unit_cube();
        let mut q = [0.0; N];
        for step in 1..=10 {
            let part = reach * f64::from(step) / 10.0;
            let actuated = goal.map(|x| part * x);
            let Some(found) = mechanism.fk_near(&actuated, &q) else {
                break;
            };
            if mechanism.actuator_singularity(&found.q) < 0.02 {
                break;
            }
            q = found.q;
            all.push(q);
        }
    }
    assert!(all.len() > 40, "{}", all.len());
    all
}

fn check<P, const N: usize, const M: usize, const K: usize>(mechanism: &P, file: &str, reach: f64)
where
    P: ParallelKinematics<N, M, K>,
{
    let generic = generic(file);
    let length = P::LENGTH;
    assert!((generic.length() - length).abs() < 1e-15);
    assert_eq!(generic.mobility(), P::MOBILITY);
    for q in walks(mechanism, reach) {
        assert!(mechanism.gap(&q) < CLOSED * length);
        agree(mechanism, &generic, &q);
        differences(mechanism, &q);
        rates_close_the_loops(mechanism, &q);
    }
}

/// Poses, twists and measures are those of the generic mechanism.
fn agree<P, const N: usize, const M: usize, const K: usize>(
    mechanism: &P,
    generic: &kinematics::Mechanism,
    q: &[f64; N],
) where
    P: ParallelKinematics<N, M, K>,
{
    let (poses, twists) = mechanism.chains(q);
    for (a, b) in poses.iter().zip(generic.poses(q)) {
        assert!(a.translation_distance(&b) < 1e-14 && a.rotation_distance(&b) < 1e-14);
    }
    for (a, b) in twists.iter().zip(generic.twists(q)) {
        assert!((*a - b).to_array().iter().all(|x| x.abs() < 1e-14));
    }
    let measures = [
        (
            mechanism.actuator_singularity(q),
            generic.actuator_singularity(q),
        ),
        (
            mechanism.kinematic_singularity(q),
            generic.kinematic_singularity(q, P::MOBILITY),
        ),
    ];
    assert!(
        measures.iter().all(|(a, b)| (a - b).abs() < 1e-12),
        "{measures:?}"
    );
}

/// The forward Jacobian is the derivative of the platform's pose by the
/// actuated joints, and the inverse one undoes it.
fn differences<P, const N: usize, const M: usize, const K: usize>(mechanism: &P, q: &[f64; N])
where
    P: ParallelKinematics<N, M, K>,
{
    const STEP: f64 = 1e-5;
    let forward = mechanism.forward_jacobian(q).unwrap();
    let rows = mechanism.inverse_jacobian(q).unwrap();
    let at = mechanism.actuated(q);
    for a in 0..M {
        let pose = |sign: f64| {
            let mut moved = at;
            moved[a] += sign * STEP;
            mechanism.platform(&mechanism.fk_near(&moved, q).unwrap().q)
        };
        let twist = (pose(1.0) * pose(-1.0).inverse()).log() * (0.5 / STEP);
        let off = (twist - forward.column(a)).to_array();
        let size = forward
            .column(a)
            .to_array()
            .iter()
            .fold(1.0, |m: f64, x| m.max(x.abs()));
        assert!(
            off.iter().all(|x| x.abs() < 1e-5 * size * size * size),
            "{off:?}"
        );
        for (b, row) in rows.iter().enumerate() {
            let column = forward.column(a).to_array();
            let product: f64 = row.iter().zip(column).map(|(x, y)| x * y).sum();
            assert!(
                (product - f64::from(u8::from(a == b))).abs() < 1e-9,
                "{product}"
            );
        }
    }
}

/// J₁ θ̇₁ = J₂ θ̇₂ = … = V.
fn rates_close_the_loops<P, const N: usize, const M: usize, const K: usize>(
    mechanism: &P,
    q: &[f64; N],
) where
    P: ParallelKinematics<N, M, K>,
{
    let actuated = [1.0; M];
    let rates = mechanism.joint_rates(q, &actuated).unwrap();
    let velocity = mechanism.forward_jacobian(q).unwrap().velocity(&actuated);
    let jacobian = mechanism.structure_jacobian(q);
    let largest = rates.iter().fold(1.0, |most: f64, x| most.max(x.abs()));
    for [first, end] in P::CHAINS {
        let mut only = [0.0; N];
        only[first..end].copy_from_slice(&rates[first..end]);
        let off = (jacobian.velocity(&only) - velocity).to_array();
        assert!(off.iter().all(|x| x.abs() < 1e-12 * largest), "{off:?}");
    }
    for (joint, rate) in P::ACTUATED.iter().zip(actuated) {
        assert!((rates[*joint] - rate).abs() < 1e-10);
    }
}

#[test]
fn four_bar() {
    check(&FourBar, "../robots/four_bar.yaml", 3.0);
}

#[test]
fn led() {
    check(&Led, "robots/led.yaml", 0.4);
}

#[test]
fn slider_crank() {
    check(&SliderCrank, "../robots/slider_crank.yaml", 3.0);
}

#[test]
fn five_bar() {
    check(&FiveBar, "../robots/five_bar.yaml", 1.0);
}

#[test]
fn delta() {
    check(&Delta, "../robots/delta.yaml", 0.7);
}

#[test]
fn stewart() {
    check(&Stewart, "../robots/stewart.yaml", 0.1);
}

/// Closed forms find the assembly that made the actuated values, and the ways
/// to hold a platform contain the one that it came from.
macro_rules! returns {
    ($mechanism:ident, $reach:expr) => {
        for q in walks(&$mechanism, $reach) {
            let actuated = $mechanism.actuated(&q);
            let found = $mechanism.fk(&actuated);
            assert!(
                found.iter().any(|s| same(&s.q, &q, 1e-9)),
                "{q:?} {found:?}"
            );
            let postures = $mechanism.ik(&$mechanism.platform(&q));
            assert!(postures.iter().any(|other| same(&other, &q, 1e-7)), "{q:?}");
        }
    };
}

#[test]
fn closed_forms_return_to_where_they_came_from() {
    returns!(FourBar, 3.0);
    returns!(SliderCrank, 3.0);
    returns!(FiveBar, 1.0);
    returns!(Delta, 0.7);
}

/// Beside all assembly modes that many starts of Newton's method find.
#[test]
fn closed_forms_find_all_assembly_modes() {
    let mut random = Random::new(7);
    for _ in 0..10 {
        let crank = [random.angle()];
        let expected = generic("../robots/four_bar.yaml").assembly_modes(&crank);
        assert_eq!(FourBar.fk(&crank).len(), expected.len());
        for q in expected {
            assert!(FourBar.fk(&crank).iter().any(|s| {
                (0..4).all(|i| kinematics::__private::math::wrap(s.q[i] - q[i]).abs() < 1e-6)
            }));
        }
        let motors = [random.between(-0.8, 0.8), random.between(-0.8, 0.8)];
        let expected = generic("../robots/five_bar.yaml").assembly_modes(&motors);
        assert_eq!(FiveBar.fk(&motors).len(), expected.len());
    }
}
