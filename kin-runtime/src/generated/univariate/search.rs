//! The search for the solutions of one target.

use super::candidates::{Candidate, Candidates};
use super::elimination::Elimination;
use super::found::{Answer, Found, NEXT_TO, REACHED, Waiting};
use super::polish::{Polished, polished};
use super::polynomial::{NOISY, polynomial};
use super::recover::{Recovery, Starts};
use super::roots::{CLUSTER, MOST, Roots, roots};
use super::sharing::{RATIOS, SHARING};
use super::split::split;
use super::{LANES, Outcome, Univariate};
use crate::generated::refinement::{Problem, levenberg};
use crate::linear::vector::norm;
use crate::scalar::tolerance::ROTATION;
use crate::{Pose, Solution, Solutions, Target, math};
use core::f64::consts::TAU;

/// Cosines and sines that are off by more are those of an extraneous root.
const EXTRANEOUS: f64 = 0.05;

/// The same of several that have almost met: at one value of the kept joint what is nearly taken
/// to zero is their space but for how far their own values are apart, and its vectors mix them.
const MIXED: f64 = 0.5;

/// The same of one that eigenvalues tell from others: of no solution.
const OF_NONE: f64 = 0.2;

/// Where they are off by less, a null vector is of one solution, and no mixture.
const PURE: f64 = 1e-3;

/// In units of half the arm's size, a target that is farther away than the arm is long by no more may be
/// one that is reached.
const BEYOND_REACH: f64 = 1e-6;

/// Relative noise above which the roots tell nothing.
const DROWNED: f64 = 1e-3;

/// Relative noise above which no answer is sure.
const UNCERTAIN: f64 = 1e-9;

/// Relative noise above which a double root is too far off for its null space to be found.
const BLURRED: f64 = 1e-7;

/// How far the targets beside one with a family of solutions are: by angle, radians, and
/// in units of half the arm's size.
const BESIDE: f64 = 1e-4;
const BESIDE_BY: [f64; 3] = [3e-5, -5e-5, 8e-5];

/// Values of the kept joint that are nearer to each other, radians, are one.
const SAME: f64 = 1e-9;

/// Steps of Newton's method at most; twice as many where it converges slowly.
const STEPS: usize = 6;

/// The arm's size in the units of its frames.
const SIZE: f64 = 2.0;

/// A seed that misses the target by less, in units of half the arm's size, is taken to be beside a solution.
const BESIDE_SEED: f64 = 2e-2;

/// Evaluations of Levenberg's method at most on its way to a singular solution.
const STEPS_TO_SEED: usize = 40;

/// Below this another solution may be so near that roots of the polynomial do not
/// tell the two apart.
const MEETING: f64 = 3e-3;

/// The same of branches of an idealized arm, as a multiple of what is nearly singular: where a
/// root of the plan is flagged, the two solutions that differ by its sign may be as far from
/// each other.
const MEETING_BRANCHES: f64 = 4.0;

/// The joints behind the tip of an arm of fewer are this near to zero at its solutions, unless six
/// are nearly singular: then another solution is near, and they may be farther. An arm that is off its
/// design by little may miss a target by as little with the mirror image of a solution.
const AT_ZERO: f64 = 1e-12;

/// In units of the arm's size, how near Newton's method comes to a target that it
/// converges to slowly, or that is out of reach by little.
const NEARLY: f64 = 1e-3;

/// Rounds of looking for them at most: where several meet, each shows the next.
const MEETINGS: usize = 4;

/// What is known of one target.
pub(super) struct Search<'a> {
    arm: &'a Univariate<'a>,
    /// Orthonormal; lengths in units of half the arm's size.
    target: Pose,
    /// Whether the given one was so nearly, and is no farther away than the arm is long.
    may_be_reached: bool,
    found: Found,
    /// The branch of the next solution.
    branch: u32,
    /// Configurations to start Newton's method from.
    starts: Waiting,
    /// Configurations near the target that it led to, and no further.
    stuck: Waiting,
    /// Below this independence another solution may be near.
    meeting: f64,
    /// Whether another target is the one that is meant.
    is_beside: bool,
    /// How many regular solutions were searched for neighbours.
    looked_at: usize,
    /// The same of singular ones.
    looked_at_singular: usize,
}

