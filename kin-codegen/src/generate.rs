//! Robot file in, Rust out.

use crate::compile::compile;
use crate::compiled::Compiled;
use crate::emit::{self, TAKEN, header};
use crate::error::Error;
use crate::options::Options;
use crate::spec::{Diagnostic, Diagnostics, Source};
use proc_macro2::{Ident, Span, TokenStream};

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

/// Compiles a robot file to Rust. The macro, `build::Config` and `kin
/// generate` all call this.
///
/// # Errors
///
/// What is wrong with the file or the options, each with a place and a remedy,
/// or why the arm has no closed form.
pub fn generate(source: &Source, options: &Options) -> Result<Generated, Error> {
    let name = options.type_name(&source.path);
    let ident = type_ident(source, &name)?;
    let robot = compile(source, options)?;
    let commented = match &robot {
        Compiled::Arm(arm) => emit::robot(arm, &ident),
        Compiled::Mechanism(mechanism) => emit::mechanism(mechanism, &ident),
    };
    Ok(Generated {
        tokens: emit::without_comments(commented.clone()),
        commented,
        hash: header::fnv1a(source.text.as_bytes()),
        name,
        robot,
        options: options.clone(),
    })
}

fn type_ident(source: &Source, name: &str) -> Result<Ident, Diagnostics> {
    let reason = match syn::parse_str::<Ident>(name) {
        Ok(_) if TAKEN.contains(&name) => {
            format!("the generated code uses a type `{name}` of its own")
        }
        Ok(_) => return Ok(Ident::new(name, Span::call_site())),
        Err(_) => format!("`{name}` cannot name a Rust type"),
    };
    let diagnostic = Diagnostic::whole(reason, "choose one with the option `name`");
    Err(Diagnostics::one(&source.path, diagnostic))
}

impl Generated {
    /// The items as formatted source, under a header that says from what and
    /// how they were made.
    pub fn code(&self) -> String {
        let items = emit::print(self.commented.clone());
        format!("{}\n{items}", self.header())
    }

    /// From what the code was made, with which options, and what it costs.
    fn header(&self) -> String {
        let asked = &self.options;
        let (path, told, ends, target) = match &self.robot {
            Compiled::Arm(arm) => {
                let target = arm.form().map(|form| form.plan.target);
                let ends = [&arm.model.base, &arm.model.tip];
                (&arm.file, header::arm(arm), ends, target)
            }
            Compiled::Mechanism(compiled) => {
                let mechanism = &compiled.mechanism;
                let ends = [&mechanism.base, &mechanism.platform];
                (&compiled.file, header::mechanism(compiled), ends, None)
            }
        };
        let [base, tip] = ends.map(|end| Some(end.clone()));
        let options = Options {
            name: Some(self.name.clone()),
            base,
            tip,
            ik: asked.ik,
            target,
            strict: asked.strict,
        };
        let hash = self.hash;
        header::Provenance {
            path,
            hash,
            asked,
            options,
        }
        .header(&told)
    }
}
