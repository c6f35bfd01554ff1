//! What moving signs outwards leaves as it is: the value of every branch.

use super::*;
use crate::expr::inverse::Parts;
use crate::expr::tape::Tape;
use crate::random::Random;

/// Two that share a loop, and three that are moved.
const CHOICES: u32 = 5;
const INPUTS: usize = 4;

/// A graph with inputs and choices, and these.
fn leaves() -> (Graph, Vec<Expr>, Vec<Expr>) {
    let mut g = Graph::new();
    let inputs = (0..INPUTS).map(|i| g.input(format!("x{i}"))).collect();
    let signs = (0..CHOICES).map(|_| g.sign()).collect();
    (g, inputs, signs)
}

fn inverse(mut g: Graph, q: Vec<Expr>, invalid: Option<Expr>) -> InverseGraph {
    let zero = g.zero();
    InverseGraph {
        graph: g,
        q,
        residual: zero,
        invalid: invalid.unwrap_or(zero),
        singular: zero,
        margin: None,
        arguments: None,
        residual_share: 1.0,
        free_joints: Vec::new(),
        parts: Parts::default(),
        tape: Tape::default(),
    }
}

/// Numbers for inputs; round ones make terms equal and sums zero.
fn numbers(random: &mut Random) -> Vec<[f64; INPUTS]> {
    let mut number = |round: usize| match round % 3 {
        0 => random.between(-2.0, 2.0),
        1 => [-1.0, -0.5, 0.5, 1.0][random.below(4)],
        _ => 1e-9 * random.between(-2.0, 2.0),
    };
    (0..24)
        .map(|round| std::array::from_fn(|_| number(round)))
        .collect()
}

/// Asserts that every result has in every branch that exists the value that it had, where
/// `same` is asked about the two.
fn keeps_values(before: &InverseGraph, numbers: &[[f64; INPUTS]], same: impl Fn(f64, f64) -> bool) {
    let after = signs_outwards(before);
    assert_eq!(after.graph.choices(), before.graph.choices());
    let (mut old, mut new) = (Vec::new(), Vec::new());
    for inputs in numbers {
        for lane in 0..1 << CHOICES {
            before.graph.evaluate(inputs, lane, &mut old);
            after.graph.evaluate(inputs, lane, &mut new);
            let refused = old[before.invalid.index()];
            assert_eq!(refused, new[after.invalid.index()]);
            for (a, b) in before.q.iter().zip(&after.q).filter(|_| refused <= 0.0) {
                let (a, b) = (old[a.index()], new[b.index()]);
                assert!(same(a, b), "{b} for {a} in branch {lane} at {inputs:?}");
            }
        }
    }
}

/// A random product of some of the signs.
fn product(g: &mut Graph, signs: &[Expr], random: &mut Random) -> Expr {
    let one = g.one();
    let chosen: Vec<Expr> = (signs.iter().copied())
        .filter(|_| random.below(2) == 0)
        .collect();
    chosen.into_iter().fold(one, |a, b| g.mul(a, b))
}

/// Without a rounding more or less, and so to the last bit, but for the sign of zero.
#[test]
fn what_is_computed_keeps_its_value_to_the_last_bit() {
    let mut random = Random(7);
    for _ in 0..400 {
        let (mut g, inputs, signs) = leaves();
        let signed = signs.iter().zip(inputs.iter().cycle());
        let signed: Vec<Expr> = signed.map(|(&sign, &input)| g.mul(sign, input)).collect();
        let mut known = [inputs, signed].concat();
        for _ in 0..24 {
            let mut any = || known[random.below(known.len() as u64)];
            let [a, b, x, y] = [any(), any(), any(), any()];
            let next = match random.below(8) {
                0 => g.add(a, b),
                1 => g.sub(a, b),
                2 | 3 => g.mul(a, b),
                4 => g.neg(a),
                5 => g.max(a, b),
                6 => {
                    let square = g.square(a);
                    g.sqrt(square)
                }
                _ => g.select_less(a, b, x, y),
            };
            known.push(next);
        }
        let results = known.split_off(known.len() - 8);
        keeps_values(&inverse(g, results, None), &numbers(&mut random), |a, b| {
            a == b
        });
    }
}

/// The angle of a vector whose components have signs, of early choices and of late ones.
#[test]
fn angles_keep_their_values() {
    let near = |a: f64, b: f64| {
        let turned = (a - b).abs();
        let turned = turned.min((turned - 2.0 * PI).abs());
        turned < 1e-15 && -PI < b && b <= PI
    };
    let mut random = Random(8);
    for _ in 0..200 {
        let (mut g, inputs, signs) = leaves();
        let inner = product(&mut g, &signs[..3], &mut random);
        let three = g.constant(3.0);
        let shifted = g.add(three, inner);
        let even = g.mul(shifted, inputs[0]);
        let (sine, cosine) = g.sin_cos(even);
        let [y, x] = [sine, cosine].map(|even| {
            let outer = product(&mut g, &signs, &mut random);
            g.mul(outer, even)
        });
        let angle = g.atan2(y, x);
        keeps_values(&inverse(g, vec![angle], None), &numbers(&mut random), near);
    }
}

/// Along the axes, where an angle is at an end of its interval or zero.
#[test]
fn angles_along_the_axes_keep_their_values() {
    let mut random = Random(9);
    let axes = [[0.0, 1.0], [0.0, -1.0], [1.0, 0.0], [-1.0, 0.0]].map(|[y, x]| [y, x, 0.0, 0.0]);
    for _ in 0..100 {
        let (mut g, inputs, signs) = leaves();
        let [y, x] = [0, 1].map(|i| {
            let sign = product(&mut g, &signs, &mut random);
            g.mul(sign, inputs[i])
        });
        let angle = g.atan2(y, x);
        keeps_values(&inverse(g, vec![angle], None), &axes, |a, b| a == b);
    }
}

/// A vector that is its seed's where it is too short, and the − of the choice is refused: there
/// it may be anything, elsewhere nothing but itself.
#[test]
fn what_is_not_refused_keeps_its_value_beside_a_seed() {
    for refused in [2, 3] {
        let (mut g, inputs, signs) = leaves();
        let [zero, bound] = [0.0, 0.3].map(|x| g.constant(x));
        let negated = g.neg(signs[refused]);
        let invalid = g.select_less(inputs[0], bound, negated, zero);
        let results = [(inputs[1], inputs[2]), (inputs[2], inputs[3])].map(|(seed, root)| {
            let root = g.mul(signs[2], root);
            g.select_less(inputs[0], bound, seed, root)
        });
        let inverse = inverse(g, results.to_vec(), Some(invalid));
        keeps_values(&inverse, &numbers(&mut Random(10)), |a, b| a == b);
    }
}

/// The purpose of it: both signs of a wrist have one arctangent.
#[test]
fn what_both_signs_share_is_in_front_of_the_choice() {
    let (mut g, inputs, signs) = leaves();
    let flipped = [0, 1].map(|i| g.mul(signs[2], inputs[i]));
    let angles = vec![
        g.atan2(flipped[0], flipped[1]),
        g.atan2(flipped[0], inputs[2]),
    ];
    let after = signs_outwards(&inverse(g, angles, None)).graph;
    let levels = after.levels();
    let arctangents = after.nodes().iter().zip(levels);
    let arctangents = arctangents.filter(|(node, _)| matches!(node, Node::Atan2(..)));
    assert_eq!(
        arctangents.map(|(_, level)| level).collect::<Vec<_>>(),
        [0, 0]
    );
}
