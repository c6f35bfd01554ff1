//! The search among the plans for one reading of the axes.

use super::beside::eliminations_beside;
use super::{
    CHOICES, Certified, Lack, NoClosedForm, better, rank_without, turns_about_one_direction,
};
use crate::certificate::{Failure, Trials, certify};
use crate::closed_form::{ClosedForm, Reading, Refinement};
use crate::expr::inverse::{FreeJoints, InverseGraph, Turn, weight};
use crate::geometry::{Idealized, Linkage, NOISIEST, angle};
use crate::plan::{Plan, Plans, Target};
use crate::scalar::Scalar;
use crate::univariate;
use std::f64::consts::FRAC_PI_2;

/// Plans of which the one with the fewest operations is tried first.
pub(crate) const COMPARED: usize = 4;
/// As [`CERTIFIED`], on an idealized arm: refinement makes a certificate dear.
const REFINED: usize = 2;
/// Plans tried from the first on that is certified but leaves singular targets
/// unanswered.
const CERTIFIED: usize = 8;

/// Plans in a row on an idealized arm, of the ways in which they move free joints each, that leave as
/// much to the elimination beside them as those before: what they lose is its own, and the next plan
/// will not find it.
const IN_VAIN: usize = 12;

/// Plans that lose much are those of axes whose relation was read wrongly; so many of them
/// at one tolerance are borne before the next.
pub(super) struct Patience {
    plans: usize,
    /// Whether it was over at any tolerance.
    pub ended: bool,
}

impl Patience {
    pub fn of(plans: usize) -> Self {
        Self {
            plans,
            ended: false,
        }
    }

    /// Whether it is over after so many.
    fn ends_with(&mut self, plans: usize) -> bool {
        let ends = plans >= self.plans;
        self.ended |= ends;
        ends
    }
}

/// The best plan for one reading.
///
/// # Errors
///
/// Why there is none.
pub(super) fn solve_idealized(
    trials: &Trials,
    idealized: Idealized,
    target: Target,
    most: usize,
    patience: &mut Patience,
) -> Result<Certified, NoClosedForm> {
    let reading = Reading::new(trials.model(), trials.linkage(), idealized, target)
        .ok_or(NoClosedForm::NoPlan(target))?;
    check(&reading, target)?;
    let (linkage, exact) = (&reading.linkage, reading.is_exact());
    let mut plans = Plans::new(linkage, target);
    // The search estimates what a plan costs; of those that it comes by first, the
    // one that needs the fewest operations is tried first.
    let mut first: Vec<Plan> = plans.by_ref().take(COMPARED).collect();
    if exact && linkage.variables() == target.coordinates() + usize::from(linkage.swivel.is_some())
    {
        first.sort_by_cached_key(|plan| weight(linkage, plan));
    }
    let mut search = Search::new(trials, &reading, target, first.first());
    let mut later = Later {
        linkage,
        target,
        all: plans,
        lost: 0,
        solving: None,
        known: first.clone(),
    };
    let mut first = first.into_iter();
    let enough = if exact { CERTIFIED } else { REFINED };
    let (mut certified, mut degenerate) = (0, 0);
    for tried in 0..most {
        let next = first.next().or_else(|| {
            let lost = match exact {
                true => trials.lost(linkage),
                false => Vec::new(),
            };
            later.next(&lost)
        });
        let Some(plan) = next else {
            break;
        };
        // To move a free joint costs operations: not for plans that cost more than one that stands.
        let may_turn = !search.stands() || tried < COMPARED;
        if search.is_complete_with(&plan, may_turn) {
            break;
        }
        certified += usize::from(search.stands());
        degenerate += usize::from(search.loses_much());
        let in_vain = !exact && search.in_vain >= IN_VAIN;
        if certified == enough || in_vain || patience.ends_with(degenerate) {
            break;
        }
    }
    search.best.ok_or(search.refusal)
}

