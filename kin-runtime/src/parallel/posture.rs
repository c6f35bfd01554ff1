//! One configuration of a mechanism: what its chains say of the platform, and
//! of each other.

use crate::linear::givens;
use crate::linear::singular_values::singular_values;
use crate::linear::span::Span;
use crate::linear::vector::{add, cross, dot, scale, sub};
use crate::{Pose, Twist};
use core::borrow::Borrow;

/// A twist or a wrench with its angular part in metres; see [`Posture`].
pub(crate) type Vector6 = [f64; 6];

/// A joint is dependent if the others of its chain leave less than this of its twist, relative to
/// the longest: the rounding of a long chain.
pub(crate) const DEPENDENT: f64 = 1e-10;

/// A configuration as its chains see it. Twists are compared at the platform's
/// origin, with angles times `length`, so that all six coordinates are metres.
pub(crate) struct Posture<'a> {
    /// The platform's pose by each chain; equal where the loops are closed.
    pub poses: &'a [Pose],
    /// The spatial twist of every joint, displaced by those before it.
    pub twists: &'a [Twist],
    /// First joint of every chain, and one past its last.
    pub chains: &'a [[usize; 2]],
    /// Which joints are actuated.
    pub actuated: &'a [usize],
    /// Metres that weigh as much as one radian.
    pub length: f64,
}

/// Where the equations of the wrenches disagree by more than this, relative to `length`, the rates
/// of actuated joints are not independent; less is the error with which loops are closed.
const CONTRADICTION: f64 = 1e-4;

/// A direction in which the platform is held no better than this counts as
/// free; relative to wrenches of length 1.
pub(crate) const FREE: f64 = 1e-9;

impl Posture<'_> {
    fn origin(&self) -> [f64; 3] {
        self.poses[0].translation
    }

    /// A spatial twist at the platform's origin, in metres.
    pub(crate) fn scaled(&self, twist: &Twist) -> Vector6 {
        let v = add(twist.linear, cross(twist.angular, self.origin()));
        let w = scale(self.length, twist.angular);
        [v[0], v[1], v[2], w[0], w[1], w[2]]
    }

    /// The inverse of [`Posture::scaled`].
    pub(crate) fn spatial(&self, v: &Vector6) -> Twist {
        let angular = scale(1.0 / self.length, [v[3], v[4], v[5]]);
        Twist {
            linear: sub([v[0], v[1], v[2]], cross(angular, self.origin())),
            angular,
        }
    }

    fn column(&self, joint: usize) -> Vector6 {
        self.scaled(&self.twists[joint])
    }

    pub(crate) fn is_actuated(&self, joint: usize) -> bool {
        self.actuated.contains(&joint)
    }

    /// The motions that a chain's passive joints can give the platform.
    pub(crate) fn passive(&self, chain: usize) -> Span<6> {
        self.span(chain, |joint| !self.is_actuated(joint))
    }

    /// The span of those joints of a chain that `keep` picks; its columns are
    /// numbered as the joints are, from the chain's first.
    pub(crate) fn span(&self, chain: usize, keep: impl Fn(usize) -> bool) -> Span<6> {
        let [first, end] = self.chains[chain];
        let column = |j: usize| match keep(first + j) {
            true => self.column(first + j),
            false => [0.0; 6],
        };
        Span::of(end - first, column, DEPENDENT)
    }

    /// How far the chains' ends are apart: the larger of the translation and
    /// the angle times the length, metres.
    pub(crate) fn gap(&self) -> f64 {
        let first = &self.poses[0];
        let mut gap = 0.0;
        for pose in &self.poses[1..] {
            let turned = self.length * pose.rotation_distance(first);
            for apart in [pose.translation_distance(first), turned] {
                // What is no number is no closed loop.
                if apart > gap || apart.is_nan() {
                    gap = apart;
                }
            }
            if gap.is_nan() {
                break;
            }
        }
        gap
    }

    /// The rows of J₁ θ̇₁ − Jₖ θ̇ₖ = 0, for every chain k after the first.
    pub(crate) fn constraint(&self, row: usize, out: &mut [f64]) {
        let (k, i) = (row / 6 + 1, row % 6);
        out.fill(0.0);
        for (chain, sign) in [(0, 1.0), (k, -1.0)] {
            let [first, end] = self.chains[chain];
            (first..end).for_each(|joint| out[joint] = sign * self.column(joint)[i]);
        }
    }

    /// How many rows [`Posture::constraint`] has.
    pub(crate) fn constraints(&self) -> usize {
        6 * (self.chains.len() - 1)
    }

    /// The singular values of the structure equation's Jacobian, largest
    /// first. `square` has room for n×n numbers, `row` and `values` for n.
    pub(crate) fn structure(&self, square: &mut [f64], row: &mut [f64], values: &mut [f64]) {
        square.fill(0.0);
        for i in 0..self.constraints() {
            self.constraint(i, row);
            givens::absorb(square, &mut [], row, &mut []);
        }
        singular_values(square, values);
    }

    /// How well the chains hold the platform while the actuated joints are
    /// locked: singular values of the wrenches that they can bear, each of
    /// length 1.
    pub(crate) fn held(&self) -> [f64; 6] {
        values(self.wrenches::<0>(|_, _| []).r)
    }

    /// All the wrenches that locked actuators bear, as a triangle, with what
    /// `tail` says of each beside them.
    fn wrenches<const M: usize>(&self, tail: impl Fn(usize, &Vector6) -> [f64; M]) -> Wrenches<M> {
        let chains = 0..self.chains.len();
        wrenches(chains.map(|chain| self.passive(chain)), tail)
    }

    /// The spatial twist that unit rate of each actuated joint gives the
    /// platform; none if it can move while they are locked, or they cannot be chosen freely.
    pub(crate) fn forward_jacobian<const M: usize>(&self) -> Option<[Twist; M]> {
        let Wrenches { r, tails, left } = self.wrenches::<M>(|chain, wrench| {
            let [first, end] = self.chains[chain];
            core::array::from_fn(|a| {
                let joint = self.actuated[a];
                match (first..end).contains(&joint) {
                    true => dot(*wrench, self.column(joint)),
                    false => 0.0,
                }
            })
        });
        let is_held = values(r)[5] >= FREE;
        let is_free = left <= CONTRADICTION * self.length;
        let twist = |a: usize| self.spatial(&back_substitute(&r, |i| tails[i][a]));
        (is_held && is_free).then(|| core::array::from_fn(twist))
    }

    /// The rate of every joint while the actuated ones move at the given rates, and the platform
    /// with the spatial velocity that these give it. A passive joint whose motion the other passive
    /// ones of its chain can undo stays at rest.
    pub(crate) fn joint_rates(&self, actuated: &[f64], velocity: &Twist, rates: &mut [f64]) {
        let velocity = self.scaled(velocity);
        rates.fill(0.0);
        for (&joint, &rate) in self.actuated.iter().zip(actuated) {
            rates[joint] = rate;
        }
        for (chain, &[first, end]) in self.chains.iter().enumerate() {
            let mut left = velocity;
            for joint in (first..end).filter(|&joint| self.is_actuated(joint)) {
                let column = self.column(joint);
                (0..6).for_each(|i| left[i] -= rates[joint] * column[i]);
            }
            let span = self.passive(chain);
            span.coordinates(left, |j, rate| rates[first + j] = rate);
        }
    }

    /// The row r of the inverse Jacobian: r · V is the rate of the actuated
    /// joint `a` for every velocity V that the mechanism allows. None if the
    /// joint's motion is one that the others of its chain can do without it.
    pub(crate) fn inverse_row(&self, a: usize) -> Option<Vector6> {
        let joint = self.actuated[a];
        let inside = |chain: &&[usize; 2]| (chain[0]..chain[1]).contains(&joint);
        let chain = self.chains.iter().position(|chain| inside(&chain))?;
        let others = self.span(chain, |other| other != joint);
        let own = self.column(joint);
        let rest = others.reject(own);
        let square = dot(rest, own);
        if square <= FREE * FREE * dot(own, own) {
            return None;
        }
        let row = rest.map(|x| x / square);
        // r · (v + ω × p, ℓ ω) in terms of (v, ω).
        let (force, moment) = ([row[0], row[1], row[2]], [row[3], row[4], row[5]]);
        let moment = add(cross(self.origin(), force), scale(self.length, moment));
        Some([
            force[0], force[1], force[2], moment[0], moment[1], moment[2],
        ])
    }

    /// How many independent motions there are at this configuration: n less
    /// the rank of the structure equation, given its singular values.
    #[cfg(feature = "alloc")]
    pub(crate) fn mobility(values: &[f64]) -> usize {
        let largest = values.first().copied().unwrap_or(0.0);
        values.iter().filter(|x| **x <= FREE * largest).count()
    }
}

