//! No file takes more than its length: inputs that once took minutes, at sizes
//! at which a quadratic reader would again, and what is refused beyond the
//! bounds. No message echoes a megabyte.

use kin_codegen::mechanism::Mechanism;
use kin_codegen::model::Model;
use kin_codegen::spec::{Diagnostics, Source, Spec, bounds};

const HEAD: &str = "robot: r\nunits: {angle: deg, length: mm}\n";

/// Reads a file up to the chains. How many joints these have, or why not.
fn read(path: &str, text: String) -> Result<usize, Diagnostics> {
    let path = path.into();
    match Spec::parse(&Source { path, text })? {
        Spec::Arm(arm) => Model::new(&arm, None, None).map(|model| model.joints.len()),
        Spec::Mechanism(mechanism) => {
            let legs = Mechanism::new(&mechanism, None, None)?.legs;
            Ok(legs.iter().map(|leg| leg.model.joints.len()).sum())
        }
    }
}

/// The message about a file. A screen or two of it, however many mistakes
/// there are, and of each no more than a few lines are kept.
#[track_caller]
fn message(path: &str, text: String) -> String {
    let diagnostics = read(path, text).unwrap_err();
    for diagnostic in diagnostics.iter() {
        let kept = diagnostic.line.len() + diagnostic.reason.len() + diagnostic.remedy.len();
        assert!(kept < 10_000, "{diagnostic:?}");
    }
    let shown = diagnostics.to_string();
    assert!(shown.len() < 50_000, "{shown}");
    shown
}

#[track_caller]
fn refused(path: &str, text: String, reason: &str) {
    let shown = message(path, text);
    assert!(shown.contains(reason), "{shown}");
}

fn lines(n: usize, line: impl Fn(usize) -> String) -> String {
    (0..n).map(|i| line(i) + "\n").collect()
}

fn urdf(links: usize, joints: String) -> String {
    let links = lines(links, |i| format!("<link name='l{i}'/>"));
    format!("<robot name='r'>\n{links}{joints}</robot>\n")
}

fn joint(i: usize, parent: &str, rest: &str) -> String {
    format!(
        "<joint name='j{i}' type='continuous'><parent link='{parent}'/><child link='l{}'/>\
         <axis xyz='0 0 1'/>{rest}</joint>",
        i + 1
    )
}

/// A chain of `n` joints.
fn chain(n: usize, rest: impl Fn(usize) -> String) -> String {
    urdf(n + 1, lines(n, |i| joint(i, &format!("l{i}"), &rest(i))))
}

fn none(_: usize) -> String {
    String::new()
}

#[test]
fn deep_brackets() {
    let reason = "64 brackets, lists and mappings stand here one inside another";
    for bracket in ["[", "{a: ", "- ", "[{a: "] {
        refused("a.yaml", bracket.repeat(100_000), reason);
    }
    refused(
        "a.yaml",
        "? ".repeat(100_000),
        "a key marked by `?` is not read",
    );
}

#[test]
fn many_joints_in_yaml() {
    let row = |i| format!("  - {{name: j{i}, axis: [0, 0, 1], xyz: [0, 0, 1], limits: [-1, 1]}}");
    let rows = |n| format!("{HEAD}joints:\n{}", lines(n, row));
    assert_eq!(read("a.yaml", rows(10_000)).unwrap(), 10_000);
    let flow = |i| format!("{{name: j{i}, axis: [0, 0, 1]}},");
    let one_line = format!(
        "{HEAD}joints: [{}]\n",
        lines(10_000, flow).replace('\n', " ")
    );
    assert_eq!(read("a.yaml", one_line).unwrap(), 10_000);
    refused(
        "a.yaml",
        rows(10_000).replace("[-1, 1]", "[-1, x]"),
        "and 9980 more",
    );
    let doubled = |_| "  - {name: j, axis: [0, 0, 1]}".into();
    let doubled = format!("{HEAD}joints:\n{}", lines(10_000, doubled));
    refused("a.yaml", doubled, "a second joint is named `j`");
    refused(
        "a.yaml",
        HEAD.to_owned() + &lines(10_000, |i| format!("k{i}: 1")),
        "unknown key `k0`",
    );
}

