//! No text makes the readers panic, and what they accept is sound.

use kin_codegen::model::Model;
use kin_codegen::spec::{ArmSpec, Source};
use proptest::prelude::*;
use std::path::Path;

/// Robot files of both formats, and two with the rarer words.
fn seeds() -> Vec<(String, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../robots");
    let names = [
        "ur5e.urdf",
        "ur10e.yaml",
        "irb6640.yaml",
        "kr6_r900.yaml",
        "puma560.yaml",
    ];
    let read = |name: &str| {
        (
            name.to_string(),
            std::fs::read_to_string(folder.join(name)).unwrap(),
        )
    };
    let rare = [("rare.urdf", RARE_URDF), ("rare.yaml", RARE_YAML)];
    names
        .map(read)
        .into_iter()
        .chain(rare.map(|(name, text)| (name.into(), text.into())))
        .collect()
}

const RARE_URDF: &str = r#"<robot name="r" xmlns:x="u"><link name="a"/><link name="b"><visual/></link><x:y/>
<link name="c"/><joint name="j" type="prismatic"><parent link="a"/><child link="b"/><axis xyz="1 &#49; 0"/>
<origin quat_xyzw="0 0 0 1"/><limit lower="0" upper="1"/></joint><!-- é --><joint name="k" type="revolute">
<parent link="b"/><child link="c"/><limit lower="-1" upper="1"/><mimic joint="j" multiplier="2"/></joint></robot>"#;

const RARE_YAML: &str = "robot: r\nunits: {angle: rad, length: m}\nbase: {link: é, matrix: [[1,0,0],[0,1,0],[0,0,1]]}\njoints:\n  - &j {name: a, axis: [0, 0, 1], limits: [-pi/2, (1+2)*pi]}\n  - {name: b, type: prismatic, parent: a_link, axis: [0, 1, 0], mimic: {joint: a}}\n  - *j\n";

/// Words that mean something somewhere.
const WORDS: [&str; 24] = [
    "<",
    ">",
    "\"",
    "'",
    "&",
    "/",
    "<joint",
    "</joint>",
    "<!--",
    "${pi}",
    "nan",
    "1e999",
    "-",
    ":",
    "[",
    "}",
    "\t",
    "\n",
    "é",
    "\u{0}",
    "*a",
    "&a ",
    "!t ",
    "<link name=\"a\"/>",
];

/// Reads; whatever comes out must be well-formed.
fn read(path: &str, text: String) {
    let source = Source {
        path: path.into(),
        text,
    };
    let result = ArmSpec::parse(&source).and_then(|spec| Model::new(&spec, None, None));
    match result {
        Ok(model) => check(&model),
        Err(diagnostics) => {
            assert!(diagnostics.to_string().contains("help: "));
            assert!(
                diagnostics
                    .iter()
                    .all(|d| !d.reason.is_empty() && !d.remedy.is_empty())
            );
        }
    }
}

fn check(model: &Model) {
    for joint in &model.joints {
        let length: f64 = joint.axis.iter().map(|x| x * x).sum();
        assert!((length - 1.0).abs() < 1e-9, "{:?}", joint.axis);
        assert!(joint.point.iter().all(|x| x.is_finite()));
        assert!(joint.variable < model.variables.len());
        assert!(joint.multiplier.is_finite() && joint.offset.is_finite());
    }
    assert!(model.home.translation.iter().all(|x| x.is_finite()));
    assert!(
        model
            .variables
            .iter()
            .flat_map(|v| v.limits)
            .all(|[lower, upper]| lower <= upper)
    );
}

/// The nearest character boundary at or below a fraction of the text.
fn boundary(text: &str, fraction: f64) -> usize {
    let mut at = (text.len() as f64 * fraction) as usize;
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn cut_files(seed in 0..7_usize, fraction in 0.0..1.0) {
        let (path, text) = &seeds()[seed];
        read(path, text[..boundary(text, fraction)].to_string());
    }

    #[test]
    fn files_with_a_piece_missing_or_a_word_too_many(
        seed in 0..7_usize,
        edits in prop::collection::vec((0.0..1.0, 0..12_usize, 0..WORDS.len() + 8), 1..4),
    ) {
        let (path, text) = &seeds()[seed];
        let mut text = text.clone();
        for (fraction, length, word) in edits {
            let start = boundary(&text, fraction);
            let end = boundary(&text, ((start + length) as f64 / text.len().max(1) as f64).min(1.0)).max(start);
            text.replace_range(start..end, WORDS.get(word).unwrap_or(&""));
        }
        read(path, text);
    }

    #[test]
    fn shuffled_lines(seed in 0..7_usize, swaps in prop::collection::vec((0.0..1.0, 0.0..1.0), 1..5)) {
        let (path, text) = &seeds()[seed];
        let mut lines: Vec<&str> = text.lines().collect();
        for (a, b) in swaps {
            let at = |fraction: f64| (fraction * lines.len() as f64) as usize;
            let (a, b) = (at(a), at(b));
            lines.swap(a, b);
        }
        read(path, lines.join("\n"));
    }

    #[test]
    fn any_numbers(numbers in prop::collection::vec(any::<f64>(), 9)) {
        let [x, y, z, r, p, w, a, b, c] = numbers[..] else { unreachable!() };
        read("n.urdf", format!(
            "<robot name='n'><link name='a'/><link name='b'/><joint name='j' type='continuous'><parent link='a'/>\
             <child link='b'/><origin xyz='{x:e} {y:e} {z:e}' rpy='{r:e} {p} {w}'/><axis xyz='{a:e} {b:e} {c}'/></joint></robot>"
        ));
        read("n.yaml", format!(
            "robot: n\nunits: {{angle: deg, length: mm}}\nscrews:\n  - {{name: j, axis: [{a:e}, {b:e}, {c}], point: [{x:e}, {y:e}, {z}]}}\n\
             home: {{rpy: [{r:e}, {p}, {w}]}}\n"
        ));
    }

    #[test]
    fn any_text(text in any::<String>()) {
        for path in ["a.urdf", "a.yaml", "a"] {
            read(path, text.clone());
        }
    }
}

#[test]
fn deep_nesting() {
    for depth in [100, 10_000] {
        read("deep.urdf", "<a>".repeat(depth));
        read(
            "deep.urdf",
            format!(
                "<robot>{}{}</robot>",
                "<link>".repeat(depth),
                "</link>".repeat(depth)
            ),
        );
        read("deep.yaml", "[".repeat(depth));
        read("deep.yaml", "{a: ".repeat(depth));
    }
}

/// A billion laughs.
#[test]
fn exploding_aliases() {
    let mut text = String::from("a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n");
    for i in 1..12 {
        let aliases = vec![format!("*a{}", i - 1); 10].join(", ");
        text += &format!("a{i}: &a{i} [{aliases}]\n");
    }
    read("laughs.yaml", text);
}
