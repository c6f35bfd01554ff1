//! Inverse kinematics of any chain, by descending from many starts.

use alloc::vec::Vec;
use core::f64::consts::PI;

use super::chain::is_prismatic;
use super::characteristic_length::characteristic_length;
use super::descent::{Descent, Task};
use super::given::Given;
use super::starts::{Effort, Starts};
use crate::linear::vector::norm;
use crate::types::projection::Projection;
use crate::{Chain, Parameter, Pose, Target, Twist, math};

/// How [`Chain::ik_all`] searches. The defaults suit arms of up to six
/// joints, and arms of more with parameters that leave six.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SearchOptions<'a> {
    /// What of the target counts; [`Target::Pose`] by default.
    pub target: Target,
    /// What is given beside the target, so that an arm with more joints than that has
    /// coordinates has isolated solutions: values of joints, the turn of the tool (then all of
    /// the target so turned counts) and the swivel angle, each at most once. For a swivel the
    /// chain needs its frames ([`Chain::with_links`]); where that angle is not defined, rounding
    /// decides.
    pub given: &'a [(Parameter, f64)],
    /// How often in a row a doubling of the number of starts must find nothing
    /// new.
    pub stable_doublings: u32,
    /// The search ends after this many starts in any case.
    pub max_starts: usize,
    /// The search ends with this many solutions in any case: a redundant arm
    /// or a singular target has infinitely many.
    pub max_solutions: usize,
    /// Two configurations are the same if no joint differs by more; radians,
    /// modulo 2π, and metres.
    pub same: f64,
}

impl Default for SearchOptions<'_> {
    fn default() -> Self {
        SearchOptions {
            target: Target::Pose,
            given: &[],
            stable_doublings: 3,
            max_starts: 1 << 14,
            max_solutions: 64,
            same: 1e-5,
        }
    }
}

/// A configuration found by [`Chain::ik_all`].
#[derive(Clone, Debug, PartialEq)]
pub struct ChainSolution {
    /// Values of all joints: radians in (−π, π], metres for prismatic joints.
    pub q: Vec<f64>,
    /// How far the tip is from the target, metres: [`Target::distance`] with
    /// the chain's characteristic length: how far the tip is at home from the farthest axis of
    /// rotation, metres, or 1.
    pub residual: f64,
    /// The least singular value of the geometric Jacobian by its Frobenius
    /// norm, with the angular part in units of the characteristic length; of the joints that are not
    /// given, with a row for the elbow where a swivel angle is. 0, or below
    /// 1e-6 or so, where this is one of a family or two solutions that meet.
    pub conditioning: f64,
}

/// The starts of the first batch.
const FIRST_BATCH: usize = 32;

impl Chain {
    /// All isolated configurations that put the tip at `target`, in the order
    /// of their first joint values.
    ///
    /// Levenberg-Marquardt descents from evenly scattered starts, until
    /// doubling their number has found nothing new several times in a row:
    /// complete with high probability, not with certainty. Every solution is
    /// within 1e-12 of the target, relative to the characteristic length, and the answer
    /// does not vary from call to call. A target out of reach, also one that a
    /// chain of fewer than six joints cannot orient itself to, yields none.
    /// Where solutions form families, scattered members of them come back, with
    /// a [`ChainSolution::conditioning`] near 0; isolated solutions where it is
    /// below 1e-6 may be missed, because the descent towards them is too flat.
    ///
    /// A target of a six-joint arm with eight branches takes some two
    /// milliseconds.
    ///
    /// ```
    /// use kin_runtime::{Chain, Pose, SearchOptions, Target, Twist};
    /// let z = [0.0, 0.0, 1.0];
    /// let planar = Chain::new(
    ///     vec![Twist::revolute(z, [0.0; 3]), Twist::revolute(z, [0.5, 0.0, 0.0])],
    ///     Pose::from_translation([0.9, 0.0, 0.0]),
    /// );
    /// let target = Pose::from_translation([0.3, 0.4, 0.0]);
    /// let options = SearchOptions { target: Target::Position, ..Default::default() };
    /// assert_eq!(planar.ik_all(&target, &options).len(), 2);
    /// assert!(planar.ik_all(&target, &SearchOptions::default()).is_empty());
    /// ```
    ///
    /// Of three joints in a plane, one is given beside a position:
    ///
    /// ```
    /// use kin_runtime::{Chain, Parameter, Pose, SearchOptions, Target, Twist};
    /// let joint = |x| Twist::revolute([0.0, 0.0, 1.0], [x, 0.0, 0.0]);
    /// let home = Pose::from_translation([1.3, 0.0, 0.0]);
    /// let planar = Chain::new(vec![joint(0.0), joint(0.5), joint(0.9)], home);
    /// let options = SearchOptions {
    ///     target: Target::Position,
    ///     given: &[(Parameter::Joint(2), 0.4)],
    ///     ..Default::default()
    /// };
    /// let found = planar.ik_all(&planar.fk(&[0.3, 0.8, 0.1]), &options);
    /// assert_eq!(found.len(), 2);
    /// assert!(found.iter().all(|solution| solution.q[2] == 0.4));
    /// ```
    ///
    /// # Panics
    /// If there is no joint of a place that is given; so does [`Chain::ik_from`].
    pub fn ik_all(&self, target: &Pose, options: &SearchOptions) -> Vec<ChainSolution> {
        let given = Given::new(self, target, options.target, options.given);
        let chain = &given.chain;
        let task = chain.task(&given);
        // Slides begin within the reach.
        let reach = task.length + norm(target.translation);
        let range = |twist: &Twist| if is_prismatic(twist) { reach } else { PI };
        let mut starts = Starts::new(chain.twists().iter().map(range).collect());
        let mut descent = Descent::new(task);
        let mut found: Vec<ChainSolution> = Vec::new();
        let effort = Effort {
            first: FIRST_BATCH,
            stable_doublings: options.stable_doublings,
            most: options.max_starts,
        };
        effort.search(|| {
            if descent.run(starts.next()) {
                chain.insert(&mut found, &mut descent, options.same);
            }
            (found.len() < options.max_solutions).then_some(found.len())
        });
        let whole = |found| given.completed(found);
        in_order(found.into_iter().map(whole).collect())
    }