#[test]
fn many_mimics() {
    let row = |i: usize| match i {
        0 => "  - {name: j0, axis: [0, 0, 1]}".into(),
        _ => format!(
            "  - {{name: j{i}, axis: [0, 0, 1], mimic: {{joint: j{}}}}}",
            i - 1
        ),
    };
    let rows = format!("{HEAD}joints:\n{}", lines(10_000, row));
    assert_eq!(read("a.yaml", rows).unwrap(), 10_000);
    let n = 20_000;
    let mimic = |leader: usize| format!("<mimic joint='j{leader}'/>");
    let forth = chain(n, |i| if i > 0 { mimic(i - 1) } else { none(i) });
    assert_eq!(read("a.urdf", forth).unwrap(), n);
    let round = chain(n, |i| mimic((i + 1) % n));
    refused("a.urdf", round, "joint `j0` mimics itself");
}

#[test]
fn long_chains_and_wide_trees() {
    assert_eq!(read("a.urdf", chain(100_000, none)).unwrap(), 100_000);
    let one_line = chain(30_000, none).replace('\n', " ");
    assert_eq!(read("a.urdf", one_line).unwrap(), 30_000);
    let star = urdf(50_001, lines(50_000, |i| joint(i, "l0", "")));
    refused("a.urdf", star, "chains of joints begin at `l0`");
    let circle = chain(50_000, none).replace("<child link='l50000'/>", "<child link='l0'/>");
    message("a.urdf", circle);
    let comments = "<!---->".repeat(50_000) + &chain(10_000, none);
    assert_eq!(read("a.urdf", comments).unwrap(), 10_000);
}

#[test]
fn many_mistakes_in_urdf() {
    let misspelt = lines(3000, |i| joint(i, &format!("m{i}"), ""));
    refused("a.urdf", urdf(3001, misspelt), "did you mean `l10`?");
    let doubled = urdf(0, "<link name='l'/>\n".repeat(50_000));
    refused(
        "a.urdf",
        doubled,
        "a second link is named `l`; the first is in line 2",
    );
    // On one line, which no diagnostic keeps.
    let nameless = urdf(0, "<link nam='l'/>".repeat(50_000));
    refused("a.urdf", nameless, "unknown attribute `nam` in <link>");
    let origins = lines(50_000, |i| format!("<origin xyz='{i} 0 0'/>"));
    let doubled = urdf(2, joint(0, "l0", &origins));
    refused("a.urdf", doubled, "a second <origin> in the same joint");
}

#[test]
fn attributes_and_prefixes() {
    let attributes: String = (0..100_000).map(|i| format!(" a{i}='1'")).collect();
    let reason = "this element has 100001 attributes, and at most 256 are read";
    refused(
        "a.urdf",
        urdf(0, format!("<link name='l'{attributes}/>")),
        reason,
    );
    let nested = lines(60_000, |i| format!("<a xmlns:n{i}='u'>"));
    let reason = "65 prefixes (`xmlns:...`) hold here, and at most 64 are read";
    refused("a.urdf", urdf(0, nested), reason);
    // Nothing else is slow about depth.
    let deep = "<a>".repeat(100_000) + &"</a>".repeat(100_000);
    assert_eq!(
        read("a.urdf", urdf(2, joint(0, "l0", "") + &deep)).unwrap(),
        1
    );
}

