//! Links that hang without moving on those of the chain.

use super::Frame;
use super::chain::Chain;
use crate::spec::{ArmSpec, JointType};
use kin_runtime::Pose;

/// The links of an arm beside its base and those of joints that lead, with what
/// carries them; in the order of the file.
pub(super) fn fixed(spec: &ArmSpec, chain: &Chain, leads: &[bool]) -> Vec<Frame> {
    let mut beside = vec![Vec::new(); spec.links.len()];
    // What is wrong with a joint, or moves it, ends what can be said.
    let joints = spec.joints.iter();
    for joint in joints.filter(|joint| joint.kind == JointType::Fixed && joint.faults.is_empty()) {
        let out = joint.origin * joint.mount;
        beside[joint.parent].push((joint.child, out));
        beside[joint.child].push((joint.parent, out.inverse()));
    }
    let moving = |&j: &usize| spec.joints[j].kind != JointType::Fixed;
    let moved = chain.joints.iter().copied().filter(moving);
    let mut placed: Vec<Option<(Option<usize>, Pose)>> = vec![None; spec.links.len()];
    let bodies: Vec<usize> = std::iter::once(chain.base)
        .chain(moved.map(|j| spec.joints[j].child))
        .collect();
    for (i, &body) in bodies.iter().enumerate() {
        let joint = i.checked_sub(1);
        placed[body] = Some((joint, Pose::IDENTITY));
        let mut open = vec![(body, Pose::IDENTITY)];
        while let Some((link, pose)) = open.pop() {
            for &(next, step) in &beside[link] {
                if placed[next].is_none() {
                    placed[next] = Some((joint, pose * step));
                    open.push((next, pose * step));
                }
            }
        }
    }
    for (i, &body) in bodies.iter().enumerate() {
        if i.checked_sub(1).is_none_or(|joint| leads[joint]) {
            placed[body] = None;
        }
    }
    let links = spec.links.iter().zip(placed);
    links
        .filter_map(|(link, placed)| {
            let (joint, pose) = placed?;
            let name = link.name.clone();
            Some(Frame { name, joint, pose })
        })
        .collect()
}
