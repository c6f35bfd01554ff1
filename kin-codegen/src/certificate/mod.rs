//! The certificate: no inverse kinematics is emitted that was not seen to
//! work.
//!
//! The plan runs in the interpreter on random and on structured configurations
//! of the arm as given, and is held against the generic product of
//! exponentials, which shares no code with it: every configuration that made
//! the target must come back (*recovered*), every solution must reach the target
//! (*sound*), and no solution twice. Among the configurations are those in which axes are
//! aligned, and those in which what the plan divides by vanishes.

mod alignment;
mod parameters;
mod vanishing;

pub(crate) use parameters::SOMEWHERE;
use vanishing::{Driven, OnBranch, Quantity};

use crate::closed_form::{BranchSolution, ClosedForm};
use crate::expr::inverse::{InverseGraph, Turn};
use crate::geometry::{self, Linkage, SINGULAR};
use crate::model::{Model, anywhere, configurations, spread};
use crate::plan::Target;
use crate::random::Random;
use kin_runtime::{Chain, Pose};
use std::cell::{OnceCell, RefCell};
use std::collections::BTreeSet;
use std::f64::consts::{PI, TAU};
use std::fmt;
use std::rc::Rc;

/// Excused configurations that are tried all the same: near a singular one the
/// refinement of a branch costs a hundred times as much.
const EXCUSED: usize = 40;

/// Targets that no configuration made, on which only soundness is tried.
const ELSEWHERE: usize = 32;

/// Random configurations whose conditioning tells how many are excused.
const SHARE: usize = 400;

/// With a larger share of configurations that are excused there is no certificate.
const MOST_EXCUSED: f64 = 0.05;

/// With a larger share of singular ones too little is seen.
const MOST_SINGULAR: f64 = 0.5;

/// Configurations near singular ones, for each value of the locked joints.
const NEAR: usize = 240;

/// Of these, those on which an elimination is tried.
const TRIED: usize = 30;

/// Starts from which what a plan divides by is driven to zero; one less for each value of the locked
/// joints.
const STARTS: usize = 3;

/// Where a step degenerates and the arm is singular, so many configurations of its other joints are
/// tried: an angle that is free may leave later steps a root for some of them alone.
const SINGULAR_ONES: usize = 12;

/// Above this conditioning the arm is not singular where a step degenerates.
const NEARLY_SINGULAR: f64 = 1e-5;

/// Above this conditioning a configuration is far from singular.
const REGULAR: f64 = 1e-3;

/// What the certificate saw.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Certificate {
    /// Configurations tried.
    pub configurations: usize,
    /// Of these, singular: answered by a representative.
    pub singular: usize,
    /// Those nearer to singular than an idealized arm's branches can tell: what
    /// is lost there is excused, and of these only some are tried. None if the
    /// arm is exact.
    pub excused: usize,
    /// The share of excused ones among random configurations, 0 to 1.
    pub excused_share: f64,
    /// Singular ones to which no solution was found, and excused ones that did
    /// not come back.
    pub unanswered: usize,
    /// Regular ones that did not come back, with axes aligned that are no
    /// neighbours or nothing to divide by, or came back flagged as singular: a
    /// step of the plan degenerates there, and the arm does not.
    pub lost: usize,
    /// Solutions found in all.
    pub solutions: usize,
    /// The largest distance of a solution from its target, metres.
    pub worst_residual: f64,
    /// The largest number of solutions to one regular target.
    pub most_solutions: usize,
}

/// What a plan got wrong.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// No solution is the configuration that made the target.
    Lost(Vec<f64>),
    /// A solution does not reach its target.
    Unsound {
        /// The solution.
        q: Vec<f64>,
        /// By how much, metres.
        distance: f64,
    },
    /// One solution came twice.
    Doubled(Vec<f64>),
    /// So large a share of configurations is so near to singular that nothing is promised there.
    NearSingular(f64),
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Failure::Lost(q) => write!(f, "the configuration {q:.4?} is not among the solutions"),
            Failure::Unsound { q, distance } => write!(
                f,
                "the solution {q:.4?} misses its target by {distance:.1e} m"
            ),
            Failure::Doubled(q) => write!(f, "a solution to the target of {q:.4?} comes twice"),
            Failure::NearSingular(share) => write!(
                f,
                "{:.0} % of random configurations are so near to singular that solutions to their \
                 targets may be missing",
                100.0 * share
            ),
        }
    }
}

