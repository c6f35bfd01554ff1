//! Angles that a singular target leaves free.
//!
//! Any value closes the step that asks for such an angle, but not every value leaves the
//! steps behind it a real root: a UR with its wrist stretched can turn its
//! elbow out of reach of the shoulder. The branches have the seed's value.
//! Where that leaves a later root none, the freedom is spent on it: its
//! equation a cos θ + b sin θ = d has the more room the nearer d is to zero,
//! and as a function of the free angle d often is d₀ + d₁ cos φ + d₂ sin φ, which its
//! values at three angles tell. Where it is not, since angles in between follow the free one,
//! turns all round are tried. They take more runs of the plan, which regular targets do not pay.

use super::super::math;
use super::super::scalar::Real;
use super::super::scalar::consts::{FRAC_PI_2, PI};
use super::super::scalar::tolerance::AS_TOLD;
pub use super::super::scalar::tolerance::{FREE_BELOW, NEARLY_FREE};
use super::branches::Branches;

/// What later roots say of F angles that may be free, as array lanes.
#[derive(Clone, Copy, Debug)]
pub struct FreeAngles<const L: usize, const F: usize> {
    /// d of the root's equation a cos θ + b sin θ = d, as a share of the amplitude where that
    /// depends on the target.
    pub level: [[Real; L]; F],
    /// Positive where the angle is free and its value leaves no real root.
    pub no_root: [[Real; L]; F],
}

impl<const L: usize, const F: usize> FreeAngles<L, F> {
    /// Whether an angle's value costs some branch its root.
    #[inline(always)]
    pub fn leave_no_root(&self) -> bool {
        let mut leave = false;
        for i in 0..F {
            for k in 0..L {
                leave |= self.no_root[i][k] > 0.0;
            }
        }
        leave
    }

    /// Whether in a lane some of these angles leaves a root none.
    fn leaves_none(&self, k: usize, mut angles: impl Iterator<Item = usize>) -> bool {
        angles.any(|i| self.no_root[i][k] > 0.0)
    }
}

/// What a later root says of a free angle at some turns of the seed's.
#[derive(Clone, Copy, Debug)]
pub struct Levels([Real; 4]);

impl Levels {
    /// The turns, radians: three tell d₀ + d₁ cos φ + d₂ sin φ, and the fourth whether d is that.
    pub const TURNS: [Real; 4] = [0.0, FRAC_PI_2, PI, 4.0];

    /// From d at [`TURNS`](Self::TURNS).
    pub fn new(levels: [Real; 4]) -> Self {
        Levels(levels)
    }

    /// The turn, radians, that leaves the root the most room.
    ///
    /// ```
    /// use kin_runtime::__private::free_angle::Levels;
    /// let level = |turn: f64| 0.3 - 0.5 * turn.cos() + 0.4 * turn.sin();
    /// let levels = Levels::new(Levels::TURNS.map(level));
    /// assert!(level(levels.roomiest()).abs() < 1e-15);
    /// ```
    pub fn roomiest(self) -> Real {
        let [mean, x, y] = self.harmonics();
        // mean + x cos φ + y sin φ = 0 by the tangent of half of φ less the phase, or what comes
        // nearest to it.
        let amplitude = math::sqrt(x * x + y * y);
        let [near, far] = [amplitude + mean, amplitude - mean].map(|end| math::sqrt(end.max(0.0)));
        math::wrap(math::atan2(y, x) - 2.0 * math::atan2(near, far))
    }

    /// Whether d is as the three turns tell it, at the fourth and where it is known too.
    pub fn tell(self, turn: Real, level: Real) -> bool {
        let [mean, x, y] = self.harmonics();
        let scale = mean.abs() + x.abs() + y.abs();
        let is_told = |(turn, level): (Real, Real)| {
            let (sine, cosine) = math::sin_cos(turn);
            let off = mean + x * cosine + y * sine - level;
            off.abs() <= AS_TOLD * scale
        };
        let known = [(Self::TURNS[3], self.0[3]), (turn, level)];
        known.into_iter().all(is_told)
    }

