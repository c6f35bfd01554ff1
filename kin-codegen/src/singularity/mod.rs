//! The singularities of an arm: found in the factors of its determinant, named
//! as the field does, and seen to be so.
//!
//! Where a factor vanishes is computed; that the arm loses rank there, and
//! which of the classical conditions its axes then satisfy, is looked up on
//! the generic product of exponentials, with all joints that do not take part
//! anywhere. A noisy file has one factor where the idealized arm has three, so
//! the singularities are those of the idealized arm; the determinant is always
//! the file's.

mod locus;
mod name;

pub use locus::Locus;

use crate::expr::determinant::{Determinant, Factor, Rows, determinant};
use crate::expr::{Expr, Graph, Operations};
use crate::geometry::{Condition, Linkage, conditioning, conditions, idealize, size};
use crate::model::Model;
use crate::plan::Target;
use crate::random::Random;
use kin_runtime::Jacobian;
use locus::Factored;
use std::f64::consts::PI;

/// What there is to say about the singular configurations of an arm whose
/// Jacobian is square.
#[derive(Clone, Debug)]
pub struct Singular {
    /// Holds the expressions below; the inputs are the coordinates of q.
    pub graph: Graph,
    /// Of the arm as the file has it.
    pub determinant: Determinant,
    /// From the base outwards.
    pub singularities: Vec<Singularity>,
    /// By how much axes were turned, radians, and, relative to the arm's size,
    /// shifted, if the singularities are those of an idealized arm.
    pub idealized: Option<f64>,
    /// The largest difference to the determinant of the generic Jacobian that
    /// was seen, relative to its largest value; none if that is not square.
    pub difference: Option<f64>,
}

/// A set of configurations in which the Jacobian loses rank: where one factor of
/// its determinant vanishes.
#[derive(Clone, Debug)]
pub struct Singularity {
    /// Shoulder, elbow, wrist, or the joints.
    pub name: String,
    /// The factor: 0 in the singularity.
    pub expression: Expr,
    /// How often it is a factor of the determinant.
    pub power: usize,
    /// In which power of metres it is, if that is known; 0 for the sine of an
    /// angle.
    pub metres: Option<usize>,
    /// The coordinates that it depends on, from 0.
    pub coordinates: Vec<usize>,
    /// Where it vanishes.
    pub locus: Locus,
    /// What the axes satisfy there.
    pub conditions: Vec<Condition>,
}

/// Readings of a noisy file that are tried if it has a single factor.
const TOLERANCES: [f64; 4] = [1e-8, 1e-6, 5e-5, 1e-3];
/// Below this the Jacobian has lost rank; see [`conditioning`].
const LOST: f64 = 1e-6;
/// The generic determinant and the product agree to this.
const AGREES: f64 = 1e-9;
/// Configurations on which they are compared.
const COMPARED: usize = 12;

impl Singular {
    /// The analysis of an arm, of which `idealized` is the one that has a closed
    /// form, if that is another. None if its Jacobian has not as many rows that count
    /// as columns.
    pub fn new(
        model: &Model,
        linkage: &Linkage,
        idealized: Option<&Model>,
        target: Target,
    ) -> Option<Self> {
        let n = model.variables.len();
        if n > 6 || model.is_coupled() {
            return None;
        }
        let mut graph = Graph::new();
        let q: Vec<Expr> = (1..=n).map(|i| graph.input(format!("q{i}"))).collect();
        let given = determinant(&mut graph, linkage, &q, target)?;
        let difference = difference(model, &graph, &given);
        if difference.is_some_and(|difference| difference > AGREES) {
            return None;
        }
        let (factors, idealized) = match idealized {
            Some(idealized) => {
                let linkage = Linkage::new(idealized);
                let found = determinant(&mut graph, &linkage, &q, target)?;
                (found.factors, Some(idealized.clone()))
            }
            None if given.factors.len() > 1 || n < 4 => (given.factors.clone(), None),
            None => read_idealized(&mut graph, model, &q, target, &given),
        };
        let arm = idealized.as_ref().unwrap_or(model);
        let counts = match given.rows {
            Rows::All | Rows::Moving => Target::Pose,
            Rows::Counting(target) => target,
        };
        let mut singularities = factors
            .iter()
            .map(|factor| Singularity::new(&graph, arm, factor, counts))
            .collect::<Option<Vec<Singularity>>>()
            .unwrap_or_default();
        singularities.sort_by_key(|singularity| singularity.coordinates.clone());
        name::distinct(&mut singularities);
        Some(Self {
            idealized: idealized.map(|idealized| moved(model, &idealized)),
            graph,
            determinant: given,
            singularities,
            difference,
        })
    }

