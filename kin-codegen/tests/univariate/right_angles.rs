//! Arms of right angles, at which the equations of an elimination depend on each other.

use super::arms::anywhere;
use kin_codegen::certificate::recovered;
use kin_codegen::closed_form::ClosedForm;
use kin_codegen::geometry::{Linkage, conditioning, size};
use kin_codegen::model::Model;
use kin_codegen::plan::Target;
use kin_codegen::random::Random;
use kin_codegen::solver::{Certified, solve};
use kin_codegen::spec::{ArmSpec, Source};
use kin_codegen::univariate::Arm;
use kin_runtime::{Pose, SearchOptions};
use std::f64::consts::FRAC_PI_2;

/// Of six links: Denavit and Hartenberg's d, a and α.
fn model(links: [[f64; 3]; 6]) -> Model {
    let mut frame = Pose::IDENTITY;
    let mut text = String::from("robot: arm\nunits: {angle: rad, length: m}\nscrews:\n");
    for (i, [d, a, alpha]) in links.into_iter().enumerate() {
        let (axis, point) = (frame.rotation.map(|row| row[2]), frame.translation);
        text += &format!("- {{name: j{i}, axis: {axis:?}, point: {point:?}}}\n");
        frame = frame * Pose::from_axis_angle([1.0, 0.0, 0.0], alpha, [a, 0.0, d]);
    }
    let (xyz, matrix) = (frame.translation, frame.rotation);
    text += &format!("home: {{xyz: {xyz:?}, matrix: {matrix:?}}}\n");
    let path = "arm.yaml".into();
    let spec = ArmSpec::parse(&Source { path, text }).unwrap();
    Model::new(&spec, None, None).unwrap()
}

fn solved(model: &Model) -> ClosedForm {
    let Certified { form, certificate } =
        solve(model, &Linkage::new(model), Target::Pose).expect("a plan");
    assert_eq!(certificate.lost, 0);
    form
}

/// Links of these lengths, each axis at a right angle to the one before, this way or that.
fn snake(lengths: [f64; 5], ways: [f64; 5]) -> Model {
    model(std::array::from_fn(|i| match i {
        5 => [0.0, 0.1, 0.0],
        _ => [0.0, lengths[i], ways[i] * FRAC_PI_2],
    }))
}

/// Two equal links of a snake and the joint between them move the axis behind in seven
/// independent ways, and where that joint is folded a polynomial in it vanishes whatever the
/// target.
#[test]
fn nothing_is_lost_of_snakes() {
    let (by_turns, alike) = ([1.0, -1.0, 1.0, -1.0, 1.0], [1.0; 5]);
    let mut random = Random(31);
    for (lengths, ways, most) in [
        ([0.1; 5], by_turns, 4),
        ([0.1; 5], alike, 4),
        ([0.1, 0.1, 0.15, 0.1, 0.1], by_turns, 16),
        ([0.1, 0.1, 0.15, 0.15, 0.2], by_turns, 16),
        ([0.1, 0.12, 0.15, 0.07, 0.2], by_turns, 16),
    ] {
        let model = snake(lengths, ways);
        let (form, chain, size) = (solved(&model), model.chain(), size(&model));
        for k in 0..400 {
            let q = anywhere(&mut random);
            let target = chain.fk(&q);
            let solutions = form.solutions(&target);
            let conditioning = conditioning(&chain, &q, size, Target::Pose);
            let back = recovered(&model, &q, &solutions, conditioning);
            assert!(conditioning < 1e-5 || back.is_ok(), "{lengths:?} {back:?}");
            let singular = solutions.iter().any(|solution| solution.singular);
            assert!(singular || solutions.len() <= most, "{lengths:?} {q:?}");
            if k < 3 {
                let all = chain.ik_all(&target, &SearchOptions::default());
                assert_eq!(solutions.len(), all.len(), "{lengths:?} {q:?}");
            }
        }
    }
}

/// A joint by the angle to the next axis, a quarter turn or none, and whether there are a length
/// a and an offset d.
fn joint(word: &str) -> [f64; 3] {
    let has = |letter| f64::from(u8::from(word.contains(letter)));
    let way = has('+') - has('-');
    [0.2 * has('d'), 0.3 * has('a'), way * FRAC_PI_2]
}

/// Next to families of solutions a polynomial drowns; one in another joint does not.
#[test]
fn what_one_elimination_loses_another_finds() {
    for [a, b, c, d, e, f] in [
        ["-d", "+a", "-a", "+", "+ad", "ad"],
        ["-ad", "+", "-d", "+a", "-d", "d"],
        ["+", "+d", "-a", "-", "-a", "-"],
        ["-", "a", "-a", "-", "-a", "d"],
        ["ad", "+ad", "-", "+a", "ad", "ad"],
    ] {
        solved(&model([a, b, c, d, e, f].map(joint)));
    }
}

/// The matrix takes two vectors nearly to zero where one root is real and two others, which are
/// complex and of no solution, are 3e-4 beside it.
#[test]
fn roots_beside_complex_ones_are_not_extraneous() {
    let model = model(["-a", "-d", "-ad", "+ad", "ad", "+d"].map(joint));
    let q = [
        -1.570796331948987,
        3.1415926632388644,
        -1.5707963173577206,
        -1.5707963316532392,
        1.5707963234552873,
        -1.5707963280776196,
    ];
    let target = model.chain().fk(&q);
    let mut arms = Arm::keeping_each(&model, &Linkage::new(&model)).into_iter();
    let arm = arms.find(|arm| arm.kept[0].elimination.joints[0] == 4);
    assert_eq!(arm.unwrap().solutions::<6>(&target).len(), 4);
}
