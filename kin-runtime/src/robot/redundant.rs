//! Arms with one joint more than their targets have coordinates.

use super::follow::{Follow, PathStep, follow};
use crate::__private::Eliminant;
#[cfg(feature = "alloc")]
use crate::{
    Criterion, FeasibleInterval, JointLimit,
    feasible::{best, feasible, feasible_within},
};
use crate::{Kinematics, Nearest, NoSolution, Pose, Solution, Solutions, Swivel, Target};
#[cfg(feature = "alloc")]
use alloc::vec::Vec;
use core::f64::consts::{PI, TAU};

/// What an arm is given beside a target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Parameter {
    /// The value of a joint, by its place from 0; radians, and metres of a prismatic
    /// one.
    Joint(usize),
    /// The turn of the tool about the tip's z axis from where the target has it, radians.
    Turn,
    /// The swivel angle of an arm with a spherical shoulder and a spherical wrist, radians.
    Swivel(Swivel),
}

/// The inverse kinematics of an arm with one joint more than its targets have
/// coordinates: seven for whole poses, or six where the tool may turn. One number beside
/// the target, the parameter, leaves isolated solutions.
///
/// The parameter is the value of a joint, the swivel angle, or the turn of the tool; generated
/// robots tell which.
///
/// # Singularities and internal motions
///
/// Where the joints that are not given are singular and the arm is not, the internal motion has
/// no share of the parameter: solutions meet, and a feasible interval ends. Where the arm is
/// singular, it has more than one internal motion. The guide to singularities has a section on
/// both, with the methods that measure, avoid and follow them ("Redundant arms");
/// they are those of [`Kinematics`]: [`manipulability`](Kinematics::manipulability),
/// [`internal_motions`](Kinematics::internal_motions),
/// [`null_space_projection`](Kinematics::null_space_projection).
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no single parameter",
    note = "of an arm with several parameters, `along` of `HighlyRedundantKinematics` holds all \
            but one"
)]
pub trait RedundantKinematics<const N: usize>: Kinematics<N> {
    /// What the parameter is.
    const PARAMETER: Parameter;
    /// How many branches [`RedundantKinematics::ik_at`] looks at.
    const BRANCHES_AT: usize;

    /// How many roots of its plan a branch takes, as far as one of them may cease to be real;
    /// 0 where branches come from no plan that has only square roots.
    #[doc(hidden)]
    const ROOTS: usize = 0;

    /// [`RedundantKinematics::PARAMETER`], or that of a robot that is known when the program
    /// runs.
    #[doc(hidden)]
    fn parameter(&self) -> Parameter {
        Self::PARAMETER
    }

    /// [`RedundantKinematics::BRANCHES_AT`], in the same way.
    #[doc(hidden)]
    fn branches_at(&self) -> usize {
        Self::BRANCHES_AT
    }

    /// [`RedundantKinematics::ROOTS`], in the same way.
    #[doc(hidden)]
    fn roots(&self) -> usize {
        Self::ROOTS
    }

    /// The values of joints that are held as well, of an arm with several parameters
    /// ([`Along`](crate::Along)).
    #[doc(hidden)]
    fn held(&self) -> [Option<f64>; N] {
        [None; N]
    }

    /// How far the tool is turned, of an arm with several parameters whose turn of the tool is
    /// held.
    #[doc(hidden)]
    fn held_turn(&self) -> Option<f64> {
        None
    }

    /// What of a target counts once the parameters are fixed: the whole pose, where the turn of the
    /// tool is one of them.
    #[doc(hidden)]
    fn own_target_at(&self) -> Target {
        match self.parameter() == Parameter::Turn || self.held_turn().is_some() {
            true => Target::Pose,
            false => self.own_target(),
        }
    }

    /// The swivel whose angle is held, of an arm with several parameters, and that angle.
    #[doc(hidden)]
    fn held_swivel(&self) -> Option<(Swivel, f64)> {
        None
    }

    /// All configurations with this parameter that put the tip at the target, as far as
    /// the target counts: every isolated one once, and none if the target is out of
    /// reach.
    fn ik_at(&self, target: &Pose, parameter: f64) -> Solutions<N>;

