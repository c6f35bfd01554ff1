//! What a file says of a parallel mechanism: chains from one base to one
//! platform, or a tree and the joints that close its loops.

use super::{ArmSpec, Diagnostic, Diagnostics, Location, Source, Spec};

/// A parallel mechanism, in metres and radians. Joint names are unique.
#[derive(Clone, Debug)]
pub struct MechanismSpec {
    /// The mechanism's name.
    pub name: String,
    /// How its joints connect.
    pub topology: Topology,
    /// What the file has that is odd, and changes no frame and no joint value.
    pub warnings: Vec<Diagnostic>,
    /// Where all of this was read, for messages.
    pub source: Source,
    /// Where the file introduces the chains or loops.
    pub at: Location,
}

/// How the joints of a mechanism connect.
#[derive(Clone, Debug)]
pub enum Topology {
    /// Two or more chains, from one base to one platform (YAML).
    Chains {
        /// The link that all chains begin at.
        base: String,
        /// The link that all chains end at.
        platform: String,
        /// In the order of the file.
        chains: Vec<ChainSpec>,
    },
    /// A tree and the joints that close its loops (URDF). Base and platform are
    /// links of it; [`Mechanism::new`](crate::mechanism::Mechanism::new) cuts it
    /// into chains between them.
    Looped(LoopedTree),
}

impl Topology {
    /// How a file actuates some of its joints.
    pub(crate) fn actuate(&self, joints: &str) -> String {
        match self {
            Self::Chains { .. } => format!("mark {joints} with `actuated: true`"),
            Self::Looped(_) => format!(
                "name {joints} in a transmission: <transmission name=\"...\"><joint \
                 name=\"...\"/></transmission>"
            ),
        }
    }
}

/// One chain of a mechanism.
#[derive(Clone, Debug)]
pub struct ChainSpec {
    /// Unique among the chains.
    pub name: String,
    /// Where the file introduces it.
    pub at: Location,
    /// The chain, from the mechanism's base to its platform.
    pub spec: ArmSpec,
    /// The names of its actuated joints.
    pub actuated: Vec<String>,
}

/// A tree of links, whose loops further joints close: the `<loop_joint>`
/// elements of a URDF (in the dialect of Drake):
///
/// ```xml
/// <loop_joint name="rocker_pin" type="revolute">
///   <link1 link="rocker" xyz="0 2 0" rpy="0 0 0"/>
///   <link2 link="coupler" xyz="1.5 0 0"/>
///   <axis xyz="0 0 1"/>
/// </loop_joint>
/// ```
///
/// The joint's frame lies in `link1`, with `axis` a direction in it (x by
/// default); `link2` says where the same point lies in the other link, and
/// with all joint values 0 the two coincide. `type` is `revolute`,
/// `prismatic`, `fixed`, or `spherical` (three revolutes); the first two may
/// have a `<limit>`, without which they have none. Joints that a
/// `<transmission>` names are actuated.
#[derive(Clone, Debug)]
pub struct LoopedTree {
    /// Links and joints. Behind those of the tree are the joints that close
    /// loops: their child is a link that has a parent already.
    pub links: ArmSpec,
    /// How many of the joints are the tree's.
    pub tree_joints: usize,
    /// The names of the joints that transmissions drive.
    pub actuated: Vec<String>,
}

impl MechanismSpec {
    /// Reads the file of a mechanism; the formats are described at
    /// [`LoopedTree`] and [`yaml::mechanism`](super::yaml::mechanism).
    ///
    /// ```
    /// use kin_codegen::spec::{MechanismSpec, Source, Topology};
    ///
    /// let text = "\
    /// robot: parallelogram
    /// units: {angle: deg, length: m}
    /// mechanism:
    ///   platform: coupler
    ///   home: {xyz: [0, 1, 0]}
    ///   chains:
    ///     - name: left
    ///       screws:
    ///         - {name: crank, axis: [0, 0, 1], point: [0, 0, 0], actuated: true}
    ///         - {name: pin, axis: [0, 0, 1], point: [0, 1, 0]}
    ///     - name: right
    ///       screws:
    ///         - {name: rocker, axis: [0, 0, 1], point: [2, 0, 0]}
    ///         - {name: other_pin, axis: [0, 0, 1], point: [2, 1, 0]}
    /// ";
    /// let source = Source { path: "parallelogram.yaml".into(), text: text.into() };
    /// let Topology::Chains { chains, .. } = MechanismSpec::parse(&source)?.topology else {
    ///     panic!("YAML lists its chains")
    /// };
    /// assert_eq!(chains[0].actuated, ["crank"]);
    /// # Ok::<(), kin_codegen::spec::Diagnostics>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Those of [`Spec::parse`], and the file of an arm. What no mechanism can
    /// have (chains that end elsewhere, no mobility) is left to
    /// [`Mechanism::new`](crate::mechanism::Mechanism::new).
    pub fn parse(source: &Source) -> Result<MechanismSpec, Diagnostics> {
        match Spec::parse(source)? {
            Spec::Mechanism(mechanism) => Ok(mechanism),
            Spec::Arm(_) => Err(Diagnostics::one(
                &source.path,
                Diagnostic::whole(
                    "this file describes an arm: no joint closes a loop",
                    "give the file of a mechanism: YAML with `mechanism:`, or a URDF with \
                     <loop_joint> elements",
                ),
            )),
        }
    }
}
