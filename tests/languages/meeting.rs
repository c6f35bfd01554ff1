//! What the search in JavaScript does where solutions have nearly met or share a joint, and where an
//! elimination tells nothing. Each of these makes up for mistakes in the others, so that a comparison
//! of solutions does not find them.

use crate::js::JsRobot;
use crate::random::Random;
use crate::{loaded, read, rows};
use kin_codegen::{Options, generate_js};
use kinematics::__private::math;
use kinematics::{Pose, Robot, RobotOptions};
use std::f64::consts::PI;

const ARM: &str = "robots/xarm6.yaml";

/// What statements say that stand among the functions of a robot's module, of the robot and numbers.
fn ask(given: &[f64], statements: &str) -> Vec<f64> {
    let generated = generate_js(&read(ARM), &Options::default()).unwrap();
    let among =
        format!("\nglobalThis.asked = (robot, given) => {{\n{statements}\n}};\nreturn $arm(");
    let source = generated.source.replacen("\nreturn $arm(", &among, 1);
    let asking = format!("export default {{ ask: () => asked(robot, {given:?}) }};");
    let source = source.replace("export default robot;", &asking);
    let said = JsRobot::new(&source).call("ask_of", "");
    said.split(' ').map(|x| x.parse().unwrap()).collect()
}

/// The largest difference of joints, full turns left out.
pub fn apart(a: &[f64], b: &[f64]) -> f64 {
    let off = a.iter().zip(b).map(|(x, y)| math::wrap(x - y).abs());
    off.fold(0.0, f64::max)
}

fn rust() -> Robot {
    loaded(ARM, &RobotOptions::default())
}

/// Of solutions that have nearly met, as Rust has them, either leads to next to the other, to second
/// order, and from there to the other itself.
#[test]
fn solutions_that_have_nearly_met_show_each_other() {
    let rust = rust();
    let mut random = Random::new(23);
    let mut pairs = Vec::new();
    while pairs.len() < 24 {
        let q: Vec<f64> = (0..6).map(|_| random.angle()).collect();
        let pose = rust.fk(&q);
        let found = rust.ik(&pose);
        let near = found
            .iter()
            .find(|it| (2e-3..0.1).contains(&apart(it.q, &q)));
        pairs.extend(near.map(|it| (pose, q, it.q.to_vec())));
    }
    let given = pairs
        .iter()
        .flat_map(|(pose, q, _)| [rows(pose), q.clone()].concat());
    let said = ask(
        &given.collect::<Vec<f64>>(),
        "const { form } = robot;
        return Array.from({ length: given.length / 18 }, (_, k) => {
            const search = $begin(form, given.slice(18 * k, 18 * k + 12));
            const q = given.slice(18 * k + 12, 18 * k + 18);
            const starts = $split(form.search, search.target, q);
            search.meeting = 1.0;
            $insert_new(search, $polish(form.search, search.target, q, 6));
            $meet(search);
            const others = search.regular.slice(1, 4).map((it) => it.q);
            return [...starts, ...others, q, q, q].slice(0, 6);
        }).flat().flatMap((q) => Array.from(q));",
    );
    assert_eq!(said.len(), 36 * pairs.len());
    for ((_, q, other), said) in pairs.iter().zip(said.chunks(36)) {
        let missed = |some: &[f64]| {
            let each = some.chunks(6).map(|start| apart(start, other));
            each.fold(f64::INFINITY, f64::min)
        };
        let (starts, found) = said.split_at(18);
        let between = apart(q, other);
        assert!(missed(starts) < 0.2 * between, "{q:?}: {starts:?}");
        assert!(missed(found) < 1e-9, "{q:?}: {found:?}");
    }
}

