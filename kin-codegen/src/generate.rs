//! Robot file in, Rust out.

use crate::compile::{compile, compile_cached};
use crate::compiled::Compiled;
use crate::emit::header;
use crate::emit::rust::{self, Names};
use crate::error::Error;
use crate::hash::fnv1a;
use crate::options::{self, Options};
use crate::spec::{Diagnostic, Diagnostics, Source};
use proc_macro2::{Ident, TokenStream};
use quote::quote;
use std::path::Path;

/// The generated robot.
#[derive(Clone, Debug)]
pub struct Generated {
    /// Its items.
    pub tokens: TokenStream,
    /// Of the robot file.
    hash: u64,
    /// The same with markers where comments are to stand.
    commented: TokenStream,
    /// The name of its type.
    pub name: String,
    /// What it was generated from.
    pub robot: Compiled,
    /// The options that were asked for.
    pub options: Options,
}

/// Compiles a robot file to Rust. `build::Config` and `kin generate` call this.
///
/// # Errors
///
/// What is wrong with the file or the options, each with a place and a remedy,
/// or why the arm has no closed form.
pub fn generate(source: &Source, options: &Options) -> Result<Generated, Error> {
    generated(source, options, || compile(source, options))
}

/// The same with a folder of what was found before, see [`compile_cached`]. The macro calls this.
///
/// # Errors
///
/// As [`generate`].
pub fn generate_cached(
    source: &Source,
    options: &Options,
    folder: &Path,
) -> Result<Generated, Error> {
    generated(source, options, || compile_cached(source, options, folder))
}

fn generated(
    source: &Source,
    options: &Options,
    compile: impl FnOnce() -> Result<Compiled, Error>,
) -> Result<Generated, Error> {
    let name = options.type_name(&source.path);
    let refused = |diagnostic| Diagnostics::one(&source.path, diagnostic);
    let names = Names {
        robot: type_ident(&name).map_err(refused)?,
        runtime: runtime(options).map_err(refused)?,
    };
    let robot = compile()?;
    let commented = match &robot {
        Compiled::Arm(arm) => rust::robot(arm, &names),
        Compiled::Mechanism(mechanism) => rust::mechanism(mechanism, &names),
    };
    Ok(Generated {
        tokens: rust::without_comments(commented.clone()),
        commented,
        hash: fnv1a(source.text.as_bytes()),
        name,
        robot,
        options: options.clone(),
    })
}

/// The name of a type. It has a capital letter, as generated variables,
/// functions and modules, the primitive types and all keywords but `Self` have
/// not.
fn type_ident(name: &str) -> Result<Ident, Diagnostic> {
    let (reason, remedy) = match syn::parse_str::<Ident>(name) {
        Ok(_) if rust::is_taken(name) => (
            format!("the generated code uses a type `{name}` of its own"),
            "choose another with the option `name`".into(),
        ),
        Ok(ident) if ident == name && !is_lower_case(name) => return Ok(ident),
        _ => (
            format!("`{name}` cannot name the type of a robot"),
            match options::upper_camel_case(name) {
                camel if camel == name || rust::is_taken(&camel) || camel == "Self" => {
                    "choose another with the option `name`".into()
                }
                camel => format!(
                    "types have names of letters and digits with a capital one: `name = {camel}`"
                ),
            },
        ),
    };
    Err(Diagnostic::whole(reason, remedy))
}

fn is_lower_case(name: &str) -> bool {
    let lower = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
    name.chars().all(lower)
}

/// The path of the crate `kinematics`: from any module, since generated code
/// has modules of its own.
fn runtime(options: &Options) -> Result<TokenStream, Diagnostic> {
    let Some(path) = &options.krate else {
        return Ok(quote!(::kinematics));
    };
    let refused = || {
        Diagnostic::whole(
            format!("`{path}` is no path of a crate"),
            "the option `crate` takes a path that is the same in every module: `::robotics` or \
             `crate::robotics::kinematics`",
        )
    };
    let parsed: syn::Path = syn::parse_str(path).map_err(|_| refused())?;
    let is_plain = parsed.segments.iter().all(|part| part.arguments.is_empty());
    let first = parsed.segments.first().map(|part| part.ident.to_string());
    match (first.as_deref(), parsed.leading_colon) {
        (Some("self" | "super" | "Self") | None, _) => Err(refused()),
        _ if !is_plain => Err(refused()),
        (Some("crate"), None) | (_, Some(_)) => Ok(quote!(#parsed)),
        // Of another crate, as in a list of dependencies.
        (_, None) => Ok(quote!(::#parsed)),
    }
}

impl Generated {
    /// The items as formatted source, under a header that says from what and
    /// how they were made.
    pub fn code(&self) -> String {
        let items = rust::print(self.commented.clone());
        let header = header::of(&self.robot, &self.name, self.hash, &self.options, None);
        format!("{}\n{items}", rust::header(&header))
    }
}
