//! Closed forms in lanes, of one target or of several.

use super::super::Pose;
use super::super::scalar::Real;
use super::branches::Branches;
use super::dispatch::{Dispatched, dispatch};
use super::free_angle::{FREE_BELOW, FreeAngle};
use core::marker::PhantomData;

/// A closed form with L branches for N joints, of which P more are given.
pub trait Inverse<const N: usize, const L: usize, const P: usize> {
    /// The coordinate whose seed an angle has that singular targets leave free, if
    /// its value can leave a later root none.
    const FREE: Option<usize>;

    /// The branches of T targets. Angles that are free are at `seed`; vectors whose
    /// square is below `free` tell no angle; `locked` are the values of the joints
    /// that are given; all in radians and metres. To be `#[inline(always)]`.
    fn lanes<const T: usize>(
        targets: &[Pose; T],
        seed: &[Real; N],
        locked: &[Real; P],
        free: Real,
    ) -> Lanes<N, L, T>;
}

/// The branches of T targets; see [`Branches`] and [`FreeAngle`].
#[derive(Clone, Copy)]
pub struct Lanes<const N: usize, const L: usize, const T: usize> {
    /// By joint, in (−π, π] radians or metres.
    pub q: [[[Real; T]; L]; N],
    /// The distance of each branch from its target, metres.
    pub residual: [[Real; T]; L],
    /// Positive where the branch does not exist or repeats another.
    pub invalid: [[Real; T]; L],
    /// Positive where a root is double or an angle is free.
    pub singular: [[Real; T]; L],
    /// d of the equation a cos θ + b sin θ = d of the root behind a free angle.
    pub level: [[Real; T]; L],
    /// Positive where the angle is free and its value leaves no real root.
    pub no_root: [[Real; T]; L],
}

impl<const N: usize, const L: usize> Lanes<N, L, 1> {
    #[inline(always)]
    fn branches(&self) -> Branches<N, L> {
        Branches {
            q: self.q.map(alone),
            residual: alone(self.residual),
            invalid: alone(self.invalid),
            singular: alone(self.singular),
        }
    }

    #[inline(always)]
    fn free_angle(&self) -> FreeAngle<L> {
        FreeAngle {
            level: alone(self.level),
            no_root: alone(self.no_root),
        }
    }
}

#[inline(always)]
fn alone<const L: usize>(lanes: [[Real; 1]; L]) -> [Real; L] {
    lanes.map(|[one]| one)
}

/// The branches of one target.
struct Single<R, const P: usize>(PhantomData<R>);

impl<R, const N: usize, const L: usize, const P: usize>
    Dispatched<(&Pose, &[Real; N], &[Real; P], PhantomData<[(); L]>)> for Single<R, P>
where
    R: Inverse<N, L, P>,
{
    type Output = Branches<N, L>;

    #[inline(always)]
    fn run(
        (pose, seed, locked, _): (&Pose, &[Real; N], &[Real; P], PhantomData<[(); L]>),
    ) -> Self::Output {
        R::lanes(&[*pose], seed, locked, FREE_BELOW).branches()
    }
}

/// The same with what is said of an angle that may be free.
struct Seeded<R, const P: usize>(PhantomData<R>);

impl<R, const N: usize, const L: usize, const P: usize>
    Dispatched<(&Pose, &[Real; N], &[Real; P], Real, PhantomData<[(); L]>)> for Seeded<R, P>
where
    R: Inverse<N, L, P>,
{
    type Output = (Branches<N, L>, FreeAngle<L>);

    #[inline(always)]
    fn run(
        (pose, seed, locked, free, _): (&Pose, &[Real; N], &[Real; P], Real, PhantomData<[(); L]>),
    ) -> Self::Output {
        let lanes = R::lanes(&[*pose], seed, locked, free);
        (lanes.branches(), lanes.free_angle())
    }
}

impl<const N: usize, const L: usize> Branches<N, L> {
    /// Those of a closed form for one target, with angles that are free at `seed`.
    #[inline]
    pub fn of<R, const P: usize>(pose: &Pose, seed: &[Real; N], locked: &[Real; P]) -> Self
    where
        R: Inverse<N, L, P>,
    {
        let Some(coordinate) = R::FREE else {
            return dispatch::<Single<R, P>, _>((pose, seed, locked, PhantomData));
        };
        let seeded = |seed: &[Real; N], free: Real| {
            dispatch::<Seeded<R, P>, _>((pose, seed, locked, free, PhantomData))
        };
        let (branches, free_angle) = seeded(seed, FREE_BELOW);
        // A free angle at the seed's value can leave a later step no root: it turns
        // to where it leaves the most room.
        if free_angle.leaves_no_root() {
            return branches.with_free_angle(&free_angle, seed, coordinate, seeded);
        }
        branches
    }
}
