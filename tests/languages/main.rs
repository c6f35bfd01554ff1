//! Robots in other languages: what they compute is what Rust has, on every robot of this
//! repository, as C, as C++ and as JavaScript.

#[path = "../random.rs"]
mod random;

#[path = "../cached.rs"]
mod cached;
mod js;
mod mechanisms;
mod meeting;
mod mistakes;
mod misuse;
mod moveit;
#[path = "../../kin-codegen/tests/named/mod.rs"]
mod named;
mod names;
mod pages;
mod program;
mod refused;
mod robots;
mod targets;

use js::JsRobot;
use kin_codegen::{GeneratedC, GeneratedJs};
use kinematics::__private::math;
use kinematics::__private::reproducible::reproducibly;
use kinematics::{Pose, Robot, RobotOptions, RobotSource, Target, Twist};
use program::{Compiler, Program, generated};
use robots::{Asked, all};
use std::f64::consts::PI;
use std::fmt::Write as _;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Of the size of these arms, up to two metres, 1e-9.
const REACHED: f64 = 2e-9;

/// Regular solutions are the same to this, radians and metres.
const SAME: f64 = 1e-9;
/// Of a few dozen operations, metres and radians.
const ROUNDING: f64 = 1e-13;
/// Where roots nearly meet, the last bit of a cube root is worth this.
const MET: f64 = 1e-7;
/// So far a member of a motion that moves the tip by rounding may be from another.
const NEARBY: f64 = 1e-3;

/// A robot in all languages, and what all are asked.
struct Subject {
    path: &'static str,
    rust: Robot,
    /// The source of its module.
    js: String,
    /// What it is asked, as text.
    input: String,
    has_inverse: bool,
    /// Whether a polynomial in one joint takes part.
    eliminates: bool,
    /// Whether branches are refined, and have the numbers of a plan's.
    refines: bool,
    configurations: Vec<Vec<f64>>,
    /// With seeds.
    targets: Vec<(Pose, Vec<f64>)>,
}

fn read(path: &str) -> RobotSource {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    RobotSource::read(path, &root).unwrap()
}

/// A robot as it is read while a program runs.
fn loaded(path: &str, options: &RobotOptions) -> Robot {
    cached::cached(&format!("../{path}"), options)
}

/// All robots in all languages, on two cores.
fn compiled() -> Vec<(Asked, GeneratedC, String, Robot)> {
    let both = |(number, asked): (usize, Asked)| {
        let source = read(asked.path);
        let c = generated(asked.path, &format!("robot{number}"), &asked.options);
        let js = GeneratedJs::of(c.robot.clone(), &source, &asked.options).source;
        let rust = loaded(asked.path, &asked.options);
        (asked, c, js, rust)
    };
    let mut all: Vec<_> = all().into_iter().enumerate().collect();
    let rest = all.split_off(all.len() / 2);
    std::thread::scope(|scope| {
        let rest = scope.spawn(move || rest.into_iter().map(both).collect::<Vec<_>>());
        let first: Vec<_> = all.into_iter().map(both).collect();
        first.into_iter().chain(rest.join().unwrap()).collect()
    })
}

/// All robots, and the program in C of them.
fn subjects() -> (Vec<Subject>, Program) {
    let mut program = Program::new("c");
    let mut subjects = Vec::new();
    for (asked, c, js, rust) in compiled() {
        program.add(&c);
        subjects.push(Subject::new(&asked, &c, js, rust));
    }
    (subjects, program)
}

impl Subject {
    fn new(asked: &Asked, c: &GeneratedC, js: String, rust: Robot) -> Self {
        let mut configurations = targets::configurations(rust.joints());
        configurations.extend(targets::at_limits(rust.limits()));
        let has_inverse = c.header.contains("_MAX_SOLUTIONS");
        let mut targets = match has_inverse {
            true => reproducibly(|| targets::targets(&rust, &configurations)),
            false => Vec::new(),
        };
        if asked.path == targets::UPRIGHT {
            targets.push(reproducibly(|| targets::upright(&rust)));
        }
        if asked.path == targets::ALONG_RAIL {
            targets.extend(reproducibly(|| targets::along_rail(&rust)));
        }
        if asked.path == targets::OVER_THE_BASE {
            targets.extend(reproducibly(|| targets::over_the_base(&rust)));
        }
        if asked.path == targets::NEXT_TO_AXIS_1 {
            targets = targets::next_to_axis_1(&rust);
        }
        if asked.path == targets::FOLDED {
            targets = reproducibly(|| targets::folded(&rust));
        }
        let mut subject = Subject {
            path: asked.path,
            rust,
            js,
            input: String::new(),
            has_inverse,
            eliminates: asked.eliminates,
            refines: asked.refines,
            configurations,
            targets,
        };
        subject.input = subject.asking(1);
        subject
    }

