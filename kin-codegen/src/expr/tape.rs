//! Expressions as a tape: instructions in a row that compute some outputs in array lanes, for
//! arms that are solved where no code was generated.
//!
//! Every value is as wide as the lanes, those that depend on no sign too: an instruction is one
//! loop, which becomes packed instructions, and the cost of finding the next one is shared by
//! all lanes. Places of values that are read no more are used again, so that all of them stay in
//! the first cache. The operations are those of generated code, in its order within an
//! expression, and so are the results.

use super::hash::NodeMap;
use super::{Expr, Graph, Lane, Node, RootField};
use crate::scalar::Scalar;
use kin_runtime::__private::quartic::{TrigRoot, trig_roots};
use kin_runtime::__private::{Arithmetic, Dispatched, Fused, dispatch, lanes, math, reproducible};
use kin_runtime::single::__private::math as single;

/// Where a value stands.
type Place = u16;

/// One operation, and where it reads and writes.
#[derive(Clone, Copy, Debug)]
enum Instruction {
    Add(Place, [Place; 2]),
    Sub(Place, [Place; 2]),
    Mul(Place, [Place; 2]),
    Div(Place, [Place; 2]),
    /// a b + c, where nothing else reads the product.
    ProductAdd(Place, [Place; 3]),
    /// a b − c.
    ProductSub(Place, [Place; 3]),
    /// a − b c.
    SubProduct(Place, [Place; 3]),
    /// a b + c d.
    ProductsAdd(Place, [Place; 4]),
    /// a b − c d.
    ProductsSub(Place, [Place; 4]),
    Max(Place, [Place; 2]),
    Atan2(Place, [Place; 2]),
    /// The same angle in all lanes of some inputs: generated code has another polynomial for it.
    OneAtan2(Place, [Place; 2]),
    Neg(Place, Place),
    Sqrt(Place, Place),
    Wrap(Place, Place),
    /// Sine and cosine.
    SinCos([Place; 2], Place),
    Select(Place, [Place; 4]),
    /// All roots of a quartic, by the number of their places.
    Roots(Place),
}

/// Where the roots of a trigonometric quartic go: sine, cosine and state of each.
#[derive(Clone, Debug)]
struct Roots {
    coefficients: [Place; 5],
    parts: [[Place; 3]; 4],
}

/// A graph's outputs as instructions.
#[derive(Clone, Debug, Default)]
pub struct Tape {
    constants: Vec<(Place, f64)>,
    /// The place of an input, and which it is.
    inputs: Vec<(Place, u16)>,
    /// The place of a sign, and of which choice.
    signs: Vec<(Place, u8)>,
    /// The sines and cosines of inputs, which all lanes share.
    angles: Vec<([Place; 2], u16)>,
    instructions: Vec<Instruction>,
    roots: Vec<Roots>,
    outputs: Vec<Place>,
    places: usize,
    scalar: Scalar,
    fused: Fusing,
}

/// What generated code computes with fused operations, where the processor has them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Fusing {
    /// Nothing.
    #[default]
    Nothing,
    /// All but sines and cosines, which are those of angles that come with the target.
    Lanes,
    /// Sines and cosines, too.
    All,
}

/// The values of some lanes.
#[derive(Clone, Debug)]
pub struct Lanes<'a, const L: usize> {
    tape: &'a Tape,
    values: Vec<[f64; L]>,
}

impl<const L: usize> Lanes<'_, L> {
    /// An output, by its number, in all lanes.
    pub fn output(&self, number: usize) -> &[f64; L] {
        &self.values[usize::from(self.tape.outputs[number])]
    }
}

impl Tape {
    /// Of some outputs, in their order.
    pub fn new(graph: &Graph, outputs: &[Expr]) -> Self {
        Writer::new(graph, outputs).write(outputs)
    }

    /// The same, computed in a scalar. Single precision is had by rounding every operation of
    /// double precision, which gives the same: that has more than twice the digits.
    pub fn of(self, scalar: Scalar) -> Self {
        Self { scalar, ..self }
    }

    /// The same with products and sums fused as in generated code, where the processor can and
    /// nothing is asked for that is the same on every machine.
    pub fn fusing(self, fused: Fusing) -> Self {
        Self { fused, ..self }
    }

    /// How many outputs there are.
    pub fn outputs(&self) -> usize {
        self.outputs.len()
    }

