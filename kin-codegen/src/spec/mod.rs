//! Reading robot files.
//!
//! Two formats, one result: a [`Spec`], which is an arm or a parallel
//! mechanism, in metres and radians; its numbers are finite, its names unique,
//! and its joints connect. A file that leaves any of this open is refused with
//! every diagnostic that can be made in one go, each with its place and a
//! remedy. Which joints make up the arm is not decided here; see
//! [`Model`](crate::model::Model) and
//! [`Mechanism`](crate::mechanism::Mechanism).
//!
//! Reading takes time proportional to the length of a file; what a file may
//! hold is said in [`bounds`].
pub mod bounds;
mod collector;
mod diagnostic;
mod format;
mod look_alike;
mod mechanism;
mod one_line;
mod orientation;
mod places;
mod source;
mod suggest;
mod tree;
mod urdf;
#[cfg(feature = "urdf-rs")]
mod urdf_rs;
pub mod yaml;

pub(crate) use collector::Collector;
pub use diagnostic::{Diagnostic, Diagnostics, Location, Severity};
pub use mechanism::{ChainSpec, LoopedTree, MechanismSpec, Topology};
pub(crate) use one_line::escaped;
pub use one_line::{is_shown, one_line};
pub(crate) use orientation::FULL_TURN;
pub use source::Source;
pub(crate) use source::{file_name, stem};
pub(crate) use suggest::{did_you_mean, list as list_names};

use kin_runtime::Pose;

/// What a robot file describes.
///
/// # The tip
///
/// An arm's chain runs from the option `base`, by default the root, to the
/// option `tip`. Without it the joints that move decide: the chain ends with
/// the last of them, and what hangs beside it without moving (cameras,
/// collision links) does not count. Fingers are left out, with a warning: what
/// forks off behind an arm of three joints or more, in lines of no more joints than the arm has, nor
/// than four, or five where there are three lines or more; and at the end of a chain joints that
/// mimic others than those before them, slides of less than 12 cm and joints named as a gripper's, or
/// that move a link named so (one that is named `gripper` itself: by limits that open from zero to one
/// side), unless they turn the wrist that carries a jaw, turn what two jaws slide
/// on that do not mimic them, or slide by 12 cm or more. A shorter slide is the arm's where it moves a
/// link that is called as a tip is, or, in a chain of up to five joints, is parallel to the axes of
/// all that turn before it, two at least, with nothing beside it that moves, as the quill of a SCARA.
/// Of the links that the last joint moves the tip is the first that
/// is called, perhaps behind a prefix, `tool0`, `tcp`, `tcp_link`, `tool`,
/// `tool_link`, `tool_frame`, `flange`, `flange_link`, `ee_link`, `ee`,
/// `ee_frame`, `eef`, `eef_link`, `end_effector`, `end_effector_link`,
/// `grasp_link`, `grasp_frame`, `gripper_frame_link`, `gripper_frame`, `end_link`, `tool_tip`,
/// `tool_tip_link`, `gripper_center`, `gripper_center_link`, `grasp_point`, `grasping_point`,
/// `grasp_center` or `grasping_frame`;
/// without these the only leaf; otherwise the link that the joint moves or that
/// carries the fingers. A file with several arms is ambiguous, and the error
/// lists them, those of most joints first. Wheels, casters and heads make no file ambiguous: where
/// one chain has five joints or more, and every other no more than two of its own, and three in all or
/// as many as leave that one five of its own, that one is the arm, with a warning.
///
/// # Errors and warnings
///
/// What can change a frame or a joint value is an error if it is on the chain:
/// a misspelt word, junk in a number, an attribute `quat`, xacro that was not
/// expanded, doubled names, loops, links that are missing, parts that
/// contradict each other. What cannot is a warning (see
/// [`Severity`]): definitions left over from xacro, elements that only a vendor
/// knows, an identity where nothing is read, repetitions, limits 0..0, XML that
/// only the reader of ROS takes (`--` in comments, prefixes that are not
/// declared, blanks before the declaration), and whatever is wrong with joints
/// off the chain. The option `strict` makes errors of them.
#[derive(Clone, Debug)]
pub enum Spec {
    /// A tree of links, of which a chain is the arm.
    Arm(ArmSpec),
    /// Several chains to one platform.
    Mechanism(MechanismSpec),
}

