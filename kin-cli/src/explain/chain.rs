//! The chain as the file has it.

use kin_codegen::geometry::size;
use kin_codegen::model::{self, JointKind, Model};
use serde::Serialize;

/// A serial chain at home.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Chain {
    /// The link that poses are given in.
    pub base: String,
    /// The link that poses are of.
    pub tip: String,
    /// The frame of a tool in that of the tip, whose poses are meant instead: x, y, z, roll, pitch
    /// and yaw, metres and radians.
    pub tool: Option<[f64; 6]>,
    /// How far the tip can be from the first axis with every link stretched;
    /// tolerances are relative to it.
    pub size: f64,
    /// The moving joints, from base to tip.
    pub joints: Vec<Joint>,
    /// The tip's position at home.
    pub home_translation: [f64; 3],
    /// The tip's orientation at home, by rows.
    pub home_rotation: [[f64; 3]; 3],
    /// The other links that do not move against the base or one that a joint
    /// moves: cameras, flanges, tool changers.
    pub frames: Vec<FixedFrame>,
}

/// A link that is fixed to another one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FixedFrame {
    /// From the file.
    pub name: String,
    /// The base, or the link that a joint moves, which carries it.
    pub link: String,
    /// Its position in the frame of that link.
    pub translation: [f64; 3],
    /// Its orientation in the frame of that link, by rows.
    pub rotation: [[f64; 3]; 3],
}

/// A moving joint.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Joint {
    /// From the file.
    pub name: String,
    /// How it moves.
    pub motion: JointMotion,
    /// Unit direction of its axis.
    pub axis: [f64; 3],
    /// Where the file puts its frame: a point on the axis.
    pub point: [f64; 3],
    /// Lower and upper bound; none for a joint without stops.
    pub limits: Option<[f64; 2]>,
    /// The coordinate of q that moves it: 1 for q₁.
    pub coordinate: usize,
    /// How it follows that coordinate, unless it is the joint that the coordinate is.
    pub mimic: Option<Mimic>,
}

/// How a joint moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum JointMotion {
    /// About its axis, between limits.
    Revolute,
    /// About its axis, without limits.
    Continuous,
    /// Along its axis.
    Prismatic,
}

/// The joint's value is `multiplier * coordinate + offset`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Mimic {
    /// See above.
    pub multiplier: f64,
    /// See above.
    pub offset: f64,
}

impl Chain {
    pub(crate) fn of(model: &Model) -> Self {
        Self {
            base: model.base.clone(),
            tip: model.tip.clone(),
            tool: model.tool,
            size: size(model),
            joints: model.joints.iter().map(|j| joint(model, j)).collect(),
            home_translation: model.home.translation,
            home_rotation: model.home.rotation,
            frames: model.frames.iter().map(|f| frame(model, f)).collect(),
        }
    }
}

fn frame(model: &Model, frame: &model::Frame) -> FixedFrame {
    let link = frame
        .joint
        .map_or(&model.base, |joint| &model.joints[joint].link);
    FixedFrame {
        name: frame.name.clone(),
        link: link.clone(),
        translation: frame.pose.translation,
        rotation: frame.pose.rotation,
    }
}

fn joint(model: &Model, joint: &model::Joint) -> Joint {
    let variable = &model.variables[joint.variable];
    let motion = match (joint.kind, variable.limits) {
        (JointKind::Prismatic, _) => JointMotion::Prismatic,
        (JointKind::Revolute, Some(_)) => JointMotion::Revolute,
        (JointKind::Revolute, None) => JointMotion::Continuous,
    };
    let mimic = Mimic {
        multiplier: joint.multiplier,
        offset: joint.offset,
    };
    let limits = variable.limits.map(|ends| {
        let [a, b] = ends.map(|end| joint.multiplier * end + joint.offset);
        [a.min(b), a.max(b)]
    });
    let is_own = joint.is_coordinate(joint.variable) && joint.name == variable.name;
    Joint {
        name: joint.name.clone(),
        motion,
        axis: joint.axis,
        point: joint.point,
        limits,
        coordinate: joint.variable + 1,
        mimic: (!is_own).then_some(mimic),
    }
}
