//! Closed forms in lanes, of one target or of several.

use super::super::scalar::{Real, tolerance::SAME};
use super::super::types::nearest::Motion;
use super::super::{Nearest, Pose, Solution, Solutions, math};
use super::acceptance::{Acceptance, Completion};
use super::arithmetic::{Arithmetic, Fused};
use super::branches::Branches;
use super::dispatch::{Dispatched, dispatch};
use super::free_joint::{ELSEWHERE, FREE_BELOW, FreeJoint, FreeJoints, Moving, NEARLY_FREE};
use super::refinement::is_next_to;
use super::sin_cos::{Known, SinCos};
use core::marker::PhantomData;

/// A closed form with L branches for N joints, of which P more are given, that takes the
/// sines and cosines of M angles of these and of a seed, with F joints that singular targets may
/// leave free and that move then.
pub trait Inverse<const N: usize, const L: usize, const P: usize, const M: usize, const F: usize> {
    /// What makes a branch a solution.
    const ACCEPT: Acceptance;

    /// The targets for which an elimination completes the branches.
    const COMPLETION: Completion = Completion::Never;

    /// How many branches much of the arithmetic is done for.
    const WIDTH: usize;

    /// The joints that singular targets leave free, where their
    /// values can leave a later root none; by root, in the order of the plan.
    const FREE: [FreeJoint; F];

    /// The angles whose sines and cosines `lanes` asks for, radians.
    fn angles(seed: &[Real; N], locked: &[Real; P]) -> [Real; M];

    /// The branches of T targets. Joints that are free are at `seed`; vectors whose
    /// square is below `free` tell no angle; `locked` are the values of the joints
    /// that are given; all in radians and metres. To be `#[inline(always)]`.
    fn lanes<A: Arithmetic, const T: usize>(
        targets: &[Pose; T],
        seed: &[Real; N],
        locked: &[Real; P],
        sin_cos: impl SinCos<M>,
        free: Real,
    ) -> Lanes<N, L, T, F>;
}

/// The branches of T targets; see [`Branches`] and [`FreeJoints`].
#[derive(Clone, Copy)]
pub struct Lanes<const N: usize, const L: usize, const T: usize, const F: usize> {
    /// By joint, in (−π, π] radians or metres.
    pub q: [[[Real; T]; L]; N],
    /// The distance of each branch from its target, metres.
    pub residual: [[Real; T]; L],
    /// Positive where the branch does not exist or repeats another.
    pub invalid: [[Real; T]; L],
    /// Positive where a root is double or an angle is free.
    pub singular: [[Real; T]; L],
    /// d of the equations a cos θ + b sin θ = d of the roots behind free joints.
    pub level: [[[Real; T]; L]; F],
    /// Positive where a joint is free and its value leaves no real root.
    pub no_root: [[[Real; T]; L]; F],
}

impl<const N: usize, const L: usize, const T: usize, const F: usize> Lanes<N, L, T, F> {
    /// Positive for targets that ask for more: with a free joint that leaves a later root
    /// none, a branch that rounding may keep from the target, or solutions that no branch tells.
    #[inline(always)]
    pub(super) fn unsettled(&self, completion: Completion, accept: &Acceptance) -> [Real; T] {
        let mut unsettled = [0.0; T];
        for k in 0..L {
            for t in 0..T {
                let misses = self.residual[k][t] > accept.taken;
                let little = self.residual[k][t] <= accept.nearly;
                let nearly = (self.invalid[k][t] <= 0.0) & misses & little;
                unsettled[t] = math::max(unsettled[t], math::select(nearly, 1.0, 0.0));
                for no_root in &self.no_root {
                    unsettled[t] = math::max(unsettled[t], no_root[k][t]);
                }
            }
        }
        if completion != Completion::Never {
            for t in 0..T {
                let completed = self.of(t).branches().are_completed(completion, accept);
                unsettled[t] = math::max(unsettled[t], math::select(completed, 1.0, 0.0));
            }
        }
        unsettled
    }

    /// Target `t` alone.
    #[inline(always)]
    fn of(&self, t: usize) -> Lanes<N, L, 1, F> {
        Lanes {
            q: self.q.map(|lanes| lanes.map(|targets| [targets[t]])),
            residual: self.residual.map(|targets| [targets[t]]),
            invalid: self.invalid.map(|targets| [targets[t]]),
            singular: self.singular.map(|targets| [targets[t]]),
            level: self.level.map(|lanes| lanes.map(|targets| [targets[t]])),
            no_root: self.no_root.map(|lanes| lanes.map(|targets| [targets[t]])),
        }
    }

    #[inline(always)]
    fn reaches(&self, k: usize, t: usize, accept: &Acceptance) -> bool {
        (self.invalid[k][t] <= 0.0) & (self.residual[k][t] <= accept.taken)
    }

