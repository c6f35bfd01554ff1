//! The closed form of an arm: the relations that were read into its axes, the
//! plan, its expressions, and the refinement onto the arm as given.

mod approximate;
mod branches;
mod reading;
mod roots;

pub use reading::Reading;
pub(crate) use reading::tip_shift;
pub use roots::Domain;

use crate::expr::inverse::{FreeJoints, InverseGraph, TipShift};
use crate::geometry::{Carried, Coupling, Idealized, Linkage};
use crate::model::Model;
use crate::plan::{Atom, Plan, Step, Subproblem, Target};
use crate::scalar::Tolerances;
use crate::single;
use crate::univariate;
use branches::existing;
use kin_runtime::__private::refinement::{AtSwivel, Problem, correct_branches};
use kin_runtime::__private::{Acceptance, Completion, Projection};
use kin_runtime::{Chain, Pose, Solution, Solutions};

/// In square roots of the relative shift of the tip, how near to a singular
/// configuration the branches of the idealized arm do not tell those of the arm
/// as given: two roots that are nearer may have met on one of the two arms and
/// have left each other on the other.
const NEAR_SINGULAR: f64 = 0.5;

/// The same of solutions that are corrected from branches, by which those are found of two roots that
/// have met on one arm and not on the other; not where a step degenerates.
const NOT_CORRECTED: f64 = 0.1;

/// Of branches that are none of the arm's: how near they are to a target tells nothing.
const NONE: f64 = -1.0;

/// Residuals are believed to tell a larger share of a miss than this.
const LEAST_RESIDUAL_SHARE: f64 = 0.1;

/// A tip that is off by less than this share of what branches may miss a target by is not off.
const NOTICED: f64 = 1e-3;

/// Below this conditioning an elimination may not tell two solutions apart.
const DROWNED: f64 = 1e-4;

/// What computes the branches of a plan.
#[derive(Clone, Debug)]
pub enum Inverse {
    /// Expressions for its subproblems.
    Expressions(Box<InverseGraph>),
    /// A polynomial in one joint.
    Univariate(Box<univariate::Arm>),
}

/// A closed form.
#[derive(Clone, Debug)]
pub struct ClosedForm {
    /// The arm that the plan is for: that of the file, with its relations made
    /// exact.
    pub idealized: Idealized,
    /// Its frames.
    pub linkage: Linkage,
    /// The frames of the arm as given.
    pub given: Linkage,
    /// The plan.
    pub plan: Plan,
    /// What becomes of joints that its singular targets leave free.
    pub free: FreeJoints,
    /// The plan as it is run.
    pub inverse: Inverse,
    /// How far the idealized arm's tip is from the given one's, metres.
    pub tip_shift: f64,
    /// From the branches to solutions of the arm as given.
    pub refinement: Refinement,
    /// Forward kinematics of the arm as given, where it is computed in single precision.
    pub single: Option<single::Forward>,
}

/// From the branches of the plan to the solutions of the arm as given.
#[derive(Clone, Debug, PartialEq)]
pub enum Refinement {
    /// They are the same, but for what rounding does where roots nearly meet; of an arm off its
    /// design each leads to one, by Levenberg's method.
    Correction,
    /// Newton's method, and where the branches do not tell all solutions, because the arm
    /// is off the idealized one or a step degenerates, an elimination of all joints but one.
    Univariate(Box<univariate::Arm>),
}

/// A [`Solution`] with as many joints as a robot that is known at run time has.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct BranchSolution {
    /// Joint values, radians and metres.
    pub q: Vec<f64>,
    /// The distance of its pose from the target, metres.
    pub residual: f64,
    /// Which combination of roots it is.
    pub branch: u32,
    /// Whether it stands for a family of solutions, or for two that have met.
    pub singular: bool,
}

impl BranchSolution {
    /// Of a solution in an array.
    pub fn of<const N: usize>(found: &Solution<N>) -> Self {
        Self {
            q: found.q.to_vec(),
            residual: found.residual,
            branch: found.branch,
            singular: found.singular,
        }
    }