/// A tree of links connected by joints.
#[derive(Clone, Debug)]
pub struct ArmSpec {
    /// The robot's name; the file's stem where the file gives none.
    pub name: String,
    /// In the order of the file.
    pub links: Vec<Link>,
    /// In the order of the file.
    pub joints: Vec<Joint>,
    /// The link that the file calls the tip, if it has a word for it.
    pub tip: Option<String>,
    /// What the file has that is odd, and changes no frame and no joint value.
    pub warnings: Vec<Diagnostic>,
    /// Why it is no one tree, if it is not: links that joints name and the file does not introduce
    /// (they are behind the others of `links`), parts that no joint connects. Between two links of
    /// one part there is a chain all the same.
    pub apart: Vec<Diagnostic>,
    /// Where all of this was read, for messages.
    pub source: Source,
}

/// A rigid body.
#[derive(Clone, Debug)]
pub struct Link {
    /// Unique among the links.
    pub name: String,
    /// Where the file introduces it.
    pub at: Location,
}

/// A connection between two links. The child's frame, in the parent's
/// coordinates, is `origin * motion(q) * mount`.
#[derive(Clone, Debug)]
pub struct Joint {
    /// Unique among the joints.
    pub name: String,
    /// How it moves.
    pub kind: JointType,
    /// Index into [`ArmSpec::links`].
    pub parent: usize,
    /// Index into [`ArmSpec::links`].
    pub child: usize,
    /// The joint's frame in the parent link.
    pub origin: Pose,
    /// Unit direction in the joint's frame, through that frame's origin;
    /// meaningless for fixed, floating and spherical joints.
    pub axis: [f64; 3],
    /// The child link's frame in the joint's moving frame: the identity except
    /// where Denavit-Hartenberg parameters and screws place it.
    pub mount: Pose,
    /// Where the joint stops.
    pub limits: Limits,
    /// The joint that this one follows.
    pub mimic: Option<Mimic>,
    /// How fast and how strong it may be.
    pub rating: Rating,
    /// What keeps the joint from being used: errors if it is part of the
    /// chain, and warnings elsewhere.
    pub faults: Vec<Diagnostic>,
    /// Where the file introduces it.
    pub at: Location,
}

impl Joint {
    /// The same joint from its child to its parent.
    pub fn reversed(&self) -> Self {
        Self {
            parent: self.child,
            child: self.parent,
            origin: self.mount.inverse(),
            axis: self.axis.map(|x| 0.0 - x),
            mount: self.origin.inverse(),
            ..self.clone()
        }
    }
}

/// How a joint moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointType {
    /// Not at all.
    Fixed,
    /// About its axis; URDF's `continuous` is one with [`Limits::Unlimited`].
    Revolute,
    /// Along its axis.
    Prismatic,
    /// In all six directions.
    Floating,
    /// In the plane normal to its axis.
    Planar,
    /// About its origin.
    Spherical,
}

/// The range of a joint value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limits {
    /// The file does not say, although its format requires it.
    Missing,
    /// The joint has no stops.
    Unlimited,
    /// As written; nothing is said about their order.
    Range {
        /// Radians or metres.
        lower: f64,
        /// Radians or metres.
        upper: f64,
        /// Where the file says so.
        at: Location,
    },
}

/// What a drive is rated for, where the file says so.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rating {
    /// rad/s or m/s.
    pub velocity: Option<f64>,
    /// N m or N.
    pub effort: Option<f64>,
}

/// The joint value is `multiplier * (value of joint) + offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mimic {
    /// Index into [`ArmSpec::joints`]; never leads back to the mimicking joint.
    pub joint: usize,
    /// In radians and metres.
    pub multiplier: f64,
    /// In radians or metres.
    pub offset: f64,
    /// Where the file says so.
    pub at: Location,
}

