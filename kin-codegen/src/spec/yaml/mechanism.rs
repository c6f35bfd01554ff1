//! Parallel mechanisms.
//!
//! Instead of joints, a file may have `mechanism`: several chains from the base
//! to one platform, which closes the loops. This is a five-bar linkage that
//! two motors on the frame drive:
//!
//! ```yaml
//! robot: five_bar
//! units: {angle: deg, length: mm}
//! mechanism:
//!   platform: pen
//!   home: {xyz: [50, 120, 0]}
//!   chains:
//!     - name: left
//!       screws:
//!         - {name: left_motor, axis: [0, 0, 1], point: [0, 0, 0], actuated: true}
//!         - {name: left_elbow, axis: [0, 0, 1], point: [-30, 70, 0]}
//!     - name: right
//!       screws:
//!         - {name: right_motor, axis: [0, 0, 1], point: [100, 0, 0], actuated: true}
//!         - {name: right_elbow, axis: [0, 0, 1], point: [130, 70, 0]}
//!         - {name: hinge, axis: [0, 0, 1], point: [50, 120, 0]}
//! ```
//!
//! | key of `mechanism` | meaning |
//! |---|---|
//! | `chains` | two or more chains; required |
//! | `platform` | the name of the link that all chains end at; `platform` by default |
//! | `home` | the [pose](super#poses) of the platform with all joint values 0; required with `screws` |
//!
//! A chain has a `name`, its joints in one of the [four conventions](super#the-four-conventions),
//! and, but with `screws`, may have a `base` and a `tip` of poses alone: where
//! its first joint's frame lies in the base link, and the platform in the last
//! joint's link. Joint names are unique in the whole file. A joint that is
//! driven has `actuated: true`; all others are passive.
//!
//! All chains are at home together: with all joint values 0 each has to end at
//! the same platform pose, to 1e-4 of the size of a chain; from 1e-6 on that is told.

use super::fields::{Fields, Reader};
use super::node::{Node, Value};
use super::units::{self, Units};
use super::{CONVENTIONS, End, frames, joint, pose};
use crate::spec::tree::{self, Draft, Name};
use crate::spec::{ChainSpec, JointType, MechanismSpec, Source, Topology, bounds};
use kin_runtime::Pose;
use std::collections::{HashMap, HashSet};

/// All keys at the top of such a file.
const KEYS: [&str; 4] = ["robot", "units", "base", "mechanism"];

/// The key that makes a document one about a mechanism.
pub(super) fn key(document: &Node) -> Option<usize> {
    let Value::Map(entries) = &document.value else {
        return None;
    };
    let is_key = |key: &&Node| matches!(&key.value, Value::Text(key) if key == "mechanism");
    let mut keys = entries.iter().map(|(key, _)| key);
    keys.find(is_key).map(|key| key.at)
}

/// Reads a mechanism in this format.
pub(super) fn read(source: &Source, document: &Node, reader: &mut Reader) -> Option<MechanismSpec> {
    reader.of_mechanism = true;
    let file = reader.fields(document, "file of a mechanism", &KEYS)?;
    let name = file
        .required("robot", reader)
        .and_then(|node| reader.name(node));
    let units = file
        .required("units", reader)
        .and_then(|node| units::read(node, reader));
    let base = match file.get("base") {
        Some(node) => reader.name(node).map(|name| name.text),
        None => Some("base".to_owned()),
    };
    let node = file.required("mechanism", reader)?;
    let keys = ["chains", "platform", "home"];
    let fields = reader.fields(node, "mechanism", &keys)?;
    let platform = match fields.get("platform") {
        Some(node) => reader.name(node),
        None => Some(Name {
            text: "platform".into(),
            at: reader.place(node.at),
        }),
    };
    let list = fields.required("chains", reader)?;
    let (units, base, platform) = (units?, base?, platform?);
    let home = match fields.get("home") {
        Some(node) => {
            let fields = reader.fields(node, "pose", &pose::KEYS)?;
            Some(pose::read(&fields, &units, reader)?)
        }
        None => None,
    };
    let ends = Ends {
        base,
        platform,
        home,
    };
    let at = reader.place(file.key("mechanism"));
    let chains = chains(list, &ends, &units, source, reader)?;
    refuse_repeated_names(&chains, reader);
    Some(MechanismSpec {
        name: name?.text,
        topology: Topology::Chains {
            base: ends.base,
            platform: ends.platform.text,
            chains,
        },
        source: source.clone(),
        warnings: Vec::new(),
        at,
    })
}

/// What all chains share.
struct Ends {
    base: String,
    platform: Name,
    home: Option<Pose>,
}