    /// The same with the values of joints in place of the coordinates that they depend on.
    pub fn by_joints(&self, linkage: &Linkage) -> Self {
        Self {
            q: linkage.joints_at(&self.q).into_owned(),
            ..self.clone()
        }
    }
}

impl ClosedForm {
    /// By an elimination alone, of the arm as given.
    pub fn eliminating(
        model: &Model,
        linkage: &Linkage,
        target: Target,
        arm: univariate::Arm,
    ) -> Self {
        let joints = arm.kept[0].elimination.joints;
        let joints = joints.iter().filter_map(|&i| linkage.joint_of(i.into()));
        let step = Step {
            subproblem: Subproblem::Univariate,
            unknowns: joints.map(Atom::Joint).collect(),
            relations: Vec::new(),
            complement: None,
        };
        Self {
            idealized: Idealized {
                model: model.clone(),
                moved: Vec::new(),
                tolerance: 0.0,
            },
            linkage: linkage.clone(),
            given: linkage.clone(),
            plan: Plan {
                steps: vec![step],
                target,
            },
            free: FreeJoints::Seeded,
            inverse: Inverse::Univariate(Box::new(arm)),
            tip_shift: 0.0,
            refinement: Refinement::Correction,
            single: None,
        }
    }

    /// What the digits of the scalar allow.
    fn tolerances(&self) -> Tolerances {
        self.linkage.scalar.tolerances()
    }

    /// Whether the arm as given has the relations exactly.
    pub fn is_exact(&self) -> bool {
        self.tip_shift < self.linkage.unmoved(self.plan.target)
    }

    /// The elimination of all joints but one, if the arm is solved by that or has it beside
    /// its branches.
    pub fn elimination(&self) -> Option<&univariate::Arm> {
        match (&self.inverse, &self.refinement) {
            (Inverse::Univariate(arm), _) | (_, Refinement::Univariate(arm)) => Some(arm),
            _ => None,
        }
    }

    /// How many solutions a target has at most: its branches, and what an elimination finds beside them.
    pub fn most_solutions(&self) -> usize {
        match self.elimination() {
            Some(_) => Solutions::<6>::CAPACITY,
            None => self.plan.branches(),
        }
    }

    /// For which targets an elimination completes the branches of an exact arm.
    pub fn completion(&self) -> Completion {
        match self.refinement {
            Refinement::Univariate(_) if !self.is_exact() => Completion::Never,
            // That flags all steps that degenerate.
            Refinement::Univariate(_) if self.free == FreeJoints::Flagged => Completion::Degenerate,
            Refinement::Univariate(_) => Completion::Unanswered,
            _ => Completion::Never,
        }
    }

    /// Whether an elimination is asked for targets that are not singular.
    pub fn asks_elimination(&self) -> bool {
        self.elimination().is_some() && self.completion() != Completion::Unanswered
    }

    /// Whether its branches are its solutions, but for a few targets.
    pub fn is_in_lanes(&self) -> bool {
        self.is_exact() && self.expressions().is_some()
    }

    /// Whether where its solutions begin and end is told by an elimination: not of plans, whose
    /// roots tell it unless the arm is off them.
    pub fn is_told_by_elimination(&self) -> bool {
        self.elimination().is_some() && (self.expressions().is_none() || !self.is_exact())
    }

    /// What the generated function will return, computed on the tape; of an arm
    /// without locked joints.
    pub fn solutions(&self, target: &Pose) -> Vec<BranchSolution> {
        self.solutions_at(target, &[])
    }

    /// The same with the values of the locked joints, which are left out of the
    /// configurations, or with the swivel angle.
    pub fn solutions_at(&self, target: &Pose, parameters: &[f64]) -> Vec<BranchSolution> {
        self.solutions_each([(target, parameters)]).swap_remove(0)
    }

