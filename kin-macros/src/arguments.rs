//! What stands between the parentheses of `kinematics!`.

use kin_codegen::{Ik, Options, Target, Unknown};
use proc_macro2::Span;
use std::fmt::Display;
use std::str::FromStr;
use syn::ext::IdentExt;
use syn::parse::{Parse, ParseStream};
use syn::{Error, Ident, LitBool, LitStr, Result, Token};

/// The options, as they are written.
const OPTIONS: [&str; 6] = ["name", "base", "tip", "ik", "target", "debug"];

/// `"arm.urdf", name = Arm, base = "base_link", ..`
pub struct Arguments {
    /// The robot file.
    pub path: LitStr,
    /// What the compiler is asked for.
    pub options: Options,
    /// Whether the code goes through a file that can be opened.
    pub debug: bool,
}

impl Parse for Arguments {
    fn parse(input: ParseStream) -> Result<Self> {
        let mut arguments = Self {
            path: path(input)?,
            options: Options::default(),
            debug: false,
        };
        let mut given: Vec<String> = Vec::new();
        while !input.is_empty() {
            comma(input)?;
            if input.is_empty() {
                break;
            }
            let option = option(input)?;
            let name = option.to_string();
            if given.contains(&name) {
                return Err(error(option.span(), format!("`{name}` is given twice")));
            }
            arguments.set(&option, input)?;
            given.push(name);
        }
        Ok(arguments)
    }
}

impl Arguments {
    fn set(&mut self, option: &Ident, input: ParseStream) -> Result<()> {
        let options = &mut self.options;
        match option.to_string().as_str() {
            "name" => options.name = Some(identifier(input)?),
            "base" => options.base = Some(link("base", input)?),
            "tip" => options.tip = Some(link("tip", input)?),
            "ik" => options.ik = word("ik", &Ik::WORDS, input)?,
            "target" => options.target = Some(word("target", &Target::WORDS, input)?),
            "debug" => self.debug = switch(input)?,
            other => return Err(unknown_option(option.span(), other)),
        }
        Ok(())
    }
}

fn error(span: Span, message: impl Display) -> Error {
    Error::new(span, message)
}

/// Says what was expected, at what stands there instead.
fn expected(input: ParseStream, what: impl Display) -> Error {
    input.error(what)
}

fn path(input: ParseStream) -> Result<LitStr> {
    let example = "`kinematics!(\"arm.urdf\")`";
    if input.is_empty() {
        return Err(error(
            Span::call_site(),
            format!("which robot file? Write its path: {example}"),
        ));
    }
    input.parse().map_err(|_| {
        expected(
            input,
            format!("the path of a robot file comes first, in quotes: {example}"),
        )
    })
}

fn comma(input: ParseStream) -> Result<()> {
    input
        .parse::<Token![,]>()
        .map(|_| ())
        .map_err(|_| expected(input, "expected a comma before the next option"))
}

/// `name =`
fn option(input: ParseStream) -> Result<Ident> {
    let option = input.call(Ident::parse_any).map_err(|_| {
        let known = OPTIONS.join("`, `");
        expected(input, format!("expected one of the options `{known}`"))
    })?;
    let name = option.to_string();
    if !OPTIONS.contains(&name.as_str()) {
        return Err(unknown_option(option.span(), &name));
    }
    input
        .parse::<Token![=]>()
        .map_err(|_| expected(input, format!("expected `=` and a value for `{name}`")))?;
    Ok(option)
}

fn unknown_option(span: Span, name: &str) -> Error {
    let unknown = Unknown::new("option", name, &OPTIONS);
    let known = OPTIONS.join("`, `");
    error(span, format!("{unknown}\nhelp: the options are `{known}`"))
}

/// `Arm`
fn identifier(input: ParseStream) -> Result<String> {
    input
        .parse::<Ident>()
        .map(|name| name.to_string())
        .map_err(|_| {
            expected(
                input,
                "`name` takes the name of a type, without quotes: `name = Arm`",
            )
        })
}

/// `"base_link"`
fn link(option: &str, input: ParseStream) -> Result<String> {
    input
        .parse::<LitStr>()
        .map(|link| link.value())
        .map_err(|_| {
            expected(
                input,
                format!("`{option}` takes the name of a link, in quotes: `{option} = \"link\"`"),
            )
        })
}

/// `none`
fn word<T: FromStr<Err = Unknown>>(option: &str, known: &[&str], input: ParseStream) -> Result<T> {
    let word = input.call(Ident::parse_any).map_err(|_| {
        let known = known.join("` or `");
        expected(
            input,
            format!("`{option}` takes a word without quotes: `{known}`"),
        )
    })?;
    word.to_string()
        .parse()
        .map_err(|unknown: Unknown| error(word.span(), unknown))
}

/// `true`
fn switch(input: ParseStream) -> Result<bool> {
    input
        .parse::<LitBool>()
        .map(|switch| switch.value)
        .map_err(|_| expected(input, "`debug` takes `true` or `false`"))
}
