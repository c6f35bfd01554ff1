//! Parallel mechanisms as C, as C++ and as JavaScript: what the interpreter and the runtime have.

use crate::js::JsRobot;
use crate::meeting::apart;
use crate::program::{Compiler, END, Program, generated};
use crate::{Written, by_rows, read, rows, write};
use kin_codegen::closed_form::ClosedForm;
use kin_codegen::mechanism::{CompiledMechanism, ForwardMethod};
use kin_codegen::{Compiled, GeneratedJs, Options, compile};
use kinematics::__private::math;
use kinematics::Twist;
use std::f64::consts::PI;

const SIX_LEGS: &str = "robots/stewart.yaml";
const SLIDER_CRANK: &str = "robots/slider_crank.yaml";

/// Its chains have no closed form.
const TWO_ARMS: &str = "tests/robots/two_arms.yaml";

const LARGE: [&str; 3] = [
    SIX_LEGS,
    "tests/robots/led.yaml",
    "tests/robots/calibrated_loop.yaml",
];

const MECHANISMS: [&str; 8] = [
    "robots/delta.yaml",
    "robots/five_bar.yaml",
    "robots/four_bar.yaml",
    SLIDER_CRANK,
    SIX_LEGS,
    "tests/robots/uneven_delta.yaml",
    "tests/robots/led.yaml",
    "tests/robots/calibrated_loop.yaml",
];

/// The mechanism of a file, and the JavaScript of it.
fn both(path: &str) -> (CompiledMechanism, JsRobot) {
    let (source, options) = (read(path), Options::default());
    let robot = compile(&source, &options).unwrap();
    let js = JsRobot::new(&GeneratedJs::of(robot.clone(), &source, &options).source);
    match robot {
        Compiled::Mechanism(mechanism) => (*mechanism, js),
        Compiled::Arm(_) => panic!("{path} is an arm"),
    }
}

/// Closed configurations, no two the same.
fn samples(mechanism: &CompiledMechanism) -> Vec<Vec<f64>> {
    let samples = &mechanism.freedom.samples;
    samples
        .iter()
        .step_by(1 + samples.len() / 12)
        .cloned()
        .collect()
}

#[test]
fn all_chains_have_all_their_solutions() {
    for path in MECHANISMS.into_iter().chain([TWO_ARMS]) {
        let (mechanism, js) = both(path);
        let generic = mechanism.mechanism.generic();
        let mut targets: Vec<_> = samples(&mechanism)
            .iter()
            .map(|q| generic.poses(q)[0])
            .collect();
        let mut far = targets[0];
        far.translation[0] += 90.0;
        targets.push(far);
        let mut input = format!("{}\n", targets.len());
        targets.iter().for_each(|it| write(&mut input, &rows(it)));
        let said = js.call("placed_of", &input);
        let mut said = Written(said.split_ascii_whitespace());
        let mut solved = 0;
        for target in &targets {
            let placed = mechanism.solutions(target);
            let of = &(path, target);
            assert_eq!(said.integer() as usize, placed.len(), "{of:?}");
            for placed in placed {
                said.same(&rows(&placed.pose), 1e-11, of);
                // Any solution of a chain goes with any of the others.
                for pick in [0, usize::MAX] {
                    let chains = placed.solutions.iter();
                    let q = chains.map(|all| all[pick.min(all.len() - 1)].clone());
                    let gap = generic.gap(&q.collect::<Vec<_>>().concat());
                    assert!(gap < 1e-8 * generic.length(), "{of:?}: {gap}");
                }
                for solutions in &placed.solutions {
                    assert_eq!(said.integer() as usize, solutions.len(), "{of:?}");
                    let in_js = solutions
                        .iter()
                        .map(|q| q.iter().map(|_| said.number()).collect());
                    let mut in_js: Vec<Vec<f64>> = in_js.collect();
                    // Of an elimination, roots at half a turn may come first or last.
                    for q in solutions {
                        let same = |other: &Vec<f64>| apart(q, other) < 1e-6;
                        let place = in_js.iter().position(same);
                        in_js.swap_remove(
                            place.unwrap_or_else(|| panic!("{of:?}: {q:?}, {in_js:?}")),
                        );
                    }
                    solved += solutions.len();
                }
            }
        }
        assert!(said.0.next().is_none());
        assert!(solved > 20, "{path}: {solved}");
    }
}

