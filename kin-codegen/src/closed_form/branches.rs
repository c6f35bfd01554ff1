//! The branches of a plan by its tape: of one target, or of several side by side.

use super::ClosedForm;
use crate::expr::Lanes;
use crate::expr::inverse::InverseGraph;
use crate::scalar::Scalar;
use kin_runtime::__private::Completion;
use kin_runtime::__private::free_joint::{ELSEWHERE, FreeJoint, Levels, Room, all_round};
use kin_runtime::{Pose, Solution, Solutions};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

/// Lanes that are computed at once for a target: most plans have so many branches.
const LANES: usize = 8;
/// Targets that are computed side by side.
const TARGETS: usize = 4;
const WIDTH: usize = LANES * TARGETS;

/// What a root is of differs by less than this share of itself where that is rounding.
const SAME_LEVEL: f64 = 1e-9;

/// Outputs of [`InverseGraph::outputs`] behind the joint values.
const RESIDUAL: usize = 0;
const INVALID: usize = 1;
const SINGULAR: usize = 2;
/// From here on two by free joint: the level, and whether it leaves no root.
const FREE: usize = 3;

impl ClosedForm {
    /// The branches of the plan that exist, if it is run by expressions.
    pub(crate) fn branches<const N: usize>(
        &self,
        target: &Pose,
        parameters: &[f64],
        seed: &[f64; N],
    ) -> Vec<Solution<N>> {
        existing(&self.all_branches(target, parameters, seed)).collect()
    }

    /// All branches of the plan, also those that do not exist or repeat another, and whether they
    /// do.
    pub(super) fn all_branches<const N: usize>(
        &self,
        target: &Pose,
        parameters: &[f64],
        seed: &[f64; N],
    ) -> Vec<(bool, Solution<N>)> {
        match self.question(target, parameters, seed) {
            Some(at) => at.all_solutions(&at.evaluate(self.tolerances().free_below)),
            None => Vec::new(),
        }
    }

    /// The solutions for each of many targets, as [`ClosedForm::solved`] has them.
    pub fn solved_each<'a, const N: usize>(
        &self,
        targets: impl IntoIterator<Item = (&'a Pose, &'a [f64])>,
        mut answer: impl FnMut(Solutions<N>),
    ) {
        let seed = [0.0; N];
        let mut targets = targets.into_iter().peekable();
        while targets.peek().is_some() {
            let some: Vec<_> = targets.by_ref().take(TARGETS).collect();
            let questions: Option<Vec<Question>> = some
                .iter()
                .map(|(target, parameters)| self.question(target, parameters, &seed))
                .collect();
            let whole = questions.and_then(|all| <[Question; TARGETS]>::try_from(all).ok());
            let Some(all) = whole else {
                for (target, parameters) in some {
                    answer(self.solved(target, parameters));
                }
                continue;
            };
            let lanes = evaluate_each(&all, self.tolerances().free_below);
            for (place, at) in all.iter().enumerate() {
                let values = Values {
                    joints: at.inverse.q.len(),
                    of: Of::Several(&lanes, place),
                };
                let sorted = |branches: &[_]| self.sorted(at.target, at.parameters, None, branches);
                answer(self.led_to(at, &values, sorted));
            }
        }
    }

    /// The solutions of a target that is solved by expressions, `sorted` from its branches; see
    /// [`kin_runtime::__private::solve_given`].
    pub(super) fn solved_by_branches<const N: usize>(
        &self,
        target: &Pose,
        parameters: &[f64],
        seed: &[f64; N],
        sorted: impl Fn(&[(bool, Solution<N>)]) -> Solutions<N>,
    ) -> Solutions<N> {
        match self.question(target, parameters, seed) {
            None => sorted(&[]),
            Some(at) => {
                let values = at.evaluate(self.tolerances().free_below);
                self.led_to(&at, &values, sorted)
            }
        }
    }

    fn led_to<const N: usize>(
        &self,
        at: &Question,
        values: &Values,
        sorted: impl Fn(&[(bool, Solution<N>)]) -> Solutions<N>,
    ) -> Solutions<N> {
        let branches = at.all_solutions(values);
        let mut solutions = sorted(&branches);
        if !self.is_in_lanes() || self.completion() != Completion::Never {
            return solutions;
        }
        let add = |solutions: &mut Solutions<N>, mut branches: Vec<(bool, Solution<N>)>| {
            for known in &*solutions {
                branches[known.branch as usize].0 = false;
            }
            for solution in &sorted(&branches) {
                solutions.insert_new(*solution, self.tolerances().one);
            }
        };
        let moves = at.moves(values);
        let as_told = match moves {
            true => at.as_told(values),
            false => branches,
        };
        let nearly = self.acceptance().nearly;
        let begins = |(exists, branch): &&(bool, Solution<N>)| *exists && branch.residual <= nearly;
        let begin = as_told.iter().filter(begins).count();
        if moves {
            add(&mut solutions, as_told);
        }
        for turn in ELSEWHERE {
            if solutions.len() < begin {
                let seed: Vec<f64> = at.seed.iter().map(|x| finite(*x) + turn).collect();
                let values = at.evaluate_at(&seed, self.tolerances().nearly_free);
                add(&mut solutions, at.as_told(&values));
            }
        }
        solutions
    }

    /// How many targets are best solved side by side: where refinement or an elimination takes
    /// the time, each by itself.
    pub fn side_by_side(&self) -> usize {
        match self.is_in_lanes() && self.single.is_none() {
            true => TARGETS,
            false => 1,
        }
    }

    /// What the first nodes of the expressions are for a branch.
    pub(crate) fn first_values(
        &self,
        count: usize,
        target: &Pose,
        parameters: &[f64],
        branch: u32,
    ) -> Vec<f64> {
        let mut values = Vec::new();
        if let Some(inverse) = self.expressions() {
            let seed = vec![0.0; inverse.q.len()];
            let free_below = self.tolerances().free_below;
            let inputs = inputs(target, &seed, parameters, free_below);
            inverse
                .graph
                .evaluate_first(count, &inputs, branch, &mut values);
        }
        values
    }

    /// Whether on some branch what a later root says of a joint that a target leaves free depends
    /// on it.
    pub(crate) fn depends_on(&self, joint: usize, target: &Pose, parameters: &[f64]) -> bool {
        let seed = vec![0.0; self.given.variables()];
        let Some(at) = self.question(target, parameters, &seed) else {
            return false;
        };
        let moved = Levels::TURNS.map(|turn| at.moved_by(turn, joint, &seed).1);
        let depends = |branch| {
            let levels = moved.each_ref().map(|values| values.level(joint, branch));
            let apart = |level: &f64| (level - levels[0]).abs() > SAME_LEVEL * levels[0].abs();
            levels.iter().any(apart)
        };
        (0..at.branches).any(depends)
    }

    fn question<'a>(
        &'a self,
        target: &'a Pose,
        parameters: &'a [f64],
        seed: &'a [f64],
    ) -> Option<Question<'a>> {
        Some(Question {
            inverse: self.expressions()?,
            target,
            parameters,
            seed,
            branches: self.plan.branches() as u32,
            scalar: self.linkage.scalar,
            moved: RefCell::default(),
        })
    }
}

