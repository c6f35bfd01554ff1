//! Joints that a singular target leaves free.
//!
//! Any value closes the step that asks for such a joint, but not every value leaves the steps behind
//! it a real root: a UR with its wrist stretched can turn its elbow out of reach of the shoulder, and
//! an arm in the plane of its rail may be too far along it. The branches have the seed's value. Where
//! that leaves a later root none, the joint moves to where the root is a double one, if that is next to
//! it. Otherwise the freedom is spent on the root: its equation a cos θ + b sin θ = d has
//! the more room the nearer d is to zero. As a function of a free angle φ d often is
//! d₀ + d₁ cos φ + d₂ sin φ, and of a free slide x d₀ + d₁ x + d₂ x², which its values at three places
//! tell. Where it is not, since angles in between follow the free joint, places all round are tried.
//! They take more runs of the plan, which regular targets do not pay.

use super::super::math;
use super::super::scalar::Real;
use super::super::scalar::consts::{FRAC_PI_2, PI};
use super::super::scalar::tolerance::AS_TOLD;
pub use super::super::scalar::tolerance::{FREE_BELOW, NEARLY_FREE};
use super::branches::Branches;

/// What later roots say of F joints that may be free, as array lanes.
#[derive(Clone, Copy, Debug)]
pub struct FreeJoints<const L: usize, const F: usize> {
    /// d of the root's equation a cos θ + b sin θ = d, as a share of the amplitude.
    pub level: [[Real; L]; F],
    /// Positive where the joint is free and its value leaves no real root.
    pub no_root: [[Real; L]; F],
}

impl<const L: usize, const F: usize> FreeJoints<L, F> {
    /// Whether a joint's value costs some branch its root.
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

    /// Whether in a lane some of these joints leaves a root none.
    fn leaves_none(&self, k: usize, mut joints: impl Iterator<Item = usize>) -> bool {
        joints.any(|i| self.no_root[i][k] > 0.0)
    }
}

/// A joint that singular targets may leave free.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeJoint {
    /// Its coordinate of the seed.
    pub coordinate: usize,
    /// How far a slide goes while an angle turns by one radian; none for an angle. Slides move by
    /// turns too.
    pub slide: Option<Real>,
}

/// What a later root says of a free joint at some turns from the seed's value.
#[derive(Clone, Copy, Debug)]
pub struct Levels {
    levels: [Real; 4],
    is_slide: bool,
}

impl Levels {
    /// The turns, radians: three tell d₀ + d₁ cos φ + d₂ sin φ or d₀ + d₁ φ + d₂ φ², and the fourth
    /// whether d is that.
    pub const TURNS: [Real; 4] = [0.0, FRAC_PI_2, PI, 4.0];

    /// From d at [`TURNS`](Self::TURNS).
    pub fn new(levels: [Real; 4], joint: FreeJoint) -> Self {
        let is_slide = joint.slide.is_some();
        Levels { levels, is_slide }
    }

    /// The turn, radians, that leaves the root the most room; of two for a slide the nearer one.
    ///
    /// ```
    /// use kin_runtime::__private::free_joint::{FreeJoint, Levels};
    /// let angle = FreeJoint { coordinate: 0, slide: None };
    /// let level = |turn: f64| 0.3 - 0.5 * turn.cos() + 0.4 * turn.sin();
    /// let levels = Levels::new(Levels::TURNS.map(level), angle);
    /// assert!(level(levels.roomiest()).abs() < 1e-15);
    ///
    /// let slide = FreeJoint { coordinate: 0, slide: Some(1.5) };
    /// let level = |turn: f64| 12.0 - 8.0 * turn + turn * turn;
    /// let levels = Levels::new(Levels::TURNS.map(level), slide);
    /// assert!((levels.roomiest() - 2.0).abs() < 1e-14);
    /// ```
    pub fn roomiest(self) -> Real {
        let [mean, x, y] = self.coefficients();
        if self.is_slide {
            return FRAC_PI_2 * nearest_zero([mean, x, y]);
        }
        // mean + x cos φ + y sin φ = 0 by the tangent of half of φ less the phase, or what comes
        // nearest to it.
        let amplitude = math::sqrt(x * x + y * y);
        let [near, far] = [amplitude + mean, amplitude - mean].map(|end| math::sqrt(end.max(0.0)));
        math::wrap(math::atan2(y, x) - 2.0 * math::atan2(near, far))
    }