impl<'a> Search<'a> {
    pub fn new(arm: &'a Univariate<'a>, target: &Pose) -> Self {
        let (rotated, gap) = whole(arm.counts, target);
        let target = Pose {
            translation: target.translation.map(|x| x * (2.0 / arm.size)),
            ..rotated
        };
        let is_too_far = norm(target.translation) > arm.frames.reach() + BEYOND_REACH;
        Self {
            arm,
            target,
            may_be_reached: gap <= ROTATION && !is_too_far,
            found: Found::new(arm, gap),
            branch: 0,
            starts: Waiting::default(),
            stuck: Waiting::default(),
            meeting: MEETING,
            is_beside: false,
            looked_at: 0,
            looked_at_singular: 0,
        }
    }

    /// The target as the arm's frames have it.
    pub fn target(&self) -> &Pose {
        &self.target
    }

    /// All that the eliminations find.
    pub fn run(mut self) -> Answer {
        if self.may_be_reached {
            self.ask_in_turn();
        }
        Answer {
            solutions: self.found(),
            nearest: self.found.nearest,
        }
    }

    /// What was found so far.
    pub fn found(&self) -> Solutions<6> {
        let first = self.arm.eliminations.first();
        let joint = first.map_or(0, |first| usize::from(first.joints[0] % 6));
        self.found.by_joint(joint)
    }

    /// Moves the branches of an idealized arm to solutions of this one. Where one is lost,
    /// or too near to another one to tell them apart, the eliminations are asked in turn for the
    /// others, which are numbered from `count` on; `seed` is the first of them if it is a singular
    /// solution.
    pub fn refine(
        mut self,
        branches: impl Iterator<Item = Solution<6>>,
        seed: &[f64; 6],
        count: usize,
        near_singular: f64,
        moving: usize,
    ) -> Answer {
        if !self.may_be_reached {
            return Answer {
                solutions: Solutions::new(),
                nearest: None,
            };
        }
        self.meeting = math::max(MEETING, MEETING_BRANCHES * near_singular);
        self.branch = count as u32;
        // Of arms of fewer joints branches need not reach the target. Those that do are off by less,
        // unless a root is nearly double.
        let missed = self.meeting * self.arm.size;
        let (mut clear, mut some, mut reaching) = (true, false, None);
        let mut numbers = [0; LANES];
        let mut certain = [false; LANES];
        for branch in branches {
            some = true;
            if branch.residual <= NEXT_TO * self.arm.size {
                reaching = reaching.or(Some(branch));
            }
            clear &= !branch.singular;
            certain[self.starts.count] = branch.residual <= missed;
            numbers[self.starts.count] = branch.branch;
            self.starts.push(branch.q);
            if self.starts.is_full() {
                clear &= self.refined(&numbers, &certain);
            }
        }
        if self.starts.count > 0 {
            clear &= self.refined(&numbers, &certain);
        }
        let is_solution = |it: &Solution<6>| it.q[moving..].iter().all(|q| q.abs() < AT_ZERO);
        clear &= !some || self.found.regular.iter().any(is_solution);
        if !clear {
            self.keep(seed);
            self.branch += 1;
            self.ask_in_turn();
        }
        // Where the ideal arm is singular, Newton's steps lead away from a branch that reaches the
        // target but for the noise.
        Answer {
            solutions: self.found.by_branch(),
            nearest: self.found.nearest.or(reaching),
        }
    }

    /// Starts Newton's method from branches of the ideal arm; whether all that are `certain` to
    /// reach the target lead to regular solutions, each to one of its own.
    fn refined(&mut self, numbers: &[u32; LANES], certain: &[bool; LANES]) -> bool {
        let (starts, count) = self.starts.take();
        let arrived = self.polished(&starts, STEPS);
        let mut all = true;
        for (k, &number) in numbers[..count].iter().enumerate() {
            let before = self.found.regular.len();
            if !self.found.insert(&arrived, k, number) {
                self.stick(&arrived, k);
            }
            all &= self.found.regular.len() > before || !certain[k];
        }
        all
    }