/// Of branches those that exist.
pub(super) fn existing<const N: usize>(
    branches: &[(bool, Solution<N>)],
) -> impl Iterator<Item = Solution<N>> + Clone {
    let exist = branches.iter().filter(|(exists, _)| *exists);
    exist.map(|(_, branch)| *branch)
}

/// What expressions are evaluated for.
struct Question<'a> {
    inverse: &'a InverseGraph,
    target: &'a Pose,
    parameters: &'a [f64],
    /// What free joints keep.
    seed: &'a [f64],
    branches: u32,
    scalar: Scalar,
    /// What was computed with joints moved, by the bits of the seed that moves them: each of the
    /// branches asks for the same ones.
    moved: RefCell<BTreeMap<Vec<u64>, Rc<Values<'a>>>>,
}

/// All branches of a plan.
struct Values<'a> {
    joints: usize,
    of: Of<'a>,
}

enum Of<'a> {
    One(Vec<Lanes<'a, LANES>>),
    /// The target at a place among several.
    Several(&'a [Lanes<'a, WIDTH>], usize),
}

impl Values<'_> {
    fn joint(&self, coordinate: usize, branch: u32) -> f64 {
        let branch = branch as usize;
        let (block, lane) = (branch / LANES, branch % LANES);
        match &self.of {
            Of::One(blocks) => blocks[block].output(coordinate)[lane],
            Of::Several(blocks, place) => blocks[block].output(coordinate)[place * LANES + lane],
        }
    }

    /// Of an output behind the joint values.
    fn at(&self, output: usize, branch: u32) -> f64 {
        self.joint(self.joints + output, branch)
    }

    /// What a later root says of a joint that may be free.
    fn level(&self, joint: usize, branch: u32) -> f64 {
        self.at(FREE + 2 * joint, branch)
    }

    /// Whether some of the joints that are free leave a later root none.
    fn leaves_none(&self, mut joints: impl Iterator<Item = usize>, branch: u32) -> bool {
        joints.any(|joint| self.at(FREE + 2 * joint + 1, branch) > 0.0)
    }
}

fn finite(x: f64) -> f64 {
    if x.is_finite() { x } else { 0.0 }
}

/// What expressions are computed from; joints without a seed are at 0.
pub(super) fn inputs(target: &Pose, seed: &[f64], parameters: &[f64], free_below: f64) -> Vec<f64> {
    let mut inputs: Vec<f64> = Vec::with_capacity(24);
    inputs.extend(target.rotation.iter().flatten());
    inputs.extend(target.translation);
    inputs.extend(seed.iter().copied().map(finite));
    inputs.extend(parameters);
    inputs.push(free_below);
    inputs
}

/// The branches of several targets side by side, with joints free below a threshold.
fn evaluate_each<'a>(all: &[Question<'a>; TARGETS], free_below: f64) -> Vec<Lanes<'a, WIDTH>> {
    let Question {
        inverse, branches, ..
    } = all[0];
    let of = |at: &Question| inputs(at.target, at.seed, at.parameters, free_below);
    let inputs = all.each_ref().map(of);
    let blocks = (0..branches).step_by(LANES);
    blocks
        .map(|first| {
            inverse
                .tape
                .run_each(inputs.each_ref().map(|x| &x[..]), first)
        })
        .collect()
}

