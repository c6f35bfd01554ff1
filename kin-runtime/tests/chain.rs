//! The product of exponentials for any chain: golden arms of the book, and what
//! has to hold for all.

use core::f64::consts::PI;
use kin_runtime::{Chain, Jacobian, Pose, Twist};
use proptest::prelude::*;

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];
const MINUS_X: [f64; 3] = [-1.0, 0.0, 0.0];

const L0: f64 = 0.5;
const L1: f64 = 0.4;
const L2: f64 = 0.3;

fn scara() -> Chain {
    let revolute = |y: f64| Twist::revolute(Z, [0.0, y, 0.0]);
    Chain::new(
        vec![
            revolute(0.0),
            revolute(L1),
            revolute(L1 + L2),
            Twist::prismatic(Z),
        ],
        Pose::from_translation([0.0, L1 + L2, L0]),
    )
}

fn elbow() -> Chain {
    let at = |axis, y| Twist::revolute(axis, [0.0, y, L0]);
    let wrist = L1 + L2;
    let axes = [at(Z, 0.0), at(MINUS_X, 0.0), at(MINUS_X, L1)];
    let hand = [at(Z, wrist), at(MINUS_X, wrist), at(Y, wrist)];
    Chain::new(
        [axes, hand].concat(),
        Pose::from_translation([0.0, wrist, L0]),
    )
}

fn stanford() -> Chain {
    let at = |axis, y| Twist::revolute(axis, [0.0, y, L0]);
    let arm = [at(Z, 0.0), at(MINUS_X, 0.0), Twist::prismatic(Y)];
    let hand = [at(Z, L1), at(MINUS_X, L1), at(Y, L1)];
    Chain::new([arm, hand].concat(), Pose::from_translation([0.0, L1, L0]))
}

fn near(a: &[f64], b: &[f64], tolerance: f64) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(x, y)| (x - y).abs() <= tolerance)
}

fn determinant(columns: &[Twist]) -> f64 {
    let mut m: Vec<[f64; 6]> = columns.iter().map(|twist| twist.to_array()).collect();
    let mut product = 1.0;
    for k in 0..6 {
        let pivot = (k..6)
            .max_by(|&i, &j| m[i][k].abs().total_cmp(&m[j][k].abs()))
            .unwrap();
        if pivot != k {
            m.swap(pivot, k);
            product = -product;
        }
        product *= m[k][k];
        for i in k + 1..6 {
            let factor = m[i][k] / m[k][k];
            for j in k..6 {
                m[i][j] -= factor * m[k][j];
            }
        }
    }
    product
}

#[test]
fn scara_matches_the_book() {
    let q = [0.3, -0.5, 0.7, 0.1];
    let pose = scara().fk(&q);
    assert!(near(
        &pose.translation,
        &[-0.058607283, 0.676154569, 0.6],
        1e-9
    ));
    assert!((pose.rpy()[2] - 0.5).abs() < 1e-15);

    let (s1, c1, s12, c12) = (
        0.3_f64.sin(),
        0.3_f64.cos(),
        (-0.2_f64).sin(),
        (-0.2_f64).cos(),
    );
    let expected = [
        [0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
        [L1 * c1, L1 * s1, 0.0, 0.0, 0.0, 1.0],
        [L1 * c1 + L2 * c12, L1 * s1 + L2 * s12, 0.0, 0.0, 0.0, 1.0],
        [0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
    ];
    let columns = scara().spatial_jacobian(&q);
    assert!(
        columns
            .iter()
            .zip(expected)
            .all(|(c, e)| near(&c.to_array(), &e, 1e-15))
    );
}

#[test]
fn elbow_matches_the_book() {
    let q = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6];
    let pose = elbow().fk(&q);
    assert!(near(
        &pose.translation,
        &[-0.065420978, 0.652027622, 0.276704606],
        1e-9
    ));
    assert!(near(
        &pose.rotation[0],
        &[0.878680246, -0.387910292, 0.278292347],
        1e-9
    ));
    assert!((determinant(&elbow().spatial_jacobian(&q)) + 0.020393770).abs() < 1e-9);
    let twin = [
        0.1,
        0.456825217,
        5.983185307,
        0.517850781,
        0.808784714,
        0.790954174,
    ];
    assert!(elbow().fk(&twin).translation_distance(&pose) < 1e-9);
    assert!(elbow().fk(&twin).rotation_distance(&pose) < 2e-9);
}

#[test]
fn stanford_matches_the_book() {
    let q = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6];
    let pose = stanford().fk(&q);
    assert!(near(
        &pose.translation,
        &[-0.068490377, 0.682619229, 0.360931468],
        1e-9
    ));
    let columns = stanford().spatial_jacobian(&q);
    assert!((determinant(&columns) - 0.421443776).abs() < 1e-9);
    let (s, c) = 0.1_f64.sin_cos();
    assert!(near(
        &columns[1].to_array(),
        &[L0 * s, -L0 * c, 0.0, -c, -s, 0.0],
        1e-15
    ));
}