/// A configuration near a singular one.
pub struct NearSingular {
    /// At which values of the locked joints.
    held: usize,
    /// Radians and metres.
    pub q: Vec<f64>,
    /// How far from singular.
    pub conditioning: f64,
    /// How the tip moves least, by joint and of length 1.
    pub motion: [f64; 6],
}

/// The configurations to try on an arm, with the targets that they make.
pub struct Trials<'a> {
    model: &'a Model,
    linkage: &'a Linkage,
    target: Target,
    /// One for each value of the locked joints that is tried; a single one where none
    /// is locked.
    held: Vec<Held>,
    /// The conditioning of random configurations.
    spread: OnceCell<Vec<f64>>,
    /// Which configurations some plan has lost: the next is tried on them first.
    lost: RefCell<Vec<(usize, Rc<Trial>)>>,
}

/// The arm with its locked joints at some values: what targets are solved for, and what
/// is singular, are the others.
struct Held {
    /// What comes with targets that no configuration made.
    parameters: Vec<f64>,
    model: Model,
    chain: Chain,
    all: Vec<Rc<Trial>>,
}

#[derive(Clone)]
struct Trial {
    q: Vec<f64>,
    /// What comes with the target.
    parameters: Vec<f64>,
    pose: Pose,
    /// How far from singular.
    conditioning: f64,
    /// Whether a step may degenerate: axes that are no neighbours are aligned, or what the plan divides
    /// by is nothing, or nearly.
    may_degenerate: bool,
    /// Whether it is next to a round configuration, or a step may degenerate: on an idealized
    /// arm near singular it is not tried.
    is_attack: bool,
}

impl Trial {
    /// The same with a target that has been rounded again, as those that come by a quaternion: what
    /// is left of a sine in the sum that makes an entry is then no more than chance.
    fn rounded(&self, random: &mut Random) -> Rc<Self> {
        let mut rounded = |x: f64| x + f64::EPSILON * random.between(-1.0, 1.0);
        Rc::new(Self {
            pose: Pose {
                rotation: self.pose.rotation.map(|row| row.map(&mut rounded)),
                ..self.pose
            },
            ..self.clone()
        })
    }
}

impl<'a> Trials<'a> {
    /// Moves the arm to all the configurations.
    pub fn new(model: &'a Model, linkage: &'a Linkage, target: Target) -> Self {
        let held = parameters::tried(model, &linkage.locked);
        let held = held.into_iter().map(|parameters| {
            let model = match parameters.is_empty() {
                true => model.clone(),
                false => model.locked(&linkage.locked, &parameters),
            };
            Held::new(parameters, model, linkage, target)
        });
        Self {
            model,
            linkage,
            target,
            held: held.collect(),
            spread: OnceCell::new(),
            lost: RefCell::default(),
        }
    }

    /// The arm as the file has it; where joints mimic others, that whose joints move by themselves.
    pub fn model(&self) -> &Model {
        self.model
    }

    /// Its frames.
    pub fn linkage(&self) -> &Linkage {
        self.linkage
    }

