//! The chains of a mechanism, each as a serial model, at home together.

use super::chains::{Chains, chains};
use crate::geometry::{Vec3, axes, concurrency, size};
use crate::model::{JointKind, Model};
use crate::spec::{ChainSpec, Collector, Diagnostic, Diagnostics, Location, MechanismSpec};
use kin_runtime::{Chain, Pose};
use std::collections::HashSet;

/// Chains that end further apart at home, relative to their size, are not meant to be one mechanism;
/// those that end nearer are joined by the platform as it is.
const TOGETHER: f64 = 1e-4;
/// This is told.
const APART: f64 = 1e-6;

/// A mechanism at home (all joint values 0), in the coordinates of its base;
/// metres and radians.
#[derive(Clone, Debug)]
pub struct Mechanism {
    /// From the file.
    pub name: String,
    /// The link that all chains begin at.
    pub base: String,
    /// The link that all chains end at.
    pub platform: String,
    /// Two or more. Their homes are equal.
    pub legs: Vec<Leg>,
    /// Where the file introduces the chains, for diagnostics.
    pub at: Location,
}

/// One chain of a mechanism.
#[derive(Clone, Debug)]
pub struct Leg {
    /// From the file.
    pub name: String,
    /// The chain; every joint is a coordinate of its own.
    pub model: Model,
    /// Which of its joints are actuated, in order.
    pub actuated: Vec<usize>,
}

impl Mechanism {
    /// Builds the chains and holds their ends together. `base` and `platform`
    /// name links of a URDF; by default the base is the root, and the platform
    /// the only other link at which more than two chains meet, or the tree's
    /// only leaf in the loop. YAML says both itself.
    ///
    /// # Errors
    ///
    /// There are no chains between the two, a chain cannot be used, or does not
    /// end at home where the first does.
    pub fn new(
        spec: &MechanismSpec,
        base: Option<&str>,
        platform: Option<&str>,
    ) -> Result<Self, Diagnostics> {
        let Chains {
            base,
            platform,
            chains,
        } = chains(spec, base, platform)?;
        let mut legs = Vec::new();
        let mut refused: Option<Diagnostics> = None;
        for chain in &chains {
            match Model::new(&chain.spec, Some(&base), Some(&platform)) {
                Ok(model) => legs.push(Leg {
                    name: chain.name.clone(),
                    actuated: numbers(&model, &chain.actuated),
                    model,
                }),
                Err(more) => {
                    refused = Some(match refused {
                        Some(all) => all.and(more),
                        None => more,
                    });
                }
            }
        }
        if let Some(refused) = refused {
            return Err(refused);
        }
        let mut mechanism = Mechanism {
            name: spec.name.clone(),
            base,
            platform,
            legs,
            at: spec.at,
        };
        let mut diagnostics = Collector::new(&spec.source);
        mechanism.join(&chains, &mut diagnostics);
        diagnostics.unless_any(Some(mechanism))
    }

    /// Refuses chains that end elsewhere, and makes what is nearly one home the
    /// same home.
    fn join(&mut self, chains: &[ChainSpec], diagnostics: &mut Collector) {
        let sizes = self.legs.iter().map(|leg| size(&leg.model));
        let size = sizes.fold(0.0, f64::max);
        let (first, home) = (self.legs[0].name.clone(), self.legs[0].model.home);
        for (leg, chain) in self.legs.iter_mut().zip(chains).skip(1) {
            let end = leg.model.home;
            let (apart, turned) = (
                end.translation_distance(&home),
                end.rotation_distance(&home),
            );
            let ends = format!(
                "with all joint values 0 the chain `{}` ends {apart:.6} m and {:.4}° away from where \
                 `{first}` does",
                leg.name,
                turned.to_degrees()
            );
            let most = turned.max(apart / size);
            if most > TOGETHER {
                let reason = format!("{ends}: they hold no platform together");
                let remedy = "correct its geometry, or choose the zeros of its joints so that all \
                              chains are assembled there";
                diagnostics.at(chain.at, reason, remedy);
            } else if most > APART {
                let reason = format!("{ends}: it holds the platform where it ends");
                let remedy = "give axes and points with all digits, twelve behind the point";
                let told = Diagnostic::at(chain.at, &chain.spec.source, reason, remedy);
                leg.model.warnings.push(told.warning());
            }
            leg.model.home = home;
        }
    }

    /// The platform's pose at home.
    pub fn home(&self) -> Pose {
        self.legs[0].model.home
    }

    /// How many joints all chains have.
    pub fn joints(&self) -> usize {
        self.legs.iter().map(|leg| leg.model.joints.len()).sum()
    }

    /// The first joint of every chain, and one past its last.
    pub fn ranges(&self) -> Vec<[usize; 2]> {
        let mut first = 0;
        let range = |leg: &Leg| {
            let end = first + leg.model.joints.len();
            let range = [first, end];
            first = end;
            range
        };
        self.legs.iter().map(range).collect()
    }

    /// The numbers of the actuated joints among those of all chains.
    pub fn actuated(&self) -> Vec<usize> {
        let legs = self.legs.iter().zip(self.ranges());
        legs.flat_map(|(leg, [first, _])| leg.actuated.iter().map(move |j| first + j))
            .collect()
    }

    /// The generic mechanism, to check what is generated.
    pub fn generic(&self) -> kin_runtime::Mechanism {
        let chains = self.legs.iter().map(|leg| leg.chain()).collect();
        kin_runtime::Mechanism::new(chains, self.actuated())
    }
}

impl Leg {
    /// The generic chain.
    pub fn chain(&self) -> Chain {
        self.model.chain()
    }

    /// The names of its actuated joints.
    pub fn actuated_names(&self) -> Vec<String> {
        let name = |j: &usize| self.model.joints[*j].name.clone();
        self.actuated.iter().map(name).collect()
    }

    /// The chain by the letters of the field, a star behind an actuated joint:
    /// `UP*S`. Two revolutes whose axes meet are a universal joint, three a
    /// spherical one.
    pub fn structure(&self) -> String {
        let joints = &self.model.joints;
        let mut text = String::new();
        let mut i = 0;
        while i < joints.len() {
            let alike = |count: usize| {
                i + count <= joints.len()
                    && (i..i + count).all(|j| !self.actuated.contains(&j))
                    && meet(&self.model, i..i + count)
            };
            let (letter, count) = match joints[i].kind {
                JointKind::Prismatic => ("P", 1),
                JointKind::Revolute if alike(3) => ("S", 3),
                JointKind::Revolute if alike(2) => ("U", 2),
                JointKind::Revolute => ("R", 1),
            };
            text += letter;
            if self.actuated.contains(&i) {
                text += "*";
            }
            i += count;
        }
        text
    }
}

/// Whether some joints are revolute, and their axes meet in a point.
fn meet(model: &Model, joints: std::ops::Range<usize>) -> bool {
    let turn = |j: usize| model.joints[j].is_revolute();
    joints.clone().all(turn) && meeting_point(model, joints).is_some()
}

/// Where the axes of some joints meet, unless they are one line.
pub(super) fn meeting_point(model: &Model, joints: std::ops::Range<usize>) -> Option<Vec3> {
    concurrency(&axes(model)[joints], 1e-6, 1e-9 * size(model))
}

fn numbers(model: &Model, names: &[String]) -> Vec<usize> {
    let names: HashSet<&String> = names.iter().collect();
    let actuated = |j: &usize| names.contains(&model.joints[*j].name);
    (0..model.joints.len()).filter(actuated).collect()
}