#[test]
fn loops_are_closed() {
    for path in MECHANISMS {
        let (mechanism, js) = both(path);
        let generic = mechanism.mechanism.generic();
        let samples = samples(&mechanism);
        let mut input = format!("{}\n", samples.len());
        samples.iter().for_each(|q| write(&mut input, q));
        let said = js.call("closed_of", &input);
        let mut said = Written(said.split_ascii_whitespace());
        let length = generic.length();
        let mut closed = 0;
        for q in &samples {
            let of = &(path, q);
            assert!(
                said.number() < 1e-9 * length,
                "{of:?}: was not seen to be closed"
            );
            let residual = said.number();
            let found: Vec<f64> = q.iter().map(|_| said.number()).collect();
            let gap = generic.gap(&found);
            assert!(
                (gap - residual).abs() < 1e-6 * residual + 1e-12 * length,
                "{of:?}: {gap}, {residual}"
            );
            for (i, joint) in mechanism.mechanism.actuated().into_iter().enumerate() {
                let moved = q[joint] + 0.01 * (i % 3) as f64 - 0.01;
                assert!((found[joint] - moved).abs() < 1e-15, "{of:?}");
            }
            closed += usize::from(residual < 1e-9 * length);
        }
        // Some of the samples are where the drives cannot go on.
        assert!(
            10 * closed >= 8 * samples.len(),
            "{path}: {closed} of {}",
            samples.len()
        );
    }
}

/// The sine of half a turn is that of none.
#[test]
fn ends_half_a_turn_apart_are_not_closed() {
    let (mechanism, js) = both("robots/five_bar.yaml");
    for turn in [PI, PI - 1e-9, 1.0, 0.0] {
        let q = [0.0, 0.0, 0.0, 0.0, turn];
        let mut input = String::new();
        write(&mut input, &q);
        let said: f64 = js.call("gap_of", &input).trim().parse().unwrap();
        let gap = mechanism.mechanism.generic().gap(&q);
        assert!((said - gap).abs() < 1e-9, "{turn}: {said}, {gap}");
    }
}

/// Where crank and rod are in one line, and the rod can undo what the crank does.
fn dead_centre(slider_crank: &CompiledMechanism) -> Vec<f64> {
    let generic = slider_crank.mechanism.generic();
    let samples = &slider_crank.freedom.samples;
    let crank = (0.2_f64 / 4.0).asin();
    let found = samples.iter().find_map(|q| generic.fk_near(&[crank], q));
    let q = found.unwrap();
    assert!(generic.inverse_jacobian(&q).is_none());
    q
}

#[test]
fn c_has_what_the_runtime_has() {
    // Some things a compiler only sees where it optimizes; large ones take it half a minute.
    let (large, others): (Vec<&str>, _) = MECHANISMS.iter().partition(|it| LARGE.contains(it));
    for (name, paths, optimized) in [("mechanisms", others, "-O2"), ("large", large, "-O0")] {
        let compilers = [
            (Compiler::C, optimized, "of_c"),
            (Compiler::Cpp, "-O0", "of_cpp"),
        ];
        holds_in(name, &paths, &compilers);
    }
}

#[test]
fn c_has_chains_without_a_closed_form() {
    holds_in("two_arms", &[TWO_ARMS], &[(Compiler::C, "-O0", "of_c")]);
}

/// Holds mechanisms against the runtime and the interpreter, as compilers make them.
fn holds_in(name: &str, paths: &[&str], compilers: &[(Compiler, &str, &str)]) {
    let mut program = Program::new(name);
    let (mut input, mut all) = (String::new(), Vec::new());
    for (number, path) in paths.iter().enumerate() {
        let c = generated(path, &format!("robot{number}"), &Options::default());
        assert_eq!(c.warnings, [], "{path}");
        program.add(&c);
        let Compiled::Mechanism(mechanism) = c.robot else {
            panic!("{path} is an arm")
        };
        let mut samples = samples(&mechanism);
        if *path == SLIDER_CRANK {
            samples.push(dead_centre(&mechanism));
        }
        input += &format!("{}\n", samples.len());
        samples.iter().for_each(|q| write(&mut input, q));
        all.push((path, mechanism, samples));
    }
    let there = compilers.iter().filter(|(it, ..)| it.is_there());
    let said: Vec<String> = there
        .map(|(compiler, flag, name)| program.build(*compiler, &[flag], name).run(&input))
        .collect();
    assert!(said.windows(2).all(|it| it[0] == it[1]), "C++ differs");
    if let Some(said) = said.first() {
        let mut said = Written(said.split_ascii_whitespace());
        for (path, mechanism, samples) in &all {
            for q in samples {
                holds(mechanism, q, &mut said, &(path, q));
            }
            assert_eq!(said.0.next(), Some(END));
        }
        assert!(said.0.next().is_none());
    }
}

