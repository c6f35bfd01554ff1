//! Where a factor of the determinant vanishes.

use crate::expr::{Expr, Graph, Node};
use crate::geometry::size;
use crate::model::Model;
use crate::random::Random;
use std::f64::consts::{FRAC_PI_2, PI};

/// Where a factor vanishes.
#[derive(Clone, Debug, PartialEq)]
pub enum Locus {
    /// At these values of the only coordinate that it depends on: radians in
    /// (−π, π], or metres.
    Values(Vec<f64>),
    /// On a surface in the space of several coordinates; a configuration of all
    /// joints that lies on it.
    Surface(Vec<f64>),
    /// Nowhere that was looked.
    Never,
}

/// Lines in joint space on which a factor of several coordinates is followed.
const LINES: usize = 24;
/// Zeros of it that are looked at.
const SAMPLES: usize = 4;
/// Points of a line between which the sign may change.
const POINTS: usize = 48;

/// A factor with what it depends on.
pub(super) struct Factored {
    graph: Graph,
    expression: Expr,
    model: Model,
    /// From 0.
    pub coordinates: Vec<usize>,
    ranges: Vec<[f64; 2]>,
}

impl Factored {
    pub fn new(g: &Graph, model: &Model, expression: Expr) -> Self {
        // On its own it is evaluated faster.
        let n = model.variables.len();
        let mut graph = Graph::new();
        let inputs: Vec<(Expr, Expr)> = (0..n as u16)
            .map(|i| {
                let there = g.find(Node::Input(i)).unwrap_or(g.at(0));
                (there, graph.input(format!("q{}", i + 1)))
            })
            .collect();
        let expression = graph.import(g, expression, &inputs);
        let needed = graph.reachable(&[expression]);
        let coordinates = (0..n).filter(|&i| needed[inputs[i].1.index()]).collect();
        let reach = 2.0 * size(model);
        let range = |i: usize| match model.variables[i].travel() {
            _ if model.turns(i) => [-PI, PI],
            // A slide is looked at beyond its limits, too.
            Some([low, high]) => [low - reach, high + reach],
            None => [-reach, reach],
        };
        Self {
            ranges: (0..n).map(range).collect(),
            model: model.clone(),
            graph,
            expression,
            coordinates,
        }
    }

    fn at(&self, q: &[f64]) -> f64 {
        let mut values = Vec::new();
        self.graph.evaluate(q, 0, &mut values);
        values[self.expression.index()]
    }

    /// Where it vanishes, and for every value, or for the surface, some
    /// configurations there with all other coordinates anywhere.
    pub fn locus(&self) -> (Locus, Vec<Vec<Vec<f64>>>) {
        let mut random = Random(0x9e37_79b9_7f4a_7c15);
        if let [only] = self.coordinates[..] {
            let zeros = self.zeros(&self.anywhere(&mut random), only);
            let mut at = |zero: f64| {
                let mut q = self.anywhere(&mut random);
                q[only] = zero;
                q
            };
            let samples = zeros
                .iter()
                .map(|&zero| (0..SAMPLES).map(|_| at(zero)).collect());
            let samples = samples.collect();
            return match zeros.is_empty() {
                true => (Locus::Never, samples),
                false => (Locus::Values(zeros), samples),
            };
        }
        let mut samples: Vec<Vec<f64>> = Vec::new();
        for line in 0..LINES {
            let along = self.coordinates[line % self.coordinates.len().max(1)];
            let mut q = self.anywhere(&mut random);
            if let Some(&zero) = self.zeros(&q, along).first() {
                q[along] = zero;
                samples.push(q);
            }
            if samples.len() == SAMPLES {
                break;
            }
        }
        match samples.first() {
            Some(first) => (Locus::Surface(first.clone()), vec![samples]),
            None => (Locus::Never, Vec::new()),
        }
    }

    fn anywhere(&self, random: &mut Random) -> Vec<f64> {
        let ranges = self.ranges.iter();
        ranges
            .map(|&[low, high]| random.between(low, high))
            .collect()
    }

    /// The zeros along one coordinate.
    fn zeros(&self, q: &[f64], along: usize) -> Vec<f64> {
        let [low, high] = self.ranges[along];
        let mut q = q.to_vec();
        let mut of = |x: f64| {
            q[along] = x;
            self.at(&q)
        };
        // Off the quarters, where zeros of exact arms lie.
        let step = (high - low) / POINTS as f64;
        let places: Vec<f64> = (0..=POINTS)
            .map(|k| low + (k as f64 + 0.37) * step)
            .collect();
        let mut zeros = Vec::new();
        for pair in places.windows(2) {
            let (mut a, mut b) = (pair[0], pair[1]);
            let sign = of(a) > 0.0;
            if (of(b) > 0.0) == sign {
                continue;
            }
            while b - a > f64::EPSILON * (1.0 + a.abs()) {
                let middle = 0.5 * (a + b);
                if middle <= a || middle >= b {
                    break;
                }
                match (of(middle) > 0.0) == sign {
                    true => a = middle,
                    false => b = middle,
                }
            }
            zeros.push(self.rounded(along, 0.5 * (a + b)));
        }
        zeros.sort_by(f64::total_cmp);
        zeros
    }

    /// In (−π, π], and a multiple of a quarter turn where it is one.
    fn rounded(&self, along: usize, x: f64) -> f64 {
        if !self.model.turns(along) {
            return x;
        }
        let x = kin_runtime::__private::math::wrap(x);
        let right = (x / FRAC_PI_2).round() * FRAC_PI_2;
        match (x - right).abs() < 1e-12 {
            true if right <= -PI => PI,
            true => right + 0.0,
            false => x,
        }
    }
}