impl Spec {
    fn warnings_mut(&mut self) -> &mut Vec<Diagnostic> {
        match self {
            Spec::Arm(arm) => &mut arm.warnings,
            Spec::Mechanism(mechanism) => &mut mechanism.warnings,
        }
    }

    /// What the file has that is odd, and changes no frame and no joint value.
    pub fn warnings(&self) -> &[Diagnostic] {
        match self {
            Spec::Arm(arm) => &arm.warnings,
            Spec::Mechanism(mechanism) => &mechanism.warnings,
        }
    }

    /// Reads a robot file. Its content decides whether it is an arm or a
    /// mechanism: YAML with the key `mechanism`, and a URDF with
    /// `<loop_joint>` elements, are mechanisms.
    ///
    /// # Errors
    ///
    /// Everything that is wrong with the file, in its order. What only a chain
    /// cannot have (missing limits, floating joints) is left to
    /// [`Model::new`](crate::model::Model::new): it matters on the chain alone.
    pub fn parse(source: &Source) -> Result<Spec, Diagnostics> {
        let source = source.without_mark();
        match format::of(&source)? {
            format::Format::Urdf => urdf::parse(&source),
            format::Format::Yaml => yaml::parse(&source),
        }
    }
}

impl ArmSpec {
    /// Reads the file of an arm.
    ///
    /// ```
    /// use kin_codegen::spec::{ArmSpec, Source};
    ///
    /// let text = "\
    /// robot: slider
    /// units: {angle: deg, length: mm}
    /// joints:
    ///   - {name: rail, type: prismatic, axis: [1, 0, 0], limits: [0, 8OO]}
    /// ";
    /// let source = Source { path: "slider.yaml".into(), text: text.into() };
    /// let refused = ArmSpec::parse(&source).unwrap_err();
    /// assert!(refused.to_string().starts_with("slider.yaml:4:64: `8OO` is not a number"));
    ///
    /// let source = Source { text: text.replace("8OO", "800"), ..source };
    /// assert_eq!(ArmSpec::parse(&source)?.joints[0].name, "rail");
    /// # Ok::<(), kin_codegen::spec::Diagnostics>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Those of [`Spec::parse`], and the file of a mechanism.
    pub fn parse(source: &Source) -> Result<ArmSpec, Diagnostics> {
        match Spec::parse(source)? {
            Spec::Arm(arm) => Ok(arm),
            Spec::Mechanism(mechanism) => {
                let mut diagnostics = Collector::new(source);
                diagnostics.at(
                    mechanism.at,
                    "this file describes a parallel mechanism, not one arm",
                    "generate it, or `kin explain` it; whatever takes one arm cannot take it",
                );
                diagnostics.unless_any(None)
            }
        }
    }

    /// The link of this name, which an option gives for a role.
    pub(crate) fn find(
        &self,
        role: &str,
        name: &str,
        diagnostics: &mut Collector,
    ) -> Option<usize> {
        let names: Vec<&str> = self.links.iter().map(|link| link.name.as_str()).collect();
        let found = names.iter().position(|known| *known == name);
        if found.is_none() {
            let reason = format!("the {role} `{name}` is no link of this robot");
            diagnostics.whole(reason, did_you_mean(name, &names));
        }
        found
    }

    /// By link the joint that it hangs on, if any.
    pub(crate) fn above(&self) -> Vec<Option<usize>> {
        let mut above = vec![None; self.links.len()];
        for (j, joint) in self.joints.iter().enumerate() {
            above[joint.child] = Some(j);
        }
        above
    }

    /// By link the joints that hang on it.
    pub(crate) fn below(&self) -> Vec<Vec<usize>> {
        let mut below = vec![Vec::new(); self.links.len()];
        for (j, joint) in self.joints.iter().enumerate() {
            below[joint.parent].push(j);
        }
        below
    }
}