    /// Takes a configuration in if it is singular, and nearly a solution. Where the Jacobian loses two
    /// ranks at once Newton's steps, which divide rounding by both pivots, lead away from one.
    pub fn keep(&mut self, seed: &[f64; 6]) {
        let mut arrived = self.polished(&seed.map(|q| [q; LANES]), STEPS);
        let start = self.arm.frames.forward(seed);
        let missed = Target::Pose.distance(&start, &self.target, SIZE);
        if arrived.residual[0] > REACHED && missed < BESIDE_SEED {
            let led = self.led(seed);
            arrived = self.polished(&led.map(|q| [q; LANES]), 0);
        }
        self.found.keep(&arrived, self.branch);
    }

    /// Where Levenberg's method leads.
    #[cold]
    fn led(&self, from: &[f64; 6]) -> [f64; 6] {
        let problem = Problem {
            fk_jacobian: |q: &[f64; 6]| self.arm.frames.fk_jacobian(q),
            target: &self.target,
            size: SIZE,
            counts: Target::Pose,
        };
        levenberg(&problem, *from, STEPS_TO_SEED).q
    }

    /// Asks the eliminations in turn until one is sure of its answer.
    fn ask_in_turn(&mut self) {
        for elimination in self.arm.eliminations {
            if self.ask(elimination).certain {
                return;
            }
        }
    }

    /// Adds what one elimination finds.
    pub fn ask(&mut self, elimination: &Elimination) -> Outcome {
        let recovery = Recovery::new(elimination, &self.arm.frames, &self.target);
        let f = polynomial(&recovery);
        let mut outcome = Outcome {
            noise: f.noise,
            ..Outcome::default()
        };
        let Some(roots) = (f.noise < DROWNED).then(|| roots(&f)) else {
            self.take_members(&recovery);
            self.ask_beside(elimination);
            return outcome;
        };
        outcome.roots = roots.count;
        self.found.again = 0;
        let mut unclear = self.one_each(&recovery, &roots);
        outcome.unclear = unclear.len();
        let may_be_certain = !roots.incomplete && f.noise < UNCERTAIN;
        if may_be_certain {
            unclear.count_zeros(elimination.fold, &f);
        }
        self.several_each(&recovery, f.noise >= NOISY, &mut unclear);
        if !may_be_certain || !self.has_all(&unclear) {
            if roots.incomplete || f.noise > BLURRED {
                self.ask_beside(elimination);
            }
            self.meet();
            self.drop_complete(elimination, &mut unclear);
        }
        outcome.certain = may_be_certain && self.has_all(&unclear);
        outcome
    }

    /// Where a family of solutions makes a polynomial of zeros, every value that the kept joint has in
    /// the family is a root: adds the members at some, which are alone there or two.
    #[cold]
    fn take_members(&mut self, recovery: &Recovery) {
        let before = self.found.singular.len();
        for offset in [0.0, 0.5] {
            let kept = core::array::from_fn(|k| (k as f64 + offset) * (TAU / LANES as f64));
            let alone = recovery.joints(&kept);
            (0..LANES).for_each(|k| self.start_of(&alone, k, EXTRANEOUS));
            self.arrive();
            if self.found.singular.len() > before {
                return;
            }
            let space = recovery.null_space::<2>(&kept).vectors;
            for starts in recovery.sharing(&kept, &space, RATIOS[0]).starts {
                (0..LANES).for_each(|k| self.start_of(&starts, k, EXTRANEOUS));
            }
            self.arrive();
            if self.found.singular.len() > before {
                return;
            }
        }
    }

    /// Whether there is nothing left to look for, and what was known before was found again.
    fn has_all(&self, unclear: &Candidates) -> bool {
        unclear.is_empty() && self.found.all_again()
    }

    /// Where a family of solutions makes a polynomial of zeros, those of targets beside this
    /// one are none, and the solutions there are beside those here.
    #[cold]
    fn ask_beside(&mut self, elimination: &Elimination) {
        if self.is_beside {
            return;
        }
        let there = Pose::from_axis_angle([0.36, 0.48, 0.8], BESIDE, BESIDE_BY);
        // Where solutions have met, one of the two is out of reach.
        for motion in [there, there.inverse()] {
            let mut beside = Self {
                target: self.target * motion,
                found: Found::new(self.arm, 0.0),
                is_beside: true,
                ..Self::new(self.arm, &Pose::IDENTITY)
            };
            beside.ask(elimination);
            for solution in beside.found.regular.iter().chain(&beside.found.singular) {
                self.start(&solution.q.map(|q| [q; LANES]), 0);
            }
            // Of a family that leads nowhere else these are next to its members.
            for q in beside.stuck.iter() {
                self.start(&q.map(|q| [q; LANES]), 0);
            }
        }
        self.arrive();
        self.meet();
    }

