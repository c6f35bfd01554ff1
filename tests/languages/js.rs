//! Robots as JavaScript, run by QuickJS.

use crate::random::Random;
use kin_codegen::{Options, Source, generate_js};
use rquickjs::{CatchResultExt, Context, Function, Module, Object, Runtime};

/// A robot's module, and what asks it.
pub struct JsRobot {
    context: Context,
    // Behind the context that it is of.
    _runtime: Runtime,
    source: String,
}

impl JsRobot {
    pub fn new(source: &str) -> Self {
        let runtime = Runtime::new().unwrap();
        JsRobot {
            context: Context::full(&runtime).unwrap(),
            _runtime: runtime,
            source: source.to_owned(),
        }
    }

    /// What the driver writes for an input.
    pub fn ask(&self, input: &str) -> String {
        self.call("all_of", input)
    }

    /// What a function of the driver says of the robot for an input.
    pub fn call(&self, function: &str, input: &str) -> String {
        let evaluated = |ctx: &rquickjs::Ctx<'_>| -> rquickjs::Result<String> {
            let load = |name: &str, source: &str| {
                let (module, done) = Module::declare(ctx.clone(), name, source)?.eval()?;
                done.finish::<()>()?;
                Ok::<_, rquickjs::Error>(module)
            };
            let robot: Object = load("robot", &self.source)?.get("default")?;
            let ask: Function = load("driver", include_str!("driver.js"))?.get(function)?;
            ask.call((robot, input))
        };
        self.context.with(|ctx| {
            let said = evaluated(&ctx).catch(&ctx);
            said.unwrap_or_else(|error| panic!("{error}"))
        })
    }
}

/// Names of robots, joints and links.
pub const NAMES: [&str; 10] = [
    "</script><script>alert(1)</script>",
    "<!-- <script>",
    "]]>",
    "\"; throw 1; \"",
    "'${`\\u0022",
    "*/ throw 1; /*",
    "ends\nthe\r\nline",
    "ends\u{2028}the\u{2029}line",
    "ärm 机械臂 \u{202e}turned 🦾",
    "\\",
];

pub fn named(name: &str) -> Source {
    let escape = |c: char| match c {
        ' '..='~' if !matches!(c, '"' | '\\') => c.to_string(),
        _ => format!("\\U{:08x}", u32::from(c)),
    };
    let quoted: String = name.chars().map(escape).collect();
    let text = format!(
        "robot: \"{quoted}\"\nunits: {{angle: rad, length: m}}\nbase: \"{quoted}\"\nscrews:\n  \
         - {{name: \"{quoted}\", axis: [0, 0, 1], point: [0, 0, 0]}}\n  \
         - {{name: elbow, axis: [0, 0, 1], point: [0.5, 0, 0]}}\nhome: {{xyz: [0.9, 0, 0]}}\n"
    );
    let path = format!("{name}.yaml");
    Source { path, text }
}

fn robot(name: &str) -> String {
    let generated = generate_js(&named(name), &Options::default());
    generated.unwrap_or_else(|e| panic!("{e}")).source
}

/// Whether nothing in a script begins markup of the page around it, nor turns its text.
pub fn is_no_markup(script: &str) -> bool {
    let next = script
        .match_indices('<')
        .map(|(at, _)| script[at + 1..].chars().next());
    let steers = ['\u{2028}', '\u{2029}', '\u{202e}'];
    !script.contains(steers) && next.into_iter().all(|c| matches!(c, Some(' ' | '=')))
}

#[test]
fn names_are_data() {
    for name in NAMES {
        let source = robot(name);
        assert!(is_no_markup(&source), "{name:?}: a page could read markup");
        assert_eq!(JsRobot::new(&source).call("name_of", ""), name);
    }
}

/// So that a comparison with other text than a robot's own would be seen.
#[test]
fn what_is_not_a_number_is_not_taken() {
    let mut random = Random::new(3);
    let q = [random.angle(), random.angle()];
    let source = robot("arm");
    let asked = format!("1\n{:e} {:e}\n0\n", q[0], q[1]);
    let written = JsRobot::new(&source).ask(&asked);
    let x: f64 = written
        .split_ascii_whitespace()
        .nth(3)
        .unwrap()
        .parse()
        .unwrap();
    let expected = 0.5 * q[0].cos() + 0.4 * (q[0] + q[1]).cos();
    assert!((x - expected).abs() < 1e-15);
}
