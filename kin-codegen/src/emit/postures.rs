//! What the branches of a closed form are in the words of the field: shoulder
//! left or right, elbow up or down, wrist flipped or not.
//!
//! A branch is a number whose bits are the signs of the plan's roots. A posture
//! is a sign, too: of a product of the arm's axes and points that vanishes
//! where two postures meet, which is a singularity. Which bits a posture's sign
//! is the product of is seen on random targets; a posture that no bits tell on
//! all of them is not named, and neither is one that the arm's geometry does
//! not have.

use super::headings::list;
use super::text::degrees;
use crate::closed_form::{ClosedForm, Inverse};
use crate::geometry::{Line, Vec3, concurrency, cross, dot, sub};
use crate::model::{JointKind, Model};
use crate::random::Random;
use kin_runtime::{Chain, Pose};
use std::f64::consts::{FRAC_PI_2, PI};

/// The postures that tell a plan's branches apart.
pub struct Postures {
    /// Named or not; together they have all bits.
    pub columns: Vec<Posture>,
}

/// A sign that branches differ in.
pub struct Posture {
    /// `shoulder`, `elbow` or `wrist`, or the step whose root it is.
    pub name: String,
    /// The bits of a branch whose parity it is; of two roots of a quartic, all
    /// values of two bits.
    pub bits: Vec<u8>,
    /// What it is called, by the bits' parity or value.
    pub words: Vec<String>,
    /// What the words mean.
    pub meaning: String,
}

/// Targets looked at.
const SAMPLES: usize = 48;
/// Signs of less than this, relative to the arm's size, are not judged: two
/// postures meet.
const MARGIN: f64 = 2e-3;
/// Relations between axes, and to the vertical, hold to this, radians or relative to the arm's size:
/// words for what the arm is, whatever digits its file has or its calibration found. That they tell
/// branches apart is seen.
const NEAR: f64 = 5e-3;

/// An arm that stands upright with all joints at zero is seen to lean at so much, radians.
const LEANING: f64 = 0.5;

impl Postures {
    /// Of the arm that the plan is for; none of one without a plan.
    pub fn of(solver: &ClosedForm) -> Option<Self> {
        let Inverse::Expressions(_) = &solver.inverse else {
            return None;
        };
        let arm = PostureArm::new(&solver.idealized.model, solver.linkage.size);
        let candidates = arm.candidates();
        let seen = seen(solver, &arm, &candidates);
        let choices = solver.plan.choices();
        let mut columns: Vec<Posture> = Vec::new();
        for (i, candidate) in candidates.iter().enumerate() {
            let Some((mask, sign)) = parity(&seen, i, choices) else {
                continue;
            };
            // The first candidate of a name is the one that says most.
            if columns.iter().all(|column| column.name != candidate.name) {
                columns.push(candidate.posture(mask, sign));
            }
        }
        if !is_independent(&columns) {
            columns.clear();
        }
        columns.extend(roots_without_a_word(solver, &columns));
        Some(Self { columns })
    }

    /// What a branch is called, by column.
    pub fn words(&self, branch: u32) -> impl Iterator<Item = &str> {
        self.columns.iter().map(move |column| column.word(branch))
    }
}

impl Posture {
    /// What a branch is called.
    pub fn word(&self, branch: u32) -> &str {
        let bit = |bit: &u8| (branch >> bit & 1) as usize;
        let index = match self.words.len() {
            2 => self.bits.iter().map(bit).sum::<usize>() % 2,
            _ => self
                .bits
                .iter()
                .rev()
                .fold(0, |value, b| 2 * value + bit(b)),
        };
        &self.words[index]
    }

    /// `bit 0`, `bits 0 and 2`.
    pub fn told_by(&self) -> String {
        let bits = list(self.bits.iter().map(u8::to_string));
        match self.bits.len() {
            1 => format!("bit {bits}"),
            _ => format!("bits {bits}"),
        }
    }
}

