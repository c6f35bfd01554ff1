//! Names of a robot file neither break the lines that `kin` shows nor steer the
//! terminal that it shows them on.

use kin_cli::check::check;
use kin_cli::explain::explain;
use kin_codegen::{Options, Source};
use std::fs;
use std::path::Path;

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

fn steers(c: char) -> bool {
    let turns = matches!(c, '\u{200f}' | '\u{202e}' | '\u{2066}' | '\u{2028}');
    turns || c.is_control() && c != '\n'
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
    [explained, check(&source, &options).to_string(), lost]
}

#[test]
fn names_neither_break_lines_nor_steer_terminals() {
    for of in [arm, mechanism] {
        let tame = shown("tame.yaml", of("tame"));
        assert!(tame[1].contains("solved"), "{}", tame[1]);
        for name in NAMES {
            let shown = shown("wi\nld\u{1b}.yaml", of(name));
            for (shown, tame) in shown.iter().zip(&tame) {
                assert!(!shown.chars().any(steers), "{shown:?}");
                assert_eq!(shown.lines().count(), tame.lines().count(), "{shown}");
            }
        }
    }
}

/// Six joints with a closed form, and a link that is fixed to one.
fn urdf(name: &str) -> String {
    let xml: String = name
        .chars()
        .map(|c| format!("&#{};", u32::from(c)))
        .collect();
    let ur5e = include_str!("../../robots/ur5e.urdf");
    ["upper_arm_link", "elbow_joint", "tool0"]
        .iter()
        .fold(ur5e.to_owned(), |text, old| {
            text.replace(&format!("\"{old}\""), &format!("\"{xml} {old}\""))
        })
        .replacen("<robot name=\"", &format!("<robot name=\"{xml} "), 1)
}

/// All strings in some JSON.
fn strings(json: &serde_json::Value, found: &mut Vec<String>) {
    match json {
        serde_json::Value::String(text) => found.push(text.clone()),
        serde_json::Value::Array(all) => all.iter().for_each(|one| strings(one, found)),
        serde_json::Value::Object(all) => all.values().for_each(|one| strings(one, found)),
        _ => {}
    }
}

/// What every command says of a file, and whether JSON has the name as it is.
fn commands(folder: &Path, file: &str, name: &str) {
    let out = folder.join("maps\u{1b}");
    let out = out.to_str().unwrap();
    let at = "0.3,-1.2,1.5,-0.7,1.1,0.4";
    for arguments in [
        &["explain"][..],
        &["explain", "--json"],
        &["explain", "--tip", "no\u{9b}ne"],
        &["check"],
        &["check", "--json"],
        &["check", "--targets", "20", "--json"],
        &["check", "--at", at],
        &["check", "--at", at, "--json"],
        &["workspace", "--cells", "3", "--samples", "4", "--out", out],
        &["generate", "--name", "Arm"],
        &["generate", "--output", "/none\u{1b}/arm.rs"],
    ] {
        let mut line = vec!["kin", arguments[0], file];
        line.extend(&arguments[1..]);
        let done = kin_cli::run(&line);
        for shown in [&done.stdout, &done.stderr] {
            assert!(!shown.chars().any(steers), "{arguments:?}: {shown:?}");
        }
        // A sweep is of an arm.
        let swept = line.contains(&"--targets") || line.contains(&"--at");
        if line.contains(&"--json") && !(swept && file.ends_with(".yaml")) {
            let json = serde_json::from_str(&done.stdout);
            let json: serde_json::Value = json.unwrap_or_else(|_| panic!("{done:?}"));
            let mut found = Vec::new();
            strings(&json, &mut found);
            let told = found.iter().any(|text| text.contains(name));
            assert!(told || arguments[0] == "check", "{arguments:?}: {found:?}");
        }
    }
}

#[test]
fn no_command_lets_a_name_out_of_its_place() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("hostile");
    let _ = fs::remove_dir_all(&folder);
    let inside = folder.join("a/b");
    fs::create_dir_all(&inside).unwrap();
    for name in ["\r\n\u{85} \u{9b}2J\u{7f}", "\u{202e}\u{2028} ../../../up/"] {
        let file = inside.join("wi\nld\u{1b}.urdf");
        fs::write(&file, urdf(name)).unwrap();
        commands(&inside, file.to_str().unwrap(), name);
        let file = inside.join("wi\nld.yaml");
        let quoted: String = name
            .chars()
            .map(|c| format!("\\U{:08x}", u32::from(c)))
            .collect();
        fs::write(&file, mechanism(&quoted)).unwrap();
        commands(&inside, file.to_str().unwrap(), name);
    }
    // Maps are where they were asked for.
    let entries = |path: &Path| fs::read_dir(path).unwrap().count();
    assert_eq!((entries(&folder), entries(&folder.join("a"))), (1, 1));
    assert!(entries(&inside.join("maps\u{1b}")) >= 12);
}