    /// Adds the solution at every root that is one, if it has one; those that may have more.
    fn one_each(&mut self, recovery: &Recovery, roots: &Roots) -> Candidates {
        let mut unclear = Candidates::default();
        let is_one = |&root: &usize| !roots.is_double(root) && !roots.is_several(root);
        (0..roots.count)
            .filter(|root| !is_one(root))
            .for_each(|root| unclear.push(roots, root));
        let mut left = (0..roots.count).filter(is_one);
        while let Some(first) = left.next() {
            let (mut some, mut count) = ([first; LANES], 1);
            for root in left.by_ref().take(LANES - 1) {
                some[count] = root;
                count += 1;
            }
            let starts = recovery.joints(&some.map(|root| roots.angles[root % MOST]));
            let mut new = Waiting::default();
            let mut candidates = [0; LANES];
            for (k, &root) in some[..count].iter().enumerate() {
                let before = self.found.again;
                let off = starts.inconsistency[k];
                let known = self.mark_if_known(&starts.q, k);
                // Next to another one a root is known to half of its digits.
                let mixed = off >= EXTRANEOUS && roots.has_neighbour(root);
                if known && (self.found.again == before || off > PURE) || mixed {
                    unclear.push(roots, root);
                } else if !known && off < EXTRANEOUS {
                    candidates[new.count] = root;
                    new.push(starts.q.map(|q| q[k]));
                } else if !known {
                    let at = [roots.angles[root % MOST]; LANES];
                    // Where more is taken to zero than what is of a solution, a vector need not be.
                    if recovery.null_space::<2>(&at).dimension(0) > 1 {
                        unclear.push(roots, root);
                    }
                }
            }
            if new.count == 0 {
                continue;
            }
            let (from, count) = new.take();
            let arrived = self.polished(&from, STEPS);
            for (k, &root) in candidates[..count].iter().enumerate() {
                let before = self.found.again;
                self.insert(&arrived, k);
                let new = self.found.again & !before;
                // It may have led to the solution at another root.
                let mut near = self.kept_near(recovery.elimination, roots.angles[root]);
                if !near.any(|(place, _)| new >> place & 1 == 1) {
                    unclear.push(roots, root);
                }
            }
        }
        unclear
    }

    /// Adds the solutions that share a value of the kept joint, and leaves the candidates that may
    /// have more. Where a pivot is nearly zero at all its values, as next to a target with a family
    /// of solutions, so is what it leaves alone, and the space of two solutions has more dimensions.
    fn several_each(&mut self, recovery: &Recovery, is_noisy: bool, unclear: &mut Candidates) {
        let elimination = recovery.elimination;
        self.drop_complete(elimination, unclear);
        let may_be_more = |it: &Candidate| it.is_several && it.zeros.is_some_and(|it| it.count > 2);
        self.share::<2>(recovery, unclear, |it| !may_be_more(it), EXTRANEOUS);
        self.share::<SHARING>(recovery, unclear, |it| is_noisy || it.is_several, MIXED);
        self.share::<2>(recovery, unclear, may_be_more, EXTRANEOUS);
        self.share_exactly(recovery, unclear);
        self.drop_complete(elimination, unclear);
        // What else is nearly taken to zero mixes with the two.
        self.share::<SHARING>(recovery, unclear, |it| it.is_double, EXTRANEOUS);
    }