    /// Computes `L` lanes from `first` on: bit i of a lane's number tells that choice i is −1.
    pub fn run<const L: usize>(&self, inputs: &[f64], first: Lane) -> Lanes<'_, L> {
        self.run_each::<L, 1>([inputs], first)
    }

    /// The same for several inputs side by side: of `L` lanes those of the first inputs come
    /// first, `L / T` of them, from `first` on.
    pub fn run_each<const L: usize, const T: usize>(
        &self,
        inputs: [&[f64]; T],
        first: Lane,
    ) -> Lanes<'_, L> {
        let mut values = vec![[0.0; L]; self.places];
        let input = (self, inputs, first, &mut values[..]);
        match self.scalar {
            Scalar::F64 => dispatch::<Running<L, T, false>, _>(input),
            Scalar::F32 => Running::<L, T, true>::run::<false>(input),
        }
        Lanes { tape: self, values }
    }
}

/// Angles whose sines and cosines are computed side by side.
const ANGLES: usize = 8;

/// What is compiled for several instruction sets.
struct Running<const L: usize, const T: usize, const SINGLE: bool>;

type Input<'a, const L: usize, const T: usize> =
    (&'a Tape, [&'a [f64]; T], Lane, &'a mut [[f64; L]]);

impl<const L: usize, const T: usize, const SINGLE: bool> Dispatched<Input<'_, L, T>>
    for Running<L, T, SINGLE>
{
    type Output = ();

    #[inline(always)]
    fn run<const FUSED: bool>((tape, inputs, first, values): Input<'_, L, T>) {
        let fused = match FUSED && !reproducible::wanted() {
            true => tape.fused,
            false => Fusing::Nothing,
        };
        // How many lanes one of the inputs has.
        let each = L / T;
        let of_each = |x: [f64; T]| -> [f64; L] { std::array::from_fn(|k| x[k / each]) };
        for &(place, x) in &tape.constants {
            values[usize::from(place)] = [tape.scalar.rounded(x); L];
        }
        for &(place, input) in &tape.inputs {
            let x = inputs.map(|inputs| tape.scalar.rounded(inputs[usize::from(input)]));
            values[usize::from(place)] = of_each(x);
        }
        for &(place, choice) in &tape.signs {
            let lane = |k: usize| first + (k % each) as u32;
            let sign = |k: usize| 1.0 - 2.0 * f64::from((lane(k) >> choice) & 1);
            values[usize::from(place)] = std::array::from_fn(sign);
        }
        for angles in tape.angles.chunks(ANGLES) {
            let mut sines = [[0.0; T]; ANGLES];
            let mut cosines = [[0.0; T]; ANGLES];
            for t in 0..T {
                let mut inputs_of = [0.0; ANGLES];
                for (x, (_, input)) in inputs_of.iter_mut().zip(angles) {
                    *x = inputs[t][*input as usize];
                }
                let (sine, cosine) = match fused {
                    _ if SINGLE => in_single(inputs_of),
                    Fusing::All => lanes::sin_cos_by::<FUSED, ANGLES>(inputs_of),
                    _ => lanes::sin_cos(inputs_of),
                };
                for k in 0..ANGLES {
                    (sines[k][t], cosines[k][t]) = (sine[k], cosine[k]);
                }
            }
            for (k, ([sin, cos], _)) in angles.iter().enumerate() {
                values[*sin as usize] = of_each(sines[k]);
                values[*cos as usize] = of_each(cosines[k]);
            }
        }
        for instruction in &tape.instructions {
            tape.step::<L, T, SINGLE, FUSED>(*instruction, fused, values);
        }
    }
}

fn one_in_single(angle: f64) -> (f64, f64) {
    let (sine, cosine) = single::sin_cos(angle as f32);
    (sine.into(), cosine.into())
}

fn in_single<const N: usize>(angles: [f64; N]) -> ([f64; N], [f64; N]) {
    let both = angles.map(one_in_single);
    (both.map(|(sine, _)| sine), both.map(|(_, cosine)| cosine))
}

