//! What stands between the parentheses of `kinematics!`.

use kin_codegen::{Ik, Options, Scalar, Target, Unknown, target};
use proc_macro2::Span;
use quote::ToTokens;
use std::fmt::Display;
use syn::ext::IdentExt;
use syn::parse::{Parse, ParseStream};
use syn::{Error, Ident, Lit, LitBool, LitStr, Path, Result, Token, bracketed, token};

/// The options, as they are written.
const OPTIONS: [&str; 11] = [
    "name", "base", "tip", "tool", "ik", "target", "free", "scalar", "strict", "crate", "debug",
];

/// `"arm.urdf", name = Arm, base = "base_link", ..`
pub struct Arguments {
    /// The robot file.
    pub path: LitStr,
    /// What the compiler is asked for.
    pub options: Options,
    /// Whether the code goes through a file that can be opened.
    pub debug: bool,
    /// The `$crate` that the path of the option `crate` begins with. To
    /// `options` it is `crate`, for which generated code has no other use: text
    /// does not tell which crate is meant.
    pub dollar_crate: Option<Ident>,
}

impl Parse for Arguments {
    fn parse(input: ParseStream) -> Result<Self> {
        let mut arguments = Self {
            path: path(input)?,
            options: Options::default(),
            debug: false,
            dollar_crate: None,
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
        match &arguments.dollar_crate {
            Some(which) if arguments.debug => Err(error(
                which.span(),
                "a file cannot name `$crate`: leave out `debug = true`",
            )),
            _ => Ok(arguments),
        }
    }
}

impl Arguments {
    fn set(&mut self, option: &Ident, input: ParseStream) -> Result<()> {
        let options = &mut self.options;
        let value = Value { option, input };
        match option.to_string().as_str() {
            "name" => options.name = Some(value.identifier()?),
            "base" => options.base = Some(value.link()?),
            "tip" => options.tip = Some(value.link()?),
            "tool" => options.tool = Some(value.frame()?),
            "ik" => options.ik = value.word(&Ik::WORDS, str::parse)?,
            "target" => options.target = Some(value.word(&Target::WORDS, target)?),
            "free" => options.free = value.joints()?,
            "scalar" => options.scalar = value.word(&Scalar::WORDS, str::parse)?,
            "strict" => options.strict = value.switch()?,
            "crate" => {
                let (path, dollar_crate) = value.path()?;
                options.krate = Some(path);
                self.dollar_crate = dollar_crate;
            }
            "debug" => self.debug = value.switch()?,
            other => return Err(unknown_option(option.span(), other)),
        }
        Ok(())
    }
}

fn error(span: Span, message: impl Display) -> Error {
    Error::new(span, message)
}

/// Where something is missing: at what stands there instead, or behind what
/// came before.
fn place(input: ParseStream, before: Span) -> Span {
    if input.is_empty() {
        before
    } else {
        input.span()
    }
}

fn path(input: ParseStream) -> Result<LitStr> {
    let example = "`kinematics!(\"arm.urdf\")`";
    if input.is_empty() {
        let message = format!("which robot file? Write its path: {example}");
        return Err(error(Span::call_site(), message));
    }
    let place = input.span();
    input.parse().map_err(|_| {
        error(
            place,
            format!("the path of a robot file comes first, in quotes: {example}"),
        )
    })
}

fn comma(input: ParseStream) -> Result<()> {
    match input.parse::<Token![,]>() {
        Ok(_) => Ok(()),
        Err(_) => Err(error(
            input.span(),
            "expected a comma before the next option",
        )),
    }
}

/// `name =`
fn option(input: ParseStream) -> Result<Ident> {
    let place = input.span();
    let option = input.call(Ident::parse_any).map_err(|_| {
        let known = OPTIONS.join("`, `");
        error(place, format!("expected one of the options `{known}`"))
    })?;
    let name = option.to_string();
    if !OPTIONS.contains(&name.as_str()) {
        return Err(unknown_option(option.span(), &name));
    }
    let place = self::place(input, option.span());
    match input.parse::<Token![=]>() {
        Ok(_) => Ok(option),
        Err(_) => Err(error(
            place,
            format!("expected `=` and a value for `{name}`"),
        )),
    }
}

/// `-0.05`
fn number(input: ParseStream) -> Result<f64> {
    let sign = match input.parse::<Option<Token![-]>>()? {
        Some(_) => -1.0,
        None => 1.0,
    };
    let literal: Lit = input.parse()?;
    match &literal {
        Lit::Int(number) => Ok(sign * number.base10_parse::<f64>()?),
        Lit::Float(number) => Ok(sign * number.base10_parse::<f64>()?),
        other => Err(error(other.span(), "expected a number")),
    }
}

fn unknown_option(span: Span, name: &str) -> Error {
    error(span, Unknown::new("option", name, &OPTIONS))
}

/// Values, each with what to say of another one at the option's place.
struct Value<'a> {
    option: &'a Ident,
    input: ParseStream<'a>,
}

