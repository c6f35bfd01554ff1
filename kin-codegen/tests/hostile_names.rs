//! Names in a robot file are data: none gets out of the comment, the
//! documentation or the literal that it stands in.

mod named;

use kin_codegen::{Error, Generated, Ik, Options, Source, generate};
use named::yaml;
use proc_macro2::{Group, Literal, TokenStream, TokenTree};
use proptest::prelude::*;
use quote::ToTokens;
use std::sync::LazyLock;
use syn::LitStr;

const NAMES: [&str; 7] = [
    "ends\nthe line; fn evil() {}",
    "ends\r\nit; too",
    "`code` ``span``",
    "a | table | cell",
    "```",
    "\"quoted\\\" */ //",
    "back \u{202e} wards",
];

fn generated(name: &str, options: Options) -> Generated {
    let quoted = format!("{name:?}")
        .replace("\\'", "'")
        .replace("\\u{202e}", "\\u202e");
    let [link, tip] = ["link", "tip"].map(|role| quoted.replacen('"', &format!("\"{role} "), 1));
    let text = format!(
        "robot: {quoted}\nunits: {{angle: rad, length: m}}\nbase: {quoted}\ntip: {tip}\nscrews:\n  \
         - {{name: {quoted}, link: {link}, axis: [0, 0, 1], point: [0, 0, 0]}}\n  \
         - {{name: elbow, axis: [0, 0, 1], point: [0.5, 0, 0]}}\nhome: {{xyz: [0.9, 0, 0]}}\n"
    );
    let path = format!("{name}.yaml");
    let options = Options {
        name: Some("Arm".into()),
        ..options
    };
    generate(&Source { path, text }, &options).unwrap()
}

fn count(tokens: TokenStream) -> usize {
    let trees = tokens.into_iter().map(|tree| match tree {
        TokenTree::Group(group) => 1 + count(group.stream()),
        _ => 1,
    });
    trees.sum()
}

#[test]
fn names_stay_where_they_are() {
    let expected = count(generated("harmless", Options::default()).tokens);
    for name in NAMES {
        let generated = generated(name, Options::default());
        let code = generated.code();
        assert_eq!(count(generated.tokens), expected, "{code}");
        let items = syn::parse_file(&code).unwrap().items;
        assert_eq!(items.len(), 2, "{code}");
        // One example, which ends where it ends.
        let fences = code
            .lines()
            .filter(|line| line.trim_start().starts_with("/// ```"))
            .count();
        assert_eq!(fences, 2, "{code}");
        assert!(!code.contains('\u{202e}'), "{code}");
    }
}

#[test]
fn names_do_not_become_options() {
    let options = Options {
        ik: Ik::None,
        ..Options::default()
    };
    for name in NAMES {
        let code = generated(name, options.clone()).code();
        let last = code.lines().rfind(|line| line.starts_with("// ")).unwrap();
        assert!(last.ends_with(" --name Arm --ik none"), "{last}");
    }
}

fn hostile_name() -> impl Strategy<Value = String> {
    let part = prop_oneof![
        any::<char>().prop_map(String::from),
        "[a-z_]{1,8}",
        prop::sample::select(vec![
            "\n",
            "\r",
            "\t",
            "\0",
            "\u{1b}[2J",
            "\u{85}",
            "\u{2028}",
            "\u{202e}",
            "\u{200f}",
            "\"",
            "\\",
            "'",
            "`",
            "```",
            "*/",
            "//",
            "\"#",
            "#\"",
            "{",
            "}",
            "{}",
            "|",
            "<script>",
            "[x](javascript:0)",
            "]]>",
            "&",
            "-->",
            "#![no_std]",
            "\n```\npanic!()\n",
        ])
        .prop_map(String::from),
    ];
    prop::collection::vec(part, 1..8).prop_map(|parts| parts.concat())
}

/// Characters that XML can hold, even as references.
fn in_xml(name: &str) -> String {
    let holds = |c: &char| !c.is_control() || matches!(c, '\n' | '\r' | '\t' | '\u{7f}'..);
    let holds = |c: &char| holds(c) && !matches!(c, '\u{fffe}' | '\u{ffff}');
    let held: String = name.chars().filter(holds).collect();
    match held.trim().is_empty() {
        true => "x".into(),
        false => held,
    }
}

