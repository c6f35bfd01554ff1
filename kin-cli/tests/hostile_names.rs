//! Names of a robot file neither break the lines that `kin` shows nor steer the
//! terminal that it shows them on.

use kin_cli::check::check;
use kin_cli::explain::explain;
use kin_codegen::{Options, Source};

/// As in a YAML file.
const NAMES: [&str; 4] = [
    r"world\npub fn pwned() {}\n//",
    r"\e[2J\e]0;title\a",
    r"turned \u202e\u2066 round\u200f",
    r"\x7f\x9b31m\r\0\t\u2028",
];

fn arm(name: &str) -> String {
    format!(
        "robot: \"{name}\"\nunits: {{angle: rad, length: m}}\nbase: \"{name}\"\nscrews:\n  \
         - {{name: \"{name}\", axis: [0, 0, 1], point: [0, 0, 0]}}\n  \
         - {{name: elbow, axis: [0, 0, 1], point: [0.5, 0, 0]}}\nhome: {{xyz: [0.9, 0, 0]}}\n"
    )
}

fn mechanism(name: &str) -> String {
    let five_bar = include_str!("../../robots/five_bar.yaml");
    let named = ["five_bar", "frame", "tool", "hinge", "right\n"];
    named.iter().fold(five_bar.to_owned(), |text, old| {
        let word = old.trim_end();
        let quoted = format!(": \"{name} {word}\"{}", &old[word.len()..]);
        text.replace(&format!(": {old}"), &quoted)
    })
}

fn shown(path: &str, text: String) -> [String; 3] {
    let path = path.into();
    let source = Source { path, text };
    let options = Options::default();
    let explained = match explain(&source, &options) {
        Ok(explanation) => explanation.to_string(),
        Err(error) => error.to_string(),
    };
    let tip = Some("none\n\u{1b}[2J".into());
    let lost = explain(
        &source,
        &Options {
            tip,
            ..options.clone()
        },
    );
    let lost = lost.map_or_else(|error| error.to_string(), |told| told.to_string());
    [explained, check(&source, &options, 0).to_string(), lost]
}

#[test]
fn names_neither_break_lines_nor_steer_terminals() {
    for of in [arm, mechanism] {
        let tame = shown("tame.yaml", of("tame"));
        assert!(tame[1].contains("solved"), "{}", tame[1]);
        for name in NAMES {
            let shown = shown("wi\nld\u{1b}.yaml", of(name));
            for (shown, tame) in shown.iter().zip(&tame) {
                let steers = |c: char| {
                    let turns = matches!(c, '\u{200f}' | '\u{202e}' | '\u{2066}' | '\u{2028}');
                    turns || c.is_control() && c != '\n'
                };
                assert!(!shown.chars().any(steers), "{shown:?}");
                assert_eq!(shown.lines().count(), tame.lines().count(), "{shown}");
            }
        }
    }
}