impl Value<'_> {
    fn parse<T: Parse>(&self, what: impl Display) -> Result<T> {
        let place = place(self.input, self.option.span());
        let diagnostic = |_| error(place, format!("`{}` takes {what}", self.option));
        self.input.parse().map_err(diagnostic)
    }

    /// `Arm`
    fn identifier(&self) -> Result<String> {
        let place = place(self.input, self.option.span());
        // Of a keyword too, the compiler tells what to write instead.
        let name = self.input.call(Ident::parse_any).map_err(|_| {
            error(
                place,
                "`name` takes the name of a type, without quotes: `name = Arm`",
            )
        })?;
        Ok(name.to_string())
    }

    /// `::robotics`, also in quotes, and the `$crate` that it begins with
    fn path(&self) -> Result<(String, Option<Ident>)> {
        if self.input.peek(LitStr) {
            return Ok((self.input.parse::<LitStr>()?.value(), None));
        }
        let path: Path = self.parse("the path of `kinematics`: `crate = ::robotics`")?;
        let text = path.to_token_stream().to_string().replace(' ', "");
        let first = path.segments.first().map(|part| part.ident.clone());
        Ok(match text.strip_prefix('$') {
            Some(text) => (text.to_owned(), first),
            None => (text, None),
        })
    }

    /// `"base_link"`
    fn link(&self) -> Result<String> {
        let example = format!("`{} = \"link\"`", self.option);
        let link: LitStr = self.parse(format!("the name of a link, in quotes: {example}"))?;
        Ok(link.value())
    }

    /// `[0.1, 0, 0.05, 0, -0.8, 0]`
    fn frame(&self) -> Result<[f64; 6]> {
        let what = "six numbers in brackets, x, y and z in metres, then roll, pitch and yaw in \
                    radians: `tool = [0, 0, 0.1, 0, 0.8, 0]`";
        let place = place(self.input, self.option.span());
        let refused = |place| error(place, format!("`tool` takes {what}"));
        if !self.input.peek(token::Bracket) {
            return Err(refused(place));
        }
        let numbers;
        let brackets = bracketed!(numbers in self.input);
        let entries = numbers.parse_terminated(number, Token![,]);
        let entries: Option<Vec<f64>> = entries.ok().map(|entries| entries.into_iter().collect());
        let entries = entries.and_then(|entries| entries.try_into().ok());
        entries.ok_or_else(|| refused(brackets.span.join()))
    }

    /// `"rail"`, or several in brackets
    fn joints(&self) -> Result<Vec<String>> {
        let what = "the name of a joint, in quotes, or several in brackets: `free = \"joint\"`, \
                    `free = [\"rail\", \"joint\"]`";
        if !self.input.peek(token::Bracket) {
            return Ok(vec![self.parse::<LitStr>(what)?.value()]);
        }
        let names;
        let brackets = bracketed!(names in self.input);
        let names = names.parse_terminated(|name| name.parse::<LitStr>(), Token![,]);
        let refused = || error(brackets.span.join(), format!("`free` takes {what}"));
        let names = names.map_err(|_| refused())?;
        match names.is_empty() {
            true => Err(refused()),
            false => Ok(names.iter().map(LitStr::value).collect()),
        }
    }

    /// `none`
    fn word<T>(
        &self,
        known: &[&str],
        read: fn(&str) -> std::result::Result<T, Unknown>,
    ) -> Result<T> {
        let known = known.join("` or `");
        let word: Ident = self.parse(format!("a word without quotes: `{known}`"))?;
        read(&word.to_string()).map_err(|unknown| error(word.span(), unknown))
    }

    /// `true`
    fn switch(&self) -> Result<bool> {
        let switch: LitBool = self.parse("`true` or `false`")?;
        Ok(switch.value)
    }
}

#[cfg(test)]
#[path = "../../fuzz/src/arguments.rs"]
mod checked;
#[cfg(test)]
#[path = "../../fuzz/src/mutation.rs"]
mod mutation;

#[cfg(test)]
mod tests {
    use super::*;
    use kin_codegen::random::Random;
    use std::fs;
    use std::path::Path;

    #[test]
    fn whatever_is_written_is_read_or_refused() {
        let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz/corpus/arguments");
        let mut files: Vec<_> = fs::read_dir(corpus)
            .unwrap()
            .map(|e| e.unwrap().path())
            .collect();
        files.sort();
        let seeds: Vec<String> = files
            .iter()
            .map(|file| fs::read_to_string(file).unwrap())
            .collect();
        let mut read = 0;
        for seed in 1..=5000 {
            let mut random = Random(seed);
            let text = &seeds[random.below(seeds.len() as u64)];
            let other = &seeds[random.below(seeds.len() as u64)];
            let text = mutation::mutate(text, other, &mut random);
            read += usize::from(checked::check(&text, syn::parse2::<Arguments>));
        }
        assert!((100..4900).contains(&read), "{read}");
    }
}
