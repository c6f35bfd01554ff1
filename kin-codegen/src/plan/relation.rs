//! Relations: two invariants, and the joints between them that matter.

use super::{Invariant, Kind};
use crate::geometry::{Line, Linkage, Swivel, cross, dot, norm, sub};
use kin_runtime::Pose;
use std::fmt;
use std::ops::Range;

/// An unknown of the loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Atom {
    /// The value of a joint.
    Joint(usize),
    /// The sum of the angles of a run of parallel joints; the index of the
    /// run, and its joints from the first to the last that turn.
    Sum {
        /// Which of the linkage's runs.
        run: usize,
        /// First turning joint.
        first: usize,
        /// Last turning joint.
        last: usize,
    },
}

impl Atom {
    /// The joints that it stands for, with what slides in a run.
    pub fn joints(self, linkage: &Linkage) -> Range<usize> {
        match self {
            Atom::Joint(joint) => joint..joint + 1,
            Atom::Sum { run, .. } => linkage.runs[run].joints.clone(),
        }
    }
}

impl fmt::Display for Atom {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Atom::Joint(i) => write!(f, "q{}", i + 1),
            Atom::Sum { first, last, .. } => {
                let terms: Vec<String> = (*first..=*last).map(|i| format!("q{}", i + 1)).collect();
                f.write_str(&terms.join("+"))
            }
        }
    }
}

/// An equation of the closed loop.
///
/// With two invariants: their distance (point and point), height (point and
/// plane) or angle (two directions) is the same along both arcs of the loop.
/// With one: transported around the loop, it comes back to itself.
#[derive(Clone, Debug, PartialEq)]
pub struct Relation {
    /// The first in the order of the joints.
    pub from: Invariant,
    /// The second, if there is one.
    pub to: Option<Invariant>,
    /// The unknowns that it depends on, in the order of the loop beginning
    /// behind `from`, and how strongly.
    pub depends: Vec<Dependence>,
    /// A second relation between the same two unknowns, where one alone does
    /// not determine them: subproblem 6.
    pub with: Option<Box<Relation>>,
    /// Whether the target has the invariant where the swivel angle puts the elbow, and not
    /// where joints behind it do.
    pub is_swivel: bool,
}

/// How a relation depends on an unknown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dependence {
    /// The unknown.
    pub atom: Atom,
    /// The amplitude of the relation over a turn of the unknown, at its
    /// weakest over the sampled configurations, relative to the arm's size.
    /// Zero if the unknown only ever sits where the relation is stationary.
    pub weakest: f64,
    /// Whether that amplitude is a constant of the arm: then the subproblem
    /// cannot degenerate.
    pub steady: bool,
    /// Whether the unknown lies between `from` and `to`, and not on the arc
    /// over the target.
    pub inner: bool,
    /// Bit k is set where the amplitude is nothing in the k-th of the configurations that
    /// a plan has to tell.
    pub weak_at: u64,
    /// By sample: the first and second derivative of the relation by the
    /// unknown, when it moves `to`.
    pub derivatives: [[f64; 2]; SAMPLES],
}

/// Configurations looked at.
const SAMPLES: usize = 3;

/// The chain at some configurations, to see which joints matter to what.
pub struct Samples(Vec<Sample>);

struct Sample {
    /// By joint.
    q: Vec<f64>,
    /// Of the links, base first.
    bodies: Vec<Pose>,
    axes: Vec<Line>,
}

/// Next to a configuration with an amplitude of nothing it is less than this.
const NEARLY_NOTHING: f64 = 1e-3;

/// Below this a dependence is rounding; no looser than what idealization leaves.
const NOTHING: f64 = 1e-13;
/// The same of coupled joints: what couples them stays as the file has it, half turns of ten digits.
const NOTHING_COUPLED: f64 = 1e-11;