    /// Writes down the branches that reach target `t`.
    #[inline(always)]
    pub(super) fn write(&self, t: usize, accept: &Acceptance, solutions: &mut Solutions<N>) {
        solutions.clear(accept.prismatic);
        for k in 0..L {
            let solution = Solution {
                q: core::array::from_fn(|i| self.q[i][k][t]),
                residual: self.residual[k][t],
                branch: k as u32,
                singular: self.singular[k][t] > 0.0,
            };
            solutions.push_if(self.reaches(k, t, accept), solution);
        }
    }
}

impl<const N: usize, const L: usize, const F: usize> Lanes<N, L, 1, F> {
    /// Whether the lanes alone tell the solutions.
    #[inline(always)]
    fn settled(&self, completion: Completion, accept: &Acceptance) -> bool {
        let asks = self.free_joints().leave_no_root() | self.branches().nearly(accept);
        match completion {
            Completion::Never => !asks,
            _ => !(asks | self.branches().are_completed(completion, accept)),
        }
    }

    /// Whether of a branch that reaches the target a root is double or an angle free.
    #[inline(always)]
    fn singular(&self, accept: &Acceptance) -> bool {
        let mut singular = false;
        for k in 0..L {
            singular |= self.reaches(k, 0, accept) & (self.singular[k][0] > 0.0);
        }
        singular
    }

    #[inline(always)]
    fn branches(&self) -> Branches<N, L> {
        let mut branches = Branches {
            q: [[0.0; L]; N],
            residual: alone(&self.residual),
            invalid: alone(&self.invalid),
            singular: alone(&self.singular),
        };
        for i in 0..N {
            branches.q[i] = alone(&self.q[i]);
        }
        branches
    }

    #[inline(always)]
    fn free_joints(&self) -> FreeJoints<L, F> {
        let mut free = FreeJoints {
            level: [[0.0; L]; F],
            no_root: [[0.0; L]; F],
        };
        for i in 0..F {
            free.level[i] = alone(&self.level[i]);
            free.no_root[i] = alone(&self.no_root[i]);
        }
        free
    }
}

#[inline(always)]
fn alone<const L: usize>(lanes: &[[Real; 1]; L]) -> [Real; L] {
    let mut values = [0.0; L];
    for k in 0..L {
        values[k] = lanes[k][0];
    }
    values
}

