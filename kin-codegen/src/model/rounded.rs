//! Right angles and half turns of three or four digits.

use super::chain::Chain;
use crate::spec::{ArmSpec, Collector, Joint};
use std::f64::consts::{FRAC_PI_2, PI};

/// What is written, what is meant, and that with all digits.
const ROUNDED: [(&str, f64, &str); 8] = [
    ("1.57", 1.57 - FRAC_PI_2, "1.5707963267948966"),
    ("1.571", 1.571 - FRAC_PI_2, "1.5707963267948966"),
    ("1.5707", 1.5707 - FRAC_PI_2, "1.5707963267948966"),
    ("3.14", 3.14 - PI, "3.141592653589793"),
    ("3.142", 3.142 - PI, "3.141592653589793"),
    ("3.1415", 3.1415 - PI, "3.141592653589793"),
    ("3.141", 3.141 - PI, "3.141592653589793"),
    ("6.28", 6.28 - 2.0 * PI, "6.283185307179586"),
];

/// The sine of what is missing is this near to an entry of a rotation by several angles, of that.
const NEAR: f64 = 1e-5;

/// Warns of the first joint whose frame is turned by so much less than is meant, it seems: a joint of
/// a calibration is off by no such number.
pub(super) fn check(spec: &ArmSpec, chain: &Chain, diagnostics: &mut Collector) {
    let mut joints = chain.joints.iter().map(|&j| &spec.joints[j]);
    let of = |joint: &Joint| {
        let frames = [joint.origin, joint.mount];
        let entries: Vec<f64> = frames.iter().flat_map(|it| it.rotation).flatten().collect();
        ROUNDED.iter().find(|(_, off, _)| {
            let off = off.sin().abs();
            entries.iter().any(|x| (x.abs() - off).abs() < NEAR * off)
        })
    };
    let first = joints.by_ref().find_map(|it| Some((it, of(it)?)));
    let Some((joint, (written, off, meant))) = first else {
        return;
    };
    let more = joints.filter(|it| of(it).is_some()).count();
    let others = match more {
        0 => String::new(),
        1 => ", and so has one behind it".to_owned(),
        _ => format!(", and so have {more} behind it"),
    };
    let reason = format!(
        "joint `{}` seems to have an angle of {written}{others}: that is {:.2}° off, and the arm is the \
         one that is written",
        joint.name,
        off.abs().to_degrees()
    );
    let remedy = format!("write all digits of what is meant ({meant})");
    diagnostics.warn(joint.at, reason, remedy);
}
