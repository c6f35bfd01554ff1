//! Arms of six joints whose axes were drawn at random, read at run time: what the plan search
//! and the elimination make of them, against the numerical search.

mod random;

use kinematics::{Chain, Pose, Robot, RobotOptions, RobotSource, SearchOptions, Twist};
use nalgebra::DMatrix;
use random::Random;
use std::f64::consts::TAU;

/// How an axis lies to the one before it.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Neighbour {
    Parallel,
    Intersecting,
    General,
}

use Neighbour::{General, Intersecting, Parallel};

/// Below this conditioning of one of its solutions a target is passed over: the search may miss it.
const REGULAR: f64 = 1e-3;
/// The search accepts what is this close to the target; conditioning magnifies it.
const SEARCH: f64 = 1e-10;

/// Number `i` of the 3⁵.
fn pattern(i: usize) -> [Neighbour; 5] {
    [0, 1, 2, 3, 4].map(|k| [General, Parallel, Intersecting][i / 3_usize.pow(k) % 3])
}

struct Arm {
    chain: Chain,
    slides: [bool; 6],
    text: String,
}

impl Arm {
    /// Denavit and Hartenberg's parameters are drawn, and the frame that the base stands in.
    fn new(pattern: &[Neighbour; 5], slides: [bool; 6], random: &mut Random) -> Arm {
        let mut side = || random.between(0.2, 0.7) * if random.angle() < 0.0 { -1.0 } else { 1.0 };
        let mut link = |neighbour| match neighbour {
            Parallel => dh(side(), side(), 0.0),
            Intersecting => dh(side(), 0.0, 2.0 * side()),
            General => dh(side(), side(), 2.0 * side()),
        };
        let anywhere = Pose::from_axis_angle([0.48, -0.6, 0.64], 2.0, [0.0; 3]);
        let mut pose = anywhere * link(General);
        let mut twists = Vec::new();
        let mut screws = String::new();
        for (i, slides) in slides.into_iter().enumerate() {
            let (axis, point) = (pose.rotate([0.0, 0.0, 1.0]), pose.translation);
            screws += &match slides {
                true => format!("- {{name: q{i}, axis: {axis:?}, type: prismatic}}\n"),
                false => format!("- {{name: q{i}, axis: {axis:?}, point: {point:?}}}\n"),
            };
            twists.push(match slides {
                true => Twist::prismatic(axis),
                false => Twist::revolute(axis, point),
            });
            pose = pose * link(pattern.get(i).copied().unwrap_or(General));
        }
        Arm {
            chain: Chain::new(twists, pose),
            slides,
            text: format!(
                "robot: drawn\nunits: {{angle: rad, length: m}}\nscrews:\n{screws}\
                 home: {{xyz: {:?}, matrix: {:?}}}\n",
                pose.translation, pose.rotation
            ),
        }
    }

    fn load(&self) -> Result<Robot, String> {
        let source = RobotSource {
            path: "drawn.yaml".into(),
            text: self.text.clone(),
        };
        Robot::load(&source, &RobotOptions::default()).map_err(|error| error.to_string())
    }

    /// The least singular value of the Jacobian; dimensions are about a metre.
    fn conditioning(&self, q: &[f64]) -> f64 {
        let columns = self.chain.geometric_jacobian(q);
        singular_values::of(DMatrix::from_fn(6, 6, |i, j| columns[j].to_array()[i]))[5]
    }

    /// Whether there is no configuration in which the tip can move in all directions.
    fn is_singular_everywhere(&self, random: &mut Random) -> bool {
        (0..20).all(|_| self.conditioning(&anywhere(random)) < 1e-9)
    }

    fn apart(&self, a: &[f64], b: &[f64]) -> f64 {
        let apart = |i: usize| {
            let d = (a[i] - b[i]).abs();
            match self.slides[i] {
                true => d,
                false => (d % TAU).min(TAU - d % TAU),
            }
        };
        (0..6).map(apart).fold(0.0, f64::max)
    }

