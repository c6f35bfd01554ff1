//! A chain as it is drawn: lines between its axes.

use kin_codegen::geometry::{Line, axes, cross, norm};
use kin_codegen::model::{JointKind, Model};
use kin_runtime::Pose;
use serde::Serialize;

/// Axes this nearly parallel have no common normal to be drawn along.
const PARALLEL: f64 = 1e-3;

/// A chain's bones and axes, in metres, in the frames of the links that carry them.
#[derive(Clone, Debug, Serialize)]
pub struct Skeleton {
    /// By link, the base's first: the corners of a line. Each begins on the axis that the link
    /// hangs at and ends on the next one, or at the tip; between axes it is their common normal.
    pub bones: Vec<Vec<[f64; 3]>>,
    /// By joint, in the frame of the link that it moves.
    pub axes: Vec<Axis>,
}

/// A joint's axis.
#[derive(Clone, Debug, Serialize)]
pub struct Axis {
    /// Where the bones meet it.
    pub at: [f64; 3],
    /// Unit direction.
    pub direction: [f64; 3],
    /// Whether the joint turns about it, and does not slide along it.
    pub turns: bool,
}

impl Skeleton {
    /// Of a chain with at least one joint.
    pub fn new(model: &Model) -> Self {
        let lines = axes(model);
        let mut here = lines[0].nearest([0.0; 3]);
        let mut bones = vec![vec![[0.0; 3], here]];
        let mut drawn = Vec::new();
        for (i, joint) in model.joints.iter().enumerate() {
            let seen = |point| joint.frame.inverse().transform_point(point);
            let rotation = Pose {
                translation: [0.0; 3],
                ..joint.frame
            };
            drawn.push(Axis {
                at: seen(here),
                direction: rotation.inverse().transform_point(lines[i].direction),
                turns: joint.kind == JointKind::Revolute,
            });
            let corners = match lines.get(i + 1) {
                Some(next) => {
                    let leaves = leaves(&lines[i], next, here);
                    [here, leaves, next.nearest(leaves)]
                }
                None => {
                    let tip = model.home.translation;
                    [here, lines[i].nearest(tip), tip]
                }
            };
            bones.push(corners.map(seen).to_vec());
            here = corners[2];
        }
        Self { bones, axes: drawn }
    }
}

/// Where the common normal of two axes leaves the first; of parallel ones, which have many, the
/// one through a point.
fn leaves(axis: &Line, next: &Line, here: [f64; 3]) -> [f64; 3] {
    match norm(cross(axis.direction, next.direction)) {
        ..PARALLEL => here,
        _ => axis.foot(next),
    }
}