/// Whether the columns' parities tell as many branches apart as they could.
fn is_independent(columns: &[Posture]) -> bool {
    let mask = |column: &Posture| column.bits.iter().fold(0_u32, |mask, bit| mask | 1 << bit);
    let masks: Vec<u32> = columns.iter().map(mask).collect();
    (1_u32..1 << masks.len()).all(|some| {
        let chosen = masks.iter().enumerate().filter(|(i, _)| some >> i & 1 == 1);
        chosen.fold(0, |sum, (_, mask)| sum ^ mask) != 0
    })
}

/// The signs of the candidates at a configuration that solves a target.
struct Seen {
    branch: u32,
    /// None where the posture is not to be judged.
    signs: Vec<Option<bool>>,
}

fn seen(solver: &ClosedForm, arm: &PostureArm, candidates: &[Candidate]) -> Vec<Seen> {
    let mut random = Random(0x6a09_e667_f3bc_c909);
    let tolerance = solver.acceptance().tolerance;
    let mut seen = Vec::new();
    for _ in 0..SAMPLES {
        let anywhere = solver.coordinates(&arm.anywhere(&mut random));
        let target = arm.chain.fk(&solver.joints(&anywhere));
        let (parameters, _) = solver.split(&anywhere);
        for solution in solver.branches_at(&target, &parameters) {
            if solution.residual <= tolerance && !solution.singular {
                let q = solver.whole(&solution.q, &parameters);
                let at = arm.at(&solver.joints(&q));
                let sign = |candidate: &Candidate| (candidate.value)(arm, &at).and_then(sign);
                seen.push(Seen {
                    branch: solution.branch,
                    signs: candidates.iter().map(sign).collect(),
                });
            }
        }
    }
    seen
}

fn sign(value: f64) -> Option<bool> {
    (value.abs() > MARGIN).then_some(value < 0.0)
}

/// The bits of whose parity a candidate's sign is always the same function, the
/// fewest first, and the sign where the parity is even. None if there are no
/// such bits, or if the solutions do not tell which.
fn parity(seen: &[Seen], candidate: usize, choices: u8) -> Option<(u32, bool)> {
    let judged: Vec<(u32, bool)> = seen
        .iter()
        .filter_map(|seen| Some((seen.branch, seen.signs[candidate]?)))
        .collect();
    let fits = |mask: u32| {
        let mut signs = judged.iter().map(|(branch, sign)| {
            let odd = (branch & mask).count_ones() % 2 == 1;
            sign ^ odd
        });
        let first = signs.next()?;
        signs.all(|sign| sign == first).then_some((mask, first))
    };
    let mut found = (1_u32..1 << choices).filter_map(fits);
    let only = found.next()?;
    found.next().is_none().then_some(only)
}

/// Of an arm at a configuration.
type Value = Box<dyn Fn(&PostureArm, &At) -> Option<f64>>;

/// A posture that the arm may have.
struct Candidate {
    name: &'static str,
    /// Where the value is positive and where it is negative.
    words: [&'static str; 2],
    meaning: String,
    /// Relative to the arm's size; none where it has no meaning.
    value: Value,
}

impl Candidate {
    fn posture(&self, mask: u32, negative: bool) -> Posture {
        let mut words = self.words.map(String::from).to_vec();
        if negative {
            words.reverse();
        }
        Posture {
            name: self.name.into(),
            bits: (0..32).filter(|bit| mask >> bit & 1 == 1).collect(),
            words,
            meaning: self.meaning.clone(),
        }
    }
}

/// The arm with what postures are told by.
struct PostureArm<'a> {
    model: &'a Model,
    chain: Chain,
    size: f64,
    home: At,
}

/// The axes and the tip at some configuration, in base coordinates. A slide
/// has no line.
struct At {
    lines: Vec<Option<Line>>,
    tip: Vec3,
}

const UP: Vec3 = [0.0, 0.0, 1.0];

impl<'a> PostureArm<'a> {
    fn new(model: &'a Model, size: f64) -> Self {
        let chain = model.chain();
        let home = At::new(&chain, &vec![0.0; model.variables.len()]);
        Self {
            model,
            chain,
            size,
            home,
        }
    }

    fn at(&self, q: &[f64]) -> At {
        At::new(&self.chain, q)
    }

