//! The swivel angle: told by points of the generic chain, with other formulas than the
//! runtime's.

use crate::random::Random;
use kin_codegen::Target;
use kinematics::__private::math::wrap;
use kinematics::{
    Chain, Interval, Kinematics, Parameter, Pose, RedundantKinematics, RobotOptions, Swivel,
};
use std::f64::consts::{FRAC_PI_2, PI};

/// Shoulder, elbow and wrist as points of the generic chain at home.
pub struct Shoulder {
    centre: [f64; 3],
    reference: [f64; 3],
    elbow: [f64; 3],
    /// In the tip's frame.
    wrist: [f64; 3],
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| a[i] - b[i])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

fn unit(a: [f64; 3]) -> [f64; 3] {
    a.map(|x| x / dot(a, a).sqrt())
}

/// What of `a` is at right angles to a unit vector.
fn across(a: [f64; 3], axis: [f64; 3]) -> [f64; 3] {
    minus(a, axis.map(|x| dot(a, axis) * x))
}

impl Shoulder {
    pub fn new<const N: usize>(arm: &impl Kinematics<N>, swivel: &Swivel) -> Self {
        let home = arm.fk_links(&[0.0; N]);
        Self {
            centre: swivel.shoulder,
            reference: swivel.reference,
            elbow: home[swivel.link].transform_point(swivel.elbow),
            wrist: swivel.wrist,
        }
    }

    fn elbow_of(&self, chain: &Chain, q: &[f64]) -> [f64; 3] {
        let twists = chain.twists().iter().zip(q).take(3);
        let moved = twists.map(|(twist, &q)| Pose::exp(twist, q));
        let moved = moved.fold(Pose::IDENTITY, |before, motion| before * motion);
        moved.transform_point(self.elbow)
    }

    /// By which turn about the line to the wrist the reference's side becomes the elbow's; the
    /// wrist is that of a tip.
    pub fn angle(&self, chain: &Chain, q: &[f64], tip: &Pose) -> f64 {
        let way = unit(minus(tip.transform_point(self.wrist), self.centre));
        let side = unit(across(self.reference, way));
        let elbow = minus(self.elbow_of(chain, q), self.centre);
        let quarter = Pose::from_axis_angle(way, FRAC_PI_2, [0.0; 3]);
        dot(quarter.rotate(side), elbow).atan2(dot(side, elbow))
    }

    /// Of the elbow from the line of shoulder and wrist, and of the wrist from the line
    /// through the shoulder along the reference.
    pub fn distances(&self, chain: &Chain, q: &[f64]) -> (f64, f64) {
        let way = minus(chain.fk(q).transform_point(self.wrist), self.centre);
        let elbow = minus(self.elbow_of(chain, q), self.centre);
        let length = |v: [f64; 3]| dot(v, v).sqrt();
        (
            length(across(elbow, unit(way))),
            length(across(way, self.reference)),
        )
    }
}

/// What the documentation says: 0 where the elbow is above the line to the wrist, for a base
/// whose first axis points up, and growing by the right hand about that line.
#[test]
fn the_elbow_is_up_at_zero_and_on_the_side_at_a_quarter_turn() {
    let Parameter::Swivel(swivel) = crate::Iiwa14::PARAMETERS[0] else {
        panic!("an SRS arm has a swivel angle")
    };
    let target = crate::Iiwa14.fk(&[0.2, 0.9, 0.1, 1.3, -0.3, 0.8, 0.4]);
    let at = |angle: f64| {
        let solutions = crate::Iiwa14.ik_at(&target, angle);
        assert_eq!(solutions.len(), 8);
        let points = |q: &[f64; 7]| swivel.points(&crate::Iiwa14.fk_links(q), &target);
        let [elbow, wrist] = points(&solutions[0].q);
        let same = |q: &[f64; 7]| (0..3).all(|i| (points(q)[0][i] - elbow[i]).abs() < 1e-9);
        assert!(solutions.iter().all(|solution| same(&solution.q)));
        (elbow, wrist)
    };
    let (up, wrist) = at(0.0);
    let way = unit(minus(wrist, swivel.shoulder));
    let highest = (0..100).map(|i| at(0.0628 * f64::from(i)).0[2]);
    assert!(highest.fold(0.0, f64::max) <= up[2] + 1e-9);
    let (left, _) = at(FRAC_PI_2);
    let expected = Pose::from_axis_angle(way, FRAC_PI_2, [0.0; 3]);
    let expected = expected.rotate(minus(up, swivel.shoulder));
    let there = minus(left, swivel.shoulder);
    assert!(
        (0..3).all(|i| (there[i] - expected[i]).abs() < 1e-12),
        "{there:?} {expected:?}"
    );
}

