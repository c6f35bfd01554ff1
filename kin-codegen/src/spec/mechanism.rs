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
            Ok(format::Format::Urdf) | Err(_) => false,
        }
    }

    /// Reads a mechanism.
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
    /// let mechanism = MechanismSpec::parse(&source)?;
    /// assert_eq!(mechanism.chains[0].actuated, ["crank"]);
    /// # Ok::<(), kin_codegen::spec::Diagnostics>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Everything that is wrong with the file, in its order. What no mechanism
    /// can have (chains that end elsewhere, no mobility) is left to
    /// [`Mechanism::new`](crate::mechanism::Mechanism::new).
    pub fn parse(source: &Source) -> Result<MechanismSpec, Diagnostics> {
        let text = source.text.strip_prefix('\u{feff}').unwrap_or(&source.text);
        let source = Source {
            path: source.path.clone(),
            text: text.to_string(),
        };
        match format::of(&source)? {
            format::Format::Yaml => yaml::mechanism::parse(&source),
            format::Format::Urdf => urdf::parse(&source).and_then(|_| unreachable!()),
        }
    }
}
