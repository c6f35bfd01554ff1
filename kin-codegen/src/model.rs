//! The chain between base and tip: unit twists at the home configuration, the
//! home pose, limits and names (MLS section 3.2).

use kin_runtime::Pose;

/// A serial chain at its home configuration (all joint values 0), in the
/// coordinates of the base link; metres and radians.
#[derive(Clone, Debug)]
pub struct Model {
    /// The robot's name, from the file.
    pub name: String,
    /// Base link.
    pub base: String,
    /// Tip link.
    pub tip: String,
    /// The moving joints from base to tip. Fixed joints are folded.
    pub joints: Vec<Joint>,
    /// One per coordinate of the configuration q, in the order of the chain.
    /// Shorter than `joints` when some joints mimic others.
    pub variables: Vec<Variable>,
    /// g_st(0).
    pub home: Pose,
}

/// A moving joint.
#[derive(Clone, Debug)]
pub struct Joint {
    /// From the file.
    pub name: String,
    /// Revolute or prismatic; continuous joints are revolute without limits.
    pub kind: JointKind,
    /// Unit direction of the axis at home, base coordinates.
    pub axis: [f64; 3],
    /// A point on the axis: where the file puts the joint's frame; base
    /// coordinates.
    pub point: [f64; 3],
    /// The frame of the joint's child link at home, base coordinates.
    pub frame: Pose,
    /// Which coordinate of q moves this joint.
    pub variable: usize,
    /// The joint's value is `multiplier * q[variable] + offset`; 1 and 0
    /// unless it mimics another joint.
    pub multiplier: f64,
    /// See `multiplier`.
    pub offset: f64,
}

/// How a joint moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointKind {
    /// Turns about its axis; radians.
    Revolute,
    /// Slides along its axis; metres.
    Prismatic,
}

/// A coordinate of the configuration.
#[derive(Clone, Debug)]
pub struct Variable {
    /// The name of the joint that it is.
    pub name: String,
    /// Lower and upper bound in radians or metres; `None` for a continuous
    /// joint.
    pub limits: Option<[f64; 2]>,
}
