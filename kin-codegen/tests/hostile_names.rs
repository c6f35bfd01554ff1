//! Names in a robot file are data: none gets out of the comment, the
//! documentation or the literal that it stands in.

use kin_codegen::{Generated, Ik, Options, Source, generate};
use proc_macro2::{TokenStream, TokenTree};

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
            .filter(|line| line.starts_with("/// ```"))
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