    fn anywhere(&self, random: &mut Random) -> Vec<f64> {
        let kinds = self.model.joints.iter().map(|joint| joint.kind);
        kinds
            .map(|kind| match kind {
                JointKind::Revolute => random.between(-PI, PI),
                JointKind::Prismatic => random.between(-self.size, self.size),
            })
            .collect()
    }

    fn candidates(&self) -> Vec<Candidate> {
        let mut all = Vec::new();
        if let Some([shoulder, elbow]) = self.upper_arm() {
            all.extend(self.shoulder(shoulder));
            all.extend(self.elbow(shoulder, elbow));
        }
        all.extend(self.wrist());
        all
    }

    fn is_parallel(&self, i: usize, j: usize) -> bool {
        match (&self.home.lines[i], &self.home.lines[j]) {
            (Some(a), Some(b)) => {
                let distance = dot(a.offset_of(b.point), a.offset_of(b.point)).sqrt();
                is_zero(cross(a.direction, b.direction)) && distance > NEAR * self.size
            }
            _ => false,
        }
    }

    /// The first two axes that are parallel, of revolute joints that follow
    /// each other.
    fn upper_arm(&self) -> Option<[usize; 2]> {
        let pairs = (1..self.home.lines.len()).map(|j| [j - 1, j]);
        pairs.into_iter().find(|&[i, j]| self.is_parallel(i, j))
    }

    /// What the elbow reaches for, beyond joint `elbow`: a third parallel axis,
    /// or the point where the axes behind meet, or the tip where no axis is.
    fn hand(&self, elbow: usize) -> Option<Hand> {
        let behind: Vec<usize> = (elbow + 1..self.home.lines.len())
            .filter(|&i| self.home.lines[i].is_some())
            .collect();
        match behind[..] {
            [] => Some(Hand::Tip),
            [first, ..] if self.is_parallel(elbow, first) => Some(Hand::Axis(first)),
            _ => self.meeting(&behind).map(|_| Hand::Meeting(behind)),
        }
    }

    /// Where axes meet at home.
    fn meeting(&self, joints: &[usize]) -> Option<Vec3> {
        meeting(&self.home, joints, self.size)
    }

    /// The point of the arm that the first axis carries around: where the last
    /// two axes meet, or the tip.
    fn wrist_centre(&self) -> Hand {
        let n = self.home.lines.len();
        match n > 4 && self.meeting(&[n - 2, n - 1]).is_some() {
            true => Hand::Meeting(vec![n - 2, n - 1]),
            false => Hand::Tip,
        }
    }

    /// How far the wrist's centre is from the first axis: along axis
    /// `shoulder`, and across it, towards the arm's front.
    fn reach(&self, at: &At, shoulder: usize) -> Option<[f64; 2]> {
        let axis = at.lines[shoulder]?.direction;
        let from = sub(self.wrist_centre().at(self, at)?, at.lines[0]?.point);
        Some([dot(from, axis), dot(from, cross(axis, UP))])
    }

    /// The side of the first axis on which the arm's plane is, or the end of it
    /// that faces the wrist.
    fn shoulder(&self, shoulder: usize) -> Option<Candidate> {
        let (first, second) = (self.home.lines[0]?, self.home.lines[shoulder]?);
        if shoulder != 1 || !is_zero(cross(first.direction, UP)) || !is_across(&second, UP) {
            return None;
        }
        let [aside, ahead] = self.reach(&self.home, shoulder)?;
        // In front is where axis 2 is, and if it meets axis 1, where the wrist is with all joints at
        // zero, or of an arm that is upright then, where joint 2 leans it.
        let forward = cross(second.direction, UP);
        let offset = dot(sub(second.point, first.point), forward);
        let is_far = |x: f64| x.abs() > NEAR * self.size;
        let (words, meaning, side) = if is_far(aside) {
            let meaning = "shoulder left or right: the side of axis 1 on which the plane of the \
                           upper arm and forearm is, seen from above and from axis 1 towards the \
                           wrist";
            (["left", "right"], meaning, aside)
        } else {
            let meaning = "shoulder front or back: whether the wrist is in front of axis 1, or \
                           behind it with the arm reaching over";
            let mut leaning = vec![0.0; self.model.variables.len()];
            leaning[shoulder] = LEANING;
            let [_, leant] = self.reach(&self.at(&leaning), shoulder)?;
            let side = [offset, ahead].into_iter().find(|side| is_far(*side));
            (["front", "back"], meaning, side.unwrap_or(leant))
        };
        is_far(side).then(|| Candidate {
            name: "shoulder",
            words,
            meaning: meaning.into(),
            value: Box::new(move |arm, at| {
                let [_, ahead] = arm.reach(at, shoulder)?;
                Some(ahead * side.signum() / arm.size)
            }),
        })
    }

