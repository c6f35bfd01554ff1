//! Right angles and half turns of three or four digits.

use super::chain::Chain;
use crate::spec::{ArmSpec, Collector, Joint};
use std::f64::consts::FRAC_PI_2;

/// The sine of what is missing is this near to an entry of a rotation by several angles, of that.
const NEAR: f64 = 1e-5;

/// Warns of the first joint whose frame is turned by a little less or more than is meant, it seems: a
/// joint of a calibration is off by no such number.
pub(super) fn check(spec: &ArmSpec, chain: &Chain, diagnostics: &mut Collector) {
    let mut joints = chain.joints.iter().map(|&j| &spec.joints[j]);
    let first = joints.by_ref().find_map(|it| Some((it, rounded(it)?)));
    let Some((joint, [written, meant])) = first else {
        return;
    };
    let more = joints.filter(|it| rounded(it).is_some()).count();
    let others = match more {
        0 => String::new(),
        1 => ", and so has one behind it".to_owned(),
        _ => format!(", and so have {more} behind it"),
    };
    let reason = format!(
        "joint `{}` seems to have an angle of {written}{others}: that is {:.2}° off, and the arm is the \
         one that is written",
        joint.name,
        (written - meant).abs().to_degrees()
    );
    let remedy = format!("write all digits of what is meant ({meant})");
    diagnostics.warn(joint.at, reason, remedy);
}

/// An angle of a joint's frame as it is written, and what is meant by it.
fn rounded(joint: &Joint) -> Option<[f64; 2]> {
    let frames = [joint.origin, joint.mount];
    let entries: Vec<f64> = frames.iter().flat_map(|it| it.rotation).flatten().collect();
    // Of four decimals that are rounded, as 1.5708, the arm is off by less than it is built to.
    let written = |meant: f64| {
        let [two, three, four] = [1e2, 1e3, 1e4].map(|it| (meant * it).floor() / it);
        [two, three, (meant * 1e3).round() / 1e3, four]
    };
    let meant = [1.0, 2.0, 4.0].map(|times| times * FRAC_PI_2);
    let mut angles =
        (meant.iter()).flat_map(|&meant| written(meant).map(|written| [written, meant]));
    angles.find(|[written, meant]| {
        let off = (written - meant).sin().abs();
        entries.iter().any(|x| (x.abs() - off).abs() < NEAR * off)
    })
}
