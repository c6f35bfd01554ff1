//! The equations of a target, in all joints and the parameter.

use super::memo::Memo;
use crate::continuation::{Cut, Equations, meet};
use crate::linear::vector::norm;
use crate::scalar::tolerance::ROTATION;
use crate::{
    JointLimit, Parameter, Pose, RANK_TOLERANCE, RedundantKinematics, Solutions, Swivel, Target,
    math,
};

/// Coordinates of a point: the values of the joints that move, then the parameter unless it is one
/// of these joints; what is left is zero. A target leaves one way to go to seven joints at most, or
/// to eight whose swivel angle is held.
pub(super) const WIDTH: usize = 9;
pub(super) type Point = [f64; WIDTH];
/// Those of the tip's pose, and what a swivel angle has to be.
const EQUATIONS: usize = 7;

/// The places of coordinates.
const PLACES: [usize; WIDTH] = [0, 1, 2, 3, 4, 5, 6, 7, 8];

/// What a robot has to reach.
pub(super) struct Task<'a, K: ?Sized, const N: usize> {
    pub robot: &'a K,
    pub target: &'a Pose,
    /// Which coordinate the parameter is.
    pub parameter: usize,
    pub limits: [JointLimit; N],
    /// Branches of the plan, and how many roots of it each takes.
    pub branches: usize,
    pub roots: usize,
    /// The joints that move, whose values are the first coordinates.
    moving: ([usize; WIDTH], usize),
    /// How many coordinates there are.
    coordinates: usize,
    /// The values of joints that do not move; of the others zero.
    held: [f64; N],
    /// What the parameter is.
    pub of: Parameter,
    /// The swivel whose angle is the parameter, or is held at a value.
    pub swivel: Option<(Swivel, Option<f64>)>,
    /// What counts: with a turn of the tool, a target is a whole pose.
    counts: Target,
    /// Solutions by the parameter: branches over the same interval ask for the same.
    solved: Memo<Solutions<N>>,
}

/// A point of a curve, and the unit vector along it, to where the parameter grows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub x: Point,
    pub tangent: Point,
}

impl<'a, K: RedundantKinematics<N> + ?Sized, const N: usize> Task<'a, K, N> {
    /// # Panics
    ///
    /// More than eight joints move: then the robot is none with one parameter.
    pub fn new(robot: &'a K, target: &'a Pose) -> Self {
        let held = robot.held();
        let (mut moving, mut joints) = ([0; WIDTH], 0);
        for joint in (0..N).filter(|&joint| held[joint].is_none()) {
            assert!(joints + 1 < WIDTH, "eight joints that move at most");
            moving[joints] = joint;
            joints += 1;
        }
        let of = robot.parameter();
        let parameter = match of {
            Parameter::Joint(joint) => place(&moving[..joints], joint),
            Parameter::Swivel(_) | Parameter::Turn => joints,
        };
        Task {
            robot,
            target,
            parameter,
            limits: robot.own_limits(),
            branches: robot.branches_at(),
            roots: robot.roots(),
            moving: (moving, joints),
            coordinates: joints.max(parameter + 1),
            held: held.map(|value| value.unwrap_or(0.0)),
            of,
            swivel: match of {
                Parameter::Swivel(swivel) => Some((swivel, None)),
                _ => robot
                    .held_swivel()
                    .map(|(swivel, angle)| (swivel, Some(angle))),
            },
            counts: robot.own_target_at(),
            solved: Memo::new(),
        }
    }

    /// Whether the target is one: all that counts a finite number, and a rotation.
    pub fn is_target(&self) -> bool {
        let counts = self.counts;
        let distance = norm(self.target.translation);
        counts.is_finite(self.target)
            && counts.rotation_error(self.target) <= ROTATION
            && (distance.is_finite() || !counts.has_translation())
    }

    /// All solutions at a value of the parameter.
    pub fn solutions(&self, value: f64) -> Solutions<N> {
        self.solved
            .at(value, || self.robot.ik_at(self.target, value))
    }

    /// The joints that move, in the order of the coordinates.
    pub fn moving(&self) -> &[usize] {
        &self.moving.0[..self.moving.1]
    }

