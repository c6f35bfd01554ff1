//! The configurations that a plan is tried on, and which of them some plan has lost.

use super::held::{Held, Made, Trial};
use super::{REGULAR, parameters};
use crate::closed_form::ClosedForm;
use crate::geometry::Linkage;
use crate::model::{Model, anywhere};
use crate::plan::Target;
use crate::random::Random;
use std::cell::{OnceCell, RefCell};
use std::rc::Rc;

/// Random configurations whose conditioning tells how many are excused.
const SHARE: usize = 400;

/// The configurations to try on an arm, with the targets that they make.
pub struct Trials<'a> {
    model: &'a Model,
    pub(super) linkage: &'a Linkage,
    pub(super) target: Target,
    /// One for each value of the locked joints that is tried; a single one where none
    /// is locked.
    pub(super) held: Vec<Held>,
    /// The conditioning of random configurations.
    spread: OnceCell<Vec<f64>>,
    /// Which configurations some plan has lost: the next is tried on them first.
    pub(super) lost: RefCell<Vec<(usize, Rc<Trial>)>>,
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

    /// The configurations that some plan has lost, as the joints of a linkage move in them.
    pub fn lost(&self, linkage: &Linkage) -> Vec<Vec<f64>> {
        let lost = self.lost.borrow();
        let by_joint = |trial: &Trial| linkage.by_joint(&trial.q, &trial.parameters);
        lost.iter().map(|(_, trial)| by_joint(trial)).collect()
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

    /// Whether the branches of an idealized arm are known to be all there are at some target of a
    /// regular configuration.
    pub fn are_told_by_branches(&self, form: &ClosedForm) -> bool {
        let all = self.held.iter().flat_map(|held| &held.all);
        let is_regular = |trial: &&Rc<Trial>| !trial.may_degenerate && trial.conditioning > REGULAR;
        all.filter(is_regular).any(|trial| {
            let branches = form.branches_at(&trial.pose, &trial.parameters);
            branches.iter().any(|branch| !branch.singular)
        })
    }

    /// How many random configurations are not singular.
    pub(super) fn random(&self) -> usize {
        let all = self.held.iter().flat_map(|held| &held.all);
        let counts =
            |it: &&Rc<Trial>| it.made == Made::Random && it.conditioning >= super::SINGULAR;
        all.filter(counts).count()
    }

    /// All configurations: those that were lost before, and the others.
    pub(super) fn in_order(&self) -> [Vec<(usize, Rc<Trial>)>; 2] {
        let lost = self.lost.borrow();
        let held = self.held.iter().enumerate();
        let all = held.flat_map(|(i, held)| held.all.iter().map(move |trial| (i, trial.clone())));
        let is_new = |(_, trial): &(usize, Rc<Trial>)| {
            lost.iter().all(|(_, before)| !Rc::ptr_eq(before, trial))
        };
        [lost.clone(), all.filter(is_new).collect()]
    }

    /// The share of random configurations of less conditioning.
    pub(super) fn share_below(&self, conditioning: f64) -> f64 {
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