    /// The line in the arm's plane from axis `shoulder` to what the elbow
    /// reaches for, and how far to the left of it, seen against the axis, axis
    /// `elbow` is.
    fn bend(&self, at: &At, shoulder: usize, elbow: usize) -> Option<(Vec3, f64)> {
        let (from, over) = (at.lines[shoulder]?, at.lines[elbow]?);
        let line = from.across(sub(self.hand(elbow)?.at(self, at)?, from.point));
        let upper = from.across(sub(over.point, from.point));
        Some((
            line,
            dot(cross(line, upper), from.direction) / self.size.powi(2),
        ))
    }

    /// On which side of the line from the shoulder to the hand the elbow is.
    fn elbow(&self, shoulder: usize, elbow: usize) -> Vec<Candidate> {
        let (Some(hand), Some(axis)) = (self.hand(elbow), self.home.lines[elbow]) else {
            return Vec::new();
        };
        let line = format!("the line from axis {} to {}", shoulder + 1, hand.name());
        let joint = elbow + 1;
        if !(0..shoulder).all(|i| self.is_upright(i)) {
            return Vec::new();
        }
        if is_zero(cross(axis.direction, UP)) {
            return vec![Candidate {
                name: "elbow",
                words: ["left", "right"],
                meaning: format!(
                    "elbow left or right: the side of {line} on which axis {joint} is, seen from \
                     above"
                ),
                value: Box::new(move |arm, at| {
                    let (_, bend) = arm.bend(at, shoulder, elbow)?;
                    Some(bend * at.lines[shoulder]?.direction[2].signum())
                }),
            }];
        }
        if !is_across(&axis, UP) {
            return Vec::new();
        }
        let forward = move |at: &At| Some(cross(at.lines[shoulder]?.direction, UP));
        let up = format!("elbow up or down: whether axis {joint} is above or below {line}");
        let above = Candidate {
            name: "elbow",
            words: ["up", "down"],
            meaning: up.clone(),
            value: Box::new(move |arm, at| {
                let (line, bend) = arm.bend(at, shoulder, elbow)?;
                let forward = dot(line, forward(at)?) / arm.size;
                (forward.abs() > MARGIN).then(|| -bend * forward.signum())
            }),
        };
        // Where the shoulder is off the first axis, the line may lean back while
        // the arm reaches out; that is no other branch.
        let reaching = Candidate {
            name: "elbow",
            words: ["up", "down"],
            meaning: format!(
                "{up}; the other way round where, close to axis 1, that line leads back to it"
            ),
            value: Box::new(move |arm, at| {
                let (_, bend) = arm.bend(at, shoulder, elbow)?;
                let [_, ahead] = arm.reach(at, shoulder)?;
                (ahead.abs() > MARGIN * arm.size).then(|| -bend * ahead.signum())
            }),
        };
        match shoulder {
            1 => vec![above, reaching],
            _ => vec![above],
        }
    }

    /// Whether a joint leaves upright what is upright.
    fn is_upright(&self, joint: usize) -> bool {
        let line = &self.home.lines[joint];
        line.is_none_or(|line| is_zero(cross(line.direction, UP)))
    }

