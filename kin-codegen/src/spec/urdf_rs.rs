//! Robots that `urdf-rs` has read.

use super::Source;
use ::urdf_rs::{Joint, JointLimit, JointType, Robot};
use std::fmt::Write;

/// The kinematics of a robot that `urdf-rs` has read, written as a URDF again,
/// for programs that have a [`Robot`] in hand (those that use `k`, say) instead
/// of its file. Needs the feature `urdf-rs`.
///
/// ```
/// use kin_codegen::{Options, Source, generate};
///
/// let robot = urdf_rs::read_file("../robots/ur5e.urdf")?;
/// let generated = generate(&Source::from(&robot), &Options::default())?;
/// assert!(generated.code().contains("pub struct Ur5e;"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// The source has links and joints alone, a joint to a line, and is named
/// `<robot>.urdf`. Its numbers are those of the robot to the last bit. What
/// `urdf-rs` does not keep is lost:
///
/// - A joint without `<limit>` has a range and ratings of 0 in a [`Robot`]; so
///   one with all of them 0 counts as having no `<limit>`.
/// - A quaternion has become roll, pitch and yaw, with rounding.
/// - Closed loops (`<loop_joint>`) are gone: such a robot becomes an arm.
impl From<&Robot> for Source {
    fn from(robot: &Robot) -> Source {
        Source {
            path: format!("{}.urdf", robot.name),
            text: urdf(robot),
        }
    }
}

fn urdf(robot: &Robot) -> String {
    let mut xml = format!("<robot name=\"{}\">\n", escaped(&robot.name));
    for link in &robot.links {
        let _ = writeln!(xml, "  <link name=\"{}\"/>", escaped(&link.name));
    }
    for joint in &robot.joints {
        let _ = writeln!(xml, "  {}", element(joint));
    }
    xml + "</robot>\n"
}

fn element(joint: &Joint) -> String {
    let mut xml = format!(
        "<joint name=\"{}\" type=\"{}\"><parent link=\"{}\"/><child link=\"{}\"/>",
        escaped(&joint.name),
        type_of(joint),
        escaped(&joint.parent.link),
        escaped(&joint.child.link),
    );
    let (xyz, rpy) = (spaced(&joint.origin.xyz), spaced(&joint.origin.rpy));
    let _ = write!(xml, "<origin xyz=\"{xyz}\" rpy=\"{rpy}\"/>");
    let _ = write!(xml, "<axis xyz=\"{}\"/>", spaced(&joint.axis.xyz));
    if has_limit(&joint.limit) && !is_unlimited(joint) {
        let JointLimit { lower, upper, .. } = joint.limit;
        let _ = write!(xml, "<limit lower=\"{lower}\" upper=\"{upper}\"/>");
    }
    if let Some(mimic) = &joint.mimic {
        let (multiplier, offset) = (mimic.multiplier.unwrap_or(1.0), mimic.offset.unwrap_or(0.0));
        let leader = escaped(&mimic.joint);
        let _ = write!(
            xml,
            "<mimic joint=\"{leader}\" multiplier=\"{multiplier}\" offset=\"{offset}\"/>"
        );
    }
    xml + "</joint>"
}

fn type_of(joint: &Joint) -> &'static str {
    match joint.joint_type {
        JointType::Revolute if is_unlimited(joint) => "continuous",
        JointType::Revolute => "revolute",
        JointType::Continuous => "continuous",
        JointType::Prismatic => "prismatic",
        JointType::Fixed => "fixed",
        JointType::Floating => "floating",
        JointType::Planar => "planar",
        JointType::Spherical => "spherical",
    }
}

fn has_limit(limit: &JointLimit) -> bool {
    [limit.lower, limit.upper, limit.effort, limit.velocity] != [0.0; 4]
}

/// In URDF 1.2 a bound that is left out is infinite.
fn is_unlimited(joint: &Joint) -> bool {
    let JointLimit { lower, upper, .. } = joint.limit;
    joint.joint_type == JointType::Continuous
        || (lower, upper) == (f64::NEG_INFINITY, f64::INFINITY)
}

fn spaced([x, y, z]: &[f64; 3]) -> String {
    format!("{x} {y} {z}")
}

/// As the value of an attribute, blanks of all kinds included.
fn escaped(text: &str) -> String {
    let mut value = String::new();
    for c in text.chars() {
        match c {
            '&' | '<' | '>' | '"' | '\t' | '\n' | '\r' => {
                let _ = write!(value, "&#{};", u32::from(c));
            }
            _ => value.push(c),
        }
    }
    value
}