    /// Configurations that are nearer to singular than some conditioning, though not
    /// singular: next to singular ones there are some at every distance. Of arms that are solved
    /// for six joints, by whole poses.
    pub fn near_singular(&self, untold: f64) -> Vec<NearSingular> {
        let mut random = Random(0x94d0_49bb_1331_11eb);
        let mut nearby = |q: &[f64]| -> Vec<f64> {
            let off = untold * random.between(0.0, 4.0);
            let shifted = q.iter().map(|x| x + off * random.between(-1.0, 1.0));
            shifted.collect()
        };
        let size = self.linkage.size;
        let mut all = Vec::new();
        for (number, held) in self.held.iter().enumerate() {
            let starts = held.all.iter().cycle().take(16 * held.all.len());
            let near = starts.filter_map(|trial| {
                let q = nearby(&trial.q);
                let conditioning = geometry::conditioning(&held.chain, &q, size, self.target);
                let is_near = (0.01 * SINGULAR..untold).contains(&conditioning);
                let motion = is_near.then(|| geometry::weak_motion(&held.chain, &q, size))??;
                Some(NearSingular {
                    held: number,
                    q,
                    conditioning,
                    motion,
                })
            });
            all.extend(near.take(NEAR));
        }
        all
    }

    /// Which of some configurations near singular ones a closed form loses.
    pub fn lost_near(&self, form: &ClosedForm, near: &[NearSingular]) -> Vec<bool> {
        let tried = near
            .iter()
            .step_by(near.len().div_ceil(TRIED * self.held.len()).max(1));
        let lost = tried.map(|near| {
            let held = &self.held[near.held];
            let solutions = form.solutions_at(&held.chain.fk(&near.q), &held.parameters);
            held.recovered(self.linkage, &near.q, &solutions, near.conditioning)
                .is_err()
        });
        lost.collect()
    }

    /// The configurations that some plan has lost, of an arm that takes nothing beside a target.
    pub fn lost(&self) -> Vec<Vec<f64>> {
        let lost = self.lost.borrow();
        let known = lost.iter().filter(|_| self.linkage.parameters() == 0);
        known.map(|(_, trial)| trial.q.clone()).collect()
    }

    /// Which of the configurations that some plan has lost a closed form loses.
    pub fn lost_again(&self, form: &ClosedForm) -> Vec<bool> {
        let lost = self.lost.borrow();
        let is_lost = |(held, trial): &(usize, Rc<Trial>)| {
            let solutions = form.solutions_at(&trial.pose, &trial.parameters);
            let held = &self.held[*held];
            held.recovered(self.linkage, &trial.q, &solutions, trial.conditioning)
                .is_err()
        };
        lost.iter().map(is_lost).collect()
    }

    /// All configurations: those that were lost before, and the others.
    fn in_order(&self) -> [Vec<(usize, Rc<Trial>)>; 2] {
        let lost = self.lost.borrow();
        let held = self.held.iter().enumerate();
        let all = held.flat_map(|(i, held)| held.all.iter().map(move |trial| (i, trial.clone())));
        let is_new = |(_, trial): &(usize, Rc<Trial>)| {
            lost.iter().all(|(_, before)| !Rc::ptr_eq(before, trial))
        };
        [lost.clone(), all.filter(is_new).collect()]
    }

    /// Configurations in which what a plan divides by vanishes, and next to these; where the arm is
    /// singular there, with the joints elsewhere that do not matter for it.
    fn vanishing(&self, form: &ClosedForm) -> Vec<(usize, Rc<Trial>)> {
        let mut random = Random(0x1b87_3593_cc9e_2d51);
        let quantities = form.expressions().map(InverseGraph::divisors);
        let quantities = quantities.unwrap_or_default();
        let mut all = Vec::new();
        for (number, held) in self.held.iter().enumerate() {
            let trial = |q| held.trial(self.linkage, self.target, q, true, true);
            let (mut exact, mut singular) = (Vec::new(), Vec::new());
            for Driven { q, is_moved } in self.driven(form, held, &quantities, &mut random) {
                if trial(q.clone()).conditioning < SINGULAR {
                    let elsewhere = |_| {
                        let other = anywhere(&held.model, &mut random);
                        let other = self.linkage.coordinates_at(other).into_iter();
                        let each = other.zip(&q).zip(&is_moved);
                        each.map(|((other, &q), is_moved)| if *is_moved { q } else { other })
                            .collect()
                    };
                    singular.extend((0..SINGULAR_ONES).map(elsewhere).map(trial));
                }
                exact.push(q);
            }
            let beside = alignment::neighbours(&exact);
            let trials = exact.into_iter().chain(beside).map(trial);
            for trial in trials.filter(|trial| trial.conditioning > NEARLY_SINGULAR) {
                all.push((number, trial.rounded(&mut random)));
                all.push((number, trial));
            }
            all.extend(singular.into_iter().map(|trial| (number, trial)));
        }
        all
    }