    /// Whether a coordinate is an angle.
    pub fn turns(&self, coordinate: usize) -> bool {
        let joint = self.moving().get(coordinate);
        joint.is_none_or(|&joint| self.limits[joint].is_revolute())
    }

    /// The joint values of a point.
    pub fn q(&self, x: &Point) -> [f64; N] {
        let mut q = self.held;
        for (&joint, x) in self.moving().iter().zip(x) {
            q[joint] = *x;
        }
        q
    }

    /// The point of joint values at a parameter.
    pub fn point(&self, q: &[f64; N], parameter: f64) -> Point {
        let mut x = [0.0; WIDTH];
        for (&joint, x) in self.moving().iter().zip(&mut x) {
            *x = q[joint];
        }
        x[self.parameter] = parameter;
        x
    }

    /// The way from one point to another, angles by the shorter way round.
    pub fn way(&self, from: &Point, to: &Point) -> Point {
        core::array::from_fn(|i| {
            let way = to[i] - from[i];
            match i < self.coordinates && self.turns(i) && i != self.parameter {
                true => math::wrap(way),
                false => way,
            }
        })
    }

    fn equations(&self, x: &Point) -> Equations<WIDTH, EQUATIONS> {
        let q = self.q(x);
        let (pose, spatial) = self.robot.fk_jacobian(&q);
        let geometric = spatial.spatial_to_geometric(&pose);
        let turn = match self.of {
            Parameter::Joint(_) | Parameter::Swivel(_) => self.robot.held_turn(),
            Parameter::Turn => Some(x[self.parameter]),
        };
        let target = turn.map_or(*self.target, |turn| self.target.turned(turn));
        let own = self.counts.counting_rows(&pose, &geometric).rows;
        let mut rows = [[0.0; WIDTH]; EQUATIONS];
        for (k, &joint) in self.moving().iter().enumerate() {
            for (row, own) in rows.iter_mut().zip(&own) {
                row[k] = own[joint];
            }
        }
        let mut missing = [0.0; EQUATIONS];
        missing[..6].copy_from_slice(&self.counts.missing(&pose, &target).to_array());
        if let Some((swivel, held)) = self.swivel {
            let (row, angle) = swivel.row(&self.robot.fk_links(&q), &pose, &spatial);
            for (k, &joint) in self.moving().iter().enumerate() {
                rows[6][k] = row[joint];
            }
            if held.is_none() {
                rows[6][self.parameter] = -1.0;
            }
            missing[6] = math::wrap(held.unwrap_or(x[self.parameter]) - angle);
        }
        if let Parameter::Turn = self.of {
            // The target turns about its z axis.
            for i in 0..3 {
                rows[3 + i][self.parameter] = -target.rotation[i][2];
            }
        }
        Equations {
            rows,
            missing,
            size: Equations::<WIDTH, EQUATIONS>::size(&target, &spatial, &q),
        }
    }

    /// The coordinates that there are not.
    fn resting(&self) -> &[usize] {
        &PLACES[self.coordinates..]
    }

    /// The place of a point, if there is one way to go on.
    pub fn place(&self, x: Point) -> Option<Place> {
        self.place_where(x, RANK_TOLERANCE)
    }

    /// The same where equations count as dependent below a share of the longest.
    pub fn place_where(&self, x: Point, dependent: f64) -> Option<Place> {
        let span = self.equations(&x).span(self.resting(), None, dependent);
        let mut ways = span.complement();
        let tangent = ways.next()?;
        if ways.next().is_some() {
            return None;
        }
        let sign = 1.0_f64.copysign(tangent[self.parameter]);
        let tangent = tangent.map(|t| sign * t);
        Some(Place { x, tangent })
    }

    /// Where the curve meets a hyperplane, by Newton's method; none if it does not get there.
    pub fn meet(&self, cut: &Cut<WIDTH>, guess: Point) -> Option<Point> {
        meet(|x| self.equations(x), self.resting(), cut, guess)
    }
}

/// The place of a joint among those that move.
fn place(moving: &[usize], joint: usize) -> usize {
    let place = moving.iter().position(|&other| other == joint);
    place.expect("a joint that moves")
}