fn urdf(name: &str) -> Source {
    let escape = |c: char| format!("&#{};", u32::from(c));
    let name: String = name.chars().map(escape).collect();
    let text = format!(
        "<robot name=\"{name}\"><link name=\"{name}\"/><link name=\"upper\"/><link name=\"tip\"/>\
         <joint name=\"{name}\" type=\"continuous\"><parent link=\"{name}\"/>\
         <child link=\"upper\"/><axis xyz=\"0 0 1\"/></joint>\
         <joint name=\"elbow\" type=\"continuous\"><parent link=\"upper\"/><child link=\"tip\"/>\
         <origin xyz=\"0.5 0 0\"/><axis xyz=\"0 0 1\"/></joint></robot>"
    );
    let path = "arm.urdf".into();
    Source { path, text }
}

/// Two cranks that hold a platform: of everything that has a name, the name.
fn mechanism(name: &str) -> Source {
    let quoted: String = name
        .chars()
        .map(|c| format!("\\U{:08x}", u32::from(c)))
        .collect();
    let screw = |joint: &str, point: &str| {
        format!("        - {{name: \"{quoted} {joint}\", axis: [0, 0, 1], point: [{point}]}}\n")
    };
    let text = format!(
        "robot: \"{quoted}\"\nunits: {{angle: rad, length: m}}\nbase: \"{quoted}\"\nmechanism:\n  \
         platform: \"{quoted} platform\"\n  home: {{xyz: [1, 1, 0]}}\n  chains:\n    \
         - name: \"{quoted} left\"\n      screws:\n{}{}    - name: \"{quoted} right\"\n      screws:\n{}{}",
        screw("crank", "0, 0, 0").replace("axis", "actuated: true, axis"),
        screw("pin", "0, 1, 0"),
        screw("rocker", "2, 0, 0"),
        screw("other pin", "2, 1, 0"),
    );
    let path = "mechanism.yaml".into();
    Source { path, text }
}

/// The items in print and as tokens, without the text of literals and
/// documentation, and how many literals hold the name.
fn items(source: &Source, ik: Ik, name: &str) -> (String, usize) {
    let options = Options {
        ik,
        ..Options::default()
    };
    let generated = generate(source, &options).unwrap();
    let code = generated.code();
    assert!(!code.chars().any(|c| c.is_control() && c != '\n'), "{code}");
    let mut held = 0;
    let tokens = |text: TokenStream| without_text(text, name, &mut held);
    let printed = syn::parse_file(&code).unwrap().into_token_stream();
    let printed = [printed, generated.tokens].map(tokens);
    (printed.map(|tokens| tokens.to_string()).join("\n"), held)
}

fn without_text(tokens: TokenStream, name: &str, held: &mut usize) -> TokenStream {
    let tree = |tree| match tree {
        TokenTree::Group(group) => {
            let inner = without_text(group.stream(), name, held);
            TokenTree::Group(Group::new(group.delimiter(), inner))
        }
        TokenTree::Literal(literal) => match syn::parse_str::<LitStr>(&literal.to_string()) {
            Ok(text) => {
                *held += usize::from(text.value() == name);
                TokenTree::Literal(Literal::string(""))
            }
            Err(_) => TokenTree::Literal(literal),
        },
        other => other,
    };
    let mut trees: Vec<TokenTree> = tokens.into_iter().map(tree).collect();
    // Where lines are broken, a comma may end them.
    let is_comma = |tree: &TokenTree| matches!(tree, TokenTree::Punct(p) if p.as_char() == ',');
    trees.pop_if(|tree| is_comma(tree));
    trees.into_iter().collect()
}

type Named = (fn(&str) -> Source, Ik, usize);

/// Files by their names, and how many literals hold the name.
const SOURCES: [Named; 4] = [
    (yaml, Ik::None, 4),
    (yaml, Ik::ClosedForm, 4),
    (urdf, Ik::ClosedForm, 4),
    (mechanism, Ik::ClosedForm, 2),
];

static TAME: LazyLock<Vec<(String, usize)>> = LazyLock::new(|| {
    let tame = |(source, ik, _): Named| items(&source("tame"), ik, "tame");
    SOURCES.into_iter().map(tame).collect()
});

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(48) })]

    #[test]
    fn hostile_names_make_the_items_of_tame_ones(name in hostile_name()) {
        let name = in_xml(&name);
        for ((source, ik, literals), (expected, tame)) in SOURCES.into_iter().zip(&*TAME) {
            if let Err(Error::Broken(told)) = generate(&source(&name), &Options::default()) {
                // Refused, and shown on lines of their own.
                let told = told.to_string();
                prop_assert!(!told.chars().any(|c| c.is_control() && c != '\n'), "{told:?}");
                continue;
            }
            let (found, held) = items(&source(&name), ik, &name);
            prop_assert!(&found == expected, "{found}");
            // The joint's and the base's, in print and in tokens.
            prop_assert_eq!((held, *tame), (literals, literals));
        }
    }
}
