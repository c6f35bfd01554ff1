//! What a user may ask of the compiler; the same behind every door.

use crate::plan::Target;

/// Settings of one robot. The default asks for everything.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// The name of the generated type; by default the file's stem in
    /// UpperCamelCase.
    pub name: Option<String>,
    /// The link that the chain begins at; by default the root.
    pub base: Option<String>,
    /// The link that the chain ends at; by default the only leaf.
    pub tip: Option<String>,
    /// Inverse kinematics.
    pub ik: Ik,
    /// What of a target counts; by default what the arm can choose.
    pub target: Option<Target>,
}

/// Which inverse kinematics to generate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ik {
    /// A closed form; an arm that has none is an error.
    #[default]
    ClosedForm,
    /// None: forward kinematics and Jacobians alone.
    None,
}

impl Options {
    /// The name of the generated type for a file.
    pub fn type_name(&self, path: &str) -> String {
        self.name
            .clone()
            .unwrap_or_else(|| upper_camel_case(stem(path)))
    }
}

fn stem(path: &str) -> &str {
    let file = path.rsplit(['/', '\\']).next().unwrap_or(path);
    file.split('.').next().unwrap_or(file)
}

/// `kr6_r900` becomes `Kr6R900`; what cannot stand in a name separates words,
/// and a leading digit gets a letter in front of it.
fn upper_camel_case(stem: &str) -> String {
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
        assert_eq!(name("C:\\arms\\my-arm.v2.urdf"), "MyArm");
        assert_eq!(name("3r.yaml"), "Robot3r");
        assert_eq!(name("ärm.urdf"), "Rm");
    }
}