/// Whether an arm that is read so can be solved for a target at all.
fn check(reading: &Reading, target: Target) -> Result<(), NoClosedForm> {
    let linkage = &reading.linkage;
    if let Some(lifting) = lifting(reading, target) {
        return Err(lifting);
    }
    if reading.is_exact() {
        return Ok(());
    }
    let solved = linkage.variables().min(target.coordinates());
    if rank_without(reading.model(), linkage, target) < solved {
        // Of the ideal arm, the others are singular throughout.
        return Err(NoClosedForm::NoPlan(target));
    }
    if target.is_projected() && !linkage.locked.is_empty() {
        return Err(NoClosedForm::Noisy);
    }
    if target.is_projected() && !turns_about_one_direction(reading.model()) {
        // A plan would tell joints by how noise tilts their axes.
        return Err(NoClosedForm::NoPlan(target));
    }
    match linkage.scalar {
        Scalar::F32 => Err(NoClosedForm::OnlyInDouble(Lack::Refinement)),
        Scalar::F64 => Ok(()),
    }
}

/// The first slide that is solved for and lifts the tip of an arm with planar targets.
fn lifting(reading: &Reading, target: Target) -> Option<NoClosedForm> {
    let linkage = &reading.linkage;
    let axis = linkage.first_turn().filter(|_| target == Target::Planar)?;
    let axis = linkage.axis(axis).direction;
    let slides = (0..linkage.links.len())
        .filter(|&i| !linkage.is_revolute(i) && !linkage.locked.contains(&i));
    let mut angles = slides.map(|i| (i, FRAC_PI_2 - angle(axis, linkage.axis(i).direction)));
    let (slide, angle) = angles.find(|(_, angle)| *angle > NOISIEST)?;
    Some(NoClosedForm::Lifting {
        joint: reading.model().joints[slide].name.clone(),
        angle,
    })
}

/// What the plans of one reading have come to.
struct Search<'a> {
    trials: &'a Trials<'a>,
    reading: &'a Reading,
    /// Asked beside the branches of an arm that is off this reading.
    beside: Option<univariate::Arm>,
    /// How many choices of those were tried.
    chosen: usize,
    /// How many plans in a row have left as much to be found as those before.
    in_vain: usize,
    best: Option<Certified>,
    /// Why there is none yet.
    refusal: NoClosedForm,
}

impl<'a> Search<'a> {
    fn new(
        trials: &'a Trials<'a>,
        reading: &'a Reading,
        target: Target,
        first: Option<&Plan>,
    ) -> Self {
        let beside = first.filter(|_| !reading.is_exact());
        let form = |plan| reading.form(plan, FreeJoints::Seeded);
        Self {
            trials,
            reading,
            beside: beside.and_then(|plan| eliminations_beside(trials, &form(plan))),
            chosen: 1,
            in_vain: 0,
            best: None,
            refusal: NoClosedForm::NoPlan(target),
        }
    }

    /// Whether a plan was found that loses no regular target.
    fn stands(&self) -> bool {
        let best = self.best.as_ref();
        best.is_some_and(|best| best.certificate.lost == 0)
    }

    fn loses_much(&self) -> bool {
        let best = self.best.as_ref();
        best.is_some_and(|best| best.certificate.loses_much())
    }

    /// What the best one does not find, if there is one.
    fn missing(&self) -> Option<(usize, usize)> {
        self.best.as_ref().map(|it| it.certificate.missing())
    }

    /// Tries a plan; tells whether nothing is left to be improved. To move free joints costs
    /// operations: of plans that cost more than one that stands, only where they lose less.
    fn is_complete_with(&mut self, plan: &Plan, may_turn: bool) -> bool {
        if may_turn {
            let [matter, all] = self.moved(plan);
            return self.is_complete_by(plan, [matter, Some(FreeJoints::Seeded), all]);
        }
        let before = self.missing();
        if self.is_complete_by(plan, [Some(FreeJoints::Seeded)]) {
            return true;
        }
        self.missing() < before && {
            let moved = self.moved(plan);
            self.is_complete_by(plan, moved)
        }
    }