    /// The same for each of some targets.
    pub fn solutions_each<'a>(
        &self,
        targets: impl IntoIterator<Item = (&'a Pose, &'a [f64])>,
    ) -> Vec<Vec<BranchSolution>> {
        let mut all = Vec::new();
        match self.given.variables() {
            1 => self.solved_each::<1>(targets, |found| all.push(of_solutions(&found))),
            2 => self.solved_each::<2>(targets, |found| all.push(of_solutions(&found))),
            3 => self.solved_each::<3>(targets, |found| all.push(of_solutions(&found))),
            4 => self.solved_each::<4>(targets, |found| all.push(of_solutions(&found))),
            5 => self.solved_each::<5>(targets, |found| all.push(of_solutions(&found))),
            7 => all.extend(targets.into_iter().map(|(target, parameters)| {
                of_solutions(&self.solved_at_swivel(target, parameters, &[0.0; 7]))
            })),
            _ => self.solved_each::<6>(targets, |found| all.push(of_solutions(&found))),
        }
        all
    }

    /// The solutions for the N joints that a target is solved for, unless they are seven with a
    /// swivel.
    pub fn solved<const N: usize>(&self, target: &Pose, parameters: &[f64]) -> Solutions<N> {
        self.solved_near(target, parameters, None)
    }

    /// The same; a joint that a singular target leaves free keeps its value in `seed`.
    pub fn solved_near<const N: usize>(
        &self,
        target: &Pose,
        parameters: &[f64],
        seed: Option<&[f64; N]>,
    ) -> Solutions<N> {
        let sorted = |branches: &[_]| self.sorted(target, parameters, seed, branches);
        self.solved_by_branches(target, parameters, seed.unwrap_or(&[0.0; N]), sorted)
    }

    /// The solutions, from all branches of the plan.
    fn sorted<const N: usize>(
        &self,
        target: &Pose,
        parameters: &[f64],
        seed: Option<&[f64; N]>,
        branches: &[(bool, Solution<N>)],
    ) -> Solutions<N> {
        match (&self.inverse, &self.refinement) {
            _ if self.plan.target.is_projected() && self.is_exact() => {
                let accept = self.acceptance();
                Solutions::build_with_prismatic(accept.prismatic, |solutions| {
                    for branch in existing(branches) {
                        solutions.push_if(branch.residual <= accept.tolerance, branch);
                    }
                })
            }
            (Inverse::Univariate(arm), _) => {
                let (carried, between) = self.carried(target, parameters);
                let arm = arm.at(between);
                match seed {
                    None => arm.solutions(&carried),
                    Some(seed) => arm.solutions_near(&carried, seed),
                }
            }
            (_, Refinement::Univariate(arm)) => {
                let begun = self.begun(branches);
                let completed = || {
                    let (carried, between) = self.carried(target, parameters);
                    let seed = seed.unwrap_or(&[0.0; N]);
                    let (begun, count) = (begun.iter().copied(), self.plan.branches());
                    arm.at(between)
                        .refined(&carried, begun, seed, count, self.least_conditioning())
                };
                let corrected = || self.refined(target, parameters, existing(branches), seed);
                let degenerates = || begun.iter().any(|branch| branch.singular);
                let nearly = self.acceptance().nearly;
                let nearly_reach = || begun.iter().any(|branch| branch.residual <= nearly);
                match self.completion() {
                    Completion::Never => completed(),
                    Completion::Unanswered => match corrected() {
                        corrected if corrected.is_empty() && nearly_reach() => completed(),
                        corrected => corrected,
                    },
                    Completion::Degenerate if degenerates() => completed(),
                    Completion::Degenerate => corrected(),
                }
            }
            _ => self.refined(target, parameters, existing(branches), seed),
        }
    }

    /// Of branches those that solutions are sought from: those that exist, and those that reach the
    /// target, which are singular.
    fn begun<const N: usize>(&self, branches: &[(bool, Solution<N>)]) -> Vec<Solution<N>> {
        let nearly = self.acceptance().nearly;
        let begins = |(exists, branch): &&(bool, Solution<N>)| *exists || branch.residual <= nearly;
        let begun = branches.iter().filter(begins);
        let begun = begun.map(|(exists, branch)| Solution {
            singular: branch.singular || !exists,
            ..*branch
        });
        begun.collect()
    }

    /// The target of the joints between those that are locked at the ends, and the values of
    /// those that are locked between them.
    fn carried<'a>(&self, target: &Pose, parameters: &'a [f64]) -> (Pose, &'a [f64]) {
        let carried = Carried::new(&self.given);
        (
            carried.target(target, parameters),
            &parameters[carried.between()],
        )
    }

    /// All joint values, from those that a target is solved for and those of locked
    /// joints.
    pub fn whole(&self, solved: &[f64], parameters: &[f64]) -> Vec<f64> {
        let mut q = solved.to_vec();
        for (&joint, &value) in self.given.locked.iter().zip(parameters) {
            q.insert(joint, value);
        }
        q
    }

    /// The values of the locked joints among all joint values, or the swivel angle, and the
    /// values of the joints that targets are solved for.
    pub fn split(&self, q: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let is_locked = |i: &usize| self.given.locked.contains(i);
        let (locked, solved) = (0..q.len()).partition::<Vec<usize>, _>(is_locked);
        let values =
            |joints: Vec<usize>| -> Vec<f64> { joints.into_iter().map(|i| q[i]).collect() };
        let mut parameters = values(locked);
        if let Some(swivel) = self.given.swivel {
            let chain = Chain::new(self.given.twists(), Pose::IDENTITY);
            parameters.push(swivel.angle(&chain, q));
        }
        (parameters, values(solved))
    }

    /// The values of all joints that are solved for or given, from all coordinates of q.
    pub fn joints(&self, q: &[f64]) -> Vec<f64> {
        let (parameters, solved) = self.split(q);
        self.whole(&self.given.joints_at(&solved), &parameters)
    }

    /// All coordinates of q, from the values of these joints.
    pub fn coordinates(&self, joints: &[f64]) -> Vec<f64> {
        let (parameters, solved) = self.split(joints);
        self.whole(&self.given.coordinates_at(solved), &parameters)
    }

    /// The plan as expressions, if it is run by them.
    pub fn expressions(&self) -> Option<&InverseGraph> {
        match &self.inverse {
            Inverse::Expressions(graph) => Some(graph),
            Inverse::Univariate(_) => None,
        }
    }

    /// The branches of the plan that exist, of an arm of so many joints as it has.
    pub fn branches_at(&self, target: &Pose, parameters: &[f64]) -> Vec<BranchSolution> {
        fn existing_ones<const N: usize>(branches: &[Solution<N>]) -> Vec<BranchSolution> {
            branches.iter().map(BranchSolution::of).collect()
        }
        match self.given.variables() {
            1 => existing_ones(&self.branches::<1>(target, parameters, &[0.0; 1])),
            2 => existing_ones(&self.branches::<2>(target, parameters, &[0.0; 2])),
            3 => existing_ones(&self.branches::<3>(target, parameters, &[0.0; 3])),
            4 => existing_ones(&self.branches::<4>(target, parameters, &[0.0; 4])),
            5 => existing_ones(&self.branches::<5>(target, parameters, &[0.0; 5])),
            7 => existing_ones(&self.branches::<7>(target, parameters, &[0.0; 7])),
            _ => existing_ones(&self.branches::<6>(target, parameters, &[0.0; 6])),
        }
    }

    /// The branches, corrected or refined onto the arm as given.
    fn refined<const N: usize>(
        &self,
        target: &Pose,
        parameters: &[f64],
        starts: impl Iterator<Item = Solution<N>> + Clone,
        seed: Option<&[f64; N]>,
    ) -> Solutions<N> {
        let accept = self.acceptance();
        let seed = seed.unwrap_or(&[0.0; N]);
        if let Some(forward) = &self.single {
            return forward.corrected(target, self.plan.target, starts, seed, &accept);
        }
        let projection = self.projection();
        let target = projection.target(target);
        let fk_jacobian =
            |q: &[f64; N]| projection.fk_jacobian(self.given.fk_jacobian(q, parameters));
        let problem = Problem::new(fk_jacobian, &target, self.plan.target, &accept);
        correct_branches(&problem, starts, seed, &accept)
    }

    /// How targets see the tip of the arm as given.
    pub fn projection(&self) -> Projection {
        self.given.projection(self.plan.target)
    }

    /// The same where its branches are corrected and targets do not see all of the tip.
    pub fn corrected_projection(&self) -> Option<Projection> {
        let is_seen = self.plan.target.is_projected() && !self.is_exact();
        is_seen.then(|| self.projection())
    }

    /// The same as [`Self::solved_near`] at a swivel angle.
    pub fn solved_at_swivel(
        &self,
        target: &Pose,
        parameters: &[f64],
        seed: &[f64; 7],
    ) -> Solutions<7> {
        let (Some(swivel), &[angle]) = (self.given.swivel, parameters) else {
            return Solutions::new();
        };
        let twists = self.given.twists();
        let arm = AtSwivel {
            swivel: &swivel.seen_from_home(&self.given.tip_home()),
            angle,
            links: |q: &[f64; 7]| swivel.links(&twists, q),
            fk_jacobian: |q: &[f64; 7]| self.given.fk_jacobian(q, &[]),
        };
        let accept = self.acceptance();
        let corrected = |branches: &[_]| arm.corrected(target, existing(branches), seed, &accept);
        self.solved_by_branches(target, parameters, seed, corrected)
    }

    /// Below this conditioning of the Jacobian solutions may be lost, 0 if none
    /// may.
    pub fn near_singular(&self) -> f64 {
        match self.refinement {
            _ if self.is_exact() => self.tolerances().near_singular,
            // Their roots that meet start in one place.
            Refinement::Correction if self.plan.target == Target::Pose => self.least_conditioning(),
            Refinement::Correction => NOT_CORRECTED * self.relative_shift().sqrt(),
            Refinement::Univariate(_) => DROWNED,
        }
    }

    /// Below this conditioning the branches of the idealized arm do not tell those
    /// of the arm as given; 0 if they are one.
    pub fn least_conditioning(&self) -> f64 {
        match self.is_exact() {
            true => 0.0,
            false => NEAR_SINGULAR * self.relative_shift().sqrt(),
        }
    }

    /// How far the idealized arm's tip is from the given one's, relative to the arm's size.
    fn relative_shift(&self) -> f64 {
        self.tip_shift / self.linkage.size
    }

    /// The same for the expressions of its plan.
    pub(crate) fn shift(&self) -> TipShift {
        TipShift {
            relative: self.relative_shift(),
            is_refined: !self.is_exact(),
        }
    }

    /// The share of a miss that residuals tell; see [`InverseGraph::residual_share`].
    fn residual_share(&self) -> f64 {
        let share = self.expressions().map_or(1.0, |graph| graph.residual_share);
        let is_all = share > 1.0 - self.tolerances().accepted;
        if is_all {
            1.0
        } else {
            share.max(LEAST_RESIDUAL_SHARE)
        }
    }

    /// What makes a branch a solution.
    pub fn acceptance(&self) -> Acceptance {
        let given = &self.given;
        let sliding = (0..given.variables()).filter(|&i| !given.repeats(i));
        let (size, tolerances) = (self.linkage.size, self.tolerances());
        let has_quartic = |step: &Step| step.subproblem.choices() == 2;
        let has_to_agree = Coupling::is_overdetermined;
        let nearly = if self.linkage.coupling.as_ref().is_some_and(has_to_agree) {
            tolerances.nearly_coupled
        } else if self.plan.steps.iter().any(has_quartic) {
            tolerances.nearly_by_quartic
        } else {
            tolerances.nearly
        };
        // A branch that reaches a target on the idealized arm may miss it by so much more on the one
        // that is given.
        let off = self.tip_shift / size;
        let off = match self.is_exact() && off > NOTICED * tolerances.accepted {
            true => off,
            false => 0.0,
        };
        let tolerance = (tolerances.accepted - off) * size;
        let is_corrected = self.refinement == Refinement::Correction && !self.is_exact();
        let (taken, nearly) = match is_corrected {
            true => (NONE, size),
            false => (self.residual_share() * tolerance, nearly * size),
        };
        Acceptance {
            size,
            tolerance,
            taken,
            nearly,
            near_singular: self.least_conditioning(),
            prismatic: sliding.fold(0, |mask, i| mask | 1 << i),
        }
    }
}

fn of_solutions<const N: usize>(found: &Solutions<N>) -> Vec<BranchSolution> {
    found.iter().map(BranchSolution::of).collect()
}