    /// The same; a joint that a singular target leaves free keeps its value in `seed` (radians,
    /// metres), so that solutions along a path are continuous.
    fn ik_seeded_at(&self, target: &Pose, parameter: f64, seed: &[f64; N]) -> Solutions<N> {
        let _ = seed;
        self.ik_at(target, parameter)
    }

    /// Of the solutions at this parameter, the one that moves the joints least from a seed,
    /// inside the limits and steps of `nearest`, with full turns where these lead there; an angle
    /// that a singular target leaves free keeps its value in the seed. What a controller asks for
    /// that chooses the parameter itself.
    ///
    /// # Errors
    ///
    /// Why there is none: no solution at this parameter, none within limits, or none that a
    /// step leads to. No solution at any parameter is what an empty
    /// [`RedundantKinematics::feasible`] tells; [`RedundantKinematics::ik_best`] has the nearest
    /// of all.
    fn try_ik_nearest_at(
        &self,
        target: &Pose,
        parameter: f64,
        nearest: &Nearest<N>,
    ) -> Result<Solution<N>, NoSolution<N>> {
        let solutions = self.ik_seeded_at(target, parameter, &nearest.seed);
        solutions.nearest_by(nearest).ok_or_else(|| {
            NoSolution::among(&solutions, nearest).unwrap_or_else(|| match parameter.is_finite() {
                true => NoSolution::of_target(self.own_target_at(), target, || None),
                false => NoSolution::NotFinite,
            })
        })
    }

    /// The same within the robot's own limits, by steps of every length; none if there is none.
    fn ik_nearest_at(&self, target: &Pose, parameter: f64, seed: &[f64; N]) -> Option<Solution<N>> {
        let nearest = Nearest::new(*seed, &self.own_limits());
        self.ik_seeded_at(target, parameter, seed)
            .nearest_by(&nearest)
    }

    /// By branch, a continuous function of the parameter, without unit, that changes its sign where
    /// the branch begins or ends: the least argument of a square root, in units of the arm's size,
    /// positive where the branch exists; of a plan with a quartic that times its discriminant, which
    /// also changes its sign where two other roots meet.
    ///
    /// Of an arm that is read as an ideal one, that of the ideal arm.
    fn margins_at(&self, target: &Pose, parameter: f64) -> Option<[f64; 16]> {
        let _ = (target, parameter);
        None
    }

    /// Of an arm without a closed form, what an elimination leaves of the target at this
    /// parameter; eliminations are counted from 0.
    #[doc(hidden)]
    fn eliminant_at(&self, target: &Pose, parameter: f64, which: usize) -> Option<Eliminant> {
        let _ = (target, parameter, which);
        None
    }

    /// By square root, in the order of the plan, and by branch, the argument of the root, without
    /// unit: an analytic function of the parameter and of the roots before it. A branch has root i
    /// negative where its bit i is set. Infinite where the argument is always positive. The
    /// first [`RedundantKinematics::ROOTS`] count.
    #[doc(hidden)]
    fn root_arguments(&self, target: &Pose, parameter: f64) -> [[f64; 16]; 4] {
        let _ = (target, parameter);
        [[f64::INFINITY; 16]; 4]
    }

    /// The parameter of a configuration that puts the tip at the target.
    fn parameter_of(&self, target: &Pose, q: &[f64; N]) -> f64 {
        match self.parameter() {
            Parameter::Joint(joint) => q[joint],
            Parameter::Turn => target.turn_to(&self.fk(q)),
            Parameter::Swivel(swivel) => swivel.angle(&self.fk_links(q), &self.fk(q)),
        }
    }

    /// The solutions at so many values of the parameter, evenly spaced over a turn, or
    /// over the travel of a prismatic joint, both ends included; none where a slide lacks a stop.
    /// Nothing is allocated.
    fn ik_sweep(&self, target: &Pose, count: usize) -> impl Iterator<Item = Solutions<N>> {
        let limits = self.own_limits();
        let (from, step) = match self.parameter() {
            Parameter::Joint(joint) if !limits[joint].is_revolute() => {
                let (from, to) = (limits[joint].lower(), limits[joint].upper());
                (from, (to - from) / (count.max(2) - 1) as f64)
            }
            _ => (-PI, TAU / count as f64),
        };
        let count = if step.is_finite() { count } else { 0 };
        let target = *target;
        (0..count).map(move |i| self.ik_at(&target, from + step * i as f64))
    }

