//! The interpreter: what the emitted code will compute, one branch at a time.

use super::{Expr, Graph, Node, RootField};
use kin_runtime::__private::quartic::{TrigRoot, trig_roots};
use kin_runtime::__private::{lanes, math};

/// One combination of signs: bit i set means that choice i is −1.
pub type Lane = u32;

/// The order in which a graph computes some outputs for all its branches: an
/// expression that sees k choices is computed in 2ᵏ lanes, and one that no
/// output needs not at all.
#[derive(Clone, Debug, Default)]
pub struct Schedule {
    /// The nodes that are needed.
    nodes: Vec<usize>,
    /// By node: where its lanes begin, and how many there are, less one.
    places: Vec<(usize, usize)>,
    /// All lanes of all nodes.
    width: usize,
}

/// The values of a graph's nodes.
#[derive(Clone, Debug)]
pub struct Values<'a> {
    schedule: &'a Schedule,
    values: Vec<f64>,
}

impl Values<'_> {
    /// Of an expression in a lane.
    pub fn at(&self, e: Expr, lane: Lane) -> f64 {
        let (begin, mask) = self.schedule.places[e.index()];
        self.values[begin + (lane as usize & mask)]
    }
}

impl Graph {
    /// The order in which to compute `outputs`.
    pub fn schedule(&self, outputs: &[Expr]) -> Schedule {
        let needed = self.reachable(outputs);
        let mut next = 0;
        let places = (self.levels().into_iter().zip(&needed)).map(|(level, &needed)| {
            let begin = next;
            next += usize::from(needed) << level;
            (begin, (1 << level) - 1)
        });
        let places = places.collect();
        Schedule {
            places,
            width: next,
            nodes: (0..needed.len()).filter(|&i| needed[i]).collect(),
        }
    }

    /// The values of all branches.
    pub fn evaluate_all<'a>(&self, schedule: &'a Schedule, inputs: &[f64]) -> Values<'a> {
        let mut values = vec![0.0; schedule.width];
        // Slices: macros run in builds without optimizations, where every index of a
        // vector is a call.
        let (places, slots) = (schedule.places.as_slice(), values.as_mut_slice());
        let mut quartic = Quartic::default();
        for &i in &schedule.nodes {
            let node = &self.nodes()[i];
            let (begin, last) = places[i];
            for lane in 0..=last {
                let of = |e: &Expr| {
                    let (begin, mask) = places[e.0 as usize];
                    slots[begin + (lane & mask)]
                };
                slots[begin + lane] = node.value(inputs, lane as Lane, of, &mut quartic);
            }
        }
        Values { schedule, values }
    }

    /// Evaluates every node for one branch with the functions that generated
    /// code uses. `values` is resized and filled, indexed by [`Expr::index`].
    pub fn evaluate(&self, inputs: &[f64], lane: Lane, values: &mut Vec<f64>) {
        values.clear();
        values.reserve(self.nodes().len());
        let mut quartic = Quartic::default();
        for node in self.nodes() {
            let value = node.value(inputs, lane, |e| values[e.index()], &mut quartic);
            values.push(value);
        }
    }
}

/// The numbers of a quartic's roots stand together: it is solved once for each
/// lane.
#[derive(Default)]
struct Quartic {
    of: Option<[Expr; 5]>,
    solved: Vec<Option<[TrigRoot; 4]>>,
}

impl Quartic {
    fn roots(
        &mut self,
        coefficients: &[Expr; 5],
        lane: Lane,
        of: impl Fn(&Expr) -> f64,
    ) -> [TrigRoot; 4] {
        if self.of != Some(*coefficients) {
            self.of = Some(*coefficients);
            self.solved.clear();
        }
        let lane = lane as usize;
        if self.solved.len() <= lane {
            self.solved.resize(lane + 1, None);
        }
        *self.solved[lane].get_or_insert_with(|| trig_roots(coefficients.map(|e| of(&e))))
    }
}

impl Node {
    fn value(
        &self,
        inputs: &[f64],
        lane: Lane,
        of: impl Fn(&Expr) -> f64,
        quartic: &mut Quartic,
    ) -> f64 {
        match self {
            Node::Constant(bits) => f64::from_bits(*bits),
            Node::Input(i) => inputs[usize::from(*i)],
            Node::Sign(choice) => 1.0 - 2.0 * f64::from((lane >> choice.0) & 1),
            Node::Add(a, b) => of(a) + of(b),
            Node::Sub(a, b) => of(a) - of(b),
            Node::Mul(a, b) => of(a) * of(b),
            Node::Div(a, b) => of(a) / of(b),
            Node::Neg(a) => -of(a),
            Node::Sqrt(a) => of(a).sqrt(),
            Node::Sin(a) => math::sin_cos(of(a)).0,
            Node::Cos(a) => math::sin_cos(of(a)).1,
            Node::Atan2(y, x) => lanes::angle(of(y), of(x)),
            Node::Wrap(a) => math::wrap(of(a)),
            Node::Max(a, b) => math::max(of(a), of(b)),
            Node::TrigRoot(coefficients, part) => {
                let root = quartic.roots(coefficients, lane, of)[usize::from(part.place)];
                match part.field {
                    RootField::Sin => root.sin,
                    RootField::Cos => root.cos,
                    RootField::State => root.state,
                }
            }
            Node::Select([a, b, x, y]) => {
                if of(a) < of(b) {
                    of(x)
                } else {
                    of(y)
                }
            }
        }
    }
}