impl Samples {
    /// Moves the chain to a few fixed, irregular configurations.
    pub fn new(linkage: &Linkage) -> Self {
        // Multiples of an irrational angle: nothing is aligned by accident.
        let value = |i: usize, k: usize| (((i + 1) * k) as f64 * 2.399_963 + 0.37).sin() * 2.3;
        let n = linkage.links.len();
        let q = |k: usize| (0..n).map(|i| value(i, k)).collect();
        Self::at(linkage, &(1..=SAMPLES).map(q).collect::<Vec<_>>())
    }

    /// Moves the chain to some configurations, by joint.
    pub fn at(linkage: &Linkage, configurations: &[Vec<f64>]) -> Self {
        let all = configurations.iter();
        Self(all.map(|q| Sample::new(linkage, q.clone())).collect())
    }

    /// The same configurations with some joints at zero.
    fn without(&self, linkage: &Linkage, joints: &[usize]) -> Self {
        let at_zero = |sample: &Sample| {
            let mut q = sample.q.clone();
            joints.iter().for_each(|&joint| q[joint] = 0.0);
            Sample::new(linkage, q)
        };
        Self(self.0.iter().map(at_zero).collect())
    }

    /// Bit k is set where two joints are parallel in the k-th configuration.
    pub fn parallel(&self, a: usize, b: usize) -> u64 {
        let sine =
            |sample: &Sample| norm(cross(sample.axes[a].direction, sample.axes[b].direction));
        self.bits(|_, sample| sine(sample) < NEARLY_NOTHING)
    }

    /// Bit k is set where it holds in the k-th configuration, of 64.
    fn bits(&self, holds: impl Fn(usize, &Sample) -> bool) -> u64 {
        let all = self.0.iter().take(64).enumerate();
        all.fold(0, |bits, (k, sample)| {
            bits | u64::from(holds(k, sample)) << k
        })
    }
}

impl Sample {
    fn new(linkage: &Linkage, q: Vec<f64>) -> Self {
        let mut bodies = vec![Pose::IDENTITY];
        let mut axes = Vec::new();
        for (i, q) in q.iter().enumerate() {
            let here = bodies[i];
            axes.push(linkage.axis(i).moved(&here));
            bodies.push(here * Pose::exp(&linkage.twist(i), *q));
        }
        Self { q, bodies, axes }
    }

    /// An invariant where this configuration has it.
    fn place(&self, invariant: &Invariant) -> Line {
        let line = Line {
            point: invariant.point,
            direction: invariant.direction,
        };
        line.moved(&self.bodies[invariant.joints.start])
    }

    /// Where it has those of a relation.
    fn ends(&self, from: &Invariant, to: Option<&Invariant>) -> Ends {
        let end = |invariant: &Invariant| (invariant.kind, self.place(invariant));
        Ends {
            from: end(from),
            to: to.map(end),
        }
    }
}

/// The invariants of a relation, where a configuration has them.
struct Ends {
    from: (Kind, Line),
    to: Option<(Kind, Line)>,
}

impl Relation {
    /// The relation between invariants, unless it says nothing. `to_solve` are configurations
    /// that a plan has to solve.
    ///
    /// A joint on the way around by the base that it does not depend on wherever the loop is closed is
    /// crossed as if it stood at zero ([`crate::expr`]), where the loop is not: what it says of the
    /// others, it has to say there. One between the invariants changes nothing, wherever it stands.
    pub fn new(
        linkage: &Linkage,
        samples: &Samples,
        to_solve: &Samples,
        from: &Invariant,
        to: Option<&Invariant>,
    ) -> Option<Self> {
        let relation = Self::seen(linkage, samples, to_solve, from, to)?;
        let inner = from.joints.end..to.map_or(from.joints.end, |to| to.joints.start);
        let is_crossed = |joint: &usize| {
            !inner.contains(joint) && relation.depends_on(linkage, *joint).is_none()
        };
        let crossed: Vec<usize> = relation.between(linkage).filter(is_crossed).collect();
        if crossed.is_empty() {
            return Some(relation);
        }
        let samples = samples.without(linkage, &crossed);
        let at_zero = Self::seen(linkage, &samples, &Samples(Vec::new()), from, to)?;
        let atoms = |relation: &Self| {
            relation
                .depends
                .iter()
                .map(|it| it.atom)
                .collect::<Vec<_>>()
        };
        (atoms(&at_zero) == atoms(&relation)).then_some(relation)
    }