    /// To which side the fifth joint turns the sixth axis out of the plane of
    /// the fourth and fifth.
    fn wrist(&self) -> Option<Candidate> {
        if self.home.lines.len() != 6 {
            return None;
        }
        let side = |at: &At| {
            let [a, b, c] = [3, 4, 5].map(|i| at.lines[i].map(|line| line.direction));
            Some(dot(a?, cross(b?, c?)))
        };
        let of = |q5: f64| side(&self.at(&[0.0, 0.0, 0.0, 0.0, q5, 0.0]));
        let (sine, cosine) = (of(FRAC_PI_2)?, of(0.0)?);
        // The sine of q5 from some angle on, which can be had between a right
        // angle back and one ahead.
        let begin = (-cosine).atan2(sine);
        let turned = !(-FRAC_PI_2 - NEAR..FRAC_PI_2 - NEAR).contains(&begin);
        let begin = begin - if turned { PI * begin.signum() } else { 0.0 };
        let sign = if turned { -1.0 } else { 1.0 };
        is_sinusoid(sine, cosine, of(1.0)?).then(|| Candidate {
            name: "wrist",
            words: ["not flipped", "flipped"],
            meaning: format!(
                "wrist not flipped: q5 is between {}° and {}°",
                degrees(begin),
                degrees(begin + PI)
            ),
            value: Box::new(move |_, at| Some(sign * side(at)?)),
        })
    }
}

/// Whether s sin φ + c cos φ has this value at φ = 1, with no constant.
fn is_sinusoid(s: f64, c: f64, at_1: f64) -> bool {
    (s * 1.0_f64.sin() + c * 1.0_f64.cos() - at_1).abs() < NEAR
}

fn is_zero(v: Vec3) -> bool {
    dot(v, v).sqrt() < NEAR
}

fn is_across(line: &Line, direction: Vec3) -> bool {
    dot(line.direction, direction).abs() < NEAR
}

/// What an arm holds out.
enum Hand {
    /// A joint's axis.
    Axis(usize),
    /// The point where the axes of joints meet.
    Meeting(Vec<usize>),
    /// The tip's origin.
    Tip,
}

impl Hand {
    fn name(&self) -> String {
        match self {
            Hand::Axis(joint) => format!("axis {}", joint + 1),
            Hand::Meeting(_) => "the wrist's centre".into(),
            Hand::Tip => "the tip".into(),
        }
    }

    fn at(&self, arm: &PostureArm, at: &At) -> Option<Vec3> {
        match self {
            Hand::Axis(joint) => Some(at.lines[*joint]?.point),
            Hand::Meeting(joints) => meeting(at, joints, arm.size),
            Hand::Tip => Some(at.tip),
        }
    }
}

fn meeting(at: &At, joints: &[usize], size: f64) -> Option<Vec3> {
    let lines: Option<Vec<Line>> = joints.iter().map(|&i| at.lines[i]).collect();
    concurrency(&lines?, NEAR, NEAR * size)
}

impl At {
    fn new(chain: &Chain, q: &[f64]) -> Self {
        let Pose { translation, .. } = chain.fk(q);
        Self {
            lines: chain
                .spatial_jacobian(q)
                .iter()
                .map(Line::of_twist)
                .collect(),
            tip: translation,
        }
    }
}

/// The bits that no posture has been found for, by the step that they are of.
fn roots_without_a_word(solver: &ClosedForm, named: &[Posture]) -> Vec<Posture> {
    // A posture of several bits names the one that no other has.
    let mut taken: Vec<u8> = Vec::new();
    let mut by_length: Vec<&Posture> = named.iter().collect();
    by_length.sort_by_key(|posture| posture.bits.len());
    for posture in by_length {
        let free = posture.bits.iter().rev().find(|bit| !taken.contains(bit));
        taken.extend(free);
    }
    let mut first = 0;
    let mut columns = Vec::new();
    for (i, step) in solver.plan.steps.iter().enumerate() {
        let own = first..first + step.subproblem.choices();
        first = own.end;
        let bits: Vec<u8> = own.filter(|bit| !taken.contains(bit)).collect();
        let unknowns = list(step.unknowns.iter().map(ToString::to_string));
        let words: Vec<String> = match bits.len() {
            0 => continue,
            1 => ["+".into(), "−".into()].into(),
            count => (0..1 << count).map(|i| (i + 1).to_string()).collect(),
        };
        let meaning = match bits.len() {
            1 => format!("step {}: the sign of the root that gives {unknowns}", i + 1),
            _ => format!("step {}: which of the roots that give {unknowns}", i + 1),
        };
        columns.push(Posture {
            name: format!("step {}", i + 1),
            bits,
            words,
            meaning,
        });
    }
    columns
}
