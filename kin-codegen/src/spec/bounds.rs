//! How much a robot file may hold.
//!
//! Files are read in time proportional to their length, up to a logarithm.
//! Where what is underneath takes longer (libyaml and nested brackets, XML and
//! the attributes of one element), and where a few words stand for many (the
//! aliases of YAML), there is a bound, far beyond what robots need. A file
//! beyond it is refused, and told so.

/// Brackets, lists and mappings of YAML, one inside another.
pub const YAML_DEPTH: usize = 64;

/// Values that the aliases (`*name`) of a YAML file repeat.
pub const YAML_ALIASED: usize = 100_000;

/// Attributes of one XML element.
pub const XML_ATTRIBUTES: usize = 256;

/// Prefixes (`xmlns:prefix`) that XML elements declare, those around them
/// included.
pub const XML_PREFIXES: usize = 64;

/// Characters of a name: of a robot, a link, a joint or a chain.
pub const NAME: usize = 256;

/// Chains, or joints that close loops, of one mechanism.
pub const CHAINS: usize = 64;

/// Joints of an arm, those that mimic others included: what is built of them takes time and code
/// that grow with the square of their number.
pub const JOINTS: usize = 64;

/// Characters of what a message quotes; the rest is cut, and so is the line
/// that is shown.
pub const QUOTED: usize = 300;

/// Names among which the one nearest to a misspelt one is looked for.
pub const SUGGESTED: usize = 1000;
