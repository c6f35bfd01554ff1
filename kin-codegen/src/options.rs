//! What a user may ask of the compiler; the same through every interface.

use crate::model::Model;
use crate::plan::Target;
use crate::scalar::Scalar;
use crate::spec::{ArmSpec, Diagnostics, did_you_mean, list_names, stem};
use std::fmt;
use std::str::FromStr;

/// Settings of one robot. The default asks for everything.
///
/// Displayed as the macro takes them, without those left at their default:
///
/// ```
/// use kin_codegen::{Ik, Options};
/// let options = Options { tip: Some("tool0".into()), ik: Ik::None, ..Default::default() };
/// assert_eq!(options.to_string(), r#"tip = "tool0", ik = none"#);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// The name of the generated type; by default the file's stem in
    /// UpperCamelCase.
    pub name: Option<String>,
    /// The link that the chain begins at: any, also one that the tip does not hang on, such as a
    /// foot; by default the root, or what stands on it by a floating or planar joint.
    pub base: Option<String>,
    /// The link that the chain ends at; by default see
    /// [`Spec`](crate::spec::Spec#the-tip).
    pub tip: Option<String>,
    /// The frame of a tool in that of the tip, x, y and z in metres, then roll, pitch and yaw in
    /// radians, as a URDF's `<origin>` has them: poses are the tool's. By default the tip's.
    pub tool: Option<[f64; 6]>,
    /// Inverse kinematics.
    pub ik: Ik,
    /// What of a target counts; by default its position for arms of up to three joints
    /// that it fixes, such as a planar 2R arm, and the whole pose for all others.
    pub target: Option<Target>,
    /// The joints, by name, whose values `ik_at` takes beside a target, where an arm has
    /// more joints than its targets have coordinates, or `swivel` for the swivel angle of an arm
    /// with a spherical shoulder and a spherical wrist; by default that angle where there is
    /// one, otherwise the joints that give the cheapest closed form that has a solution to all
    /// singular targets that are tried, of long chains first those that leave some next to the
    /// tip.
    pub free: Vec<String>,
    /// The type of numbers in generated code.
    pub scalar: Scalar,
    /// Whether warnings about the file are errors.
    pub strict: bool,
    /// The path of the crate `kinematics` in generated code, the option `crate`:
    /// `::robotics` where the dependency has another name, `::my::kinematics`
    /// where another crate hands it on, or a path that begins with `crate`. By
    /// default `::kinematics`.
    pub krate: Option<String>,
}

/// Which inverse kinematics to generate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ik {
    /// A closed form, or the roots of a polynomial in one joint; an arm that has neither is an error.
    #[default]
    ClosedForm,
    /// None: forward kinematics and Jacobians alone.
    None,
}

impl Options {
    /// The name of the generated type for a file.
    pub fn type_name(&self, path: &str) -> String {
        match &self.name {
            // A type needs no raw name: a keyword has no capital letter.
            Some(name) => name.strip_prefix("r#").unwrap_or(name).to_owned(),
            None => upper_camel_case(stem(path)),
        }
    }

    /// The chain of a robot file that they ask for, with the tool at its tip.
    ///
    /// # Errors
    ///
    /// Those of [`Model::new`]; the tool is not finite, or in other units.
    pub fn model(&self, spec: &ArmSpec) -> Result<Model, Diagnostics> {
        let (base, tip) = (self.base.as_deref(), self.tip.as_deref());
        let model = Model::new(spec, base, tip)?.with_tool(spec, self.tool)?;
        let scalar = self.scalar;
        Ok(Model { scalar, ..model })
    }
}

impl fmt::Display for Options {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let quoted = |link: &Option<String>| link.as_ref().map(|link| format!("{link:?}"));
        let ik = (self.ik != Ik::default()).then(|| self.ik.to_string());
        let target = self.target.map(|target| target.word().to_owned());
        let free = match &self.free[..] {
            [] => None,
            [joint] => Some(format!("{joint:?}")),
            joints => Some(format!("{joints:?}")),
        };
        let scalar = (self.scalar != Scalar::default()).then(|| self.scalar.to_string());
        let settings = [
            ("name", self.name.clone()),
            ("base", quoted(&self.base)),
            ("tip", quoted(&self.tip)),
            ("tool", self.tool.map(|tool| format!("{tool:?}"))),
            ("ik", ik),
            ("target", target),
            ("free", free),
            ("scalar", scalar),
            ("strict", self.strict.then(|| "true".to_owned())),
            ("crate", self.krate.clone()),
        ];
        let written: Vec<String> = settings
            .into_iter()
            .filter_map(|(option, value)| Some(format!("{option} = {}", value?)))
            .collect();
        f.write_str(&written.join(", "))
    }
}