    /// The joints between its invariants, in the order of the loop beginning behind `from`.
    fn between(&self, linkage: &Linkage) -> impl Iterator<Item = usize> + use<> {
        between(linkage.links.len(), &self.from, self.to.as_ref())
    }

    /// What it depends on by a joint.
    fn depends_on(&self, linkage: &Linkage, joint: usize) -> Option<&Dependence> {
        let atom = atom_of(linkage, joint, self.from.kind == Kind::Direction);
        self.depends.iter().find(|it| it.atom == atom)
    }

    /// What these configurations show of it.
    fn seen(
        linkage: &Linkage,
        samples: &Samples,
        to_solve: &Samples,
        from: &Invariant,
        to: Option<&Invariant>,
    ) -> Option<Self> {
        let n = linkage.links.len();
        let behind = to.map_or(n, |to| to.joints.start);
        let directional = from.kind == Kind::Direction;
        let nothing = match linkage.coupling {
            Some(_) => NOTHING_COUPLED,
            None => NOTHING,
        };
        let ends = |sample: &Sample| sample.ends(from, to);
        let places: Vec<Ends> = samples.0.iter().map(ends).collect();
        let places_to_solve: Vec<Ends> = to_solve.0.iter().map(ends).collect();
        let mut depends: Vec<Dependence> = Vec::new();
        for joint in between(n, from, to) {
            let atom = atom_of(linkage, joint, directional);
            if depends.iter().any(|d| d.atom == atom) {
                continue;
            }
            let strengths: [Strength; SAMPLES] =
                std::array::from_fn(|k| strength(linkage, &samples.0[k], &places[k], joint));
            let inner = to.is_some() && (from.joints.end..behind).contains(&joint);
            let weak = |k: usize, sample: &Sample| {
                strength(linkage, sample, &places_to_solve[k], joint).amplitude < NEARLY_NOTHING
            };
            let dependence = dependence(atom, inner, &strengths, nothing);
            depends.extend(dependence.map(|dependence| Dependence {
                weak_at: to_solve.bits(weak),
                ..dependence
            }));
        }
        let says_something = !depends.is_empty();
        says_something.then(|| Self {
            from: from.clone(),
            to: to.cloned(),
            depends,
            with: None,
            is_swivel: false,
        })
    }

    /// Where the swivel angle puts the elbow, which depends on its bend, the shoulder turns it.
    pub fn of_swivel(
        linkage: &Linkage,
        samples: &Samples,
        to_solve: &Samples,
        swivel: &Swivel,
    ) -> Option<Self> {
        let elbow = Swivel::ELBOW;
        let invariant = Invariant {
            kind: Kind::Point,
            joints: elbow..elbow + 1,
            point: swivel.elbow,
            direction: [0.0; 3],
        };
        let relation = Self::new(linkage, samples, to_solve, &invariant, None)?;
        let turns_it = |depends: &Dependence| matches!(depends.atom, Atom::Joint(i) if i < elbow);
        let mut depends = relation.depends;
        depends.retain(turns_it);
        depends.push(Dependence {
            atom: Atom::Joint(elbow + 1),
            weakest: 1.0,
            steady: true,
            inner: false,
            weak_at: 0,
            derivatives: [[0.0; 2]; SAMPLES],
        });
        Some(Self {
            depends,
            is_swivel: true,
            ..relation
        })
    }
}

/// The joints between two invariants, or all that move one: in the order of the loop beginning
/// behind the first.
fn between(
    n: usize,
    from: &Invariant,
    to: Option<&Invariant>,
) -> impl Iterator<Item = usize> + use<> {
    let behind = to.map_or(n, |to| to.joints.start);
    let again = to.map_or(n, |to| to.joints.end);
    (from.joints.end..behind)
        .chain(again..n)
        .chain(0..from.joints.start)
}