    /// The same with each of what can become of its free joints.
    fn is_complete_by(
        &mut self,
        plan: &Plan,
        ways: impl IntoIterator<Item = Option<FreeJoints>>,
    ) -> bool {
        for free in ways.into_iter().flatten() {
            let form = self.reading.form(plan, free);
            let has = |what: fn(&InverseGraph) -> bool| form.expressions().is_some_and(what);
            if form.single.is_some() && has(InverseGraph::has_quartic) {
                if let NoClosedForm::NoPlan(_) = self.refusal {
                    self.refusal = NoClosedForm::OnlyInDouble(Lack::Quartic);
                }
                break;
            }
            if self.beside.is_some() && !self.trials.are_told_by_branches(&form) {
                // The elimination would be asked at every target, and does as well alone.
                self.in_vain += 1;
                break;
            }
            match self.certified(form) {
                Ok(found) => {
                    let done = found.certificate.is_complete();
                    let before = self.missing();
                    self.best = better(self.best.take(), found);
                    self.in_vain = match self.missing() == before {
                        true => self.in_vain + 1,
                        false => 0,
                    };
                    if done {
                        return true;
                    }
                }
                // Moved otherwise, free joints may lose less.
                Err(Failure::Lost(_)) if self.best.is_some() && self.beside.is_none() => {}
                Err(failure) => {
                    let plan = plan.to_string();
                    self.refusal = NoClosedForm::Uncertified { plan, failure };
                    break;
                }
            }
        }
        false
    }

    /// The joints moved that singular targets are seen to leave free and on which a later root
    /// depends, and if there are more all that may be so.
    fn moved(&self, plan: &Plan) -> [Option<FreeJoints>; 2] {
        let coordinates = self.reading.linkage.variables();
        let form = (self.reading).form(plan, FreeJoints::all_moved(plan, coordinates));
        let matter = self.trials.turns_that_matter(&form);
        let all = form.expressions().into_iter();
        let all = all.flat_map(|graph| &graph.free_joints);
        let mut all: Vec<Turn> = all.map(|it| it.turn).collect();
        if all == matter {
            all.clear();
        }
        [matter, all].map(|turns| (!turns.is_empty()).then_some(FreeJoints::Moved(turns)))
    }

    /// Runs a closed form. What one elimination loses another may find.
    fn certified(&mut self, mut form: ClosedForm) -> Result<Certified, Failure> {
        let losses = match self.missing() {
            None => usize::MAX,
            // What loses as much is no better.
            Some((lost, 0)) if self.beside.is_none() => lost.saturating_sub(1),
            Some((lost, _)) => lost,
        };
        self.ask(&mut form);
        let mut outcome = certify(self.trials, &form, losses);
        while outcome.is_err() && self.beside.is_some() && self.chosen < CHOICES {
            self.chosen += 1;
            let another = eliminations_beside(self.trials, &form);
            if another == self.beside {
                break;
            }
            self.beside = another;
            self.ask(&mut form);
            outcome = certify(self.trials, &form, losses);
        }
        outcome.map(|certificate| Certified { form, certificate })
    }

    /// Sets the eliminations that a closed form asks.
    fn ask(&self, form: &mut ClosedForm) {
        if let Some(arm) = &self.beside {
            form.refinement = Refinement::Univariate(Box::new(arm.clone()));
        }
    }
}

/// The plans that are tried after the first ones, none twice.
struct Later<'a> {
    linkage: &'a Linkage,
    target: Target,
    all: Plans<'a>,
    /// How many configurations were lost when `solving` was asked for.
    lost: usize,
    /// Those that solve the configurations that others have lost.
    solving: Option<Plans<'a>>,
    known: Vec<Plan>,
}

impl Later<'_> {
    /// The next one, by turns of those that solve what others have lost, and of all.
    fn next(&mut self, lost: &[Vec<f64>]) -> Option<Plan> {
        if lost.len() > self.lost {
            self.lost = lost.len();
            self.solving = Some(Plans::solving(self.linkage, self.target, lost));
        }
        let is_turn_of_all = self.known.len() % 2 == 1;
        loop {
            let solving = self.solving.as_mut().filter(|_| !is_turn_of_all);
            let plan = solving
                .and_then(Iterator::next)
                .or_else(|| self.all.next())?;
            if !self.known.iter().any(|known| known.is_like(&plan)) {
                self.known.push(plan.clone());
                return Some(plan);
            }
        }
    }
}
