//! The YAML robot format.
//!
//! A file gives a robot's name, its units, and its joints in one of four conventions.
//! This is a UR-like shoulder by Denavit-Hartenberg parameters:
//!
//! ```yaml
//! robot: shoulder
//! units: {angle: deg, length: mm}
//! dh:
//!   - {name: pan,  theta: 0, d: 180.7, a: 0,      alpha: 90, limits: [-360, 360]}
//!   - {name: lift, theta: 0, d: 0,     a: -612.7, alpha: 0,  limits: [-360, 360]}
//! tip: {link: flange, xyz: [0, 0, 50]}
//! ```
//!
//! Every key is checked: one that is unknown, missing, doubled or out of place
//! is refused with its line and column.
//!
//! # The file
//!
//! | key | meaning |
//! |---|---|
//! | `robot` | the robot's name; required |
//! | `units` | `{angle: rad or deg, length: m or mm}`; both required. They hold for every angle and length in the file, limits included |
//! | `screws`, `dh`, `mdh` or `joints` | the joints, from base to tip; exactly one of the four is required |
//! | `home` | a [pose](#poses); required with `screws`, and only there |
//! | `base` | the base link: its name, or a mapping with `link` and the [pose](#poses), in that link, of the frame in which the first joint is given. Without it the link is named `base` |
//! | `tip` | the tip link: its name, or a mapping with `link` and the [pose](#poses) of the tip in the last joint's link. With `screws` only the name can be given, since `home` is the pose; without it the link is named `tip`. Elsewhere, without it, the last joint's link is the tip |
//!
//! # What all joints have
//!
//! | key | meaning |
//! |---|---|
//! | `name` | required, unique |
//! | `type` | `revolute` (the default) or `prismatic`; in `joints` also `fixed` |
//! | `limits` | `[lower, upper]`; a joint without them has no stops |
//! | `velocity` | how fast the joint may move, per second; positive |
//! | `effort` | what its drive may exert; positive. N m, and N of prismatic joints, whatever `units` says |
//! | `link` | the name of the link that the joint moves; `<name>_link` by default |
//! | `mimic` | `{joint: name, multiplier: 1, offset: 0}`: this joint's value is `multiplier` times the other's plus `offset`, in the units of the file |
//!
//! # The four conventions
//!
//! **`screws`**: the axes of the joints with all joint values 0, in the base
//! frame (product of exponentials). `axis` is a direction of any length;
//! `point` is any point on the axis, required for revolute joints and without
//! effect for prismatic ones. `home` is the pose of the tip with all joint
//! values 0. The frame of every link coincides with the base frame at home, so
//! the motion of link i is the product of the first i exponentials.
//!
//! **`dh`**: standard Denavit-Hartenberg parameters. Frame i in frame i-1 is
//! Rz(theta) Tz(d) Tx(a) Rx(alpha), and joint i moves along or about the z axis
//! of frame i-1. `theta`, `d`, `a`, `alpha` are required, but for the parameter
//! that varies (`theta` of a revolute joint, `d` of a prismatic one), which is
//! the value at home and 0 by default.
//!
//! **`mdh`**: modified Denavit-Hartenberg parameters (Craig). Frame i in frame
//! i-1 is Rx(alpha) Tx(a) Rz(theta) Tz(d), where `alpha` and `a` are those of
//! the book's link i-1, written in row i; joint i moves along or about the z
//! axis of frame i. Required as in `dh`.
//!
//! **`joints`**: frames relative to the parent link, as in URDF. A joint has a
//! [pose](#poses), and an `axis` in the frame that this pose makes (required
//! unless `fixed`). `parent` names the link it hangs on: by default that of the
//! joint listed before it, or the base. With `parent` the robot can be a tree.
//!
//! # Parallel mechanisms
//!
//! Several chains between a base and a platform: see [`mechanism`].
//!
//! # Poses
//!
//! `xyz: [x, y, z]` and at most one of `rpy: [roll, pitch, yaw]` (fixed axes x,
//! y, z in this order, as in URDF), `quat_xyzw: [x, y, z, w]`, and `matrix`,
//! the rotation as three rows. What is left out is zero.
//!
//! # Numbers
//!
//! A number may be an expression of numbers and `pi` with `+ - * /` and
//! parentheses: `pi/2`, `-3*pi/4`. Angles in degrees may not contain `pi`.
//!
//! # What of YAML is read
//!
//! Words, numbers, texts in quotes, lists, mappings, anchors (`&name`) and
//! aliases (`*name`). Blocks of text (`|`, `>`), keys marked by `?` and tags
//! (`!word`) are refused, and so is a file beyond the [bounds](super::bounds).
mod denavit_hartenberg;
mod expression;
mod fields;
mod frames;
mod joint;
pub mod mechanism;
mod node;
mod pose;
mod row;
mod screws;
mod tokens;
mod units;

use super::tree::{self, Draft, DraftJoint, Name};
use super::{
    ArmSpec, Collector, Diagnostics, JointType, Limits, Rating, Source, Spec, did_you_mean,
};
use fields::{Fields, Reader};
use kin_runtime::Pose;
use node::{Node, Value};
use units::Units;

/// The four conventions to give a chain.
const CONVENTIONS: [&str; 4] = ["screws", "dh", "mdh", "joints"];

/// All keys at the top of a file.
const KEYS: [&str; 9] = [
    "robot", "units", "base", "tip", "home", "screws", "dh", "mdh", "joints",
];

/// Reads a robot in this format.
pub(super) fn parse(source: &Source) -> Result<Spec, Diagnostics> {
    let mut reader = Reader::new(source);
    let spec = match node::parse(&source.text) {
        Ok(document) => match mechanism::key(&document) {
            Some(_) => mechanism::read(source, &document, &mut reader).map(Spec::Mechanism),
            None => read(source, &document, &mut reader).map(Spec::Arm),
        },
        Err(broken) => {
            reader.explain(broken);
            None
        }
    };
    reader.diagnostics.unless_any(spec)
}

