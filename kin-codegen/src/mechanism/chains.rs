//! The chains of a mechanism, from its base to its platform.
//!
//! Tree and loop joints of a URDF together have to be chains from the base to
//! one platform, which the options `base` and `tip` name. By default they are
//! the root, and the only other link at which more than two chains meet, or the
//! one leaf of the tree that is part of a loop. What hangs outside the loops
//! does not count. YAML lists its chains, and says both ends itself.

use crate::spec::{
    ArmSpec, ChainSpec, Collector, Diagnostic, Diagnostics, Joint, Location, LoopedTree,
    MechanismSpec, Topology, list_names,
};
use std::collections::HashSet;

/// Two or more chains from one base to one platform.
pub(super) struct Chains {
    pub base: String,
    pub platform: String,
    pub chains: Vec<ChainSpec>,
}

/// The chains of a mechanism; `base` and `platform` choose their ends.
///
/// # Errors
///
/// There are no such links, they cannot be told from each other, or the loops
/// do not run between them.
pub(super) fn chains(
    spec: &MechanismSpec,
    base: Option<&str>,
    platform: Option<&str>,
) -> Result<Chains, Diagnostics> {
    match &spec.topology {
        Topology::Chains {
            base: own_base,
            platform: own_platform,
            chains,
        } => {
            let given = [("base", base), ("tip", platform)];
            if let Some((option, _)) = given.iter().find(|(_, link)| link.is_some()) {
                return Err(meaningless(spec, option));
            }
            Ok(Chains {
                base: own_base.clone(),
                platform: own_platform.clone(),
                chains: chains.clone(),
            })
        }
        Topology::Looped(looped) => {
            let mut diagnostics = Collector::new(&spec.source);
            let chains = cut(looped, base, platform, spec.at, &mut diagnostics);
            diagnostics.unless_any(chains)
        }
    }
}

/// What is asked of a mechanism follows from it, and a YAML file says its base
/// and platform.
pub(super) fn meaningless(spec: &MechanismSpec, option: &str) -> Diagnostics {
    Diagnostics::one(
        &spec.source.path,
        Diagnostic::whole(
            format!("the option `{option}` has no meaning for this file's mechanism"),
            "leave it out: the file says where the chains begin and end, and what they can be \
             asked for follows from it",
        ),
    )
}

fn cut(
    looped: &LoopedTree,
    base: Option<&str>,
    platform: Option<&str>,
    at: Location,
    diagnostics: &mut Collector,
) -> Option<Chains> {
    let links = &looped.links;
    let graph = Graph::of(looped);
    let base = match base {
        Some(name) => links.find("base", name, diagnostics)?,
        None => {
            let tree = &links.joints[..looped.tree_joints];
            let hanging: HashSet<usize> = tree.iter().map(|joint| joint.child).collect();
            (0..links.links.len()).find(|link| !hanging.contains(link))?
        }
    };
    let platform = match platform {
        Some(name) => links.find("tip", name, diagnostics)?,
        None => graph.platform(base, at, diagnostics)?,
    };
    let paths = graph.paths(base, platform, at, diagnostics)?;
    Some(Chains {
        base: links.links[base].name.clone(),
        platform: links.links[platform].name.clone(),
        chains: paths.iter().map(|path| chain(looped, path)).collect(),
    })
}

/// Links and the joints at each.
struct Graph<'s> {
    looped: &'s LoopedTree,
    spec: &'s ArmSpec,
    /// By link; without what hangs outside the loops.
    at: Vec<Vec<usize>>,
}

/// A joint on a path, and whether it is passed from parent to child.
pub(super) type Passed = (usize, bool);

impl<'s> Graph<'s> {
    fn of(looped: &'s LoopedTree) -> Self {
        let spec = &looped.links;
        let mut at = vec![Vec::new(); spec.links.len()];
        for (j, joint) in spec.joints.iter().enumerate() {
            at[joint.parent].push(j);
            at[joint.child].push(j);
        }
        Graph { looped, spec, at }
    }

    /// Without leaves but those to keep.
    fn pruned(&self, keep: &[usize]) -> Vec<Vec<usize>> {
        let mut left: Vec<usize> = self.at.iter().map(Vec::len).collect();
        let mut cut = vec![false; self.spec.joints.len()];
        let mut leaves: Vec<usize> = (0..left.len()).collect();
        while let Some(link) = leaves.pop() {
            if left[link] != 1 || keep.contains(&link) {
                continue;
            }
            let joint = self.at[link].iter().copied().find(|&j| !cut[j]);
            let Some(joint) = joint else { continue };
            cut[joint] = true;
            let Joint { parent, child, .. } = self.spec.joints[joint];
            for end in [parent, child] {
                left[end] -= 1;
                leaves.push(end);
            }
        }
        let kept = |joints: &Vec<usize>| joints.iter().copied().filter(|&j| !cut[j]).collect();
        self.at.iter().map(kept).collect()
    }

