//! The file of definitions.

use super::language::signed;
use super::name::named;
use super::text::string;
use super::{forward, frames, inverse, runtime};
use crate::arm::CompiledArm;
use crate::model::Variable;
use crate::spec::Rating;

/// What stands in front of all functions.
const PREAMBLE: &str = "\
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) \\
    || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error \"compile without -ffast-math and its parts: rounding and what is not a number have a meaning here\"
#endif
#if defined(__FLT_EVAL_METHOD__) && (__FLT_EVAL_METHOD__ < 0 || __FLT_EVAL_METHOD__ == 2)
#error \"compile with -msse2 -mfpmath=sse: numbers with more digits than double round in other places\"
#endif

/* Refused where constants are read as float, as with -fsingle-precision-constant. */
typedef char kin_constants_have_all_digits[(long)16777217.0 == 16777217 ? 1 : -1];

#if defined(__clang__) && __clang_major__ >= 11
/* Clang does not tell of all parts of -ffast-math; of those that are left this one does harm. */
#pragma clang fp reassociate(off)
#endif

#if defined(__GNUC__) && !defined(__cplusplus)
/* No square root here sets errno, which would keep loops from becoming vector instructions. */
extern double sqrt(double) __attribute__((__const__));
#endif

/* Without optimization nothing is inlined: that would take long to compile, and more to step through. */
#if defined(__GNUC__) && defined(__OPTIMIZE__)
#define KIN_INLINE static inline __attribute__((always_inline))
#else
#define KIN_INLINE static inline
#endif
";

/// All of it, behind the comment at the top.
pub fn all(compiled: &CompiledArm, prefix: &str) -> String {
    let code = runtime::with_pieces(&functions(compiled));
    file(prefix, &constants(compiled, prefix), &named(&code, prefix))
}

/// Definitions as a file.
pub fn file(prefix: &str, constants: &str, code: &str) -> String {
    format!(
        "#include \"{prefix}.h\"\n\n#include <math.h>\n\n{}\n{constants}\n{code}",
        named(PREAMBLE, prefix),
    )
}

/// An arm's functions, not yet named after it.
pub fn functions(compiled: &CompiledArm) -> String {
    let model = &compiled.model;
    let frames = match model.frames.is_empty() {
        true => String::new(),
        false => format!("{}\n", frames::function(compiled)),
    };
    let inverse = match compiled.form() {
        Some(form) => {
            let redundancy = compiled.redundancy.as_ref();
            format!("\n{}", inverse::functions(model, form, redundancy))
        }
        None => String::new(),
    };
    let functions = [
        forward::functions(compiled),
        frames,
        runtime::LIMITS.to_owned(),
        inverse,
    ];
    functions.join("\n")
}

/// The constants, whose names are data.
pub fn constants(compiled: &CompiledArm, prefix: &str) -> String {
    let model = &compiled.model;
    let variables = &model.variables;
    let joints = variables.iter().map(|variable| string(&variable.name));
    let links = (0..variables.len()).map(|i| string(&model.joints[model.joint_of(i)].link));
    let list = |items: &mut dyn Iterator<Item = String>| items.collect::<Vec<_>>().join(",\n    ");
    let strings = |what: &str, count: &str, values: String| {
        let declared = named(
            &format!("const char *const kin_{what}[KIN_{count}]"),
            prefix,
        );
        format!("{declared} = {{\n    {values}\n}};\n")
    };
    let mut out = strings("joint_names", "JOINTS", list(&mut joints.into_iter()));
    out += &strings("link_names", "JOINTS", list(&mut links.into_iter()));
    if !model.frames.is_empty() {
        out += &strings("frame_names", "FRAMES", frames::names(compiled));
    }
    for (what, name) in [("base", &model.base), ("tip", &model.tip)] {
        let declared = named(&format!("const char *const kin_{what}"), prefix);
        out += &format!("{declared} = {};\n", string(name));
    }
    let variables = variables.iter().enumerate();
    let variables = variables.map(|(i, variable)| (variable, model.repeats(i)));
    out + &named(&limits(&variables.collect::<Vec<_>>()), prefix)
}

/// The kinds and the travel of joints that turn or do not.
pub fn limits(variables: &[(&Variable, bool)]) -> String {
    let bound = |variable: &Variable, i: usize| {
        variable
            .limits
            .unwrap_or([f64::NEG_INFINITY, f64::INFINITY])[i]
    };
    let rated = |of: fn(&Rating) -> Option<f64>| {
        move |variable: &Variable| of(&variable.rating).unwrap_or(f64::INFINITY)
    };
    let all = |what: &str, of: &dyn Fn(&Variable) -> f64| {
        let values: Vec<String> = variables
            .iter()
            .map(|(variable, _)| signed(of(variable)))
            .collect();
        format!(
            "const double kin_{what}[KIN_JOINTS] = {{{}}};\n",
            values.join(", ")
        )
    };
    let turns = variables.iter();
    let turns = turns.map(|(_, turns)| i32::from(*turns).to_string());
    let turns = turns.collect::<Vec<_>>().join(", ");
    [
        format!("const int kin_turns[KIN_JOINTS] = {{{turns}}};\n"),
        all("lower_limits", &|variable| bound(variable, 0)),
        all("upper_limits", &|variable| bound(variable, 1)),
        all("velocity_limits", &rated(|rating| rating.velocity)),
        all("effort_limits", &rated(|rating| rating.effort)),
    ]
    .concat()
}
