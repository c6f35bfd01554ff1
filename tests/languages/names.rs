//! Names of robot files are data in C as well: none ends the string or the comment that it
//! stands in, none is a reserved word, and all arrive as they are.

use crate::named::yaml;
use crate::program::{Compiler, Program};
use kin_codegen::{GeneratedC, Options, Source, generate_c};
use std::fmt::Write as _;

/// Robot files, and what their symbols begin with.
const FILES: [(&str, &str); 14] = [
    ("int.yaml", "int"),
    ("class.yaml", "class"),
    ("namespace.yaml", "namespace"),
    ("_Bool.yaml", "bool"),
    ("and.yaml", "and"),
    ("main.yaml", "main"),
    ("printf.yaml", "printf"),
    ("kin.yaml", "kin"),
    ("math.yaml", "robot_math"),
    ("7 axes.yaml", "robot7_axes"),
    ("机械臂.yaml", "robot"),
    ("x; system(\"touch pwned\").yaml", "x_system_touch_pwned"),
    ("*; int evil;.yaml", "int_evil"),
    ("a??\n\".yaml", "a"),
];

/// Names of joints, links and robots.
const NAMES: [&str; 14] = [
    "\"; system(\"touch pwned\"); \"",
    "*/ system(\"touch pwned\"); /*",
    "ends\nthe line",
    "carriage\r\nreturn",
    "back\\slash\\",
    "trigraph??/ ??' ??)",
    "%s%n%d",
    "#include \"/etc/passwd\"",
    "#define double int",
    "ärm 机械臂 \u{202e}turned",
    "octal\u{7f}7 and \u{1}2",
    "//* /* //",
    "L\"\\x41\" u8",
    "KIN_JOINTS kin_fk",
];

fn robot(path: &str, name: &str) -> GeneratedC {
    let source = Source {
        path: path.into(),
        ..yaml(name)
    };
    generate_c(&source, &Options::default()).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn names_are_data() {
    let mut program = Program::new("c_names");
    let mut expected = String::new();
    for ((path, prefix), name) in FILES.into_iter().zip(NAMES) {
        let robot = robot(path, name);
        assert_eq!(robot.name, prefix);
        assert!(!robot.header.contains('\u{202e}'), "{path}");
        program.add_names(&robot);
        for byte in name.bytes() {
            let _ = write!(expected, "{byte:02x}");
        }
        expected.push('\n');
    }
    for (compiler, name) in [(Compiler::C, "in_c"), (Compiler::Cpp, "in_cpp")] {
        if compiler.is_there() {
            assert_eq!(program.build(compiler, &["-O0"], name).run(""), expected);
        }
    }
}