    fn harmonics(self) -> [Real; 3] {
        let [here, quarter, half, _] = self.0;
        let mean = 0.5 * (here + half);
        [mean, 0.5 * (here - half), quarter - mean]
    }
}

/// How many turns all round there are, the seed's own among them.
const TURNS: usize = 16;

/// How often the steps between turns are halved where none of these leaves a root.
const HALVINGS: usize = 5;

/// Steps to the turns beside the best one, radians, through which a parabola then tells where |d| is
/// least.
const PARABOLAS: [Real; 4] = [1e-2, 1e-3, 1e-4, 2e-5];

/// Between turns all round, radians.
const STEP: Real = 2.0 * PI / TURNS as Real;

/// Turns all round but the seed's own, radians.
pub fn all_round() -> impl Iterator<Item = Real> {
    (1..TURNS).map(|step| step as Real * STEP)
}

/// What turns the angles that are free. `run` gives the branches for a seed and the threshold below
/// which angles are free and follow their coordinates of the seed.
pub(super) struct Turning<R, const F: usize> {
    pub coordinates: [usize; F],
    pub run: R,
}

/// What a turn of a free angle leaves the roots for which it makes room.
#[derive(Clone, Copy, Debug)]
pub struct Room {
    /// Radians.
    pub turn: Real,
    /// Whether all of them are real.
    pub has_roots: bool,
    /// |d| of that which asked.
    pub level: Real,
}

impl Room {
    /// Less than any.
    pub const NONE: Room = Room {
        turn: 0.0,
        has_roots: false,
        level: Real::INFINITY,
    };

    /// Of two turns the one that leaves more.
    pub fn or(self, other: Room) -> Room {
        let is_more = match self.has_roots == other.has_roots {
            true => other.level < self.level,
            false => other.has_roots,
        };
        if is_more { other } else { self }
    }

    /// This, of turns all round the best, or if it leaves a root none the best next to it: at one
    /// turn alone the root may be a double one.
    ///
    /// ```
    /// use kin_runtime::__private::free_angle::Room;
    /// // |d| is 1 where the root is double, and more at any other turn.
    /// let room = |turn: f64| {
    ///     let level = 2.0 - (turn - 0.4).cos() + 0.1 * (turn - 0.4).powi(3);
    ///     Room { turn, has_roots: level <= 1.0, level }
    /// };
    /// assert!((room(0.5).or_between(room).turn - 0.4).abs() < 1e-8);
    /// ```
    pub fn or_between(self, room: impl Fn(Real) -> Room) -> Room {
        let (mut best, mut step) = (self, STEP);
        for _ in 0..HALVINGS {
            if best.has_roots {
                break;
            }
            step *= 0.5;
            let [below, above] = [best.turn - step, best.turn + step].map(&room);
            best = best.or(below).or(above);
        }
        for step in PARABOLAS {
            if best.has_roots {
                break;
            }
            let [below, above] = [best.turn - step, best.turn + step].map(&room);
            let bend = below.level + above.level - 2.0 * best.level;
            if bend > 0.0 {
                let ahead = 0.5 * (below.level - above.level) / bend;
                best = best.or(room(best.turn + step * ahead));
            }
        }
        best
    }
}

/// What a seed leads to.
struct Turned<const N: usize, const L: usize, const F: usize> {
    seed: [Real; N],
    branches: Branches<N, L>,
    free: FreeAngles<L, F>,
}

impl<R, const F: usize> Turning<R, F> {
    /// The branches of a seed with free angles turned where their own values leave a later root
    /// none.
    #[cold]
    #[inline(never)]
    pub fn turned<const N: usize, const L: usize>(
        &self,
        mut branches: Branches<N, L>,
        free: &FreeAngles<L, F>,
        seed: &[Real; N],
    ) -> Branches<N, L>
    where
        R: Fn(&[Real; N], Real) -> (Branches<N, L>, FreeAngles<L, F>),
    {
        self.turn(&mut branches, [true; L], free, seed, 0);
        branches
    }

