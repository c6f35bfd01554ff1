//! The constants of an elimination: what vanishes on one side of the loop.

use super::order::order;
use super::turning::turns;
use kin_runtime::__private::Span;
use kin_runtime::__private::univariate::{ENTRIES, Elimination, Z_AXIS, moved, turned_back};
use kin_runtime::Pose;

/// The lines that two joints make of a third axis span so many dimensions.
const NEAR_SIDE: usize = 9;
/// What vanishes on them.
const FUNCTIONALS: usize = ENTRIES - NEAR_SIDE;
/// Below this, relative to the longest, a line adds nothing to the others.
const DEPENDENT: f64 = 1e-9;

type Functional = [f64; ENTRIES];

/// The elimination that keeps a joint, from 0; none where two joints do not move
/// the axis behind them in nine independent ways.
///
/// The first three joints are kept on the way from base to tip, the others on the
/// way back, so that the target never stands between the three.
pub fn eliminate(frames: &[Pose; 7], kept: usize) -> Option<Elimination> {
    let backwards = kept >= 3;
    let joints: [usize; 6] = std::array::from_fn(|i| match backwards {
        false => (kept + i) % 6,
        true => (kept + 6 - i) % 6,
    });
    let behind = |i: usize| match backwards {
        false => frames[joints[i] + 1],
        true => frames[joints[i]].inverse(),
    };
    let near_side = near_side([behind(0), behind(1), behind(2)]);
    let column = |j: usize| near_side.map(|entry| entry[j]);
    let span = Span::of(NEAR_SIDE, column, DEPENDENT);
    if span.rank < NEAR_SIDE {
        return None;
    }
    let vanishing: Vec<Functional> = span.complement().collect();
    let (functionals, half) = split(&vanishing);
    let mut elimination = Elimination {
        joints: joints.map(|joint| joint as u8),
        backwards,
        degree: 0,
        functionals,
        half: half as u8,
        pair: pair(&span),
        rows: [[0; 2]; 16],
        columns: std::array::from_fn(|i| i as u8),
    };
    order(&mut elimination, frames)?;
    Some(elimination)
}

/// The line of the fourth joint as the two before it move it, in the frame of the
/// kept one: the coefficients of (1, cos, sin) of the second times those of the
/// third, which change fastest.
fn near_side([first, second, third]: [Pose; 3]) -> [[f64; NEAR_SIDE]; ENTRIES] {
    let line = moved(&third, &Z_AXIS.map(|x| [x]));
    let lines = moved(&second, &turned::<1, 3>(&line));
    moved(&first, &turned::<3, 9>(&lines))
}

/// As [`turned_back`], the other way round.
fn turned<const A: usize, const B: usize>(lines: &[[f64; A]; ENTRIES]) -> [[f64; B]; ENTRIES] {
    let mut out = turned_back(lines);
    out.iter_mut()
        .flat_map(|entry| &mut entry[2 * A..])
        .for_each(|x| *x = -*x);
    out
}

/// The functionals that give the cosine and sine of the second joint, and of the
/// third.
fn pair(span: &Span<ENTRIES>) -> [Functional; 4] {
    let mut inverse = [[0.0; ENTRIES]; NEAR_SIDE];
    for i in 0..ENTRIES {
        let unit = std::array::from_fn(|j| f64::from(u8::from(i == j)));
        span.coordinates(unit, |j, x| inverse[j][i] = x);
    }
    [3, 6, 1, 2].map(|j| inverse[j])
}

/// The functionals again, those first for which half the kept joint's angle is
/// enough, and how many these are.
///
/// About the kept axis a line has parts that turn with e^{iθ}, with e^{−iθ} and
/// not at all. Six functionals have four combinations at most that see the second
/// part, so that two at least, and their conjugates, are u + v e^{iθ}: times
/// e^{−iθ/2}, linear in cos θ/2 and sin θ/2.
fn split(vanishing: &[Functional]) -> ([Functional; FUNCTIONALS], usize) {
    let turning = |v: usize, i: usize| -> Weights { array(|j| vanishing[j][v + i]) };
    let pairs = [0, 3, 6, 9].map(|v| [turning(v, 0), turning(v, 1)]);
    let flat = flat(&pairs);
    let half = unseen(&pairs, &flat);
    let mut taken: Vec<Weights> = flat.clone();
    taken.extend(half.iter().flatten());
    let full: Vec<Weights> = Span::of(taken.len(), |j| taken[j], SEEN)
        .complement()
        .collect();
    let combined = |weights: &Weights| -> Functional {
        array(|i| (0..FUNCTIONALS).map(|j| weights[j] * vanishing[j][i]).sum())
    };
    let mut rows: Vec<Functional> = half.iter().flatten().map(combined).collect();
    rows.extend(
        flat.iter()
            .map(|weights| without_turning(combined(weights))),
    );
    rows.extend(full.iter().map(combined));
    (array(|i| rows[i]), 2 * half.len())
}

fn without_turning(functional: Functional) -> Functional {
    array(|i| if turns(i) { 0.0 } else { functional[i] })
}

/// What a functional sees of a line's parts that turn, below this, is rounding.
const SEEN: f64 = 1e-10;

/// How much of each vanishing functional.
type Weights = [f64; FUNCTIONALS];

fn array<T, const N: usize>(of: impl FnMut(usize) -> T) -> [T; N] {
    std::array::from_fn(of)
}

/// The combinations that see nothing that turns: their equations are the same for
/// all values of the kept joint.
fn flat(pairs: &[[Weights; 2]; 4]) -> Vec<Weights> {
    let seen = pairs.as_flattened();
    Span::of(seen.len(), |j| seen[j], SEEN)
        .complement()
        .collect()
}

/// The complex combinations a + ib that do not see what turns with e^{−iθ}, at right
/// angles to the flat ones and to each other.
fn unseen(pairs: &[[Weights; 2]; 4], flat: &[Weights]) -> Vec<[Weights; 2]> {
    type Complex = [f64; 2 * FUNCTIONALS];
    let complex = |a: &Weights, b: &Weights| -> Complex {
        array(|j| {
            if j < FUNCTIONALS {
                a[j]
            } else {
                b[j - FUNCTIONALS]
            }
        })
    };
    let mut taken: Vec<Complex> = Vec::new();
    for [x, y] in pairs {
        taken.extend([complex(x, y), complex(&y.map(|y| -y), x)]);
    }
    for flat in flat {
        taken.extend([
            complex(flat, &[0.0; FUNCTIONALS]),
            complex(&[0.0; FUNCTIONALS], flat),
        ]);
    }
    let mut found = Vec::new();
    loop {
        let span = Span::of(taken.len(), |j| taken[j], SEEN);
        let Some(next) = span.complement().next() else {
            return found;
        };
        let (a, b) = (array(|j| next[j]), array(|j| next[j + FUNCTIONALS]));
        taken.extend([next, complex(&b.map(|b| -b), &a)]);
        found.push([a, b]);
    }
}