impl Tape {
    #[inline(always)]
    fn step<const L: usize, const T: usize, const SINGLE: bool, const FUSED: bool>(
        &self,
        instruction: Instruction,
        fused: Fusing,
        values: &mut [[f64; L]],
    ) {
        let at = |place: Place| place as usize;
        // Plain loops: macros run this in builds without optimizations, where closures are calls.
        macro_rules! rounded {
            ($value:expr) => {{
                let value: f64 = $value;
                if SINGLE {
                    f64::from(value as f32)
                } else {
                    value
                }
            }};
        }
        macro_rules! lane_by_lane {
            ($to:ident, [$($operand:ident),*], $k:ident => $value:expr) => {{
                $(let $operand = values[at($operand)];)*
                let out = &mut values[at($to)];
                let mut $k = 0;
                while $k < L {
                    out[$k] = rounded!($value);
                    $k += 1;
                }
            }};
        }
        macro_rules! product_and_sum {
            ($to:ident, [$($operand:ident),*], $k:ident => $a:expr, $b:expr, $c:expr) => {
                if fused == Fusing::Nothing {
                    lane_by_lane!($to, [$($operand),*], $k => rounded!($a * $b) + $c);
                } else {
                    lane_by_lane!($to, [$($operand),*], $k => Fused::<FUSED>::fma($a, $b, $c));
                }
            };
        }
        match instruction {
            Instruction::Add(to, [a, b]) => lane_by_lane!(to, [a, b], k => a[k] + b[k]),
            Instruction::Sub(to, [a, b]) => lane_by_lane!(to, [a, b], k => a[k] - b[k]),
            Instruction::Mul(to, [a, b]) => lane_by_lane!(to, [a, b], k => a[k] * b[k]),
            Instruction::Div(to, [a, b]) => lane_by_lane!(to, [a, b], k => a[k] / b[k]),
            Instruction::ProductAdd(to, [a, b, c]) => {
                product_and_sum!(to, [a, b, c], k => a[k], b[k], c[k]);
            }
            Instruction::ProductSub(to, [a, b, c]) => {
                product_and_sum!(to, [a, b, c], k => a[k], b[k], -c[k]);
            }
            Instruction::SubProduct(to, [a, b, c]) => {
                product_and_sum!(to, [a, b, c], k => -b[k], c[k], a[k]);
            }
            Instruction::ProductsAdd(to, [a, b, c, d]) => {
                product_and_sum!(to, [a, b, c, d], k => a[k], b[k], rounded!(c[k] * d[k]));
            }
            Instruction::ProductsSub(to, [a, b, c, d]) => {
                product_and_sum!(to, [a, b, c, d], k => a[k], b[k], -rounded!(c[k] * d[k]));
            }
            Instruction::Max(to, [a, b]) => lane_by_lane!(to, [a, b], k => math::max(a[k], b[k])),
            Instruction::Atan2(to, [y, x]) => {
                if fused == Fusing::Nothing {
                    lane_by_lane!(to, [y, x], k => match SINGLE {
                        true => single::angle(y[k] as f32, x[k] as f32).into(),
                        false => lanes::angle_of_unit::<false>(y[k], x[k]),
                    });
                } else {
                    lane_by_lane!(to, [y, x], k => Fused::<FUSED>::angle(y[k], x[k]));
                }
            }
            Instruction::OneAtan2(to, [y, x]) => {
                let [y, x] = [y, x].map(|place| values[at(place)]);
                let each = L / T;
                let angles: [f64; T] = std::array::from_fn(|t| match SINGLE {
                    true => single::atan2(y[t * each] as f32, x[t * each] as f32).into(),
                    false => math::atan2(y[t * each], x[t * each]),
                });
                values[at(to)] = std::array::from_fn(|k| angles[k / each]);
            }
            Instruction::Neg(to, a) => lane_by_lane!(to, [a], k => -a[k]),
            Instruction::Sqrt(to, a) => lane_by_lane!(to, [a], k => a[k].sqrt()),
            Instruction::Wrap(to, a) => lane_by_lane!(to, [a], k => match SINGLE {
                true => single::wrap(a[k] as f32).into(),
                false => math::wrap(a[k]),
            }),
            Instruction::SinCos([sin, cos], a) => {
                let a = values[at(a)];
                let mut both = [[0.0; L]; 2];
                for k in 0..L {
                    (both[0][k], both[1][k]) = match fused {
                        _ if SINGLE => one_in_single(a[k]),
                        Fusing::All => math::sin_cos_by::<FUSED>(a[k]),
                        _ => math::sin_cos(a[k]),
                    };
                }
                [values[at(sin)], values[at(cos)]] = both;
            }
            Instruction::Select(to, [a, b, x, y]) => {
                lane_by_lane!(to, [a, b, x, y], k => if a[k] < b[k] { x[k] } else { y[k] });
            }
            Instruction::Roots(number) => self.solve(&self.roots[at(number)], values),
        }
    }