    /// What the determinant takes.
    pub fn cost(&self) -> Operations {
        self.graph.operations(&[self.determinant.product])
    }

    /// The singularities' values.
    pub fn values(&self) -> Vec<Expr> {
        self.singularities
            .iter()
            .map(|singularity| singularity.expression)
            .collect()
    }
}

impl Singularity {
    /// What the field says of it.
    pub fn phrase(&self) -> &'static str {
        match &self.name[..] {
            "elbow" => "the arm is stretched or folded",
            "shoulder" => "the wrist is where the first axis cannot move it",
            "wrist" => "the wrist has lost a direction to turn in",
            _ => "the joints depend on each other",
        }
    }

    /// None if the arm does not lose rank where the factor vanishes, which then
    /// is none of the determinant's.
    fn new(g: &Graph, model: &Model, factor: &Factor, counts: Target) -> Option<Self> {
        let factored = Factored::new(g, model, factor.expression);
        let (locus, samples) = factored.locus();
        let (chain, size) = (model.chain(), size(model));
        let full = |q: &Vec<f64>| conditioning(&chain, q, size, counts) > LOST;
        if samples.iter().flatten().any(full) {
            return None;
        }
        let at = |q: &Vec<f64>| conditions(&chain.spatial_jacobian(q), size);
        let throughout = |sample: &Vec<Vec<f64>>| {
            let common = sample.iter().map(at).reduce(|mut common, here| {
                common.retain(|condition| here.contains(condition));
                common
            });
            common.unwrap_or_default()
        };
        let mut conditions: Vec<Condition> = Vec::new();
        for condition in samples.iter().flat_map(throughout) {
            if !conditions.contains(&condition) {
                conditions.push(condition);
            }
        }
        let coordinates = factored.coordinates;
        Some(Self {
            name: name::of(model, factor, &coordinates),
            expression: factor.expression,
            power: factor.power,
            metres: factor.metres,
            coordinates,
            locus,
            conditions,
        })
    }

    /// What its values are.
    pub fn unit(&self) -> String {
        match self.metres {
            Some(0) => "the sine of the angle to it".into(),
            Some(1) => "metres".into(),
            Some(power) => format!("metres to the power of {power}"),
            None => "powers of metres".into(),
        }
    }
}

/// Without a closed form nobody has said yet what a noisy file means: the
/// strictest reading under which the determinant falls apart.
fn read_idealized(
    g: &mut Graph,
    model: &Model,
    q: &[Expr],
    target: Target,
    given: &Determinant,
) -> (Vec<Factor>, Option<Model>) {
    for tolerance in TOLERANCES {
        let idealized = idealize(model, tolerance);
        if idealized.moved.is_empty() {
            continue;
        }
        let found = determinant(g, &Linkage::new(&idealized.model), q, target);
        if let Some(found) = found.filter(|found| found.factors.len() > 1) {
            return (found.factors, Some(idealized.model));
        }
    }
    (given.factors.clone(), None)
}

/// How far the axes of two readings of one arm are apart, at most.
fn moved(given: &Model, idealized: &Model) -> f64 {
    use crate::geometry::{axes, cross, norm};
    let size = size(given);
    let apart = |(a, b): (crate::geometry::Line, crate::geometry::Line)| {
        let angle = norm(cross(a.direction, b.direction));
        angle.max(norm(a.offset_of(b.point)) / size)
    };
    (axes(given).into_iter().zip(axes(idealized)))
        .map(apart)
        .fold(0.0, f64::max)
}

/// The product beside the determinant of the generic Jacobian.
fn difference(model: &Model, g: &Graph, product: &Determinant) -> Option<f64> {
    if product.rows != Rows::All {
        return None;
    }
    let chain = model.chain();
    let mut random = Random(0x2545_f491_4f6c_dd1d);
    let (mut worst, mut largest) = (0.0_f64, f64::MIN_POSITIVE);
    let mut values = Vec::new();
    for _ in 0..COMPARED {
        let q: Vec<f64> = (0..6).map(|_| random.between(-PI, PI)).collect();
        g.evaluate(&q, 0, &mut values);
        let columns = chain.spatial_jacobian(&q).try_into().ok()?;
        let expected = Jacobian::<6>::from_columns(columns).determinant();
        worst = worst.max((values[product.product.index()] - expected).abs());
        largest = largest.max(expected.abs());
    }
    Some(worst / largest)
}
