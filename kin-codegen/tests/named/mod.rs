//! A robot file with any name in it.

use kin_codegen::Source;

/// Two joints in a plane; robot, base and a joint have the name.
pub fn yaml(name: &str) -> Source {
    let escape = |c: char| match c {
        ' '..='~' if !matches!(c, '"' | '\\') => c.to_string(),
        _ => format!("\\U{:08x}", u32::from(c)),
    };
    let quoted: String = name.chars().map(escape).collect();
    let text = format!(
        "robot: \"{quoted}\"\nunits: {{angle: rad, length: m}}\nbase: \"{quoted}\"\nscrews:\n  \
         - {{name: \"{quoted}\", axis: [0, 0, 1], point: [0, 0, 0]}}\n  \
         - {{name: elbow, axis: [0, 0, 1], point: [0.5, 0, 0]}}\nhome: {{xyz: [0.9, 0, 0]}}\n"
    );
    Source {
        path: "arm.yaml".into(),
        text,
    }
}