    /// What it is asked if only one of so many targets is, as text.
    fn asking(&self, every: usize) -> String {
        let mut input = String::new();
        let _ = writeln!(input, "{}", self.configurations.len());
        let configurations = self.configurations.iter();
        configurations.for_each(|q| write(&mut input, q));
        if self.has_inverse {
            let targets = self.targets.iter().step_by(every);
            let _ = writeln!(input, "{}", targets.len());
            for (pose, seed) in targets {
                write(&mut input, &rows(pose));
                write(&mut input, seed);
                write(
                    &mut input,
                    &reproducibly(|| self.rust.redundancy(pose, seed)),
                );
            }
        }
        input
    }
}

fn write(out: &mut String, numbers: &[f64]) {
    for x in numbers {
        let _ = write!(out, "{x:e} ");
    }
    out.push('\n');
}

/// A pose as C has it: three rows of four.
fn rows(pose: &Pose) -> Vec<f64> {
    let row = |i: usize| {
        let [a, b, c] = pose.rotation[i];
        [a, b, c, pose.translation[i]]
    };
    (0..3).flat_map(row).collect()
}

fn by_rows(columns: &[Twist]) -> Vec<f64> {
    let columns: Vec<[f64; 6]> = columns.iter().map(|it| it.to_array()).collect();
    (0..6)
        .flat_map(|row| columns.iter().map(move |column| column[row]))
        .collect()
}

/// What a program has written, number by number.
struct Written<'a>(std::str::SplitAsciiWhitespace<'a>);

impl Written<'_> {
    fn number(&mut self) -> f64 {
        self.0.next().unwrap().parse().unwrap()
    }

    fn integer(&mut self) -> i32 {
        self.0.next().unwrap().parse().unwrap()
    }

    fn same(&mut self, expected: &[f64], off: f64, of: &dyn std::fmt::Debug) {
        for (i, &x) in expected.iter().enumerate() {
            let y = self.number();
            let same = is_same(x, y, off);
            assert!(same, "{of:?}, number {i}: {x} in Rust, {y} here");
        }
    }
}

fn is_same(x: f64, y: f64, off: f64) -> bool {
    x == y || (x - y).abs() <= off * (1.0 + x.abs()) || x.is_nan() && y.is_nan()
}

/// Compares what C has written of all robots.
fn compare(subjects: &[Subject], written: &str) {
    let mut written = Written(written.split_ascii_whitespace());
    for subject in subjects {
        compare_one(subject, 1, &mut written);
        assert_eq!(written.0.next(), Some(program::END));
    }
    assert!(written.0.next().is_none());
}

/// Without fused operations, which the other languages have not; of [`Subject::asking`].
fn compare_one(subject: &Subject, every: usize, written: &mut Written) {
    reproducibly(|| {
        for q in &subject.configurations {
            forward(subject, q, written);
        }
    });
    let mut all = || {
        for (pose, seed) in subject.targets.iter().step_by(every) {
            inverse(subject, pose, seed, written);
        }
    };
    // Eliminations are not compared to the last digits.
    match subject.eliminates {
        true => all(),
        false => reproducibly(all),
    }
}

/// Runs a robot's JavaScript, and compares. Eliminations take an interpreter of it long: of so many
/// of their targets it is asked one.
fn compare_js(subject: &Subject, of_eliminations: usize) {
    let every = match subject.eliminates {
        true => of_eliminations,
        false => 1,
    };
    let written = JsRobot::new(&subject.js).ask(&subject.asking(every));
    let mut written = Written(written.split_ascii_whitespace());
    compare_one(subject, every, &mut written);
    assert!(written.0.next().is_none());
}