    /// The turn, radians, to where the root becomes a double one, if that is as good as none: a seed
    /// next to what reaches the target is to stay there.
    ///
    /// ```
    /// use kin_runtime::__private::free_joint::{FreeJoint, Levels};
    /// let angle = FreeJoint { coordinate: 0, slide: None };
    /// let level = |turn: f64| 0.7 + 1e-6 + 0.3 * turn.cos() + 0.4 * turn.sin();
    /// let turn = Levels::new(Levels::TURNS.map(level), angle).next_root().unwrap();
    /// assert!(turn.abs() < 3e-6 && (level(turn) - 1.0).abs() < 1e-15);
    ///
    /// let slide = FreeJoint { coordinate: 0, slide: Some(1.5) };
    /// let level = |turn: f64| -1.0 - 1e-6 + 0.4 * turn + turn * turn;
    /// let turn = Levels::new(Levels::TURNS.map(level), slide).next_root().unwrap();
    /// assert!(turn.abs() < 3e-6 && (level(turn) + 1.0).abs() < 1e-15);
    ///
    /// let far = Levels::new(Levels::TURNS.map(|turn: f64| 2.0 + turn.sin()), angle);
    /// assert_eq!(far.next_root(), None);
    /// ```
    pub fn next_root(self) -> Option<Real> {
        let [_, x, y] = self.coefficients();
        let here = self.levels[0];
        let beyond = here - if here < 0.0 { -1.0 } else { 1.0 };
        // Of an angle by t, the tangent of half of it: beyond (1 + t²) + 2 y t − 2 x t² = 0.
        let turn = match self.is_slide {
            true => FRAC_PI_2 * nearest_zero([beyond, x, y]),
            false => 2.0 * math::atan2(nearest_zero([beyond, 2.0 * y, beyond - 2.0 * x]), 1.0),
        };
        (turn.abs() <= NEXT).then_some(turn)
    }

    /// Whether d is as the three turns tell it, at the fourth and where it is known too.
    pub fn tell(self, turn: Real, level: Real) -> bool {
        let coefficients = self.coefficients();
        let is_told = |(turn, level): (Real, Real)| {
            let of = self.functions(turn);
            let mut miss = -level;
            let mut scale = 0.0;
            for (coefficient, function) in coefficients.into_iter().zip(of) {
                miss += coefficient * function;
                scale += coefficient.abs() * function.abs().max(1.0);
            }
            miss.abs() <= AS_TOLD * scale
        };
        let known = [(Self::TURNS[3], self.levels[3]), (turn, level)];
        known.into_iter().all(is_told)
    }

    /// Of [`functions`](Self::functions).
    fn coefficients(self) -> [Real; 3] {
        let [here, quarter, half, _] = self.levels;
        let mean = 0.5 * (here + half);
        match self.is_slide {
            true => {
                let bend = mean - quarter;
                [here, 0.5 * (half - here) - 2.0 * bend, bend]
            }
            false => [mean, 0.5 * (here - half), quarter - mean],
        }
    }

    /// What d is a combination of at a turn: a constant, then of an angle cosine and sine, of a slide
    /// quarters and their square.
    fn functions(self, turn: Real) -> [Real; 3] {
        if self.is_slide {
            let quarters = turn / FRAC_PI_2;
            return [1.0, quarters, quarters * quarters];
        }
        let (sine, cosine) = math::sin_cos(turn);
        [1.0, cosine, sine]
    }
}

/// Where c + b x + a x² is zero nearest to 0, or if it is nowhere where it is least.
fn nearest_zero([c, b, a]: [Real; 3]) -> Real {
    let discriminant = b * b - 4.0 * a * c;
    let (over, below) = match discriminant < 0.0 {
        true => (-b, 2.0 * a),
        false => {
            let root = math::sqrt(discriminant);
            (-2.0 * c, b + if b < 0.0 { -root } else { root })
        }
    };
    if below == 0.0 { 0.0 } else { over / below }
}

/// As good as no turn, radians.
const NEXT: Real = 0.05;

/// How many turns all round there are, the seed's own among them.
const TURNS: usize = 16;

/// How often the steps between turns are halved where none of these leaves a root.
const HALVINGS: usize = 5;

/// Steps to the turns beside the best one, radians, through which a parabola then tells where |d| is
/// least.
const PARABOLAS: [Real; 4] = [1e-2, 1e-3, 1e-4, 2e-5];