/// None if it is `nothing`.
fn dependence(
    atom: Atom,
    inner: bool,
    strengths: &[Strength; SAMPLES],
    nothing: f64,
) -> Option<Dependence> {
    if strengths.iter().all(|s| s.amplitude < nothing) {
        return None;
    }
    // A relation that is always stationary has a double root for a solution.
    let stationary = strengths.iter().all(|s| s.slope.abs() < nothing);
    let amplitudes = strengths.iter().map(|s| s.amplitude);
    let weakest = amplitudes.clone().fold(f64::INFINITY, f64::min);
    let strongest = amplitudes.fold(0.0, f64::max);
    let steady = strongest - weakest < 1e-9 * strongest;
    Some(Dependence {
        atom,
        weakest: if stationary { 0.0 } else { weakest },
        steady,
        inner,
        weak_at: 0,
        derivatives: std::array::from_fn(|k| [strengths[k].slope, strengths[k].bend]),
    })
}

/// How fast a relation changes with a joint, and how fast it would at the
/// joint's best value; lengths relative to the arm's size.
struct Strength {
    slope: f64,
    bend: f64,
    amplitude: f64,
}

fn strength(linkage: &Linkage, sample: &Sample, ends: &Ends, joint: usize) -> Strength {
    let size = linkage.size;
    let axis = sample.axes[joint];
    let slides = !linkage.is_revolute(joint);
    // The velocity of a point or direction under a unit rate of the joint.
    let velocity = |kind: Kind, x: &Line| match (kind, slides) {
        (Kind::Direction, true) => [0.0; 3],
        (_, true) => axis.direction,
        (Kind::Direction, false) => cross(axis.direction, x.direction),
        (_, false) => cross(axis.direction, sub(x.point, axis.point)).map(|v| v / size),
    };
    // The part of a point or direction that turns with the joint.
    let turning = |kind: Kind, x: &Line| match (kind, slides) {
        (_, true) => [0.0; 3],
        (Kind::Direction, false) => axis.across(x.direction),
        (_, false) => axis.offset_of(x.point).map(|v| v / size),
    };
    let (from, a) = &ends.from;
    let Some((to, b)) = &ends.to else {
        let speed = norm(velocity(*from, a));
        return Strength {
            slope: speed,
            bend: speed,
            amplitude: speed,
        };
    };
    match (from, to) {
        (Kind::Point, Kind::Point) => {
            let gap = sub(b.point, a.point).map(|x| x / size);
            let (moved, arm) = (velocity(Kind::Point, b), turning(Kind::Point, b));
            let arms = norm(arm) * norm(turning(Kind::Point, a));
            Strength {
                slope: dot(gap, moved),
                bend: dot(moved, moved) - dot(gap, arm) * f64::from(!slides),
                amplitude: if slides { 1.0 } else { arms },
            }
        }
        (Kind::Direction, _) => {
            let arm = turning(Kind::Direction, b);
            Strength {
                slope: dot(a.direction, velocity(Kind::Direction, b)),
                bend: -dot(a.direction, arm),
                amplitude: norm(turning(Kind::Direction, a)) * norm(arm),
            }
        }
        (first, _) => {
            // A plane that moves on is a point that stays behind.
            let (plane, point, sign) = match first {
                Kind::Plane => (a, b, 1.0),
                _ => (b, a, -1.0),
            };
            let arm = turning(Kind::Point, point);
            let slope = sign * dot(plane.direction, velocity(Kind::Point, point));
            let across = norm(axis.across(plane.direction));
            Strength {
                slope,
                bend: -dot(plane.direction, arm),
                amplitude: if slides {
                    slope.abs()
                } else {
                    across * norm(arm)
                },
            }
        }
    }
}

/// How independently two relations determine two unknowns of both.
#[derive(Clone, Copy, Debug)]
pub struct Independence {
    /// The determinant of their slopes relative to all coefficients, at its strongest.
    pub slopes: f64,
    /// Whether those of one unknown are independent by themselves, and constants of the arm.
    pub steady: bool,
}