fn forward(subject: &Subject, q: &[f64], written: &mut Written) {
    let (rust, of) = (&subject.rust, &(subject.path, q));
    let spatial = by_rows(&rust.spatial_jacobian(q));
    written.same(&rows(&rust.fk(q)), ROUNDING, of);
    let links: Vec<f64> = rust.fk_links(q).iter().flat_map(rows).collect();
    written.same(&links, ROUNDING, of);
    written.same(&spatial, ROUNDING, of);
    written.same(&by_rows(&rust.body_jacobian(q)), ROUNDING, of);
    written.same(&by_rows(&rust.geometric_jacobian(q)), ROUNDING, of);
    written.same(&rows(&rust.fk(q)), ROUNDING, of);
    written.same(&spatial, ROUNDING, of);
    let frames = rust.frame_names();
    for name in &frames {
        assert_eq!(written.integer(), 0);
        let pose = rust.fk_frame(q, name).unwrap();
        written.same(&rows(&pose), ROUNDING, &(of, name));
    }
    if !frames.is_empty() {
        assert_eq!([written.integer(), written.integer()], [-1, -1]);
    }
    let limits = rust.limits();
    let inside: Vec<_> = q
        .iter()
        .zip(limits)
        .map(|(q, it)| it.nearest(*q, *q))
        .collect();
    let is_inside = inside.iter().all(Option::is_some);
    assert_eq!(written.integer(), i32::from(is_inside), "{of:?}");
    let moved: Vec<f64> = inside
        .iter()
        .zip(q)
        .map(|(it, q)| it.unwrap_or(*q))
        .collect();
    written.same(&moved, ROUNDING, of);
}

fn inverse(subject: &Subject, pose: &Pose, seed: &[f64], written: &mut Written) {
    let (rust, of) = (&subject.rust, &(subject.path, pose, seed));
    let parameters = rust.redundancy(pose, seed);
    let told: Vec<f64> = parameters.iter().map(|_| written.number()).collect();
    if is_defined(rust, pose, seed) {
        let off = |(x, y): (&f64, &f64)| math::wrap(x - y).abs();
        let apart = parameters.iter().zip(&told).map(off);
        assert!(
            apart.fold(0.0, f64::max) < MET,
            "{of:?}: {parameters:?}, {told:?}"
        );
    }
    let expected = rust.ik_at(pose, &parameters);
    let found = written.integer();
    if subject.eliminates {
        return eliminated(subject, pose, seed, found, written);
    }
    assert_eq!(found.max(0) as usize, expected.len(), "{of:?}");
    if found <= 0 && rust.target() == Target::Pose {
        assert_eq!(found, why_none(pose, &parameters), "{of:?}");
    }
    for solution in expected.iter() {
        assert_eq!(written.integer() as u32, solution.branch, "{of:?}");
        assert_eq!(written.integer() != 0, solution.singular, "{of:?}");
        if solution.singular {
            // Where solutions have met, what a step of Newton's method leaves is rounding's.
            assert!(written.number() <= REACHED, "{of:?}");
            let q: Vec<f64> = solution.q.iter().map(|_| written.number()).collect();
            let apart = q
                .iter()
                .zip(solution.q)
                .map(|(x, y)| math::wrap(x - y).abs());
            let is_same = apart.clone().all(|x| x <= MET);
            // Of a motion that the target hardly sees either may have another member.
            let missed = rust.target().distance(&rust.fk(&q), pose, 1.0);
            let is_member = missed <= REACHED && apart.fold(0.0, f64::max) < NEARBY;
            assert!(is_same || is_member, "{of:?}: {q:?} for {solution:?}");
        } else {
            written.same(&[solution.residual], ROUNDING, of);
            for &x in solution.q {
                // Half a turn is told by the sign that rounding gives it.
                let half = (x.abs() - PI).abs() < SAME;
                let told = written.number();
                let y = if half { told.copysign(x) } else { told };
                assert!(is_same(x, y, SAME), "{of:?}: {x} in Rust, {told} here");
            }
        }
    }
    nearest_is_the_same(subject, pose, seed, &[], written);
}

