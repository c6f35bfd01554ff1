//! From the macro's arguments to items.

use crate::arguments::Arguments;
use crate::{debug, dependency};
use kin_codegen::{Source, generate_cached};
use proc_macro2::{Group, Ident, TokenStream, TokenTree};
use quote::quote;
use std::path::{Path, PathBuf};
use syn::{Error, Result};

/// What was found for robots before: Cargo builds macros unoptimized, and expands them whenever it
/// builds the crate that they are in.
const FOUND: &str = concat!(env!("OUT_DIR"), "/found");

/// The robot's items, or the error to show.
pub fn expand(input: TokenStream) -> Result<TokenStream> {
    let invocation = input.to_string();
    let Arguments {
        path,
        options,
        debug,
        dollar_crate,
    } = syn::parse2(input)?;
    let root = root();
    let generated = Source::read(&path.value(), &root)
        .map_err(kin_codegen::Error::from)
        .and_then(|source| generate_cached(&source, &options, Path::new(FOUND)))
        .map_err(|error| Error::new(path.span(), error))?;
    if options.krate.is_none()
        && let Some(missing) = dependency::missing(&root)
    {
        return Err(Error::new(path.span(), missing));
    }
    let items = if debug {
        debug::through_file(&generated, &invocation)
            .map_err(|message| Error::new(path.span(), message))?
    } else if let Some(dollar_crate) = dollar_crate {
        in_crate(generated.tokens, &dollar_crate)
    } else {
        generated.tokens
    };
    let tracked = tracked(&root.join(path.value()));
    Ok(quote!(#items #tracked))
}

/// Tokens in which `crate` is the `$crate` of the macro that calls this one.
fn in_crate(tokens: TokenStream, dollar_crate: &Ident) -> TokenStream {
    let tree = |tree| match tree {
        TokenTree::Ident(ident) if ident == "crate" => dollar_crate.clone().into(),
        TokenTree::Group(group) => {
            let inner = in_crate(group.stream(), dollar_crate);
            Group::new(group.delimiter(), inner).into()
        }
        other => other,
    };
    tokens.into_iter().map(tree).collect()
}

/// The crate that is being compiled.
fn root() -> PathBuf {
    let root = std::env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default();
    // Outside Cargo: the directory that the compiler was started in.
    std::path::absolute(&root).unwrap_or(root.into())
}

/// Makes the compiler depend on the robot file, so that Cargo builds anew when
/// it changes. Its bytes are not kept.
fn tracked(file: &Path) -> TokenStream {
    let file = file.to_string_lossy();
    quote!(
        const _: &[::core::primitive::u8] = ::core::include_bytes!(#file);
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use kin_codegen::{Ik, Options, generate};
    use std::fs;

    const ROBOT: &str = "../robots/scara.yaml";

    fn refusal(input: TokenStream) -> String {
        expand(input).unwrap_err().to_string()
    }

    #[test]
    fn expands_to_the_library_s_tokens_and_the_tracked_file() {
        let options = Options {
            name: Some("Arm".into()),
            ik: Ik::None,
            krate: Some("::robotics".into()),
            ..Options::default()
        };
        let source = Source::read(ROBOT, &root()).unwrap();
        let items = generate(&source, &options).unwrap().tokens;
        let tracked = tracked(&root().join(ROBOT));
        let input = quote!(#ROBOT, name = Arm, ik = none, crate = ::robotics);
        let expanded = expand(input).unwrap();
        assert_eq!(expanded.to_string(), quote!(#items #tracked).to_string());
    }

    /// The file that is kept for robots of this name.
    fn kept(name: &str) -> PathBuf {
        let files = fs::read_dir(FOUND).unwrap();
        let mut files = files.map(|file| file.unwrap().path());
        let is_of = |file: &PathBuf| {
            file.file_name()
                .unwrap()
                .to_string_lossy()
                .starts_with(name)
        };
        files.find(is_of).unwrap()
    }

    #[test]
    fn what_was_found_is_kept() {
        let name = format!("crank{}", std::process::id());
        let robot = std::env::temp_dir().join(&name).with_extension("yaml");
        let text = "\
robot: crank
units: {angle: deg, length: m}
dh: [{name: turn, theta: 0, d: 0, a: 0.3, alpha: 0}]
";
        fs::write(&robot, text).unwrap();
        let path = robot.to_string_lossy().into_owned();
        let input = quote!(#path, name = Crank, crate = ::robotics);
        let expanded = || expand(input.clone()).unwrap().to_string();
        let first = expanded();
        let file = kept(&name);
        let whole = fs::read(&file).unwrap();
        // Of one that is damaged nothing is used.
        for damaged in [&whole[..], &whole[..whole.len() - 1]] {
            fs::write(&file, damaged).unwrap();
            assert_eq!(expanded(), first);
            assert_eq!(fs::read(&file).unwrap(), whole);
        }
        fs::remove_file(file).unwrap();
        fs::remove_file(robot).unwrap();
    }

    #[test]
    fn a_crate_that_is_not_found_has_a_remedy() {
        // This package does not depend on `kinematics`.
        let message = refusal(quote!(#ROBOT));
        assert!(message.contains("`crate = ::robotics`"), "{message}");
    }

    #[test]
    fn the_option_crate_alone_names_the_crate() {
        let input = quote!(#ROBOT, crate = ::robotics);
        let expanded = expand(input).unwrap().to_string();
        assert!(expanded.contains(":: robotics :: __private"));
        assert!(!expanded.contains(":: kinematics"), "{expanded}");
    }

    #[test]
    fn a_missing_file_tells_where_it_was_looked_for() {
        let looked_for = Path::new(env!("CARGO_MANIFEST_DIR")).join("arm.urdf");
        let message = refusal(quote!("arm.urdf"));
        assert!(
            message.contains(&format!("looked for {}", looked_for.display())),
            "{message}"
        );
    }
}