    /// Of the angles that may be free those that matter: what their steps divide by vanishes where
    /// the arm is singular, and a later root depends on them there.
    pub fn turns_that_matter(&self, form: &ClosedForm) -> Vec<Turn> {
        let Some(graph) = form.expressions() else {
            return Vec::new();
        };
        let turns: Vec<Turn> = graph.free_angles.iter().map(|it| it.turn).collect();
        let mut matter = vec![false; turns.len()];
        let steps: BTreeSet<usize> = turns.iter().map(|turn| turn.step).collect();
        for step in steps {
            let mut random = Random(0x5851_f42d_4c95_7f2d);
            let quantities = graph.divisors_of(step);
            let is_open = |matter: &[bool], i: &usize| turns[*i].step == step && !matter[*i];
            for held in &self.held {
                for Driven { q, .. } in self.driven(form, held, &quantities, &mut random) {
                    if self.linkage.conditioning(&held.chain, &q, self.target) >= SINGULAR {
                        continue;
                    }
                    let target = held.fk(self.linkage, &q);
                    let parameters = held.parameters(self.linkage, &q);
                    for i in (0..turns.len())
                        .filter(|i| is_open(&matter, i))
                        .collect::<Vec<_>>()
                    {
                        matter[i] = form.depends_on(i, &target, &parameters);
                    }
                }
                if !(0..turns.len()).any(|i| is_open(&matter, &i)) {
                    break;
                }
            }
        }
        let all = turns.into_iter().zip(matter);
        all.filter_map(|(turn, matters)| matters.then_some(turn))
            .collect()
    }

    /// Configurations to which what a plan divides by is driven to zero.
    fn driven(
        &self,
        form: &ClosedForm,
        held: &Held,
        quantities: &[Quantity],
        random: &mut Random,
    ) -> Vec<Driven> {
        let starts = STARTS - usize::from(!self.linkage.locked.is_empty());
        let starts = spread(&held.model, starts, random).into_iter();
        let starts = starts.map(|joints| self.linkage.coordinates_at(joints));
        let on = OnBranch {
            form,
            model: &held.model,
            // Differences of a target in single precision would be its rounding.
            asked: |q: &[f64]| (held.fk(self.linkage, q), held.parameters(self.linkage, q)),
        };
        on.vanishing(quantities, &starts.collect::<Vec<_>>())
    }

    /// The share of random configurations of less conditioning.
    fn share_below(&self, conditioning: f64) -> f64 {
        if conditioning == 0.0 {
            return 0.0;
        }
        let spread = self.spread.get_or_init(|| {
            let mut random = Random(0xc2b2_ae3d_27d4_eb4f);
            // At quarter turns of a locked joint the others may be singular throughout.
            let anywhere_held = &self.held[..self.held.len().min(parameters::ANYWHERE)];
            let held = anywhere_held.iter().cycle().take(SHARE);
            held.map(|held| {
                let q = self
                    .linkage
                    .coordinates_at(anywhere(&held.model, &mut random));
                self.linkage.conditioning(&held.chain, &q, self.target)
            })
            .collect()
        });
        let below = spread.iter().filter(|&&x| x < conditioning).count();
        below as f64 / SHARE as f64
    }
}