/// The same of an arm that is solved by a polynomial in one joint: the regular solutions are those
/// of Rust, and of families there are members.
fn eliminated(subject: &Subject, pose: &Pose, seed: &[f64], found: i32, written: &mut Written) {
    let (rust, of) = (&subject.rust, &(subject.path, pose, seed));
    let parameters = rust.redundancy(pose, seed);
    let expected = rust.ik_at(pose, &parameters);
    let mut regular: Vec<_> = expected.iter().filter(|it| !it.singular).collect();
    if found <= 0 && rust.target() == Target::Pose {
        assert_eq!(found, why_none(pose, &parameters), "{of:?}");
    }
    let (mut singular, mut listed) = (0, Vec::new());
    for place in 0..found {
        let branch = written.integer();
        assert!(branch == place || subject.refines, "{of:?}");
        let is_singular = written.integer() != 0;
        let residual = written.number();
        let q: Vec<f64> = seed.iter().map(|_| written.number()).collect();
        let missed = rust.target().distance(&rust.fk(&q), pose, 1.0);
        assert!(missed.max(residual) <= REACHED, "{of:?}: {q:?}");
        listed.push(q.clone());
        if is_singular {
            singular += 1;
            continue;
        }
        // Those that share the kept joint are in the order of its rounding.
        let apart = |it: &[f64]| {
            let off = it.iter().zip(&q).map(|(x, y)| math::wrap(x - y).abs());
            off.fold(0.0, f64::max)
        };
        let same = regular.iter().position(|it| apart(it.q) <= SAME);
        let same = same.unwrap_or_else(|| panic!("{of:?}: {q:?} is not of {regular:?}"));
        let is_of_plan = subject.refines && (branch as usize) < rust.branches();
        let is_next = same == 0 && regular[same].branch == branch as u32;
        assert!(!is_of_plan || is_next, "{of:?}");
        regular.remove(same);
    }
    assert!(regular.is_empty(), "{of:?}: {regular:?}");
    let has_singular = expected.iter().any(|it| it.singular);
    assert_eq!(singular > 0, has_singular, "{of:?}: {expected:?}");
    nearest_is_the_same(subject, pose, seed, &listed, written);
}

/// The solution nearest to the seed, of a target that has solutions or none; those that were
/// listed of an elimination.
fn nearest_is_the_same(
    subject: &Subject,
    pose: &Pose,
    seed: &[f64],
    listed: &[Vec<f64>],
    written: &mut Written,
) {
    let of = &(subject.path, pose, seed);
    let rust = &subject.rust;
    let parameters = &rust.redundancy(pose, seed);
    let nearest = match parameters.is_empty() {
        true => rust.ik_nearest(pose, seed),
        false => rust.ik_nearest_at(pose, parameters, seed),
    };
    let found = written.integer();
    assert_eq!(found == 1, nearest.is_some(), "{of:?}");
    if let Some(nearest) = nearest {
        let q: Vec<f64> = seed.iter().map(|_| written.number()).collect();
        let missed = rust.target().distance(&rust.fk(&q), pose, 1.0);
        let solutions = rust.ik_at(pose, parameters);
        let may_be_of_family = solutions.iter().any(|it| it.singular);
        if may_be_of_family {
            assert!(missed <= REACHED, "{of:?}: {q:?}");
        }
        if !(subject.eliminates && may_be_of_family) {
            // Where solutions have met, rounding moves them along a motion that hardly moves the tip.
            let within = if nearest.singular { NEARBY } else { MET };
            for ((x, seed), told) in nearest.q.iter().zip(seed).zip(q) {
                // Half a turn may be told by either sign where a seed says nothing of it.
                let half = seed.is_nan() && (x.abs() - PI).abs() < MET;
                let y = if half { told.copysign(*x) } else { told };
                assert!(is_same(*x, y, within), "{of:?}: {x} in Rust, {told} here");
            }
            return;
        }
        // Which members of a family are found, and how far one was led along it, depends on rounding.
        // None of those that are listed is nearer.
        let moved = |q: &[f64]| {
            let joints = q.iter().zip(seed).zip(rust.limits());
            let by = joints.map(|((&q, &seed), it)| {
                let by = it.nearest(q, seed)? - seed;
                Some(if by.is_finite() { by * by } else { 0.0 })
            });
            by.sum::<Option<f64>>()
        };
        let least = listed
            .iter()
            .filter_map(|it| moved(it))
            .fold(f64::INFINITY, f64::min);
        let by = moved(&q).unwrap_or_else(|| panic!("{of:?}: {q:?} is not within limits"));
        assert!(
            by <= least + MET,
            "{of:?}: {q:?} moves by {by}, one listed by {least}"
        );
        // Beside the seed there is one.
        let is_beside = moved(&nearest.q).is_some_and(|by| by < NEARBY * NEARBY);
        assert!(!is_beside || by < NEARBY, "{of:?}: {q:?} moves by {by}");
    } else {
        // None at all, or none within limits.
        let is_reached = !rust.ik_seeded_at(pose, parameters, seed).is_empty();
        assert_eq!(found == -3, is_reached, "{of:?}");
    }
}

