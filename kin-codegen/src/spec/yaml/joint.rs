//! What a joint has in each of the four conventions.

use super::fields::{Fields, Reader};
use super::node::{Node, Value};
use super::row::Row;
use super::units::Units;
use super::{denavit_hartenberg, frames, pose, screws};
use crate::spec::tree::{DraftMimic, Name};
use crate::spec::{JointType, Limits, Rating};
use std::collections::HashMap;

/// The keys that all joints have.
const COMMON: [&str; 7] = [
    "name", "type", "limits", "velocity", "effort", "link", "mimic",
];

/// Reads all entries of a list; `None` if one cannot be read.
pub(super) fn rows(
    list: &Node,
    convention: &str,
    units: &Units,
    reader: &mut Reader,
) -> Option<Vec<Row>> {
    let nodes = reader.list(list)?;
    if nodes.is_empty() {
        reader.at(
            list.at,
            "the list of joints is empty",
            "list at least one joint",
        );
        return None;
    }
    let rows: Vec<_> = nodes
        .iter()
        .map(|node| row(node, convention, units, reader))
        .collect();
    let mut rows = rows.into_iter().collect::<Option<Vec<Row>>>()?;
    convert_multipliers(&mut rows, units);
    Some(rows)
}

fn row(node: &Node, convention: &str, units: &Units, reader: &mut Reader) -> Option<Row> {
    let special: &[&str] = match convention {
        "screws" => &screws::KEYS,
        "joints" => &frames::KEYS,
        _ => &denavit_hartenberg::KEYS,
    };
    let drive: &[&str] = if reader.of_mechanism {
        &["actuated"]
    } else {
        &[]
    };
    let fields = reader.fields(node, "joint", &[&COMMON, drive, special].concat())?;
    let name = fields
        .required("name", reader)
        .and_then(|node| reader.name(node));
    let kind = kind(&fields, convention, reader);
    // The rest has its meaning, and its units, by the kind.
    let kind = kind?;
    refuse_motion_of_fixed(&fields, kind, reader);
    let geometry = match convention {
        "screws" => screws::read(&fields, kind, units, reader),
        "dh" => denavit_hartenberg::standard(&fields, kind, units, reader),
        "mdh" => denavit_hartenberg::modified(&fields, kind, units, reader),
        _ => frames::read(&fields, kind, units, reader),
    };
    let limits = limits(&fields, kind, units, reader);
    let rating = rating(&fields, kind, units, reader);
    let mimic = mimic(&fields, kind, units, reader);
    let actuated = match fields.get("actuated") {
        Some(node) => reader.truth(node),
        None => Some(false),
    };
    let name = name?;
    let link = match fields.get("link") {
        Some(node) => reader.name(node)?,
        None => Name {
            text: format!("{}_link", name.text),
            at: name.at,
        },
    };
    Some(Row {
        name,
        kind,
        limits: limits?,
        rating: rating?,
        link,
        mimic: mimic?,
        actuated: actuated?,
        geometry: geometry?,
    })
}

fn refuse_motion_of_fixed(fields: &Fields, kind: JointType, reader: &mut Reader) {
    for key in ["axis", "limits", "velocity", "effort", "mimic", "actuated"] {
        if kind == JointType::Fixed && fields.get(key).is_some() {
            let reason = format!("`{key}` has no meaning for a fixed joint");
            reader.at(
                fields.key(key),
                reason,
                "remove it, or make the joint revolute or prismatic",
            );
        }
    }
}

fn kind(fields: &Fields, convention: &str, reader: &mut Reader) -> Option<JointType> {
    let Some(node) = fields.get("type") else {
        return Some(JointType::Revolute);
    };
    let known: &[&str] = if convention == "joints" {
        &["revolute", "prismatic", "fixed"]
    } else {
        &["revolute", "prismatic"]
    };
    Some(match reader.word(node, known)? {
        "prismatic" => JointType::Prismatic,
        "fixed" => JointType::Fixed,
        _ => JointType::Revolute,
    })
}

fn limits(fields: &Fields, kind: JointType, units: &Units, reader: &mut Reader) -> Option<Limits> {
    let Some(node) = fields.get("limits") else {
        return Some(Limits::Unlimited);
    };
    if !matches!(node.value, Value::List(_)) {
        reader.at(
            node.at,
            "`limits` are a list of two numbers",
            "write [lower, upper], or leave `limits` out if the joint has no stops",
        );
        return None;
    }
    let [lower, upper] =
        reader.exactly(node, |reader, node| units.joint_value(kind, node, reader))?;
    Some(Limits::Range {
        lower,
        upper,
        at: reader.place(node.at),
    })
}

/// Efforts are N m and N whatever the units: nobody rates drives in N mm.
fn rating(fields: &Fields, kind: JointType, units: &Units, reader: &mut Reader) -> Option<Rating> {
    let velocity = positive(fields, "velocity", reader, |node, reader| {
        units.joint_value(kind, node, reader)
    });
    let effort = positive(fields, "effort", reader, |node, reader| {
        pose::plain(reader, node)
    });
    Some(Rating {
        velocity: velocity?,
        effort: effort?,
    })
}

/// A number above 0, if it is there; `None` after reporting why not.
fn positive(
    fields: &Fields,
    key: &str,
    reader: &mut Reader,
    read: impl Fn(&Node, &mut Reader) -> Option<f64>,
) -> Option<Option<f64>> {
    let Some(node) = fields.get(key) else {
        return Some(None);
    };
    let value = read(node, reader)?;
    if value <= 0.0 {
        reader.at(
            node.at,
            format!("this `{key}` is not above 0"),
            format!("write what the joint can do, or leave `{key}` out where that is not known"),
        );
        return None;
    }
    Some(Some(value))
}

fn mimic(
    fields: &Fields,
    kind: JointType,
    units: &Units,
    reader: &mut Reader,
) -> Option<Option<DraftMimic>> {
    let Some(node) = fields.get("mimic") else {
        return Some(None);
    };
    let fields = reader.fields(node, "mimic", &["joint", "multiplier", "offset"])?;
    let joint = fields
        .required("joint", reader)
        .and_then(|node| reader.name(node));
    let multiplier = match fields.get("multiplier") {
        Some(node) => pose::plain(reader, node),
        None => Some(1.0),
    };
    let offset = match fields.get("offset") {
        Some(node) => units.joint_value(kind, node, reader),
        None => Some(0.0),
    };
    Some(Some(DraftMimic {
        joint: joint?,
        multiplier: multiplier?,
        offset: offset?,
    }))
}

/// Multipliers between revolute and prismatic joints have the file's units.
fn convert_multipliers(rows: &mut [Row], units: &Units) {
    // Of joints with one name, which are refused later, the first.
    let named = rows
        .iter()
        .rev()
        .map(|row| (row.name.text.clone(), row.kind));
    let kinds: HashMap<String, JointType> = named.collect();
    for row in rows {
        let Some(mimic) = &mut row.mimic else {
            continue;
        };
        let leader = kinds.get(&mimic.joint.text).copied();
        if let Some(leader) = leader.filter(|leader| *leader != row.kind) {
            mimic.multiplier *= units.of_joint(row.kind) / units.of_joint(leader);
        }
    }
}