impl Ik {
    /// The words that stand for it.
    pub const WORDS: [&'static str; 2] = ["closed_form", "none"];
}

impl fmt::Display for Ik {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Ik::ClosedForm => "closed_form",
            Ik::None => "none",
        })
    }
}

impl FromStr for Ik {
    type Err = Unknown;

    fn from_str(word: &str) -> Result<Self, Unknown> {
        match word {
            "closed_form" => Ok(Ik::ClosedForm),
            "none" => Ok(Ik::None),
            _ => Err(Unknown::new("inverse kinematics", word, &Ik::WORDS)),
        }
    }
}

impl FromStr for Scalar {
    type Err = Unknown;

    fn from_str(word: &str) -> Result<Self, Unknown> {
        match word {
            "f64" => Ok(Scalar::F64),
            "f32" => Ok(Scalar::F32),
            _ => Err(Unknown::new("scalar", word, &Scalar::WORDS)),
        }
    }
}

/// The target that a word of the options stands for.
///
/// # Errors
///
/// It stands for none.
pub fn target(word: &str) -> Result<Target, Unknown> {
    Target::from_word(word).ok_or_else(|| Unknown::new("target", word, &Target::WORDS))
}

/// A word that is none of those that can stand in its place.
///
/// ```
/// let refused = kin_codegen::target("positoin").unwrap_err();
/// assert_eq!(
///     refused.to_string(),
///     "unknown target `positoin`: did you mean `position`? There are `pose`, `position`, \
///      `position_axis`, `position_yaw`, `planar`, `direction`, `orientation`."
/// );
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unknown {
    what: &'static str,
    word: String,
    known: Vec<&'static str>,
}

impl Unknown {
    /// For a `word` where one of `known` should stand; `what` these are.
    pub fn new(what: &'static str, word: &str, known: &[&'static str]) -> Self {
        Self {
            what,
            word: word.into(),
            known: known.to_vec(),
        }
    }
}

impl fmt::Display for Unknown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let remedy = did_you_mean(&self.word, &self.known);
        write!(f, "unknown {} `{}`: {remedy}", self.what, self.word)?;
        match remedy.ends_with('?') {
            true => write!(f, " There are {}.", list_names(&self.known)),
            false => Ok(()),
        }
    }
}

impl std::error::Error for Unknown {}

/// `kr6_r900` becomes `Kr6R900`; what cannot stand in a name separates words,
/// and a leading digit gets a word in front of it.
pub(crate) fn upper_camel_case(stem: &str) -> String {
    let words = stem
        .split(|c: char| !c.is_ascii_alphanumeric())
        .filter(|word| !word.is_empty());
    let name: String = words
        .map(|word| {
            let (first, rest) = word.split_at(1);
            first.to_uppercase() + rest
        })
        .collect();
    if name.starts_with(|c: char| c.is_ascii_alphabetic()) {
        name
    } else {
        format!("Robot{name}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_come_from_the_file() {
        let name = |path: &str| Options::default().type_name(path);
        assert_eq!(name("robots/kr6_r900.yaml"), "Kr6R900");
        assert_eq!(name("ur5e.urdf"), "Ur5e");
        assert_eq!(name("C:\\arms\\my-arm.v2.urdf"), "MyArmV2");
        assert_eq!(name("my_arm.urdf.xacro"), "MyArm");
        assert_eq!(name("arm"), "Arm");
        assert_eq!(name("3r.yaml"), "Robot3r");
        assert_eq!(name("ärm.urdf"), "Rm");
    }

    #[test]
    fn options_are_written_as_the_macro_takes_them() {
        assert_eq!(Options::default().to_string(), "");
        let all = Options {
            name: Some("Arm".into()),
            base: Some("base_link".into()),
            tip: Some("tool0".into()),
            tool: Some([0.0, 0.0, 0.1, 0.0, -0.6, 0.0]),
            ik: Ik::None,
            target: Some(Target::Position),
            free: vec!["rail".into(), "elbow".into()],
            scalar: Scalar::F32,
            strict: true,
            krate: Some("::robotics".into()),
        };
        assert_eq!(
            all.to_string(),
            r#"name = Arm, base = "base_link", tip = "tool0", tool = [0.0, 0.0, 0.1, 0.0, -0.6, 0.0], ik = none, target = position, free = ["rail", "elbow"], scalar = f32, strict = true, crate = ::robotics"#
        );
    }

    #[test]
    fn words_come_back_from_their_display() {
        for word in Ik::WORDS {
            assert_eq!(word.parse::<Ik>().unwrap().to_string(), word);
        }
        for word in Scalar::WORDS {
            assert_eq!(word.parse::<Scalar>().unwrap().to_string(), word);
        }
        for word in Target::WORDS {
            assert_eq!(target(word).unwrap().word(), word);
        }
    }
}
