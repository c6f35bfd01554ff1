//! Parallel mechanisms as JavaScript: what the interpreter has.

use crate::js::JsRobot;
use crate::{Written, read, rows, write};
use kin_codegen::mechanism::CompiledMechanism;
use kin_codegen::{Compiled, GeneratedJs, Options, compile};

const MECHANISMS: [&str; 5] = [
    "robots/delta.yaml",
    "robots/five_bar.yaml",
    "robots/four_bar.yaml",
    "robots/slider_crank.yaml",
    "robots/stewart.yaml",
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
    for path in MECHANISMS {
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
                for solutions in &placed.solutions {
                    assert_eq!(said.integer() as usize, solutions.len(), "{of:?}");
                    solutions.iter().for_each(|q| said.same(q, 1e-6, of));
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
                (gap - residual).abs() < 1e-3 * residual + 1e-12 * length,
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