impl Held {
    fn new(parameters: Vec<f64>, model: Model, linkage: &Linkage, target: Target) -> Self {
        let coordinates = |all: Vec<Vec<f64>>| -> Vec<Vec<f64>> {
            let all = all.into_iter();
            all.map(|joints| linkage.coordinates_at(joints)).collect()
        };
        let round = coordinates(configurations(&model));
        let beside = alignment::neighbours(&round);
        let aligned = coordinates(alignment::aligned(&model));
        let nearly = alignment::neighbours(&aligned);
        let mut held = Self {
            parameters: match linkage.swivel {
                Some(_) => vec![SOMEWHERE],
                None => parameters,
            },
            chain: model.chain(),
            model,
            all: Vec::new(),
        };
        let trial = |q, may_degenerate, is_attack| {
            held.trial(linkage, target, q, may_degenerate, is_attack)
        };
        held.all = (round.into_iter().map(|q| trial(q, false, false)))
            .chain(beside.into_iter().map(|q| trial(q, false, true)))
            .chain(aligned.into_iter().map(|q| trial(q, true, true)))
            .chain(nearly.into_iter().map(|q| trial(q, true, true)))
            .collect();
        let mut random = Random(0x6c62_272e_07bb_0142);
        let exact = held.all.clone();
        let rounded = exact.iter().map(|trial| trial.rounded(&mut random));
        held.all.extend(rounded);
        held
    }

    fn trial(
        &self,
        linkage: &Linkage,
        target: Target,
        q: Vec<f64>,
        may_degenerate: bool,
        is_attack: bool,
    ) -> Rc<Trial> {
        // The joints that are coupled may be singular as such where the coordinates are not.
        let may_degenerate = may_degenerate
            || linkage.coupling.is_some() && {
                let joints = linkage.joints_at(&q);
                geometry::conditioning(&self.chain, &joints, linkage.size, target) < REGULAR
            };
        Rc::new(Trial {
            pose: linkage.scalar.target(self.fk(linkage, &q)),
            conditioning: linkage.conditioning(&self.chain, &q, target),
            parameters: self.parameters(linkage, &q),
            q,
            may_degenerate,
            is_attack,
        })
    }

    /// The pose of the tip.
    fn fk(&self, linkage: &Linkage, q: &[f64]) -> Pose {
        self.chain.fk(&linkage.joints_at(q))
    }

    /// As [`recovered`], of configurations by the values of joints.
    fn recovered(
        &self,
        linkage: &Linkage,
        q: &[f64],
        solutions: &[BranchSolution],
        conditioning: f64,
    ) -> Result<(), Failure> {
        let solutions = solutions.iter().map(|solution| solution.by_joints(linkage));
        let solutions: Vec<BranchSolution> = solutions.collect();
        let joints = linkage.joints_at(q);
        let outcome = recovered(&self.model, &joints, &solutions, conditioning);
        outcome.map_err(|failure| match failure {
            Failure::Lost(_) => Failure::Lost(q.to_vec()),
            Failure::Doubled(_) => Failure::Doubled(q.to_vec()),
            other => other,
        })
    }

    /// What comes with the target of a configuration.
    fn parameters(&self, linkage: &Linkage, q: &[f64]) -> Vec<f64> {
        match linkage.swivel {
            Some(swivel) => vec![swivel.angle(&self.chain, q)],
            None => self.parameters.clone(),
        }
    }

    /// Targets that the arm was not seen to reach, and some that it cannot: the
    /// orientation of one configuration where another puts the tip, or farther.
    fn elsewhere(&self, target: Target) -> impl Iterator<Item = Pose> {
        let poses = self.all.iter().map(|trial| trial.pose);
        let farther = [0.9, 1.0, 1.1, 2.0].into_iter().cycle();
        let pairs = poses.clone().zip(poses.skip(1)).zip(farther);
        let whole = !target.is_projected();
        pairs
            .take(if whole { ELSEWHERE } else { 0 })
            .map(|((one, other), farther)| Pose {
                rotation: one.rotation,
                translation: other.translation.map(|x| farther * x),
            })
    }
}

