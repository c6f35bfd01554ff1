//! Chains of any structure: their expressions are right, and inverse
//! kinematics is right or refused.

use crate::arm::{Arm, any_arm, placed, structure};
use crate::check::Solved;
use crate::settings::in_cases;
use kin_codegen::expr::forward::{JointTrig, Outputs, link_frames, tip};
use kin_codegen::expr::jacobian::{Which, jacobian, tip_and_jacobian};
use kin_codegen::expr::{Expr, Graph};
use kin_codegen::geometry::Linkage;
use kin_codegen::geometry::rank;
use kin_runtime::{Pose, Target, Twist};
use proptest::prelude::*;

/// An arm of any structure, and a configuration.
fn arm_and_configuration() -> BoxedStrategy<(Arm, Vec<f64>)> {
    structure()
        .prop_flat_map(|steps| placed(any_arm(&steps), &steps))
        .boxed()
}

#[test]
fn poses_are_those_of_the_chain() {
    in_cases(64, arm_and_configuration(), &|(arm, q)| {
        let chain = arm.0.chain();
        let found = evaluated(&arm, &q, |g, linkage, q| {
            let trig = JointTrig::at(g, linkage, q);
            tip(g, linkage, &trig)
        });
        assert_close(&found, &pose_entries(&chain.fk(&q)));
        let joints: Vec<usize> = (0..q.len()).collect();
        let found = evaluated(&arm, &q, |g, linkage, q| {
            let trig = JointTrig::at(g, linkage, q);
            link_frames(g, linkage, &trig, &joints)
        });
        let links: Vec<f64> = chain.fk_links(&q).iter().flat_map(pose_entries).collect();
        assert_close(&found, &links);
        Ok(())
    });
}

#[test]
fn jacobians_are_those_of_the_chain() {
    in_cases(64, arm_and_configuration(), &|(arm, q)| {
        let chain = arm.0.chain();
        let columns = |which| evaluated(&arm, &q, |g, linkage, q| jacobian(g, linkage, q, which));
        assert_close(
            &columns(Which::Spatial),
            &column_entries(&chain.spatial_jacobian(&q)),
        );
        assert_close(
            &columns(Which::Body),
            &column_entries(&chain.body_jacobian(&q)),
        );
        assert_close(
            &columns(Which::Geometric),
            &column_entries(&chain.geometric_jacobian(&q)),
        );
        let together = evaluated(&arm, &q, |g, linkage, q| {
            tip_and_jacobian(g, linkage, q, Which::Spatial)
        });
        let tip = pose_entries(&chain.fk(&q));
        assert_close(
            &together,
            &[tip, column_entries(&chain.spatial_jacobian(&q))].concat(),
        );
        Ok(())
    });
}

#[test]
fn inverse_kinematics_is_right_or_refused() {
    in_cases(64, arm_and_configuration(), &|(arm, q)| {
        let singular_everywhere = rank(&arm.0, Target::Pose) < arm.0.joints.len().min(6);
        prop_assume!(!singular_everywhere);
        if let Ok(solved) = Solved::try_new(&arm) {
            solved.check(&q)?;
        }
        Ok(())
    });
}

/// The values of what is built for an arm at a configuration.
fn evaluated<T: Outputs>(
    Arm(arm): &Arm,
    q: &[f64],
    build: impl Fn(&mut Graph, &Linkage, &[Expr]) -> T,
) -> Vec<f64> {
    let linkage = Linkage::new(arm);
    let mut g = Graph::new();
    let inputs: Vec<Expr> = (0..q.len()).map(|i| g.input(format!("q{i}"))).collect();
    let outputs = build(&mut g, &linkage, &inputs).expressions();
    let mut values = Vec::new();
    g.evaluate(q, 0, &mut values);
    outputs.iter().map(|e| values[e.index()]).collect()
}

fn pose_entries(pose: &Pose) -> Vec<f64> {
    let rotation = pose.rotation.into_iter().flatten();
    rotation.chain(pose.translation).collect()
}

fn column_entries(columns: &[Twist]) -> Vec<f64> {
    columns.iter().flat_map(|twist| twist.to_array()).collect()
}

fn assert_close(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    let close = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-12;
    assert!(
        found.iter().zip(expected).all(close),
        "{found:?}, {expected:?}"
    );
}