/// Whether the parameters of a configuration are those next to it: a swivel angle is not
/// defined everywhere.
fn is_defined(rust: &Robot, pose: &Pose, q: &[f64]) -> bool {
    let here = rust.redundancy(pose, q);
    let next: Vec<f64> = (0..).zip(q).map(|(i, q)| q + 1e-9 * f64::from(i)).collect();
    let next = rust.redundancy(pose, &next);
    let mut both = here.iter().zip(&next);
    both.all(|(x, y)| math::wrap(x - y).abs() < 1e-6)
}

/// The code of a target without solutions, all of whose entries count.
fn why_none(pose: &Pose, parameters: &[f64]) -> i32 {
    let finite = rows(pose).iter().chain(parameters).all(|x| x.is_finite());
    match pose.rotation_error() {
        _ if !finite => -1,
        1e-9.. => -2,
        _ => 0,
    }
}

#[test]
fn every_robot_is_what_it_is_in_rust() {
    let (subjects, program) = subjects();
    let input: String = subjects.iter().map(|it| it.input.as_str()).collect();
    let solved = subjects.iter().filter(|subject| subject.has_inverse);
    assert!(solved.count() > 25);
    let next = AtomicUsize::new(0);
    let compare_rest_of_js = || {
        while let Some(subject) = subjects.get(next.fetch_add(1, Ordering::Relaxed)) {
            compare_js(subject, 9);
        }
    };
    std::thread::scope(|scope| {
        scope.spawn(|| {
            if Compiler::C.is_there() {
                // An index beyond its array ends the program.
                let bounded = [
                    "-O0",
                    "-fsanitize=bounds",
                    "-fsanitize-undefined-trap-on-error",
                ];
                let built = program.build(Compiler::C, &bounded, "in_c");
                compare(&subjects, &built.run(&input));
            }
            compare_rest_of_js();
        });
        scope.spawn(|| {
            if Compiler::Cpp.is_there() {
                let only_said = ["-fsyntax-only", "-Wno-unused-command-line-argument"];
                program.build(Compiler::Cpp, &only_said, "in_cpp");
            }
            compare_rest_of_js();
        });
    });
}

/// What is inlined and done by wider vector instructions where a compiler optimizes has the same
/// results.
#[test]
fn optimized_c_is_the_same() {
    if !Compiler::C.is_there() {
        return;
    }
    // A plan, whose branches are refined, and an elimination.
    let calibrated = "tests/robots/noisy/calibrated.yaml";
    let asked = all().into_iter().find(|asked| asked.path == calibrated);
    let asked = asked.unwrap();
    let c = generated(asked.path, "arm", &asked.options);
    let rust = loaded(asked.path, &asked.options);
    let mut program = Program::new("optimized");
    program.add(&c);
    let input = Subject::new(&asked, &c, String::new(), rust).input;
    let run = |flag: &str| program.build(Compiler::C, &[flag], flag).run(&input);
    let plain = run("-O0");
    assert!(plain.split_whitespace().count() > 10_000);
    assert!(plain == run("-O2"));
    assert!(plain == run("-O3"));
}
