//! Tools and bases known at run time change poses, and nothing else.

use kin_runtime::{
    Chain, Jacobian, JointLimit, Kinematics, Pose, Solution, Solutions, Twist, WithBase, WithTool,
};

const TOOL: [f64; 3] = [0.4, 0.0, 0.1];

/// A planar 2R arm with links of 0.5 and 0.4 that stands for a generated robot.
#[derive(Clone, Copy)]
struct Planar;

fn chain() -> Chain {
    let z = [0.0, 0.0, 1.0];
    let twists = [[0.0; 3], [0.5, 0.0, 0.0]].map(|point| Twist::revolute(z, point));
    Chain::new(twists.into(), Pose::from_translation([0.9, 0.0, 0.0]))
}

impl Kinematics<2> for Planar {
    const JOINT_NAMES: [&'static str; 2] = ["shoulder", "elbow"];
    const LIMITS: [JointLimit; 2] = [JointLimit::Continuous; 2];
    const BASE: &'static str = "base";
    const TIP: &'static str = "tip";
    const BRANCHES: usize = 1;

    fn fk(&self, q: &[f64; 2]) -> Pose {
        chain().fk(q)
    }
    fn fk_links(&self, q: &[f64; 2]) -> [Pose; 2] {
        chain().fk_links(q).try_into().unwrap()
    }
    fn fk_jacobian(&self, q: &[f64; 2]) -> (Pose, Jacobian<2>) {
        let columns = chain().spatial_jacobian(q).try_into().unwrap();
        (self.fk(q), Jacobian::from_columns(columns))
    }
    /// Only the elbow is computed, from the direction of the tip.
    fn ik(&self, target: &Pose) -> Solutions<2> {
        let [x, y, _] = target.translation;
        let elbow = ((x * x + y * y - 0.41) / 0.4).acos();
        let shoulder = y.atan2(x) - (0.4 * elbow.sin()).atan2(0.5 + 0.4 * elbow.cos());
        let mut solutions = Solutions::new();
        solutions.push(Solution {
            q: [shoulder, elbow],
            residual: 0.0,
            branch: 0,
            singular: false,
        });
        solutions
    }
}

fn close(a: &Jacobian<2>, b: &[Twist]) -> bool {
    let differences = a
        .columns()
        .into_iter()
        .zip(b)
        .map(|(x, y)| (x - *y).to_array());
    differences.flatten().all(|x| x.abs() < 1e-14)
}

#[test]
fn a_tool_and_a_base_are_the_chain_with_them_built_in() {
    let base = Pose::from_rpy([0.3, -0.7, 1.1], [1.0, 2.0, 3.0]);
    let tool = Pose::from_rpy([1.3, 0.2, -0.4], TOOL);
    let placed = WithBase {
        robot: WithTool {
            robot: Planar,
            tool,
        },
        base,
    };

    let twists: Vec<Twist> = chain()
        .twists()
        .iter()
        .map(|twist| base.adjoint(twist))
        .collect();
    let built_in = Chain::new(twists, base * *chain().home() * tool);
    let q = [0.4, 0.9];
    assert!(placed.fk(&q).translation_distance(&built_in.fk(&q)) < 1e-14);
    assert!(placed.fk(&q).rotation_distance(&built_in.fk(&q)) < 1e-14);
    assert!(close(
        &placed.spatial_jacobian(&q),
        &built_in.spatial_jacobian(&q)
    ));
    assert!(close(
        &placed.body_jacobian(&q),
        &built_in.body_jacobian(&q)
    ));
    assert!(close(
        &placed.geometric_jacobian(&q),
        &built_in.geometric_jacobian(&q)
    ));
    assert_eq!(placed.fk_links(&q)[1], base * Planar.fk_links(&q)[1]);
}

#[test]
fn inverse_kinematics_goes_through_the_inverse_placement() {
    let base = Pose::from_rpy([0.3, -0.7, 1.1], [1.0, 2.0, 3.0]);
    let tool = Pose::from_rpy([1.3, 0.2, -0.4], TOOL);
    let placed = WithBase {
        robot: WithTool {
            robot: Planar,
            tool,
        },
        base,
    };
    let q = [0.4, 0.9];
    let found = placed.ik(&placed.fk(&q));
    assert!((found[0].q[0] - q[0]).abs() < 1e-13 && (found[0].q[1] - q[1]).abs() < 1e-13);
}