/// Where branches lead to fewer solutions than there are of them, joints that are free turn by this,
/// radians: neither one of them, nor two or three together, by nearly a multiple of a quarter turn.
pub const ELSEWHERE: [Real; 2] = [0.65, 1.9];

/// Between turns all round, radians.
const STEP: Real = 2.0 * PI / TURNS as Real;

/// Turns all round but the seed's own, radians: to both sides, as slides go.
pub fn all_round() -> impl Iterator<Item = Real> {
    let half = TURNS as i32 / 2;
    let steps = (1 - half..=half).filter(|&step| step != 0);
    steps.map(|step| step as Real * STEP)
}

/// What moves the joints that are free. `run` gives the branches for a seed and the threshold below
/// which joints are free and follow their coordinates of the seed.
pub(super) struct Moving<R, const F: usize> {
    pub joints: [FreeJoint; F],
    pub run: R,
}

/// What a turn of a free joint leaves the roots for which it makes room.
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
    /// use kin_runtime::__private::free_joint::Room;
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
struct Moved<const N: usize, const L: usize, const F: usize> {
    seed: [Real; N],
    branches: Branches<N, L>,
    free: FreeJoints<L, F>,
}

impl<R, const F: usize> Moving<R, F> {
    /// The branches of a seed with free joints moved where their own values leave a later root
    /// none.
    #[cold]
    #[inline(never)]
    pub fn moved<const N: usize, const L: usize>(
        &self,
        mut branches: Branches<N, L>,
        free: &FreeJoints<L, F>,
        seed: &[Real; N],
    ) -> Branches<N, L>
    where
        R: Fn(&[Real; N], Real) -> (Branches<N, L>, FreeJoints<L, F>),
    {
        self.move_from(&mut branches, [true; L], free, seed, 0);
        branches
    }

    /// Moves the joints from the `first` one of the lanes that are `open`. Where more than one is
    /// free, each moves after those before it.
    fn move_from<const N: usize, const L: usize>(
        &self,
        branches: &mut Branches<N, L>,
        mut open: [bool; L],
        free: &FreeJoints<L, F>,
        seed: &[Real; N],
        first: usize,
    ) where
        R: Fn(&[Real; N], Real) -> (Branches<N, L>, FreeJoints<L, F>),
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
                let levels = Levels::new(samples.map(|level| level[k]), self.joints[i]);
                let next = levels.next_root().map(|turn| self.at(seed, i, turn));
                let next = next.filter(|next| !next.free.leaves_none(k, self.roots_of(i)));
                let best = next.unwrap_or_else(|| {
                    let turn = levels.roomiest();
                    let best = self.at(seed, i, turn);
                    let is_as_told = levels.tell(turn, best.free.level[i][k]);
                    let others = self.roots_of(i).filter(|&j| !(j == i && is_as_told));
                    if !best.free.leaves_none(k, others) {
                        return best;
                    }
                    let tried = tried.get_or_insert_with(|| self.tried_all_round(seed, i));
                    let room = |turn| self.room(&self.at(seed, i, turn).free, i, k, turn);
                    self.at(seed, i, tried[k].or_between(room).turn)
                });
                branches.set_lane(k, &best.branches);
                let only = core::array::from_fn(|other| other == k);
                self.move_from(branches, only, &best.free, &best.seed, i + 1);
            }
        }
    }

    /// Everything that a free joint makes room for.
    fn roots_of(&self, i: usize) -> impl Iterator<Item = usize> {
        (0..F).filter(move |&j| self.joints[j].coordinate == self.joints[i].coordinate)
    }

    /// Of turns all round the one that leaves each lane the most room, or the least to miss.
    fn tried_all_round<const N: usize, const L: usize>(
        &self,
        seed: &[Real; N],
        i: usize,
    ) -> [Room; L]
    where
        R: Fn(&[Real; N], Real) -> (Branches<N, L>, FreeJoints<L, F>),
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
        free: &FreeJoints<L, F>,
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
    ) -> Moved<N, L, F>
    where
        R: Fn(&[Real; N], Real) -> (Branches<N, L>, FreeJoints<L, F>),
    {
        let mut seed = *seed;
        let FreeJoint { coordinate, slide } = self.joints[i];
        seed[coordinate] += slide.unwrap_or(1.0) * turn;
        let (branches, free) = (self.run)(&seed, NEARLY_FREE);
        Moved {
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