    /// Adds the solutions of N that share a value of the kept joint.
    fn share<const N: usize>(
        &mut self,
        recovery: &Recovery,
        unclear: &mut Candidates,
        wanted: impl Fn(&Candidate) -> bool,
        off: f64,
    ) {
        let mut left = unclear.all_mut().filter(|it| wanted(it));
        while let Some(first) = left.next() {
            let mut some: [Option<&mut Candidate>; LANES] = Default::default();
            let mut kept = [first.angle; LANES];
            some[0] = Some(first);
            for (k, next) in (1..LANES).zip(&mut left) {
                kept[k] = next.angle;
                some[k] = Some(next);
            }
            let space = recovery.null_space::<N>(&kept);
            let shared = recovery.sharing(&kept, &space.vectors, RATIOS[0]);
            for (k, candidate) in some.into_iter().flatten().enumerate() {
                let met = candidate
                    .zeros
                    .as_mut()
                    .filter(|it| candidate.is_met && it.count == N);
                if let Some(zeros) = met {
                    zeros.count -= shared.extraneous(&space, k, OF_NONE);
                }
                for starts in shared.real(k) {
                    self.start_of(starts, k, off);
                }
            }
        }
        drop(left);
        self.arrive();
        self.drop_complete(recovery.elimination, unclear);
    }

    /// Leaves the candidates that other solutions than those that are known may be near.
    fn drop_complete(&mut self, elimination: &Elimination, unclear: &mut Candidates) {
        unclear.retain(|candidate| !self.mark_if_complete(elimination, candidate));
    }

    /// Whether near a candidate as many solutions are known as there are zeros: no two have one.
    /// These are marked as found again.
    fn mark_if_complete(&mut self, elimination: &Elimination, candidate: &Candidate) -> bool {
        let Some(zeros) = candidate.zeros else {
            return false;
        };
        let (mut count, mut places) = (0, 0);
        for (place, kept) in self.kept(elimination).enumerate() {
            if zeros.are_near(kept) {
                count += 1;
                places |= 1 << place;
            }
        }
        let is_complete = count == zeros.count;
        if is_complete {
            self.found.again |= places;
        }
        is_complete
    }

    /// A root of several is known to a quarter of its digits, and what is nearly taken to zero there
    /// mixes the solutions that share it. Those that are found have all digits of it, and there what
    /// is taken to zero tells whether some are missing, which other ratios may tell apart.
    fn share_exactly(&mut self, recovery: &Recovery, unclear: &Candidates) {
        let elimination = recovery.elimination;
        let several = unclear.all().filter(|it| it.is_several);
        let (mut kept, mut count) = ([0.0; LANES], 0);
        for (_, known) in several.flat_map(|it| self.kept_near(elimination, it.angle)) {
            let is_new = kept[..count].iter().all(|it| !is_same(*it, known));
            if is_new && count < LANES && self.sharing(elimination, known) < SHARING {
                kept[count] = known;
                count += 1;
            }
        }
        if count == 0 {
            return;
        }
        let space = recovery.null_space::<SHARING>(&kept);
        for (i, ratio) in RATIOS.into_iter().enumerate() {
            let mut missing = [false; LANES];
            for k in 0..count {
                missing[k] = i == 0 || space.dimension(k) > self.sharing(elimination, kept[k]);
            }
            if !missing.contains(&true) {
                return;
            }
            let all = recovery.sharing(&kept, &space.vectors, ratio).starts;
            for k in (0..count).filter(|&k| missing[k]) {
                all.iter()
                    .for_each(|starts| self.start_of(starts, k, MIXED));
            }
            self.arrive();
        }
    }

    /// The kept joint's values at regular solutions.
    fn kept(&self, elimination: &Elimination) -> impl Iterator<Item = f64> {
        let sign = if elimination.backwards { -1.0 } else { 1.0 };
        let joint = usize::from(elimination.joints[0] % 6);
        self.found
            .regular
            .iter()
            .map(move |found| sign * found.q[joint])
    }

    /// How many of them are this one.
    fn sharing(&self, elimination: &Elimination, value: f64) -> usize {
        let same = |kept: &f64| is_same(*kept, value);
        self.kept(elimination).filter(same).count()
    }

    /// Those of them that are near a root, and the solutions' places.
    fn kept_near(
        &self,
        elimination: &Elimination,
        root: f64,
    ) -> impl Iterator<Item = (usize, f64)> {
        let near = move |(_, kept): &(usize, f64)| math::wrap(kept - root).abs() < CLUSTER;
        self.kept(elimination).enumerate().filter(near)
    }