    /// The only link but the base at which three chains meet; or where there is
    /// none, and the base has but two, the tree's only leaf in the loop.
    fn platform(&self, base: usize, at: Location, diagnostics: &mut Collector) -> Option<usize> {
        let pruned = self.pruned(&[base]);
        let meeting: Vec<usize> = (0..pruned.len())
            .filter(|l| *l != base && pruned[*l].len() > 2)
            .collect();
        // Between the joints of a loop joint of several there are links that the file does not know.
        let tree = &self.spec.joints[..self.looped.tree_joints];
        let children: HashSet<usize> = tree.iter().map(|joint| joint.child).collect();
        let parents: HashSet<usize> = tree.iter().map(|joint| joint.parent).collect();
        let leaf = |l: &usize| {
            *l != base && pruned[*l].len() == 2 && children.contains(l) && !parents.contains(l)
        };
        let leaves: Vec<usize> = (0..pruned.len()).filter(leaf).collect();
        match (&meeting[..], &leaves[..]) {
            ([only], _) | ([], [only]) => Some(*only),
            (several, leaves) => {
                let candidates = if several.is_empty() { leaves } else { several };
                let names: Vec<&str> = candidates
                    .iter()
                    .map(|l| self.spec.links[*l].name.as_str())
                    .collect();
                let reason = format!(
                    "{} links could be the platform at which the chains meet: {}",
                    names.len(),
                    list_names(&names)
                );
                diagnostics.at(at, reason, "name the one you mean (tip)");
                None
            }
        }
    }

    /// Every chain from base to platform.
    fn paths(
        &self,
        base: usize,
        platform: usize,
        at: Location,
        diagnostics: &mut Collector,
    ) -> Option<Vec<Vec<Passed>>> {
        let pruned = self.pruned(&[base, platform]);
        let name = |link: usize| &self.spec.links[link].name;
        let mut paths = Vec::new();
        let mut passed = 0;
        for &first in &pruned[base] {
            let (mut link, mut path) = (base, Vec::new());
            let mut next = first;
            loop {
                let joint = &self.spec.joints[next];
                path.push((next, joint.parent == link));
                link = if joint.parent == link {
                    joint.child
                } else {
                    joint.parent
                };
                if link == platform {
                    break;
                }
                match pruned[link][..] {
                    [a, b] if link != base => next = if a == next { b } else { a },
                    _ => {
                        let reason = format!(
                            "{} chains meet at link `{}`, which is neither base nor platform",
                            pruned[link].len(),
                            name(link)
                        );
                        let remedy = format!(
                            "choose base and tip such that every chain runs from one to the other; \
                             now they are `{}` and `{}`",
                            name(base),
                            name(platform)
                        );
                        diagnostics.at(at, reason, remedy);
                        return None;
                    }
                }
            }
            passed += path.len();
            paths.push(path);
        }
        let all: usize = pruned.iter().map(Vec::len).sum::<usize>() / 2;
        if paths.len() < 2 || passed < all {
            let reason = format!(
                "the loops do not run from `{}` to `{}`: {} of their {all} joints lie on chains \
                 between them",
                name(base),
                name(platform),
                passed
            );
            diagnostics.at(at, reason, "choose another base or tip");
            return None;
        }
        Some(paths)
    }
}

/// A path as a chain of its own; a joint passed backwards moves its parent.
fn chain(looped: &LoopedTree, path: &[Passed]) -> ChainSpec {
    let spec = &looped.links;
    let start = |(j, outwards): &Passed| {
        let joint = &spec.joints[*j];
        if *outwards { joint.parent } else { joint.child }
    };
    let end = |(j, outwards): &Passed| start(&(*j, !*outwards));
    let mut links = vec![spec.links[start(&path[0])].clone()];
    let mut joints = Vec::new();
    for (i, passed) in path.iter().enumerate() {
        links.push(spec.links[end(passed)].clone());
        let joint = &spec.joints[passed.0];
        let placed = if passed.1 {
            joint.clone()
        } else {
            joint.reversed()
        };
        joints.push(Joint {
            parent: i,
            child: i + 1,
            mimic: None,
            ..placed
        });
    }
    let names = joints.iter().map(|joint| joint.name.clone());
    let driven: HashSet<&String> = looped.actuated.iter().collect();
    let actuated = names.filter(|name| driven.contains(name)).collect();
    ChainSpec {
        name: joints[0].name.clone(),
        at: joints[0].at,
        actuated,
        spec: ArmSpec {
            name: spec.name.clone(),
            links,
            joints,
            tip: None,
            warnings: Vec::new(),
            apart: Vec::new(),
            source: spec.source.clone(),
        },
    }
}