    /// The next configuration along a path of targets, for a controller that asks in every
    /// cycle: the solution nearest to `from` within limits, with the parameter carried on
    /// from there, and moved by up to `rate` to where the joints are farther from their
    /// limits ([`Follow::crowding`]). What cannot be had without a jump is told as one;
    /// none if there is no solution within limits at the parameter of `from`. Nothing is
    /// allocated; three to eight calls of [`RedundantKinematics::ik_at`].
    ///
    /// `from` reaches the target before: next to this one.
    fn ik_follow(&self, target: &Pose, from: &[f64; N], how: &Follow<N>) -> Option<PathStep<N>> {
        follow(self, target, from, how)
    }

    /// The intervals of the parameter in which each branch of solutions exists: their ends
    /// are where it meets another branch, because the joints that are not given are
    /// singular there. Ends are exact to 1e-9; of arms off their design by less than 1e-8, to 1e-8.
    ///
    /// Where branches come from the square roots of a plan, all
    /// ends are zeros of the roots' arguments, each an analytic function on the curves on which
    /// the roots before it are real, and polynomials that are these functions to nine digits
    /// leave none of them out. Which branches there are between two of them,
    /// [`RedundantKinematics::ik_at`] tells. So branches that are one throughout, because a root
    /// vanishes for all values or an angle is free, have one interval; where a root only touches
    /// zero, branches may change places, one interval ending and another one beginning; and where
    /// it does so from below, a branch exists at that value alone, and its interval has no
    /// length. Next to singular targets, where arguments vanish together, rounding decides.
    ///
    /// Other arms are followed from sample to sample, 64 to begin with. Of an arm without closed
    /// form the polynomial in one of its joints is one in the sine and cosine of the parameter as
    /// well; ends are where it has double roots, all of which are found on rectangles of both, and
    /// between any two of them there is a sample. What is shorter than 1e-4 of a turn may be left
    /// out, and more next to singular targets, since 20,000 rectangles are looked at. Between
    /// samples of an arm that is read as an ideal one, whose branches are moved on to it, they
    /// are looked for where those of the ideal arm nearly begin or end
    /// ([`RedundantKinematics::margins_at`]), which is no proof.
    ///
    /// A slide that lacks a stop is looked at up to 10 m beyond the target's distance from the
    /// base, both ways, or twice as far from its other stop.
    ///
    /// # Panics
    ///
    /// More than eight joints are not held: then one parameter does not leave isolated solutions. So do
    /// the functions below.
    #[cfg(feature = "alloc")]
    fn feasible(&self, target: &Pose) -> Vec<FeasibleInterval<N>> {
        feasible(self, target)
    }

    /// As [`RedundantKinematics::feasible`], as far as all joints are within limits; angles
    /// may be wound by full turns to be.
    ///
    /// Ends are where a joint goes beyond a limit by a tenth of [`JointLimit::TOLERANCE`]: joint
    /// values along a branch are polynomials to nine digits, of which all crossings are found. Where
    /// limits leave a joint a single value, to 1e-8, intervals have no length. An
    /// angle that a singular target leaves free has the value that solutions have.
    #[cfg(feature = "alloc")]
    fn feasible_within(&self, target: &Pose, limits: &[JointLimit; N]) -> Vec<FeasibleInterval<N>> {
        feasible_within(self, target, limits)
    }

    /// The best configuration for a target within the robot's limits, of all values of the
    /// parameter: the least minimum over the feasible intervals. None if there is none
    /// within limits.
    ///
    /// A joint that a singular target leaves free has the value that solutions have, but for
    /// [`Criterion::Nearest`], which looks at those with the seed's parameter and angle as well: it
    /// answers with the seed where that reaches the target.
    ///
    /// Minima are refined from 24 values of the parameter to a radian, and more where a joint moves
    /// by over 0.2 rad from one to the next. Within some 1e-6 of a value that is singular for the
    /// other joints a minimum may still be missed.
    #[cfg(feature = "alloc")]
    fn ik_best(&self, target: &Pose, criterion: &Criterion<N>) -> Option<[f64; N]> {
        best(self, target, &self.own_limits(), criterion)
    }
}
