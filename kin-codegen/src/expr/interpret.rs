//! The interpreter: what the emitted code will compute, one branch at a time.

use super::{Expr, Graph, Node, RootField};
use kin_runtime::__private::quartic::{TrigRoot, trig_roots};
use kin_runtime::__private::{lanes, math};

/// One combination of signs: bit i set means that choice i is −1.
pub type Lane = u32;

impl Graph {
    /// Evaluates every node for one branch with the functions that generated
    /// code uses. `values` is resized and filled, indexed by [`Expr::index`].
    pub fn evaluate(&self, inputs: &[f64], lane: Lane, values: &mut Vec<f64>) {
        self.evaluate_first(self.nodes().len(), inputs, lane, values);
    }

    /// The same of so many nodes in front.
    pub(crate) fn evaluate_first(
        &self,
        count: usize,
        inputs: &[f64],
        lane: Lane,
        values: &mut Vec<f64>,
    ) {
        values.clear();
        values.reserve(count);
        let mut quartic = Quartic::default();
        for node in &self.nodes()[..count] {
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
            Node::Atan2(y, x) => lanes::angle_of_unit::<false>(of(y), of(x)),
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