#[test]
fn links_carry_their_frames() {
    let frames: Vec<Pose> = [0.0, L1, L1 + L2, L1 + L2]
        .map(|y| Pose::from_translation([0.0, y, 0.0]))
        .into();
    let chain = scara().with_links(frames.clone());
    assert_eq!(chain.fk_links(&[0.0; 4]), frames);
    let links = chain.fk_links(&[0.3, -0.5, 0.7, 0.1]);
    // The second link's frame lies on the second joint's axis.
    let (s, c) = 0.3_f64.sin_cos();
    assert!(near(&links[1].translation, &[-L1 * s, L1 * c, 0.0], 1e-15));
    assert!((links[3].translation[2] - 0.1).abs() < 1e-15);
}

#[test]
fn a_chain_without_joints_stays_at_home() {
    let home = Pose::from_translation(X);
    assert_eq!(Chain::new(vec![], home).fk(&[]), home);
}

#[test]
#[should_panic(expected = "joint 1 has no unit twist")]
fn twists_of_any_length_are_refused() {
    Chain::new(
        vec![Twist::revolute(Z, X), Twist::prismatic([0.0, 2.0, 0.0])],
        Pose::IDENTITY,
    );
}

fn joints() -> impl Strategy<Value = Twist> {
    let vectors = || prop::array::uniform3(-1.0..1.0);
    (vectors(), vectors(), prop::bool::weighted(0.25))
        .prop_filter("a direction", |(axis, ..)| {
            axis.iter().any(|x: &f64| x.abs() > 0.1)
        })
        .prop_map(|(axis, point, prismatic)| {
            let length = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
            let axis = axis.map(|x| x / length);
            if prismatic {
                Twist::prismatic(axis)
            } else {
                Twist::revolute(axis, point)
            }
        })
}

fn chains() -> impl Strategy<Value = (Chain, Vec<f64>)> {
    let homes =
        prop::array::uniform6(-1.0..1.0).prop_map(|x| Pose::exp(&Twist::from_array(x), 1.0));
    (prop::collection::vec((joints(), -PI..PI), 1..9), homes).prop_map(|(joints, home)| {
        let (twists, q) = joints.into_iter().unzip();
        (Chain::new(twists, home), q)
    })
}

proptest! {
    #[test]
    fn exponentials_agree_with_the_pose_type((chain, q) in chains()) {
        let product = chain.twists().iter().zip(&q)
            .fold(Pose::IDENTITY, |g, (twist, value)| g * Pose::exp(twist, *value))
            * *chain.home();
        prop_assert!(chain.fk(&q).translation_distance(&product) < 1e-13);
        prop_assert!(chain.fk(&q).rotation_distance(&product) < 1e-13);
    }

    #[test]
    fn jacobians_are_derivatives((chain, q) in chains()) {
        let step = 1e-6;
        let (here, columns) = (chain.fk(&q), chain.spatial_jacobian(&q));
        for i in 0..q.len() {
            let moved = |by: f64| {
                let mut q = q.clone();
                q[i] += by;
                (chain.fk(&q) * here.inverse()).log()
            };
            let derivative = (moved(step) - moved(-step)) * (0.5 / step);
            prop_assert!(near(&derivative.to_array(), &columns[i].to_array(), 1e-7));
        }
    }

    #[test]
    fn the_three_jacobians_differ_by_coordinates((chain, q) in chains()) {
        let tool = chain.fk(&q);
        let columns = chain.spatial_jacobian(&q);
        for (i, spatial) in columns.iter().enumerate() {
            let spatial = Jacobian::from_columns([*spatial]);
            let body = spatial.spatial_to_body(&tool).column(0);
            let geometric = spatial.spatial_to_geometric(&tool).column(0);
            prop_assert_eq!(chain.body_jacobian(&q)[i], body);
            let chained = chain.geometric_jacobian(&q)[i].to_array();
            prop_assert!(near(&chained, &geometric.to_array(), 1e-14));
        }
    }
}