/// Holds what C has of a closed configuration against the runtime and the interpreter.
fn holds(mechanism: &CompiledMechanism, q: &[f64], said: &mut Written, of: &impl std::fmt::Debug) {
    let generic = mechanism.mechanism.generic();
    let (length, ranges) = (generic.length(), mechanism.mechanism.ranges());
    let poses = generic.poses(q);
    for pose in &poses {
        said.same(&rows(pose), 1e-12, of);
    }
    let gap = said.number();
    assert!(
        (gap - generic.gap(q)).abs() < 1e-13 * length,
        "{of:?}: {gap}"
    );
    assert_eq!(said.integer(), 0, "{of:?}");
    let twists = generic.twists(q);
    said.same(&by_rows(&twists), 1e-12, of);
    let actuator = generic.actuator_singularity(q);
    said.same(&[actuator], 1e-11, of);
    let mobility = mechanism.freedom.mobility;
    said.same(&[generic.kinematic_singularity(q, mobility)], 1e-11, of);

    // Nearer to singularities these have fewer digits.
    let near = 1e-12 / actuator.max(1e-3);
    let forward = generic.forward_jacobian(q);
    assert_eq!(said.integer(), i32::from(forward.is_some()), "{of:?}");
    if let Some(forward) = &forward {
        said.same(&by_rows(forward), near, of);
    }
    let inverse = generic.inverse_jacobian(q);
    assert_eq!(said.integer(), i32::from(inverse.is_some()), "{of:?}");
    if let Some(inverse) = &inverse {
        said.same(&inverse.concat(), 1e-8, of);
    }
    assert_eq!(said.integer(), i32::from(forward.is_some()), "{of:?}");
    if let Some(forward) = &forward {
        let rates: Vec<f64> = q.iter().map(|_| said.number()).collect();
        let velocity = |columns: &[Twist], rates: &[f64]| {
            let all = columns.iter().zip(rates);
            let sum = all.fold(Twist::default(), |sum, (column, rate)| {
                sum + *column * *rate
            });
            sum.to_array()
        };
        let driven: Vec<f64> = (0..forward.len()).map(|a| 1.0 - 0.3 * a as f64).collect();
        let platform = velocity(forward, &driven);
        for [first, end] in &ranges {
            let chain = velocity(&twists[*first..*end], &rates[*first..*end]);
            let far = chain.iter().zip(platform).map(|(a, b)| (a - b).abs());
            assert!(
                far.fold(0.0, f64::max) < 1e4 * near,
                "{of:?}: {chain:?} {platform:?}"
            );
        }
        for (joint, rate) in mechanism.mechanism.actuated().into_iter().zip(&driven) {
            assert!((rates[joint] - rate).abs() < 1e4 * near, "{of:?}: {joint}");
        }
    }

    let actuated = mechanism.mechanism.actuated();
    let moved = actuated.iter().enumerate();
    let moved: Vec<f64> = moved
        .map(|(a, j)| q[*j] + 0.01 * (a % 3) as f64 - 0.01)
        .collect();
    let expected = generic.fk_near(&moved, q);
    let is_closed = said.integer() == 1;
    let found: Vec<f64> = q.iter().map(|_| said.number()).collect();
    if is_closed {
        assert!(generic.gap(&found) < 1e-11 * length, "{of:?}");
    }
    if let (true, Some(expected)) = (actuator > 1e-2, expected) {
        assert!(
            is_closed && agree(&expected, &found, 1e-7),
            "{of:?}: {found:?} {expected:?}"
        );
    }
    said.integer();

    postures(mechanism, q, said, of);
    assemblies(mechanism, q, said, of);
}

fn agree(a: &[f64], b: &[f64], tolerance: f64) -> bool {
    a.iter()
        .zip(b)
        .all(|(a, b)| math::wrap(a - b).abs() < tolerance)
}