#[test]
fn aliases() {
    let named = |i| format!("  - {{name: &a{i} j{i}, axis: [0, 0, 1], link: *a{i}}}");
    let rows = format!("{HEAD}joints:\n{}", lines(10_000, named));
    assert_eq!(read("a.yaml", rows).unwrap(), 10_000);
    let reason = "the aliases (`*name`) of this file repeat more than 100000 values";
    let (list, aliases) = ("x, ".repeat(10_000), "*a, ".repeat(10_000));
    refused(
        "a.yaml",
        format!("{HEAD}base: &a [{list}]\ntip: [{aliases}]\n"),
        reason,
    );
    // A billion laughs.
    let mut text = String::from("a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n");
    for i in 1..12 {
        let aliases = vec![format!("*a{}", i - 1); 10].join(", ");
        text += &format!("a{i}: &a{i} [{aliases}]\n");
    }
    refused("a.yaml", text, reason);
}

#[test]
fn megabytes_in_one_place() {
    let n = 200_000;
    let name = "n".repeat(n);
    let row = |name: &str, axis: &str| {
        format!("{HEAD}joints:\n  - {{name: {name}, axis: [0, 0, {axis}]}}\n")
    };
    let reason = "this name has 200000 characters, and at most 256 are read";
    refused("a.yaml", row(&name, "1"), reason);
    for number in ["1 ", "(", "+1", "1e", "-", "é", "`"] {
        message("a.yaml", row("j", &format!("'{}'", number.repeat(n))));
    }
    message("a.yaml", row("j", "1") + &name + ": 1\n");
    message("a.yaml", row("j", "1") + "tip: " + &name + "\n");
    message("a.yaml", row("j", "1") + "tip: '" + &name);
    message("a.yaml", name.clone());
    let reason = "the name of this link has 200000 characters, and at most 256 are read";
    refused("a.urdf", urdf(1, format!("<link name='{name}'/>")), reason);
    refused(
        "a.urdf",
        format!("<robot name='{name}'><link name='l'/></robot>"),
        "the name of the robot has more than 256 characters",
    );
    let misspelt = joint(0, &name, "");
    message("a.urdf", urdf(2, misspelt));
    for rest in [
        "<origin xyz='{}'/>",
        "<origin {}='0'/>",
        "<{}/>",
        "<!--{}-->{}",
        "{}",
        "<{}",
        "<limit lower='{}'/>",
    ] {
        for word in [&name, &"1 ".repeat(n), &"&#65;".repeat(n)] {
            let text = urdf(2, joint(0, "l0", &rest.replace("{}", word)));
            if let Err(diagnostics) = read("a.urdf", text) {
                assert!(diagnostics.to_string().len() < 50_000);
            }
        }
    }
}

#[test]
fn many_chains_and_loops() {
    let chain = |i| {
        format!(
            "    - {{name: c{i}, screws: [{{name: a{i}, axis: [0, 0, 1], point: [0, 0, 0]}}, \
         {{name: b{i}, axis: [0, 0, 1], point: [0, 1, 0]}}]}}"
        )
    };
    let chains = |n| {
        format!(
            "{HEAD}mechanism:\n  home: {{xyz: [0, 1, 0]}}\n  chains:\n{}",
            lines(n, chain)
        )
    };
    assert_eq!(
        read("a.yaml", chains(bounds::CHAINS)).unwrap(),
        2 * bounds::CHAINS
    );
    let reason = "the mechanism has 65 chains, and at most 64 are read";
    refused("a.yaml", chains(bounds::CHAINS + 1), reason);

    let closed = |n: usize, loops: usize| {
        let tree = lines(n, |i| joint(i, &format!("l{i}"), ""));
        let driven = lines(n, |i| {
            format!("<transmission><joint name='j{i}'/></transmission>")
        });
        let loops = lines(loops, |i| {
            format!(
                "<loop_joint name='k{i}' type='revolute'><link1 link='l0'/><link2 link='l{n}'/></loop_joint>"
            )
        });
        urdf(n + 1, tree + &driven + &loops)
    };
    assert_eq!(read("a.urdf", closed(10_000, 1)).unwrap(), 10_001);
    let reason = "the robot has 10000 loop joints, and at most 64 are read";
    refused("a.urdf", closed(2, 10_000), reason);
}