impl<'a> Question<'a> {
    /// Whether a branch exists, and what it is.
    fn solution<const N: usize>(&self, values: &Values, branch: u32) -> (bool, Solution<N>) {
        let moved = self.moved(values, branch, self.seed, 0);
        self.solution_as_told(moved.as_deref().unwrap_or(values), branch)
    }

    /// The same where the seed leaves free joints.
    fn solution_as_told<const N: usize>(
        &self,
        values: &Values,
        branch: u32,
    ) -> (bool, Solution<N>) {
        let solution = Solution {
            q: std::array::from_fn(|i| values.joint(i, branch)),
            residual: values.at(RESIDUAL, branch),
            singular: values.at(SINGULAR, branch) > 0.0,
            branch,
        };
        (values.at(INVALID, branch) <= 0.0, solution)
    }

    fn all_solutions<const N: usize>(&self, values: &Values) -> Vec<(bool, Solution<N>)> {
        (0..self.branches)
            .map(|it| self.solution(values, it))
            .collect()
    }

    fn as_told<const N: usize>(&self, values: &Values) -> Vec<(bool, Solution<N>)> {
        let branches = 0..self.branches;
        branches
            .map(|it| self.solution_as_told(values, it))
            .collect()
    }

    /// Whether joints that are free move.
    fn moves(&self, values: &Values) -> bool {
        let joints = self.inverse.free_joints.len();
        (0..self.branches).any(|branch| values.leaves_none(0..joints, branch))
    }

    /// The values with joints moved, from the `first` one, that are free and leave a later root of
    /// a branch none at a seed's value; see [`kin_runtime::__private::free_joint`].
    fn moved(
        &self,
        values: &Values,
        branch: u32,
        seed: &[f64],
        first: usize,
    ) -> Option<Rc<Values<'a>>> {
        let free = &self.inverse.free_joints;
        let moving = (first..free.len()).find(|&i| values.leaves_none(i..=i, branch))?;
        let joint = free[moving].joint();
        let level = |turn| self.moved_by(turn, moving, seed).1.level(moving, branch);
        let levels = Levels::TURNS.map(level);
        let is_of_joint = |&i: &usize| free[i].turn.coordinate == joint.coordinate;
        let roots = || (0..free.len()).filter(is_of_joint);
        let next = self.scalar.next_root(levels, joint);
        let next = next.map(|turn| self.moved_by(turn, moving, seed));
        let next = next.filter(|(_, values)| !values.leaves_none(roots(), branch));
        let (seed, values) = next.unwrap_or_else(|| {
            let turn = self.scalar.roomiest_turn(levels, joint);
            let best = self.moved_by(turn, moving, seed);
            let level = best.1.level(moving, branch);
            let is_as_told = self.scalar.levels_tell(levels, joint, turn, level);
            let others = roots().filter(|&i| !(i == moving && is_as_told));
            if !best.1.leaves_none(others, branch) {
                return best;
            }
            let room = |turn| {
                let values = self.moved_by(turn, moving, seed).1;
                Room {
                    turn,
                    has_roots: !values.leaves_none(roots(), branch),
                    level: values.level(moving, branch).abs(),
                }
            };
            let roomiest = all_round().map(room).fold(Room::NONE, Room::or);
            self.moved_by(roomiest.or_between(room).turn, moving, seed)
        });
        let further = self.moved(&values, branch, &seed, moving + 1);
        Some(further.unwrap_or(values))
    }

    /// The values with a joint moved where it is free, and the seed that moves it.
    fn moved_by(&self, turn: f64, joint: usize, seed: &[f64]) -> (Vec<f64>, Rc<Values<'a>>) {
        let mut seed = seed.to_vec();
        let FreeJoint { coordinate, slide } = self.inverse.free_joints[joint].joint();
        let from = &mut seed[coordinate];
        *from = slide.unwrap_or(1.0) * turn + finite(*from);
        let bits = seed.iter().map(|x| x.to_bits()).collect();
        let nearly_free = self.scalar.tolerances().nearly_free;
        let computed = || Rc::new(self.evaluate_at(&seed, nearly_free));
        let mut moved = self.moved.borrow_mut();
        let values = moved.entry(bits).or_insert_with(computed).clone();
        (seed, values)
    }

    /// The values with joints free below a threshold.
    fn evaluate(&self, free_below: f64) -> Values<'a> {
        self.evaluate_at(self.seed, free_below)
    }

    /// The same at another seed.
    fn evaluate_at(&self, seed: &[f64], free_below: f64) -> Values<'a> {
        let inverse = self.inverse;
        let inputs = inputs(self.target, seed, self.parameters, free_below);
        let blocks = (0..self.branches).step_by(LANES);
        Values {
            joints: inverse.q.len(),
            of: Of::One(
                blocks
                    .map(|first| inverse.tape.run(&inputs, first))
                    .collect(),
            ),
        }
    }
}