fn postures(
    mechanism: &CompiledMechanism,
    q: &[f64],
    said: &mut Written,
    of: &impl std::fmt::Debug,
) {
    let generic = mechanism.mechanism.generic();
    let ranges = mechanism.mechanism.ranges();
    let placed = mechanism.solutions(&generic.poses(q)[0]);
    let count = said.integer();
    let all = placed
        .iter()
        .map(|it| it.solutions.iter().map(Vec::len).product::<usize>());
    assert_eq!(count as usize, all.sum::<usize>(), "{of:?}");
    let mut found = Vec::new();
    for [first, end] in &ranges {
        let rows: Vec<(usize, Vec<f64>)> = (0..said.integer())
            .map(|_| {
                let place = said.integer() as usize;
                (place, (*first..*end).map(|_| said.number()).collect())
            })
            .collect();
        found.push(rows);
    }
    for (chain, rows) in found.iter().enumerate() {
        for solution in placed.iter().flat_map(|placed| &placed.solutions[chain]) {
            let is_there = rows.iter().any(|(_, q)| agree(q, solution, 1e-6));
            assert!(is_there, "{of:?}: {solution:?} of chain {chain} is lost");
        }
    }
    let worst = said.number();
    assert!(worst < 1e-8 * generic.length(), "{of:?}: {worst}");
    assert_eq!(said.integer(), 0, "one more than there are");
    let by_number = (0..count.min(16)).map(|_| q.iter().map(|_| said.number()).collect());
    let by_number: Vec<Vec<f64>> = by_number.collect();
    for (i, one) in by_number.iter().enumerate() {
        assert!(!by_number[..i].contains(one), "{of:?}: {i} again");
    }
    let nearest = said.integer();
    let chosen: Vec<f64> = q.iter().map(|_| said.number()).collect();
    let legs = &mechanism.mechanism.legs;
    let limits = legs.iter().flat_map(|leg| &leg.model.variables);
    let is_inside = limits.zip(q).all(|(variable, x)| {
        variable
            .limits
            .is_none_or(|[low, high]| (low..=high).contains(x))
    });
    if is_inside && generic.inverse_jacobian(q).is_some() {
        assert_eq!(nearest, 1, "{of:?}");
        assert!(generic.gap(&chosen) < 1e-8 * generic.length());
        let motion = |to: &[f64]| -> f64 {
            let apart = to.iter().zip(q).map(|(a, b)| (a - b - 0.02).powi(2));
            apart.sum()
        };
        assert!(motion(&chosen) <= motion(q) + 1e-7, "{of:?}: {chosen:?}");
    }
    // Slides without limits reach it, and the file's do not.
    let mut far = generic.poses(q)[0];
    far.translation[0] += 90.0;
    let placed = mechanism.solutions(&far);
    let all = placed
        .iter()
        .map(|it| it.solutions.iter().map(Vec::len).product::<usize>());
    assert_eq!(said.integer() as usize, all.sum::<usize>(), "{of:?}");
    assert_eq!(said.integer(), 0, "{of:?}");
}

fn assemblies(
    mechanism: &CompiledMechanism,
    q: &[f64],
    said: &mut Written,
    of: &impl std::fmt::Debug,
) {
    if mechanism.forward.assembly_modes() == 0 {
        return;
    }
    let generic = mechanism.mechanism.generic();
    let actuated = mechanism.mechanism.actuated();
    let count = said.integer();
    assert!(
        count as usize <= mechanism.forward.assembly_modes(),
        "{of:?}: {count}"
    );
    // An elimination beside the branches numbers what it finds from these on.
    let numbers = match &mechanism.forward {
        ForwardMethod::Loop(found) => {
            match found.passive.form().and_then(ClosedForm::elimination) {
                Some(_) => found.passive.branches() + mechanism.forward.assembly_modes(),
                None => found.passive.branches(),
            }
        }
        _ => mechanism.forward.assembly_modes(),
    };
    let mut is_among = false;
    let mut last = -1;
    let here = generic.poses(q)[0];
    for _ in 0..count {
        let branch = said.integer();
        assert!(branch > last, "{of:?}: {branch} after {last}");
        assert!((branch as usize) < numbers, "{of:?}: {branch}");
        last = branch;
        let residual = said.number();
        let found: Vec<f64> = q.iter().map(|_| said.number()).collect();
        let gap = generic.gap(&found);
        assert!(
            (gap - residual).abs() < 1e-3 * residual + 1e-13,
            "{of:?}: {gap}, {residual}"
        );
        assert!(gap < 1e-8 * generic.length(), "{of:?}: {gap}");
        for joint in &actuated {
            assert!(
                agree(&[found[*joint]], &[q[*joint]], 1e-6),
                "{of:?}: {joint}"
            );
        }
        let pose = generic.poses(&found)[0];
        let off = pose
            .translation_distance(&here)
            .max(pose.rotation_distance(&here));
        is_among |= off < 1e-6;
    }
    // Where two have met, the root of rounding is what is left of their distance.
    assert!(
        is_among || generic.actuator_singularity(q) < 1e-3,
        "{of:?}: not among {count}"
    );
}
