//! A program of many robots' C, and a driver that asks all of them.

use crate::cached::folder;
use crate::read;
use kin_codegen::{Compiled, GeneratedC, Options, compile_cached};
use std::fmt::Write as _;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Nothing that a compiler can say against the code is said.
const FLAGS: [&str; 4] = ["-Wall", "-Wextra", "-Werror", "-pedantic"];
/// So that results do not depend on the processor.
const NOT_FUSED: &str = "-ffp-contract=off";

const MAIN: &str = "\
#include <stdio.h>
#include <stdlib.h>

#if defined(__GNUC__)
#define UNUSED __attribute__((unused))
#else
#define UNUSED
#endif

UNUSED static void read_numbers(double *numbers, int count)
{
    for (int i = 0; i < count; ++i) {
        if (scanf(\"%lf\", &numbers[i]) != 1) {
            exit(1);
        }
    }
}

UNUSED static void write_numbers(const double *numbers, int count)
{
    for (int i = 0; i < count; ++i) {
        printf(\"%.17g%c\", numbers[i], i + 1 < count ? ' ' : '\\n');
    }
}

";

/// What the driver writes behind a robot's answers.
pub const END: &str = "end";

/// A language with a compiler for it.
#[derive(Clone, Copy)]
pub enum Compiler {
    C,
    Cpp,
}

impl Compiler {
    pub fn command(self) -> Command {
        let (program, standard) = match self {
            Compiler::C => ("cc", &["-x", "c", "-std=c99"]),
            Compiler::Cpp => ("c++", &["-x", "c++", "-std=c++11"]),
        };
        let mut command = Command::new(program);
        command.args(standard);
        command
    }

    /// Whether it is on this machine; says so if not.
    pub fn is_there(self) -> bool {
        let found = self.command().arg("--version").output();
        let found = found.is_ok_and(|output| output.status.success());
        if !found {
            let command = self.command();
            eprintln!("SKIPPED: there is no {:?} here", command.get_program());
        }
        found
    }
}

/// Robots in one program.
pub struct Program {
    folder: PathBuf,
    text: String,
    calls: String,
}

impl Program {
    /// In a folder of the tests' own, without robots yet.
    pub fn new(name: &str) -> Self {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        fs::create_dir_all(&folder).unwrap();
        Program {
            folder,
            text: MAIN.to_owned(),
            calls: String::new(),
        }
    }

    /// Of one robot and a text with a `main` of its own.
    pub fn with_main(name: &str, robot: &GeneratedC, main: &str) -> Self {
        let mut program = Program::new(name);
        program.add_with(robot, main);
        program.calls.clear();
        program
    }

    /// Adds a robot, and asks it for what is in the input.
    pub fn add(&mut self, robot: &GeneratedC) {
        let driver = match robot.robot {
            Compiled::Arm(_) => include_str!("driver.c"),
            Compiled::Mechanism(_) => include_str!("mechanism_driver.c"),
        };
        self.add_with(robot, driver);
    }

    /// Adds a robot, and asks it for the name of its first joint: its bytes.
    pub fn add_names(&mut self, robot: &GeneratedC) {
        let driver = "static void run_kin_robot(void)\n{\n    \
                      for (const char *c = kin_joint_names[0]; *c; ++c) {\n        \
                      printf(\"%02x\", (unsigned)(unsigned char)*c);\n    }\n    \
                      printf(\"\\n\");\n}\n";
        self.add_with(robot, driver);
    }

    /// Writes a robot's files and adds them. All are one translation unit, so that no two have
    /// symbols in common.
    fn add_with(&mut self, robot: &GeneratedC, driver: &str) {
        let GeneratedC { name, .. } = robot;
        let file = |ending: &str| self.folder.join(format!("{name}.{ending}"));
        fs::write(file("h"), &robot.header).unwrap();
        fs::write(file("c"), &robot.source).unwrap();
        let upper = format!("{}_", name.to_ascii_uppercase());
        let driver = driver
            .replace("KIN_", &upper)
            .replace("kin_", &format!("{name}_"));
        let _ = writeln!(self.text, "#include \"{name}.c\"\n{driver}");
        let _ = writeln!(self.calls, "    run_{name}_robot();");
    }

    /// Compiles and links it; with more flags.
    pub fn build(&self, compiler: Compiler, flags: &[&str], name: &str) -> Built {
        let main = self.folder.join(format!("{name}.txt"));
        let text = match self.calls.is_empty() {
            true => self.text.clone(),
            false => format!(
                "{}int main(void)\n{{\n{}    return 0;\n}}\n",
                self.text, self.calls
            ),
        };
        fs::write(&main, text).unwrap();
        let program = self.folder.join(name);
        let output = compiler
            .command()
            .args(FLAGS)
            .arg(NOT_FUSED)
            .args(flags)
            .arg("-I")
            .arg(&self.folder)
            .arg("-o")
            .arg(&program)
            .arg(&main)
            .arg("-lm")
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{said}");
        assert_eq!(said, "");
        Built(program)
    }
}

/// A program to be run.
pub struct Built(PathBuf);

impl Built {
    /// What it writes for an input.
    pub fn run(&self, input: &str) -> String {
        let mut command = Command::new(&self.0);
        let command = command.stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child = command.spawn().unwrap();
        let mut stdin = child.stdin.take().unwrap();
        let input = input.to_owned();
        let writing = std::thread::spawn(move || stdin.write_all(input.as_bytes()));
        let output = child.wait_with_output().unwrap();
        writing.join().unwrap().unwrap();
        assert!(output.status.success(), "{:?}", output.status);
        String::from_utf8(output.stdout).unwrap()
    }
}

/// The C of a robot file, whose names begin with `name`.
pub fn generated(path: &str, name: &str, options: &Options) -> GeneratedC {
    let source = read(path);
    let robot = compile_cached(&source, options, folder());
    let robot = robot.unwrap_or_else(|error| panic!("{error}"));
    GeneratedC::of(robot, name.into(), &source, options)
}