/// Wrenches as equations of the platform's motion.
pub(super) struct Wrenches<const M: usize> {
    /// Their triangle.
    pub r: [[f64; 6]; 6],
    /// What is said of its rows.
    pub tails: [[f64; M]; 6],
    /// What is said that no motion fulfils: more than six of them may contradict each other.
    left: f64,
}

/// The wrenches at right angles to what each of some chains can do, as [`Posture::wrenches`].
pub(super) fn wrenches<const M: usize>(
    passive: impl Iterator<Item = impl Borrow<Span<6>>>,
    tail: impl Fn(usize, &Vector6) -> [f64; M],
) -> Wrenches<M> {
    let (mut r, mut tails) = ([[0.0; 6]; 6], [[0.0; M]; 6]);
    let mut left = 0.0;
    for (chain, span) in passive.enumerate() {
        for wrench in span.borrow().complement() {
            let (mut row, mut tail) = (wrench, tail(chain, &wrench));
            let (r, tails) = (r.as_flattened_mut(), tails.as_flattened_mut());
            givens::absorb(r, tails, &mut row, &mut tail);
            left = tail.iter().fold(left, |most: f64, x| most.max(x.abs()));
        }
    }
    Wrenches { r, tails, left }
}

/// The singular values of a triangle.
fn values(mut r: [[f64; 6]; 6]) -> [f64; 6] {
    let mut values = [0.0; 6];
    singular_values(r.as_flattened_mut(), &mut values);
    values
}

/// Solves R x = b; an x that R does not determine is 0.
pub(crate) fn back_substitute(r: &[[f64; 6]; 6], b: impl Fn(usize) -> f64) -> Vector6 {
    let mut x = [0.0; 6];
    for i in (0..6).rev() {
        let known: f64 = (i + 1..6).map(|j| r[i][j] * x[j]).sum();
        if r[i][i].abs() > 1e-12 {
            x[i] = (b(i) - known) / r[i][i];
        }
    }
    x
}