    #[cold]
    #[inline(never)]
    fn solve<const L: usize>(&self, roots: &Roots, values: &mut [[f64; L]]) {
        let coefficients = roots.coefficients.map(|place| values[usize::from(place)]);
        let all: [[u64; 5]; L] = std::array::from_fn(|k| coefficients.map(|c| c[k].to_bits()));
        for k in 0..L {
            // Branches of one target mostly ask for the same roots.
            if let Some(known) = all[..k].iter().rposition(|before| *before == all[k]) {
                for part in roots.parts.iter().flatten() {
                    let value = &mut values[usize::from(*part)];
                    value[k] = value[known];
                }
                continue;
            }
            let found = trig_roots(coefficients.map(|c| c[k]));
            for (TrigRoot { sin, cos, state }, parts) in found.iter().zip(&roots.parts) {
                for (part, x) in parts.iter().zip([sin, cos, state]) {
                    values[usize::from(*part)][k] = *x;
                }
            }
        }
    }
}

/// What an instruction reads.
#[derive(Default)]
struct Operands {
    all: [Expr; 5],
    count: usize,
}

impl Operands {
    fn extend(&mut self, others: impl IntoIterator<Item = Expr>) {
        for other in others {
            self.all[self.count] = other;
            self.count += 1;
        }
    }
}

/// A tape in the making.
struct Writer<'a> {
    graph: &'a Graph,
    needed: Vec<bool>,
    /// By node, how many choices it sees.
    levels: Vec<u8>,
    /// Products that the instruction of a sum or difference has; see [`Graph::fused`].
    inside: Vec<bool>,
    /// By node, the last one whose instruction reads it; outputs are read by none of them.
    last: Vec<usize>,
    /// By node, its place.
    place: Vec<Place>,
    /// Nodes that another one's instruction has written.
    written: Vec<bool>,
    free: Vec<Place>,
    tape: Tape,
}

impl<'a> Writer<'a> {
    fn new(graph: &'a Graph, outputs: &[Expr]) -> Self {
        let needed = graph.reachable(outputs);
        let nodes = graph.nodes();
        let inside = graph.fused(outputs);
        let mut writer = Self {
            graph,
            needed,
            levels: graph.levels(),
            inside,
            last: vec![0; nodes.len()],
            place: vec![0; nodes.len()],
            written: vec![false; nodes.len()],
            free: Vec::new(),
            tape: Tape::default(),
        };
        for i in 0..nodes.len() {
            if writer.needed[i] && !writer.inside[i] {
                let Operands { all, count } = writer.operands(i);
                for operand in &all[..count] {
                    writer.last[operand.index()] = i;
                }
            }
        }
        for output in outputs {
            writer.last[output.index()] = usize::MAX;
        }
        writer
    }

    /// What the instruction of a node reads.
    fn operands(&self, i: usize) -> Operands {
        let mut operands = Operands::default();
        for operand in self.graph.nodes()[i].operands() {
            match self.inside[operand.index()] {
                true => operands.extend(self.graph.node(operand).operands()),
                false => operands.extend([operand]),
            }
        }
        operands
    }

    fn write(mut self, outputs: &[Expr]) -> Tape {
        let nodes = 0..self.graph.nodes().len();
        let needed: Vec<usize> = nodes.filter(|&i| self.needed[i]).collect();
        for &i in &needed {
            // What nothing is made of stands before the instructions, and stays.
            let node = self.graph.nodes()[i];
            if node.operands().next().is_none() {
                let place = self.another();
                self.place[i] = place;
                match node {
                    Node::Constant(bits) => {
                        self.tape.constants.push((place, f64::from_bits(bits)));
                    }
                    Node::Input(input) => self.tape.inputs.push((place, input)),
                    Node::Sign(choice) => self.tape.signs.push((place, choice.0)),
                    _ => {}
                }
            }
        }
        let partners = self.partners();
        for i in needed {
            if self.inside[i] {
                continue;
            }
            if !self.written[i] {
                self.instruction(i, &partners);
            }
            self.release(i);
        }
        self.tape.outputs = outputs.iter().map(|e| self.place[e.index()]).collect();
        self.tape
    }