/// Runs a closed form against the arm as given. Of configurations where a step
/// may degenerate it may lose so many.
///
/// # Errors
///
/// The first configuration on which it is not sound, loses the configuration
/// or doubles a solution; or that there are too few on which it could.
pub fn certify(trials: &Trials, form: &ClosedForm, losses: usize) -> Result<Certificate, Failure> {
    let excused = form.near_singular();
    let excused_share = trials.share_below(excused);
    let singular_share = trials.share_below(SINGULAR);
    if excused_share > MOST_EXCUSED || singular_share > MOST_SINGULAR {
        return Err(Failure::NearSingular(excused_share.max(singular_share)));
    }
    let mut certificate = Certificate {
        excused_share,
        ..Certificate::default()
    };
    // What was lost before is likely to be lost again, and then the others are not asked.
    let [before, others] = trials.in_order();
    certificate.try_all(trials, form, &before, 1, losses)?;
    certificate.try_all(trials, form, &others, form.side_by_side(), losses)?;
    let own = trials.vanishing(form);
    certificate.try_all(trials, form, &own, form.side_by_side(), losses)?;
    for held in &trials.held {
        let targets = held.elsewhere(trials.target);
        let targets: Vec<Pose> = targets.map(|it| trials.linkage.scalar.target(it)).collect();
        for targets in targets.chunks(form.side_by_side()) {
            let solutions =
                form.solutions_each(targets.iter().map(|it| (it, &held.parameters[..])));
            for (target, solutions) in targets.iter().zip(&solutions) {
                certificate.sound(&Run { trials, held }, target, solutions)?;
            }
        }
    }
    Ok(certificate)
}

/// What solutions are held against.
struct Run<'a> {
    trials: &'a Trials<'a>,
    held: &'a Held,
}

impl Certificate {
    /// Whether so much is lost that relations between axes have to be read otherwise.
    pub(crate) fn loses_much(&self) -> bool {
        4 * self.lost > self.configurations
    }

    /// Tries a closed form on configurations, so many side by side.
    fn try_all(
        &mut self,
        trials: &Trials,
        form: &ClosedForm,
        all: &[(usize, Rc<Trial>)],
        side_by_side: usize,
        losses: usize,
    ) -> Result<(), Failure> {
        for some in all.chunks(side_by_side) {
            let mut tried = Vec::with_capacity(some.len());
            for (held, trial) in some {
                self.configurations += 1;
                let is_excused = trial.conditioning < form.near_singular();
                self.excused += usize::from(is_excused);
                let is_dear = trial.is_attack || self.excused > EXCUSED;
                if !(is_excused && is_dear) {
                    tried.push((*held, trial, is_excused));
                }
            }
            let targets = tried
                .iter()
                .map(|(_, it, _)| (&it.pose, &it.parameters[..]));
            let solutions = form.solutions_each(targets);
            for ((held, trial, is_excused), solutions) in tried.into_iter().zip(solutions) {
                let before = self.lost;
                let run = Run {
                    trials,
                    held: &trials.held[held],
                };
                let added = self.add(&run, trial, &solutions, is_excused, losses);
                if added.is_err() || self.lost > before {
                    let mut lost = trials.lost.borrow_mut();
                    if lost.iter().all(|(_, known)| !Rc::ptr_eq(known, trial)) {
                        lost.push((held, trial.clone()));
                    }
                }
                added?;
            }
        }
        Ok(())
    }

    /// All solutions to a target reach it.
    fn sound(
        &mut self,
        run: &Run,
        target: &Pose,
        solutions: &[BranchSolution],
    ) -> Result<(), Failure> {
        let Run { trials, held } = run;
        let size = trials.linkage.size;
        self.solutions += solutions.len();
        for solution in solutions {
            let found = held.fk(trials.linkage, &solution.q);
            let distance = trials.target.distance(&found, target, size);
            self.worst_residual = self.worst_residual.max(distance);
            if distance.is_nan() || distance > trials.linkage.scalar.tolerances().solved * size {
                let q = solution.q.clone();
                return Err(Failure::Unsound { q, distance });
            }
        }
        Ok(())
    }