fn read(source: &Source, document: &Node, reader: &mut Reader) -> Option<ArmSpec> {
    let draft = draft(document, reader)?;
    tree::build(draft, source, &mut reader.diagnostics)
}

fn draft(document: &Node, reader: &mut Reader) -> Option<Draft> {
    let file = reader.fields(document, "robot file", &KEYS)?;
    let name = file
        .required("robot", reader)
        .and_then(|node| reader.name(node));
    let units = file
        .required("units", reader)
        .and_then(|node| units::read(node, reader));
    let convention = convention(&file, reader);
    // Without units no length or angle has a meaning.
    let (units, (convention, list)) = (units?, convention?);
    let base = End::read(&file, "base", &units, reader);
    let tip = tip(&file, convention, &units, reader);
    let rows = joint::rows(list, convention, &units, reader);
    let (base, tip, rows) = (base?, tip?, rows?);
    let mut draft = Draft {
        name: name?.text,
        links: Vec::new(),
        joints: Vec::new(),
        tip: None,
    };
    draft.links.push(base.link("base", list, reader));
    frames::add(&mut draft, &base, &tip, rows, list, reader);
    Some(draft)
}

/// Which of the four conventions the file uses, and its list.
fn convention<'n>(file: &Fields<'n>, reader: &mut Reader) -> Option<(&'static str, &'n Node)> {
    let mut given = CONVENTIONS
        .iter()
        .filter_map(|&convention| Some((convention, file.get(convention)?)));
    let Some(first) = given.next() else {
        reader.at(
            file.at,
            "the robot has no joints",
            "list them under one of `screws`, `dh`, `mdh`, `joints`",
        );
        return None;
    };
    for (convention, _) in given {
        let reason = format!(
            "the joints are given twice, by `{}` and by `{convention}`",
            first.0
        );
        reader.at(file.key(convention), reason, "keep one of the two");
    }
    Some(first)
}

/// The tip, whose pose `home` gives with screws, and `tip` otherwise.
fn tip(file: &Fields, convention: &str, units: &Units, reader: &mut Reader) -> Option<End> {
    let tip = End::read(file, "tip", units, reader);
    let home = home(file, convention, units, reader);
    let tip = tip?;
    if convention != "screws" {
        return Some(tip);
    }
    if tip.pose.is_some() {
        let reason = "the pose of the tip is given twice, by `home` and by `tip`";
        reader.at(
            file.key("tip"),
            reason,
            "write the tip's name only: `tip: name`",
        );
    }
    Some(End {
        pose: Some(home?),
        ..tip
    })
}

fn home(file: &Fields, convention: &str, units: &Units, reader: &mut Reader) -> Option<Pose> {
    match (file.get("home"), convention) {
        (Some(node), "screws") => {
            let fields = reader.fields(node, "pose", &pose::KEYS)?;
            pose::read(&fields, units, reader)
        }
        (None, "screws") => {
            let reason = "`screws` say how the tip moves, not where it is: `home` is missing";
            reader.at(
                file.at,
                reason,
                "add `home`, the pose of the tip with all joint values 0",
            );
            None
        }
        (Some(_), _) => {
            let reason = format!(
                "`home` has no meaning with `{convention}`, which gives the pose of the tip already"
            );
            reader.at(
                file.key("home"),
                reason,
                "remove it, or place the tip with `tip`",
            );
            None
        }
        (None, _) => None,
    }
}

/// One end of the chain: what `base` or `tip` say.
#[derive(Default)]
struct End {
    name: Option<Name>,
    pose: Option<Pose>,
}

impl End {
    fn read(file: &Fields, key: &str, units: &Units, reader: &mut Reader) -> Option<End> {
        let Some(node) = file.get(key) else {
            return Some(End::default());
        };
        if let Value::List(_) = node.value {
            let reason = format!("`{key}` is a list, where a link's name or a pose belongs");
            reader.at(node.at, reason, format!("write {key}: {{xyz: [x, y, z]}}"));
            return None;
        }
        if !matches!(node.value, Value::Map(_)) {
            return Some(End {
                name: Some(reader.name(node)?),
                pose: None,
            });
        }
        let fields = reader.fields(node, key, &[&["link"], &pose::KEYS[..]].concat())?;
        let pose = pose::read(&fields, units, reader);
        let name = match fields.get("link") {
            Some(link) => Some(reader.name(link)?),
            None => None,
        };
        let has_pose = pose::KEYS.iter().any(|key| fields.get(key).is_some());
        let pose = pose?;
        Some(End {
            name,
            pose: has_pose.then_some(pose),
        })
    }

    fn link(&self, default: &str, list: &Node, reader: &Reader) -> Name {
        self.name.clone().unwrap_or_else(|| Name {
            text: default.into(),
            at: reader.place(list.at),
        })
    }

    fn pose(&self) -> Pose {
        self.pose.unwrap_or(Pose::IDENTITY)
    }
}

/// The tip, fixed to a link.
fn fix_tip(draft: &mut Draft, tip: Name, parent: Name, origin: Pose) {
    draft.joints.push(DraftJoint {
        name: Name {
            text: format!("{}_fixed", tip.text),
            at: tip.at,
        },
        kind: JointType::Fixed,
        parent,
        child: tip.clone(),
        origin,
        axis: [0.0, 0.0, 1.0],
        mount: Pose::IDENTITY,
        limits: Limits::Unlimited,
        mimic: None,
        rating: Rating::default(),
        faults: Vec::new(),
    });
    draft.tip = Some(tip.text.clone());
    draft.links.push(tip);
}