    /// The answers to a target are its solutions, one to one. `None` where one is too near to a
    /// singular configuration to tell.
    fn is_solved(&self, robot: &Robot, q: &[f64; 6]) -> Option<bool> {
        let target = self.chain.fk(q);
        let answers = robot.ik(&target);
        for answer in answers.iter() {
            let reached = self.chain.fk(answer.q);
            let miss = reached.translation_distance(&target) + reached.rotation_distance(&target);
            assert!(
                miss < 1e-9,
                "{}{q:?}: {answer:?} is off by {miss:e}",
                self.text
            );
        }
        let found = self.chain.ik_all(&target, &SearchOptions::default());
        let singular = |q: &[f64]| self.conditioning(q) < REGULAR;
        if answers.iter().any(|answer| singular(answer.q))
            || found.iter().any(|solution| singular(&solution.q))
        {
            return None;
        }
        let matches = |solution: &[f64]| {
            let tolerance = SEARCH / self.conditioning(solution);
            let same = answers
                .iter()
                .filter(|answer| self.apart(answer.q, solution) < tolerance);
            same.count() == 1
        };
        let all_found = found.iter().all(|solution| matches(&solution.q)) && matches(q);
        Some(all_found && answers.len() == found.len())
    }
}

/// From one axis to the next.
fn dh(d: f64, a: f64, alpha: f64) -> Pose {
    Pose::from_axis_angle([1.0, 0.0, 0.0], alpha, [a, 0.0, d])
}

fn anywhere(random: &mut Random) -> [f64; 6] {
    std::array::from_fn(|_| random.angle())
}

/// Reads an arm and tries targets until enough of them could be told. The number of targets that
/// were passed over.
fn assert_solved(arm: &Arm, targets: usize, random: &mut Random) -> usize {
    let robot = arm
        .load()
        .unwrap_or_else(|error| panic!("{}{error}", arm.text));
    let (mut told, mut passed) = (0, 0);
    while told < targets {
        let q = anywhere(random);
        match arm.is_solved(&robot, &q) {
            Some(solved) => {
                assert!(
                    solved,
                    "{}{q:?}: {:#?}",
                    arm.text,
                    robot.ik(&arm.chain.fk(&q))
                );
                told += 1;
            }
            None => passed += 1,
        }
        assert!(passed < 20, "{}", arm.text);
    }
    passed
}

#[test]
fn two_hundred_general_arms() {
    let mut random = Random::new(31);
    let mut passed = 0;
    for _ in 0..200 {
        let arm = Arm::new(&[General; 5], [false; 6], &mut random);
        passed += assert_solved(&arm, 2, &mut random);
    }
    assert!(
        passed < 40,
        "{passed} of {} targets were passed over",
        passed + 400
    );
}

/// Half of them have one, two or three slides. Where no configuration is regular, a joint is free.
#[test]
fn a_hundred_patterns_of_neighbours() {
    let mut random = Random::new(32);
    let mut regular = 0;
    for i in 0..122 {
        let mut slides = [false; 6];
        for _ in 0..if i % 2 == 0 { 0 } else { 1 + i % 3 } {
            slides[random.below(6)] = true;
        }
        let arm = Arm::new(&pattern(2 * i + 1), slides, &mut random);
        if arm.is_singular_everywhere(&mut random) {
            assert_recovered(&arm, &mut random);
        } else {
            assert_solved(&arm, 2, &mut random);
            regular += 1;
        }
    }
    assert!(regular >= 100, "{regular}");
}

/// The joints come back where the free one is given.
fn assert_recovered(arm: &Arm, random: &mut Random) {
    let robot = arm
        .load()
        .unwrap_or_else(|error| panic!("{}{error}", arm.text));
    for _ in 0..4 {
        let q = anywhere(random);
        let target = arm.chain.fk(&q);
        let answers = robot.ik_at(&target, &robot.redundancy(&target, &q));
        let comes_back = answers.iter().any(|answer| arm.apart(answer.q, &q) < 1e-6);
        assert!(comes_back, "{}{q:?}: {answers:#?}", arm.text);
    }
}