/// The textbook's property: turning the elbow costs nothing of the reach.
#[test]
fn every_branch_exists_at_every_swivel_angle() {
    let mut random = Random::new(21);
    for _ in 0..20 {
        let q: [f64; 7] = std::array::from_fn(|_| random.angle());
        let intervals = crate::Iiwa14.feasible(&crate::Iiwa14.fk(&q));
        assert_eq!(intervals.len(), 8);
        assert!(
            intervals.iter().all(|interval| interval.is_closed),
            "{intervals:?}"
        );
    }
}

/// Where the wrist is on the first axis, or the arm straight, there is no angle: answers are
/// flagged there.
#[test]
fn where_it_is_not_defined_answers_are_flagged() {
    // An elbow bent so that the wrist comes to the first axis: 420 mm and 400 mm.
    let bend: f64 = 2.0;
    let lean = (0.4 * bend.sin()).atan2(0.42 + 0.4 * bend.cos());
    for (q, answered) in [
        ([0.3, 0.0, 0.2, 0.0, 0.5, 0.7, 0.1], false),
        ([0.3, 0.8, 0.2, 0.0, 0.5, 0.7, 0.1], true),
        ([0.3, lean, 0.0, bend, 0.5, 0.7, 0.1], true),
    ] {
        let target = crate::Iiwa14.fk(&q);
        for angle in [0.0, 1.0, -2.5] {
            let solutions = crate::Iiwa14.ik_at(&target, angle);
            assert!(
                solutions.iter().all(|solution| solution.singular),
                "{solutions:#?}"
            );
            assert!(!answered || !solutions.is_empty(), "{angle} of {q:?}");
        }
    }
}

/// Off its design and with a tool that may turn: what is held beside that is the swivel angle.
#[test]
fn a_swivel_that_is_held_stays() {
    let options = RobotOptions {
        free: vec!["swivel".into()],
        target: Some(Target::PositionAxis),
        ..RobotOptions::default()
    };
    let robot = crate::cached::cached("robots/redundant/stray_iiwa.yaml", &options);
    let q = [0.3, 0.6, -0.4, -1.3, 0.5, 0.9, 0.2];
    let target = robot.fk(&q);
    let given = robot.redundancy(&target, &q);
    for (place, parameter) in given.iter().enumerate() {
        let along = robot.along(place, &given);
        let intervals = along.feasible(&target);
        let ends = || intervals.iter().flat_map(|it| [it.from, it.to]);
        let own = |it: &&Interval| it.contains(*parameter);
        assert!(
            intervals.iter().any(|it| own(&it)),
            "{place}: {intervals:?}"
        );
        for k in 0..60 {
            let value = PI * (f64::from(k) + 0.37 - 30.0) / 30.0;
            if ends().any(|end| wrap(end - value).abs() < 1e-3) {
                continue;
            }
            let held = intervals.iter().filter(|it| it.contains(value)).count();
            let solutions = along.ik_at(&target, value).len();
            assert_eq!(held, solutions, "{place} at {value}: {intervals:#?}");
        }
        for interval in &intervals {
            let told = robot.redundancy(&target, &interval.middle);
            let others = (0..2).filter(|&other| other != place);
            for other in others {
                let off = wrap(told[other] - given[other]);
                assert!(off.abs() < 1e-8, "{place}: {interval:?}");
            }
        }
    }
}