/// What is asked of the branches of a target, and where to write it.
enum Asked<'a, const N: usize> {
    Solutions(&'a mut Solutions<N>),
    /// The same where none is singular.
    Regular(&'a mut Solutions<N>),
    Nearest(&'a Motion<'a, N>, &'a mut Option<Solution<N>>),
    Themselves,
}

/// A target with what is given beside it; see [`Inverse::lanes`].
struct Given<'a, R, const N: usize, const L: usize, const P: usize, const M: usize, const F: usize>
{
    pose: &'a Pose,
    /// Of joints without one zero.
    seed: [Real; N],
    locked: &'a [Real; P],
    sin_cos: Known<M>,
    free: Real,
    /// Whether a singular branch may be the answer: angles that are free are at the seed.
    takes_singular: bool,
    solver: PhantomData<R>,
}

/// The branches of one target, with what tells of angles that may be free.
type Found<const N: usize, const L: usize, const F: usize> = (Branches<N, L>, FreeJoints<L, F>);

impl<'a, R, const N: usize, const L: usize, const P: usize, const M: usize, const F: usize>
    Given<'a, R, N, L, P, M, F>
where
    R: Inverse<N, L, P, M, F>,
{
    #[inline(always)]
    fn new(pose: &'a Pose, seed: &[Real; N], locked: &'a [Real; P]) -> Self {
        // A joint without a seed takes no part in a choice, and what of it is free is at 0.
        let seed = seed.map(|x| math::select(x.is_finite(), x, 0.0));
        Given {
            pose,
            seed,
            locked,
            sin_cos: Known::new(R::angles(&seed, locked)),
            free: FREE_BELOW,
            takes_singular: true,
            solver: PhantomData,
        }
    }

    /// Does what is asked, or gives the branches where these alone do not tell it.
    #[inline]
    fn ask(&self, asked: Asked<'_, N>) -> Option<Found<N, L, F>> {
        dispatch::<Single, _>((self, asked))
    }

    #[inline(always)]
    fn branches(&self) -> Found<N, L, F> {
        self.ask(Asked::Themselves)
            .expect("nothing but the branches is asked for")
    }

    /// What branches lead to. The angle of a vector that is nearly nothing may be given up for one that
    /// leaves later steps a root, or be the one that the target asks for. And where a free joint is at
    /// right angles to what the target is off, no step of Newton's method tells that it has to turn.
    #[cold]
    #[inline(never)]
    fn led_to<const K: usize>(
        &self,
        found: Found<N, L, F>,
        otherwise: impl Fn(Branches<N, L>) -> Solutions<K>,
    ) -> Solutions<K> {
        let mut solutions = otherwise(self.with_root(found));
        if R::COMPLETION != Completion::Never || R::ACCEPT.is_of_design() {
            return solutions; // An elimination tells the others.
        }
        let (as_told, free) = found;
        let add = |solutions: &mut Solutions<K>, branches: Branches<N, L>| {
            for solution in &otherwise(branches.without(solutions)) {
                solutions.insert_new(*solution, SAME);
            }
        };
        if F > 0 && free.leave_no_root() {
            add(&mut solutions, as_told);
        }
        let begin = as_told.begin(&R::ACCEPT);
        for turn in ELSEWHERE {
            if solutions.len() < begin {
                let seed = self.seed.map(|x| x + turn);
                let turned = Given::<R, N, L, P, M, F>::new(self.pose, &seed, self.locked);
                let free = NEARLY_FREE;
                let (branches, _) = Given { free, ..turned }.branches();
                add(&mut solutions, branches);
            }
        }
        solutions
    }

    /// The branches, where the seed's value of a free joint leaves a later step no root with that
    /// joint moved to where it leaves one.
    #[inline(always)]
    fn with_root(&self, (branches, free): Found<N, L, F>) -> Branches<N, L> {
        if F == 0 || !free.leave_no_root() {
            return branches;
        }
        let run = |seed: &[Real; N], free: Real| {
            let moved = Given::<R, N, L, P, M, F>::new(self.pose, seed, self.locked);
            Given { free, ..moved }.branches()
        };
        let moving = Moving {
            joints: R::FREE,
            run,
        };
        moving.moved(branches, &free, &self.seed)
    }
}

impl<R, const N: usize, const L: usize, const P: usize, const M: usize, const F: usize>
    Given<'_, R, N, L, P, M, F>
where
    R: Inverse<N, L, P, M, F>,
{
    /// The solution that moves the joints least, joints that are free at the seed.
    #[cold]
    #[inline(never)]
    fn nearest(
        &self,
        nearest: &Nearest<N>,
        seed: &[Real; N],
        motion: &Motion<'_, N>,
        missed: impl FnOnce(&[Real; N]) -> Real,
        otherwise: impl Fn(Branches<N, L>) -> Solutions<N>,
    ) -> Option<Solution<N>> {
        let mut solution = None;
        let found = self.ask(Asked::Nearest(motion, &mut solution));
        let missed = missed(seed);
        match &solution {
            Some(it) if is_next_to(&it.q, seed, missed, R::ACCEPT.size) => return solution,
            _ => {}
        }
        self.nearest_of_all(nearest, seed, found, otherwise)
    }

    /// The same of all solutions.
    #[cold]
    #[inline(never)]
    fn nearest_of_all(
        &self,
        nearest: &Nearest<N>,
        seed: &[Real; N],
        found: Option<Found<N, L, F>>,
        otherwise: impl Fn(Branches<N, L>) -> Solutions<N>,
    ) -> Option<Solution<N>> {
        let found = found.unwrap_or_else(|| self.branches());
        self.led_to(found, otherwise)
            .nearest_by(&nearest.from_seed(*seed))
    }
}

/// The branches of one target and what is asked of them, in one function: what that has in
/// registers does not go through memory to another.
struct Single;

impl<R, const N: usize, const L: usize, const P: usize, const M: usize, const F: usize>
    Dispatched<(&Given<'_, R, N, L, P, M, F>, Asked<'_, N>)> for Single
where
    R: Inverse<N, L, P, M, F>,
{
    const WIDTH: usize = R::WIDTH;
    type Output = Option<Found<N, L, F>>;

    #[inline(always)]
    fn run<const FUSED: bool>(
        (given, asked): (&Given<'_, R, N, L, P, M, F>, Asked<'_, N>),
    ) -> Self::Output {
        let Given {
            pose, seed, locked, ..
        } = given;
        let lanes = R::lanes::<Fused<FUSED>, 1>(&[**pose], seed, locked, given.sin_cos, given.free);
        let accept = &R::ACCEPT;
        match asked {
            Asked::Solutions(place) if lanes.settled(R::COMPLETION, accept) => {
                lanes.write(0, accept, place);
                None
            }
            Asked::Regular(place)
                if lanes.settled(R::COMPLETION, accept) & !lanes.singular(accept) =>
            {
                lanes.write(0, accept, place);
                None
            }
            Asked::Nearest(motion, place)
                if lanes.settled(R::COMPLETION, accept)
                    & (given.takes_singular | !lanes.singular(accept)) =>
            {
                *place = lanes.branches().choose(accept, motion);
                None
            }
            _ => Some((lanes.branches(), lanes.free_joints())),
        }
    }
}

/// The solutions of a robot for one target, joints that are free at 0; `otherwise` tells them where
/// lanes do not: where rounding may keep a branch from the target, a free joint leaves a later step no
/// root, or an elimination completes the branches.
#[inline]
pub fn solve<R, const N: usize, const L: usize, const P: usize, const M: usize, const F: usize>(
    _: &R,
    pose: &Pose,
    locked: &[Real; P],
    otherwise: impl Fn(Branches<N, L>) -> Solutions<N>,
) -> Solutions<N>
where
    R: Inverse<N, L, P, M, F>,
{
    // Here, where the seed is known: of zeros the sines are constants.
    let given = Given::<R, N, L, P, M, F>::new(pose, &[0.0; N], locked);
    Solutions::build_with_prismatic(R::ACCEPT.prismatic, |solutions| {
        if let Some(found) = given.ask(Asked::Solutions(solutions)) {
            *solutions = given.led_to(found, otherwise);
        }
    })
}

/// The same with joints that are free at a seed; `otherwise` is asked where a branch is singular too.
#[inline]
pub fn solve_seeded<
    R,
    const N: usize,
    const L: usize,
    const P: usize,
    const M: usize,
    const F: usize,
>(
    _: &R,
    pose: &Pose,
    seed: &[Real; N],
    locked: &[Real; P],
    otherwise: impl Fn(Branches<N, L>) -> Solutions<N>,
) -> Solutions<N>
where
    R: Inverse<N, L, P, M, F>,
{
    let given = Given::<R, N, L, P, M, F>::new(pose, seed, locked);
    Solutions::build_with_prismatic(R::ACCEPT.prismatic, |solutions| {
        if let Some(found) = given.ask(Asked::Regular(solutions)) {
            *solutions = given.led_to(found, otherwise);
        }
    })
}

/// The solutions of a robot for one target and joints that are given beside it, as `otherwise` has them of
/// branches.
#[inline]
pub fn solve_given<
    R,
    const N: usize,
    const L: usize,
    const P: usize,
    const M: usize,
    const F: usize,
    const K: usize,
>(
    _: &R,
    pose: &Pose,
    seed: &[Real; N],
    given: &[Real; P],
    otherwise: impl Fn(Branches<N, L>) -> Solutions<K>,
) -> Solutions<K>
where
    R: Inverse<N, L, P, M, F>,
{
    let given = Given::<R, N, L, P, M, F>::new(pose, seed, given);
    let found = given.branches();
    match found.0.nearly(&R::ACCEPT) | found.1.leave_no_root() {
        true => given.led_to(found, otherwise),
        false => otherwise(found.0),
    }
}

/// Of the solutions of a robot for one target the one that moves the joints least from `seed`, as
/// [`Solutions::nearest_by`] of [`solve_seeded`], without writing the others down. The seed of `nearest`
/// is not read; by how much a configuration misses the target is `missed`, metres.
///
/// The branches do not wait for the sines of the seed, which count where an angle is free: they
/// take those of zeros, which are constants, and run again for the few targets that have one.
#[inline]
pub fn solve_nearest<
    R,
    const N: usize,
    const L: usize,
    const P: usize,
    const M: usize,
    const F: usize,
>(
    _: &R,
    pose: &Pose,
    locked: &[Real; P],
    nearest: &Nearest<N>,
    seed: &[Real; N],
    missed: impl FnOnce(&[Real; N]) -> Real,
    otherwise: impl Fn(Branches<N, L>) -> Solutions<N>,
) -> Option<Solution<N>>
where
    R: Inverse<N, L, P, M, F>,
{
    let given = Given {
        takes_singular: false,
        ..Given::<R, N, L, P, M, F>::new(pose, &[0.0; N], locked)
    };
    let motion = nearest.motion(seed, R::ACCEPT.prismatic);
    let mut solution = None;
    if given.ask(Asked::Nearest(&motion, &mut solution)).is_some() {
        let given = Given::<R, N, L, P, M, F>::new(pose, seed, locked);
        solution = given.nearest(nearest, seed, &motion, missed, otherwise);
    }
    solution
}

impl<const N: usize, const L: usize> Branches<N, L> {
    /// Those of a closed form for one target, with angles that are free at `seed`.
    #[inline]
    pub fn of<R, const P: usize, const M: usize, const F: usize>(
        _: &R,
        pose: &Pose,
        seed: &[Real; N],
        locked: &[Real; P],
    ) -> Self
    where
        R: Inverse<N, L, P, M, F>,
    {
        let given = Given::<R, N, L, P, M, F>::new(pose, seed, locked);
        given.with_root(given.branches())
    }
}
