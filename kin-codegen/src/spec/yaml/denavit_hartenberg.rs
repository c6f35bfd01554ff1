//! Joints by Denavit-Hartenberg parameters, standard and modified.

use super::fields::{Fields, Reader};
use super::row::Geometry;
use super::units::Units;
use crate::spec::JointType;
use crate::spec::orientation::{about_x, about_z, shift};
use kin_runtime::Pose;

/// The keys of a row beside the common ones.
pub(super) const KEYS: [&str; 4] = ["theta", "d", "a", "alpha"];

/// Joints turn about, and slide along, the z axes.
const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// A row with angles in radians and lengths in metres.
struct Parameters {
    theta: f64,
    d: f64,
    a: f64,
    alpha: f64,
}

/// The joint comes first: frame i is Rz(theta) Tz(d) Tx(a) Rx(alpha) after it.
pub(super) fn standard(
    fields: &Fields,
    kind: JointType,
    units: &Units,
    reader: &mut Reader,
) -> Option<Geometry> {
    let Parameters { theta, d, a, alpha } = parameters(fields, kind, units, reader)?;
    let mount = about_z(theta) * shift([a, 0.0, d]) * about_x(alpha);
    Some(Geometry {
        parent: None,
        origin: Pose::IDENTITY,
        axis: Z,
        mount,
    })
}

/// The joint comes last: it moves along the z axis of
/// Rx(alpha) Tx(a) Rz(theta) Tz(d).
pub(super) fn modified(
    fields: &Fields,
    kind: JointType,
    units: &Units,
    reader: &mut Reader,
) -> Option<Geometry> {
    let Parameters { theta, d, a, alpha } = parameters(fields, kind, units, reader)?;
    let origin = about_x(alpha) * shift([a, 0.0, d]) * about_z(theta);
    Some(Geometry {
        parent: None,
        origin,
        axis: Z,
        mount: Pose::IDENTITY,
    })
}

fn parameters(
    fields: &Fields,
    kind: JointType,
    units: &Units,
    reader: &mut Reader,
) -> Option<Parameters> {
    let mut read = |key: &str, varies: bool, angle: bool| match fields.get(key) {
        None if varies => Some(0.0),
        None => fields.required(key, reader).map(|_| 0.0),
        Some(node) if angle => units.placing_angle(node, reader),
        Some(node) => units.length(node, reader),
    };
    let slides = kind == JointType::Prismatic;
    let theta = read("theta", !slides, true);
    let d = read("d", slides, false);
    let (a, alpha) = (read("a", false, false), read("alpha", false, true));
    Some(Parameters {
        theta: theta?,
        d: d?,
        a: a?,
        alpha: alpha?,
    })
}
