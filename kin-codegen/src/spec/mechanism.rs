//! What a file says of a parallel mechanism: chains from one base to one
//! platform.

use super::{Diagnostics, Location, Source, Spec, format, urdf, yaml};

/// Several chains from one base to one platform, each a robot of its own, in
/// metres and radians. Joint names are unique among all chains.
#[derive(Clone, Debug)]
pub struct MechanismSpec {
    /// The mechanism's name.
    pub name: String,
    /// The link that all chains begin at.
    pub base: String,
    /// The link that all chains end at.
    pub platform: String,
    /// In the order of the file.
    pub chains: Vec<ChainSpec>,
    /// Where all of this was read, for messages.
    pub source: Source,
    /// Where the file introduces the chains or loops.
    pub at: Location,
}

/// One chain of a mechanism.
#[derive(Clone, Debug)]
pub struct ChainSpec {
    /// Unique among the chains.
    pub name: String,
    /// Where the file introduces it.
    pub at: Location,
    /// The chain, from the mechanism's base to its platform.
    pub spec: Spec,
    /// The names of its actuated joints.
    pub actuated: Vec<String>,
}

impl MechanismSpec {
    /// Whether a file is about a mechanism rather than one arm: YAML with the
    /// key `mechanism`, or a URDF with `<loop_joint>` elements.
    pub fn is_meant(source: &Source) -> bool {
        match format::of(source) {
            Ok(format::Format::Yaml) => yaml::mechanism::is_meant(&source.text),
            Ok(format::Format::Urdf) => urdf::loops::is_meant(&source.text),
            Err(_) => false,
        }
    }

    /// Whether a file says its base and platform itself: YAML does.
    pub(crate) fn says_ends(source: &Source) -> bool {
        matches!(format::of(source), Ok(format::Format::Yaml))
    }

    /// Reads a mechanism. `base` and `platform` choose links of a URDF, whose
    /// loops the elements `<loop_joint>` close (in the dialect of Drake):
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
    /// `prismatic`, `fixed`, or `spherical` (three revolutes). Joints that a
    /// `<transmission>` names are actuated. By default the base is the root, and
    /// the platform the only other link at which more than two chains meet, or
    /// the tree's only leaf in the loop. YAML says its base and platform itself;
    /// see [`yaml::mechanism`](super::yaml::mechanism).
    ///
    /// ```
    /// use kin_codegen::spec::{MechanismSpec, Source};
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
    /// let mechanism = MechanismSpec::parse(&source, None, None)?;
    /// assert_eq!(mechanism.chains[0].actuated, ["crank"]);
    /// # Ok::<(), kin_codegen::spec::Diagnostics>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Everything that is wrong with the file, in its order. What no mechanism
    /// can have (chains that end elsewhere, no mobility) is left to
    /// [`Mechanism::new`](crate::mechanism::Mechanism::new).
    pub fn parse(
        source: &Source,
        base: Option<&str>,
        platform: Option<&str>,
    ) -> Result<MechanismSpec, Diagnostics> {
        let text = source.text.strip_prefix('\u{feff}').unwrap_or(&source.text);
        let source = Source {
            path: source.path.clone(),
            text: text.to_string(),
        };
        match format::of(&source)? {
            format::Format::Yaml => yaml::mechanism::parse(&source),
            format::Format::Urdf => urdf::loops::parse(&source, base, platform),
        }
    }
}