    /// Adds the solutions that nearly singular ones have nearly met, and those between
    /// which Newton's method got stuck.
    fn meet(&mut self) {
        let mut points = core::mem::take(&mut self.stuck);
        for _ in 0..MEETINGS {
            while !points.is_full() && self.looked_at < self.found.regular.len() {
                if self.found.independence[self.looked_at] < self.meeting {
                    points.push(self.found.regular[self.looked_at].q);
                }
                self.looked_at += 1;
            }
            while !points.is_full() && self.looked_at_singular < self.found.singular.len() {
                points.push(self.found.singular[self.looked_at_singular].q);
                self.looked_at_singular += 1;
            }
            let (from, count) = points.take();
            if count == 0 {
                break;
            }
            for starts in split(&self.arm.frames, &self.target, &from) {
                (0..count).for_each(|k| self.start(&starts, k));
            }
            self.arrive();
        }
        if !self.is_beside {
            self.stuck = Waiting::default();
        }
    }

    /// Starts Newton's method from the configuration in a lane, as soon as there are
    /// enough of them.
    fn start(&mut self, q: &[[f64; LANES]; 6], lane: usize) {
        self.starts.push(q.map(|q| q[lane]));
        if self.starts.is_full() {
            self.arrive();
        }
    }

    /// The same, if it may be near a solution that is not known: if it is off by no more.
    fn start_of(&mut self, starts: &Starts, lane: usize, off: f64) {
        if starts.inconsistency[lane] < off && !self.mark_if_known(&starts.q, lane) {
            self.start(&starts.q, lane);
        }
    }

    /// Whether the solution next to the configuration in a lane is known.
    fn mark_if_known(&mut self, q: &[[f64; LANES]; 6], lane: usize) -> bool {
        self.found.mark_if_known(&q.map(|q| q[lane]), self.meeting)
    }

    /// Starts Newton's method from the configurations that wait.
    fn arrive(&mut self) {
        if self.starts.count == 0 {
            return;
        }
        let (starts, count) = self.starts.take();
        let arrived = self.polished(&starts, 2 * STEPS);
        for k in 0..count {
            if !self.insert(&arrived, k) {
                self.stick(&arrived, k);
            }
        }
    }

    /// Keeps where Newton's method has come near.
    fn stick(&mut self, arrived: &Polished, lane: usize) {
        if arrived.residual[lane] < NEARLY {
            let prismatic = self.arm.frames.prismatic;
            self.stuck
                .push_distinct(prismatic, arrived.q.map(|q| q[lane]));
        }
    }

    fn insert(&mut self, arrived: &Polished, lane: usize) -> bool {
        let before = self.found.len();
        let reached = self.found.insert(arrived, lane, self.branch);
        self.branch += u32::from(self.found.len() > before);
        reached
    }

    /// Configurations that nearly close the loop, if any do, at values of the kept joint
    /// all round.
    pub fn all_round(&self, elimination: &Elimination) -> [[f64; LANES]; 6] {
        let recovery = Recovery::new(elimination, &self.arm.frames, &self.target);
        let kept = core::array::from_fn(|k| TAU / LANES as f64 * k as f64);
        recovery.joints(&kept).q
    }

    fn polished(&self, start: &[[f64; LANES]; 6], steps: usize) -> Polished {
        polished(&self.arm.frames, &self.target, start, steps)
    }
}

/// Whether two values of the kept joint are one.
fn is_same(a: f64, b: f64) -> bool {
    math::wrap(a - b).abs() < SAME
}

/// A pose with all that counts of a target, its rotation orthonormal, and by how much the
/// target's was not, radians.
pub(super) fn whole(counts: Target, target: &Pose) -> (Pose, f64) {
    if counts == Target::Pose {
        let nearest = target.orthonormalized().unwrap_or(*target);
        return (nearest, target.rotation_error());
    }
    let axis = target.rotation.map(|row| row[2]);
    let length = norm(axis);
    let [x, y, z] = axis.map(|x| x / length);
    // T. Duff et al., "Building an Orthonormal Basis, Revisited", J. Computer Graphics
    // Techniques 6, 2017.
    let sign = 1.0_f64.copysign(z);
    let a = -1.0 / (sign + z);
    let b = x * y * a;
    let across = [1.0 + sign * x * x * a, sign * b, -sign * x];
    let rotation = [
        [across[0], b, x],
        [across[1], sign + y * y * a, y],
        [across[2], -y, z],
    ];
    (
        Pose {
            rotation,
            ..*target
        },
        (length - 1.0).abs(),
    )
}