/// Two and four solutions that share the kept joint, as mixed as what a matrix takes to zero: the
/// vectors of their monomials are told apart, of four as well as starts of Newton's method need it.
#[test]
fn solutions_that_share_a_joint_are_told_apart() {
    let said = ask(
        &[],
        "const { search: { eliminations: [elimination] } } = robot.form;
        let seed = 7;
        const random = () => (seed = (seed * 16807) % 2147483647) / 1073741824 - 1;
        const vector_of = ([x, y]) => {
            const vector = new Float64Array(16);
            for (let i = 0; i <= elimination.powers[0]; ++i) {
                for (let j = 0; j <= elimination.powers[1]; ++j) {
                    vector[$column(elimination, i, j)] = x ** i * y ** j;
                }
            }
            $normalize(vector);
            return vector;
        };
        const missed = (n) => {
            const vectors = Array.from({ length: n }, () => vector_of([2 * random(), 2 * random()]));
            const space = [];
            for (let k = 0; k < n; ++k) {
                const mixed = new Float64Array(16);
                vectors.forEach((vector) => {
                    const share = random();
                    vector.forEach((x, i) => (mixed[i] += share * x));
                });
                space.forEach((before) => {
                    const along = $dot(before, mixed);
                    before.forEach((x, i) => (mixed[i] -= along * x));
                });
                $normalize(mixed);
                space.push(mixed);
            }
            const { vectors: found } = $monomial_vectors(elimination, space, $RATIOS[0]);
            return vectors.map((vector) => Math.min(...found.map((it) => {
                $normalize(it);
                return 1 - Math.abs($dot(it, vector));
            })));
        };
        return [2, 2, 2, 2, 4, 4, 4, 4].flatMap(missed);",
    );
    let (pairs, fours) = said.split_at(8);
    assert!(pairs.iter().all(|x| x.abs() < 1e-12), "{pairs:?}");
    assert!(
        fours.len() == 16 && fours.iter().all(|x| x.abs() < 1e-3),
        "{fours:?}"
    );
}

/// All solutions of a target that Rust has are found from targets beside it, and by the second
/// elimination where the polynomial of the first is noise.
#[test]
fn where_an_elimination_tells_nothing_others_do() {
    let rust = rust();
    let mut random = Random::new(29);
    let configurations = (0..8).map(|_| (0..6).map(|_| random.angle()).collect::<Vec<f64>>());
    let poses: Vec<_> = configurations.map(|q| rust.fk(&q)).collect();
    let given: Vec<f64> = poses.iter().flat_map(rows).collect();
    let said = ask(
        &given,
        "const { form } = robot;
        const [first] = form.search.eliminations;
        const poses = Array.from({ length: given.length / 12 }, (_, k) => given.slice(12 * k, 12 * k + 12));
        const told = (found) => [found.length, ...found.flatMap(({ q }) => Array.from(q))];
        const beside = poses.flatMap((pose) => {
            const search = $begin(form, pose);
            $ask_beside(search, first);
            return told(search.regular);
        });
        /* The harmonics above have to vanish. */
        first.degree = 2;
        return [...beside, ...poses.flatMap((pose) => told(robot.ik(pose)))];",
    );
    let mut said = said.into_iter();
    for pose in poses.iter().chain(&poses) {
        let count = said.next().unwrap() as usize;
        let found: Vec<f64> = said.by_ref().take(6 * count).collect();
        for solution in rust.ik(pose).iter() {
            let mut all = found.chunks(6);
            assert!(
                all.any(|q| apart(q, solution.q) < 1e-9),
                "{pose:?}: {solution:?}"
            );
        }
    }
    assert!(said.next().is_none());
}

/// Where the tool points straight down, solutions share values of the kept joint, and so do complex ones,
/// which are told from these: hardly ever a second elimination has to be asked.
#[test]
fn one_elimination_is_sure_where_the_tool_points_down() {
    let rust = rust();
    let mut random = Random::new(31);
    let down = |q: &[f64]| {
        let turned = Pose::from_rpy([PI, 0.0, q[5]], [0.0; 3]);
        Pose {
            translation: rust.fk(q).translation,
            ..turned
        }
    };
    let configurations = (0..120).map(|_| (0..6).map(|_| random.angle()).collect::<Vec<f64>>());
    let poses = configurations.map(|q| down(&q));
    let poses: Vec<_> = poses.filter(|pose| !rust.ik(pose).is_empty()).collect();
    let given: Vec<f64> = poses.iter().flat_map(rows).collect();
    let said = ask(
        &given,
        "const { form } = robot;
        const [first] = form.search.eliminations;
        const poses = Array.from({ length: given.length / 12 }, (_, k) => given.slice(12 * k, 12 * k + 12));
        return poses.map((pose) => Number($ask($begin(form, pose), first)));",
    );
    let sure: f64 = said.iter().sum();
    assert!(
        said.len() > 50 && sure > 0.9 * said.len() as f64,
        "{said:?}"
    );
}