fn chains(
    list: &Node,
    ends: &Ends,
    units: &Units,
    source: &Source,
    reader: &mut Reader,
) -> Option<Vec<ChainSpec>> {
    let nodes = reader.list(list)?;
    if nodes.len() < 2 {
        let reason = match nodes.len() {
            0 => "the mechanism has no chains",
            _ => "one chain alone closes no loop: the mechanism is open",
        };
        let remedy = "list two chains or more that end at the platform; a single arm has its \
                      joints at the top of the file, without `mechanism`";
        reader.at(list.at, reason, remedy);
        return None;
    }
    if nodes.len() > bounds::CHAINS {
        let reason = format!(
            "the mechanism has {} chains, and at most {} are read",
            nodes.len(),
            bounds::CHAINS
        );
        reader.at(list.at, reason, "remove chains");
        return None;
    }
    let chains: Vec<_> = nodes
        .iter()
        .map(|node| chain(node, ends, units, source, reader))
        .collect();
    chains.into_iter().collect()
}

fn chain(
    node: &Node,
    ends: &Ends,
    units: &Units,
    source: &Source,
    reader: &mut Reader,
) -> Option<ChainSpec> {
    let keys = [&["name", "base", "tip"][..], &CONVENTIONS].concat();
    let fields = reader.fields(node, "chain", &keys)?;
    let name = fields
        .required("name", reader)
        .and_then(|node| reader.name(node));
    let (convention, list) = super::convention(&fields, reader)?;
    let base = end(&fields, "base", convention, units, reader);
    let tip = end(&fields, "tip", convention, units, reader);
    let rows = joint::rows(list, convention, units, reader);
    let (name, base, mut tip, rows) = (name?, base?, tip?, rows?);
    if convention == "screws" {
        if ends.home.is_none() {
            let reason = "`screws` say how the platform moves, not where it is: `home` is missing";
            let remedy = "add `home` to `mechanism`, the pose of the platform with all joint \
                          values 0";
            reader.at(list.at, reason, remedy);
        }
        tip = ends.home;
    }
    if rows.iter().all(|row| row.kind == JointType::Fixed) {
        let reason = format!(
            "no joint of chain `{}` moves: it holds the platform still",
            name.text
        );
        reader.at(
            list.at,
            reason,
            "give it a joint that moves, or leave the chain out",
        );
        return None;
    }
    for row in &rows {
        if let Some(mimic) = &row.mimic {
            tree::refuse_mimic(&row.name.text, mimic.joint.at, &mut reader.diagnostics);
        }
    }
    let at = name.at;
    let actuated = rows
        .iter()
        .filter(|row| row.actuated)
        .map(|row| row.name.text.clone())
        .collect();
    let base_name = Name {
        text: ends.base.clone(),
        at: reader.place(list.at),
    };
    let mut draft = Draft {
        name: name.text.clone(),
        links: vec![base_name.clone()],
        joints: Vec::new(),
        tip: None,
    };
    let base = End {
        name: Some(base_name),
        pose: base,
    };
    let tip = End {
        name: Some(Name {
            text: ends.platform.text.clone(),
            at: ends.platform.at,
        }),
        pose: tip,
    };
    frames::add(&mut draft, &base, &tip, rows, list, reader);
    let spec = tree::build(draft, source, &mut reader.diagnostics)?;
    spec.refuse_apart(&mut reader.diagnostics);
    Some(ChainSpec {
        name: name.text,
        at,
        spec,
        actuated,
    })
}

/// The pose that `base` or `tip` of a chain is.
fn end(
    fields: &Fields,
    key: &str,
    convention: &str,
    units: &Units,
    reader: &mut Reader,
) -> Option<Option<Pose>> {
    let Some(node) = fields.get(key) else {
        return Some(None);
    };
    if convention == "screws" {
        let reason = format!("`{key}` has no meaning with `screws`, which are in base coordinates");
        reader.at(fields.key(key), reason, "remove it");
        return None;
    }
    let pose = reader.fields(node, "pose", &pose::KEYS)?;
    Some(Some(pose::read(&pose, units, reader)?))
}

fn refuse_repeated_names(chains: &[ChainSpec], reader: &mut Reader) {
    let mut names: HashSet<&str> = HashSet::new();
    let mut joints: HashMap<&str, &str> = HashMap::new();
    for chain in chains {
        if !names.insert(&chain.name) {
            let reason = format!("a second chain is named `{}`", chain.name);
            let remedy = "give every chain a name of its own";
            reader.diagnostics.at(chain.at, reason, remedy);
        }
        let platform = format!("{}_fixed", chain.spec.links.last().map_or("", |l| &l.name));
        for joint in &chain.spec.joints {
            let Some(other) = joints.get(joint.name.as_str()) else {
                joints.insert(&joint.name, &chain.name);
                continue;
            };
            if joint.name != platform {
                let name = &joint.name;
                let reason = format!("a second joint is named `{name}`; the first is in `{other}`");
                let remedy = "give every joint of the mechanism a name of its own";
                reader.diagnostics.at(joint.at, reason, remedy);
            }
        }
    }
}