    /// Turns the angles from the `first` one of the lanes that are `open`. Where more than one is
    /// free, each turns after those before it.
    fn turn<const N: usize, const L: usize>(
        &self,
        branches: &mut Branches<N, L>,
        mut open: [bool; L],
        free: &FreeAngles<L, F>,
        seed: &[Real; N],
        first: usize,
    ) where
        R: Fn(&[Real; N], Real) -> (Branches<N, L>, FreeAngles<L, F>),
    {
        for i in first..F {
            let is_asked = |k: usize| open[k] && free.leaves_none(k, i..=i);
            let asked: [bool; L] = core::array::from_fn(is_asked);
            if !asked.contains(&true) {
                continue;
            }
            let samples = Levels::TURNS.map(|turn| self.at(seed, i, turn).free.level[i]);
            let mut tried = None;
            for k in (0..L).filter(|&k| asked[k]) {
                open[k] = false;
                let levels = Levels::new(samples.map(|level| level[k]));
                let turn = levels.roomiest();
                let mut best = self.at(seed, i, turn);
                let is_as_told = levels.tell(turn, best.free.level[i][k]);
                let others = self.roots_of(i).filter(|&j| !(j == i && is_as_told));
                if best.free.leaves_none(k, others) {
                    let tried = tried.get_or_insert_with(|| self.tried_all_round(seed, i));
                    let room = |turn| self.room(&self.at(seed, i, turn).free, i, k, turn);
                    best = self.at(seed, i, tried[k].or_between(room).turn);
                }
                branches.set_lane(k, &best.branches);
                let only = core::array::from_fn(|other| other == k);
                self.turn(branches, only, &best.free, &best.seed, i + 1);
            }
        }
    }

    /// Everything that a free angle makes room for.
    fn roots_of(&self, i: usize) -> impl Iterator<Item = usize> {
        (0..F).filter(move |&j| self.coordinates[j] == self.coordinates[i])
    }

    /// Of turns all round the one that leaves each lane the most room, or the least to miss.
    fn tried_all_round<const N: usize, const L: usize>(
        &self,
        seed: &[Real; N],
        i: usize,
    ) -> [Room; L]
    where
        R: Fn(&[Real; N], Real) -> (Branches<N, L>, FreeAngles<L, F>),
    {
        let mut best = [Room::NONE; L];
        for turn in all_round() {
            let free = self.at(seed, i, turn).free;
            for (k, best) in best.iter_mut().enumerate() {
                *best = best.or(self.room(&free, i, k, turn));
            }
        }
        best
    }

    fn room<const L: usize>(
        &self,
        free: &FreeAngles<L, F>,
        i: usize,
        k: usize,
        turn: Real,
    ) -> Room {
        Room {
            turn,
            has_roots: !free.leaves_none(k, self.roots_of(i)),
            level: free.level[i][k].abs(),
        }
    }

    #[inline(never)]
    fn at<const N: usize, const L: usize>(
        &self,
        seed: &[Real; N],
        i: usize,
        turn: Real,
    ) -> Turned<N, L, F>
    where
        R: Fn(&[Real; N], Real) -> (Branches<N, L>, FreeAngles<L, F>),
    {
        let mut seed = *seed;
        seed[self.coordinates[i]] += turn;
        let (branches, free) = (self.run)(&seed, NEARLY_FREE);
        Turned {
            seed,
            branches,
            free,
        }
    }
}

impl<const N: usize, const L: usize> Branches<N, L> {
    fn set_lane(&mut self, k: usize, other: &Self) {
        for (q, other) in self.q.iter_mut().zip(&other.q) {
            q[k] = other[k];
        }
        self.residual[k] = other.residual[k];
        self.invalid[k] = other.invalid[k];
        self.singular[k] = other.singular[k];
    }
}
