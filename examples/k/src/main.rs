//! Beside `k`, which has trees of links, with whatever hangs on them, and one solution near a
//! seed: `kinematics` reads the same file and has all of them.
//!
//! Names carry joint values from one to the other, matrices poses, so that the versions of
//! nalgebra and of urdf-rs that each of them takes do not matter.

use kinematics::{Pose, Robot};

const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/ur5e.urdf");

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let tree = k::Chain::<f64>::from_urdf_file(FILE)?;
    let arm = Robot::from_urdf(FILE)?;

    let target = pose_in(&tree, &arm, &[0.3, -1.2, 1.5, -0.7, 1.1, 0.4])?;
    for solution in arm.ik(&target).iter() {
        let reached = pose_in(&tree, &arm, solution.q)?;
        let off = reached.translation_distance(&target);
        println!(
            "branch {}: {:6.3?}, {off:.0e} m off by k",
            solution.branch, solution.q
        );
        assert!(off < 1e-9);
    }
    assert_eq!(arm.ik(&target).len(), 8);
    Ok(())
}

/// Where k has the arm's tip in the frame of its base.
fn pose_in(
    tree: &k::Chain<f64>,
    arm: &Robot,
    q: &[f64],
) -> Result<Pose, Box<dyn std::error::Error>> {
    for (name, &value) in arm.joint_names().iter().zip(q) {
        let joint = tree.find(name).ok_or("k has no such joint")?;
        joint.set_joint_position(value)?;
    }
    tree.update_transforms();
    let frame = |link| {
        let node = tree.find_link(link).ok_or("k has no such link")?;
        node.world_transform().ok_or("k has no transform")
    };
    let tip = frame(arm.base())?.inverse() * frame(arm.tip())?;
    let matrix = tip.to_homogeneous();
    let row = |i| [0, 1, 2, 3].map(|j| matrix[(i, j)]);
    Ok(Pose::from_matrix(&[row(0), row(1), row(2), row(3)]))
}