    /// By angle, the nodes of its sine and cosine; by quartic, those of its roots.
    fn partners(&self) -> Partners {
        let mut partners = Partners::default();
        for (i, node) in self.graph.nodes().iter().enumerate() {
            if self.needed[i] && matches!(node, Node::Sin(_) | Node::Cos(_) | Node::TrigRoot(..)) {
                partners.entry(node.operand_slots()).or_default().push(i);
            }
        }
        partners
    }

    /// A place that was never used.
    fn another(&mut self) -> Place {
        self.tape.places += 1;
        Place::try_from(self.tape.places - 1).expect("an arm has fewer than 65,536 live values")
    }

    fn next(&mut self) -> Place {
        match self.free.pop() {
            Some(place) => place,
            None => self.another(),
        }
    }

    /// The places that a node was the last to read.
    fn release(&mut self, i: usize) {
        let Operands { all, count } = self.operands(i);
        let operands = &all.map(Expr::index)[..count];
        for (k, &operand) in operands.iter().enumerate() {
            let made = self.graph.nodes()[operand].operands().next().is_some();
            if made && self.last[operand] == i && !operands[..k].contains(&operand) {
                self.free.push(self.place[operand]);
            }
        }
    }

    fn instruction(&mut self, i: usize, partners: &Partners) {
        let node = self.graph.nodes()[i];
        let of = |writer: &Self, e: Expr| writer.place[e.index()];
        let instruction = match node {
            Node::Constant(_) | Node::Input(_) | Node::Sign(_) => return,
            Node::Sin(a) | Node::Cos(a) => {
                let input = match self.graph.node(a) {
                    Node::Input(input) => Some(input),
                    _ => None,
                };
                // Those of inputs come before all instructions.
                let both = match input {
                    Some(_) => [self.another(), self.another()],
                    None => [self.next(), self.next()],
                };
                for &partner in &partners[&[a; 5]] {
                    let which = matches!(self.graph.nodes()[partner], Node::Cos(_));
                    self.place[partner] = both[usize::from(which)];
                    self.written[partner] = true;
                }
                if let Some(input) = input {
                    self.tape.angles.push((both, input));
                    return;
                }
                Instruction::SinCos(both, of(self, a))
            }
            Node::TrigRoot(coefficients, _) => {
                let parts = [[(); 3]; 4].map(|part| part.map(|()| self.next()));
                for &partner in &partners[&coefficients] {
                    if let Node::TrigRoot(_, part) = self.graph.nodes()[partner] {
                        let field = match part.field {
                            RootField::Sin => 0,
                            RootField::Cos => 1,
                            RootField::State => 2,
                        };
                        self.place[partner] = parts[usize::from(part.place)][field];
                        self.written[partner] = true;
                    }
                }
                let coefficients = coefficients.map(|e| of(self, e));
                let number = self.tape.roots.len() as Place;
                self.tape.roots.push(Roots {
                    coefficients,
                    parts,
                });
                Instruction::Roots(number)
            }
            _ => {
                let to = self.next();
                self.place[i] = to;
                match node {
                    Node::Add(a, b) | Node::Sub(a, b) => {
                        let is_sum = matches!(node, Node::Add(..));
                        let Operands { all, count } = self.operands(i);
                        let places = all.map(|e| of(self, e));
                        let inside = [a, b].map(|e| self.inside[e.index()]);
                        match (inside, is_sum, &places[..count]) {
                            ([true, false], true, &[a, b, c])
                            | ([false, true], true, &[c, a, b]) => {
                                Instruction::ProductAdd(to, [a, b, c])
                            }
                            (_, true, &[a, b, c, d]) => Instruction::ProductsAdd(to, [a, b, c, d]),
                            ([true, _], false, &[a, b, c]) => {
                                Instruction::ProductSub(to, [a, b, c])
                            }
                            (_, false, &[a, b, c]) => Instruction::SubProduct(to, [a, b, c]),
                            (_, false, &[a, b, c, d]) => Instruction::ProductsSub(to, [a, b, c, d]),
                            (_, true, _) => Instruction::Add(to, [a, b].map(|e| of(self, e))),
                            (_, false, _) => Instruction::Sub(to, [a, b].map(|e| of(self, e))),
                        }
                    }
                    Node::Mul(a, b) => Instruction::Mul(to, [a, b].map(|e| of(self, e))),
                    Node::Div(a, b) => Instruction::Div(to, [a, b].map(|e| of(self, e))),
                    Node::Max(a, b) => Instruction::Max(to, [a, b].map(|e| of(self, e))),
                    Node::Atan2(y, x) if self.levels[i] == 0 => {
                        Instruction::OneAtan2(to, [y, x].map(|e| of(self, e)))
                    }
                    Node::Atan2(y, x) => Instruction::Atan2(to, [y, x].map(|e| of(self, e))),
                    Node::Sqrt(a) => Instruction::Sqrt(to, of(self, a)),
                    Node::Wrap(a) => Instruction::Wrap(to, of(self, a)),
                    Node::Select(all) => Instruction::Select(to, all.map(|e| of(self, e))),
                    Node::Neg(a) => Instruction::Neg(to, of(self, a)),
                    _ => return,
                }
            }
        };
        self.tape.instructions.push(instruction);
    }
}