    /// Whether nothing was seen to be missing.
    pub fn is_complete(&self) -> bool {
        self.lost == 0 && self.unanswered == 0
    }

    /// What is not promised, in sentences.
    pub fn reservations(&self) -> Vec<String> {
        let excused = (self.excused > 0).then(|| {
            let share = match 100.0 * self.excused_share {
                percent if percent < 0.05 => "Less than 0.1 %".to_owned(),
                percent => format!("{percent:.1} %"),
            };
            format!(
                "{share} of random configurations are so near to singular that a solution to \
                 their targets may be missing."
            )
        });
        let lost = (self.lost > 0).then(|| {
            format!(
                "Where a step degenerates and the arm does not, solutions are lost or flagged as \
                 singular: {} of {} configurations.",
                self.lost, self.configurations
            )
        });
        excused.into_iter().chain(lost).collect()
    }

    fn add(
        &mut self,
        run: &Run,
        trial: &Trial,
        solutions: &[BranchSolution],
        is_excused: bool,
        losses: usize,
    ) -> Result<(), Failure> {
        let Trial {
            q,
            pose,
            conditioning,
            ..
        } = trial;
        let model = &run.held.model;
        self.sound(run, pose, solutions)?;
        if *conditioning < SINGULAR {
            self.singular += 1;
            self.unanswered += usize::from(solutions.is_empty());
            return Ok(());
        }
        self.most_solutions = self.most_solutions.max(solutions.len());
        let flagged = solutions.iter().filter(|solution| solution.singular);
        let linkage = run.trials.linkage;
        let flagged = flagged.map(|solution| solution.by_joints(linkage));
        let flagged: Vec<BranchSolution> = flagged.collect();
        let is_flagged = || {
            let tolerance = 10.0 * model.scalar.tolerances().same;
            is_among(model, &linkage.joints_at(q), &flagged, tolerance)
        };
        match run.held.recovered(linkage, q, solutions, *conditioning) {
            Err(Failure::Lost(_)) if is_excused => self.unanswered += 1,
            Err(Failure::Lost(_)) if trial.may_degenerate && self.lost < losses => self.lost += 1,
            Err(other) => return Err(other),
            // A double root that is none of the arm has half of its digits.
            Ok(()) if *conditioning > REGULAR && is_flagged() => {
                if self.lost == losses {
                    return Err(Failure::Lost(q.clone()));
                }
                self.lost += 1;
            }
            Ok(()) => {}
        }
        Ok(())
    }
}

/// The configuration is among the solutions, to what its conditioning allows,
/// and no solution comes twice.
///
/// # Errors
///
/// Which of the two does not hold.
pub fn recovered(
    model: &Model,
    q: &[f64],
    solutions: &[BranchSolution],
    conditioning: f64,
) -> Result<(), Failure> {
    let to = model.scalar.tolerances();
    let tolerance = (to.recovered / conditioning.powi(2)).clamp(to.same, to.different);
    if !is_among(model, q, solutions, tolerance) {
        return Err(Failure::Lost(q.to_vec()));
    }
    for (i, a) in solutions.iter().enumerate() {
        if is_among(model, &a.q, &solutions[..i], to.same) {
            return Err(Failure::Doubled(q.to_vec()));
        }
    }
    Ok(())
}

fn is_among(model: &Model, q: &[f64], solutions: &[BranchSolution], tolerance: f64) -> bool {
    let same = |a: &[f64]| (0..q.len()).all(|i| joint_distance(model, i, a[i], q[i]) < tolerance);
    solutions.iter().any(|solution| same(&solution.q))
}

/// The difference of two values of a coordinate, modulo 2π where it turns.
fn joint_distance(model: &Model, variable: usize, a: f64, b: f64) -> f64 {
    let d = (a - b).abs();
    if model.turns(variable) {
        let d = d % TAU;
        if d > PI { TAU - d } else { d }
    } else {
        d
    }
}