impl Relation {
    /// How independently two relations determine two unknowns of both.
    pub fn independence(&self, other: &Relation, atoms: [Atom; 2]) -> Option<Independence> {
        let find = |relation: &Relation, atom: Atom| {
            let mut depends = relation.depends.iter();
            depends.find(|d| d.atom == atom).copied()
        };
        let find = |relation| Some([find(relation, atoms[0])?, find(relation, atoms[1])?]);
        let (a, b) = (find(self)?, find(other)?);
        let coefficients = |all: &[Dependence; 2], k: usize| {
            let [[s, t], [u, v]] = all.map(|it| it.derivatives[k]);
            [s, t, u, v]
        };
        let slopes = (0..SAMPLES).map(|k| {
            let (a, b) = (coefficients(&a, k), coefficients(&b, k));
            let (a, b) = (a.map(|x| x / size(a)), b.map(|x| x / size(b)));
            // How strong both are of an unknown does not matter: a short link is one.
            let strength = |i: usize| size([a[i], a[i + 1], b[i], b[i + 1]]);
            determinant([a[0], a[2]], [b[0], b[2]]).abs() / (strength(0) * strength(2))
        });
        let is_steady = |(a, b): (&Dependence, &Dependence)| {
            let sines = (0..SAMPLES).map(|k| apart(a.derivatives[k], b.derivatives[k]));
            let least = sines.clone().fold(f64::INFINITY, f64::min);
            let most = sines.fold(0.0, f64::max);
            a.steady && b.steady && most - least < 1e-9 * most
        };
        Some(Independence {
            slopes: slopes.fold(0.0, f64::max),
            steady: a.iter().zip(&b).any(is_steady),
        })
    }

    /// Bit k is set where two relations are one about two joints in the k-th of the
    /// configurations that a plan has to solve.
    pub fn dependent_at(
        &self,
        other: &Relation,
        linkage: &Linkage,
        to_solve: &Samples,
        joints: [usize; 2],
    ) -> u64 {
        to_solve.bits(|_, sample| {
            let [a, b] = [self, other].map(|relation| {
                let ends = sample.ends(&relation.from, relation.to.as_ref());
                let [one, other] = joints.map(|joint| strength(linkage, sample, &ends, joint));
                [one.slope, one.bend, other.slope, other.bend]
            });
            apart(a, b) < NEARLY_NOTHING
        })
    }
}

/// The sine of the angle between the coefficients of two relations.
fn apart<const N: usize>(a: [f64; N], b: [f64; N]) -> f64 {
    let (a_size, b_size) = (size(a), size(b));
    if a_size == 0.0 || b_size == 0.0 {
        return 0.0;
    }
    let apart = |sign: f64| {
        size(std::array::from_fn::<_, N, _>(|i| {
            a[i] / a_size + sign * b[i] / b_size
        }))
    };
    0.5 * apart(1.0) * apart(-1.0)
}

fn size<const N: usize>(v: [f64; N]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn determinant([s, t]: [f64; 2], [u, v]: [f64; 2]) -> f64 {
    s * v - t * u
}

impl Relation {
    /// Whether a relation of the same unknown is strong at other places than
    /// this: the slopes of the two are not proportional.
    pub fn complements(&self, other: &Relation, atom: Atom) -> bool {
        let find = |relation: &Relation| {
            let mut depends = relation.depends.iter();
            depends.find(|d| d.atom == atom).copied()
        };
        let (Some(a), Some(b)) = (find(self), find(other)) else {
            return false;
        };
        let ratio = |k: usize| a.derivatives[k][0].abs() / b.derivatives[k][0].abs();
        let all: [f64; SAMPLES] = std::array::from_fn(ratio);
        let least = all.iter().copied().fold(f64::INFINITY, f64::min);
        let most = all.iter().copied().fold(0.0, f64::max);
        most - least > 1e-6 * most
    }
}

/// Directions see a run of parallel joints as one rotation.
fn atom_of(linkage: &Linkage, joint: usize, directional: bool) -> Atom {
    let run = linkage.run_of(joint);
    match linkage.revolutes_of(run)[..] {
        [first, .., last] if directional => Atom::Sum { run, first, last },
        _ => Atom::Joint(joint),
    }
}