/// Nodes by what they are of.
type Partners = NodeMap<[Expr; 5], Vec<usize>>;

#[cfg(test)]
mod tests {
    use super::*;

    /// By the interpreter of single lanes, bit by bit.
    #[test]
    fn every_lane_is_what_the_interpreter_has() {
        let mut g = Graph::new();
        let [x, y] = ["x", "y"].map(|name| g.input(name));
        let (sin, cos) = g.sin_cos(x);
        let (first, second) = (g.sign(), g.sign());
        let root = g.sqrt(y);
        let root = g.mul(first, root);
        let sum = g.add(sin, root);
        let limited = g.max(sum, cos);
        let quotient = g.div(limited, y);
        let other = g.mul(second, quotient);
        let angle = g.atan2(other, sum);
        let wrapped = g.wrap(angle);
        let less = g.select_less(wrapped, cos, root, other);
        let minus = g.neg(less);
        let [product, another, third] = [[sin, y], [cos, less], [y, y]].map(|[a, b]| g.mul(a, b));
        let sums = [
            g.add(product, angle),
            g.sub(another, angle),
            g.sub(angle, third),
        ];
        let [fourth, fifth] = [[sums[0], y], [sums[1], cos]].map(|[a, b]| g.mul(a, b));
        let both = g.add(fourth, fifth);
        let [sixth, seventh] = [[both, y], [sums[2], cos]].map(|[a, b]| g.mul(a, b));
        let apart = g.sub(sixth, seventh);
        let outputs = [less, angle, minus, sin, y, first, both, apart];
        let tape = Tape::new(&g, &outputs);
        let inputs = [0.7, 2.3];
        let four = tape.run::<4>(&inputs, 0);
        let rest = tape.run::<2>(&inputs, 2);
        // Beside other inputs.
        let beside = tape.run_each::<8, 2>([&[-0.4, 1.9], &inputs], 0);
        for lane in 0..4 {
            let mut values = Vec::new();
            g.evaluate(&inputs, lane, &mut values);
            for (number, output) in outputs.iter().enumerate() {
                let expected = values[output.index()].to_bits();
                assert_eq!(four.output(number)[lane as usize].to_bits(), expected);
                assert_eq!(beside.output(number)[lane as usize + 4].to_bits(), expected);
                if lane >= 2 {
                    assert_eq!(rest.output(number)[lane as usize - 2].to_bits(), expected);
                }
            }
        }
        // Places are used again.
        assert!(tape.places < g.nodes().len(), "{}", tape.places);
    }

    #[test]
    fn products_are_fused_where_the_processor_can_and_reproducibly_nowhere() {
        let mut g = Graph::new();
        let [a, b, c] = ["a", "b", "c"].map(|name| g.input(name));
        let product = g.mul(a, b);
        let sum = g.add(product, c);
        let tape = Tape::new(&g, &[sum]).fusing(Fusing::Lanes);
        let small = f64::EPSILON;
        let run = || {
            tape.run::<4>(&[1.0 + small, 1.0 - small, -1.0], 0)
                .output(0)[3]
        };
        #[cfg(target_arch = "x86_64")]
        let can = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
        #[cfg(not(target_arch = "x86_64"))]
        let can = cfg!(target_arch = "aarch64");
        assert_eq!(run(), if can { -small * small } else { 0.0 });
        assert_eq!(reproducible::reproducibly(run), 0.0);
    }
}