    /// The configuration that puts the tip at `target` and that a descent from
    /// `start` arrives at, if it arrives. As exact as those of
    /// [`Chain::ik_all`]; of `options` only [`SearchOptions::target`],
    /// [`SearchOptions::given`] and [`SearchOptions::same`] count.
    ///
    /// ```
    /// use kin_runtime::{Chain, Pose, SearchOptions, Twist};
    /// let turn = Twist::revolute([0.0, 0.0, 1.0], [0.0; 3]);
    /// let chain = Chain::new(vec![turn], Pose::from_translation([1.0, 0.0, 0.0]));
    /// let found = chain.ik_from(&chain.fk(&[0.5]), &SearchOptions::default(), &[0.4]).unwrap();
    /// assert!((found.q[0] - 0.5).abs() < 1e-12);
    /// ```
    ///
    /// # Panics
    /// If `start` has not one value for each joint.
    pub fn ik_from(
        &self,
        target: &Pose,
        options: &SearchOptions,
        start: &[f64],
    ) -> Option<ChainSolution> {
        let given = Given::new(self, target, options.target, options.given);
        let mut descent = Descent::new(given.chain.task(&given));
        let mut found = Vec::new();
        if descent.run(&given.others(start)) {
            given.chain.insert(&mut found, &mut descent, options.same);
        }
        found.pop().map(|found| given.completed(found))
    }

    fn task(&self, given: &Given) -> Task<'_> {
        let twists = self.twists();
        let turn = twists.iter().find(|twist| !is_prismatic(twist));
        let slide = || twists.first().map(|first| first.linear);
        let axis = turn.map(|turn| turn.angular).or_else(slide);
        let projection = Projection {
            counts: given.counts,
            axis: axis.unwrap_or_default(),
            home: *self.home(),
        };
        Task {
            chain: self,
            target: projection.pose(&given.target),
            projection,
            length: self.length(),
            elbow: given.elbow,
        }
    }

    /// What an angle of one radian is worth in a descent, metres.
    fn length(&self) -> f64 {
        characteristic_length(self.twists(), self.home())
    }

    /// Adds the configuration that the descent arrived at, unless it is known.
    fn insert(&self, found: &mut Vec<ChainSolution>, descent: &mut Descent, same: f64) {
        let revolute = |i: usize| !is_prismatic(&self.twists()[i]);
        let reduced = |(i, &value): (usize, &f64)| {
            if revolute(i) {
                math::wrap(value)
            } else {
                value
            }
        };
        let q: Vec<f64> = descent.q().iter().enumerate().map(reduced).collect();
        let apart = |i: usize, other: f64| {
            let difference = q[i] - other;
            (if revolute(i) {
                math::wrap(difference)
            } else {
                difference
            })
            .abs()
        };
        let known = |solution: &ChainSolution| {
            solution
                .q
                .iter()
                .enumerate()
                .all(|(i, &other)| apart(i, other) <= same)
        };
        if !found.iter().any(known) {
            let conditioning = descent.conditioning();
            found.push(ChainSolution {
                residual: descent.residual(),
                conditioning,
                q,
            });
        }
    }
}

fn in_order(mut found: Vec<ChainSolution>) -> Vec<ChainSolution> {
    found.sort_by(|a, b| a.q.partial_cmp(&b.q).unwrap_or(core::cmp::Ordering::Equal));
    found
}
