//! The constants of an elimination: what vanishes on one side of the loop.

use super::fold::fold;
use super::frames::Family;
use super::order::orders;
use super::turning::turns;
use kin_runtime::__private::Span;
use kin_runtime::__private::univariate::{
    ENTRIES, Elimination, FUNCTIONALS, Z_AXIS, gone_back, moved,
};
use kin_runtime::Pose;

/// The lines that two joints make of a third axis span so many dimensions.
const NEAR_SIDE: usize = 9;
/// Two turns whose links are a pair of Bennett's linkage.
const BENNETT: usize = 7;
/// Two slides move it along a plane.
const TWO_SLIDES: usize = 6;
/// So many functionals vanish on nine.
const SIX: usize = ENTRIES - NEAR_SIDE;
/// So many of their combinations see what turns with e^{−iθ}.
const SEEING: usize = 4;
/// Below this, relative to the longest, a line adds nothing to the others.
const DEPENDENT: f64 = 1e-9;

type Functional = [f64; ENTRIES];

/// The eliminations that keep a joint, from 0; none where two joints do not move
/// the axis behind them in nine independent ways, or as joints do that are given, or where the
/// joint or that axis slides. A joint that is given may stand between the kept one and those two,
/// unless they or others slide.
///
/// The first three joints are kept on the way from base to tip, the others on the
/// way back, so that the target never stands between the three.
pub fn eliminate(family: &Family, kept: usize) -> Vec<Elimination> {
    let frames = &family.frames;
    let backwards = kept >= 3;
    let joints: [usize; 6] = std::array::from_fn(|i| match backwards {
        false => (kept + i) % 6,
        true => (kept + 6 - i) % 6,
    });
    let behind = |i: usize| match backwards {
        false => frames.fixed[joints[i] + 1],
        true => frames.fixed[joints[i]].inverse(),
    };
    let is_moved = |i: usize| family.moves(joints[i] + usize::from(!backwards));
    let slides = joints.map(|joint| frames.slides(joint));
    let has_given = is_moved(0);
    if slides[0] || slides[3] || (1..3).any(is_moved) || has_given && frames.prismatic != 0 {
        return Vec::new();
    }
    let first = if has_given { Pose::IDENTITY } else { behind(0) };
    let near_side = near_side([first, behind(1), behind(2)], [slides[1], slides[2]]);
    let column = |j: usize| near_side.map(|entry| entry[j]);
    let span = Span::of(NEAR_SIDE, column, DEPENDENT);
    let vanishing: Vec<Functional> = span.complement().collect();
    let near_slides = slides[1] || slides[2];
    let (functionals, half) = match (span.rank, near_slides && (slides[4] || slides[5])) {
        (NEAR_SIDE, _) if has_given => (vanishing, 2 * (SIX - SEEING)),
        _ if has_given => return Vec::new(),
        (NEAR_SIDE, false) => split::<6, 12>(&vanishing),
        (NEAR_SIDE, true) => split_by_square(&vanishing),
        (BENNETT, _) if !near_slides => split::<8, 16>(&vanishing),
        (TWO_SLIDES, _) if slides[1] && slides[2] => split::<9, 18>(&vanishing),
        _ => return Vec::new(),
    };
    let mut elimination = Elimination {
        joints: joints.map(|joint| joint as u8),
        backwards,
        degree: 0,
        moved: has_given,
        functionals: array(|i| functionals.get(i).copied().unwrap_or_default()),
        half: half.min(FUNCTIONALS) as u8,
        third: third(&span),
        fold: None,
        powers: [3, 3],
        rows: [[0; 2]; 16],
        columns: std::array::from_fn(|i| i as u8),
    };
    if !has_given && !family.moves(kept + usize::from(backwards)) {
        elimination.fold = fold(&elimination, frames);
    }
    orders(&elimination, &family.sampled())
}

/// The line of the fourth joint as the two before it move it, in the frame of the
/// kept one: the coefficients of (1, cos, sin) of the second, or (1, d, d²) where it slides,
/// times those of the third, which change fastest.
fn near_side([first, second, third]: [Pose; 3], slides: [bool; 2]) -> [[f64; NEAR_SIDE]; ENTRIES] {
    let line = moved(&third, &Z_AXIS.map(|x| [x]));
    let lines = moved(&second, &gone::<1, 3>(slides[1], &line));
    moved(&first, &gone::<3, 9>(slides[0], &lines))
}

/// As [`gone_back`], the other way round: what is odd in the joint changes its sign.
fn gone<const A: usize, const B: usize>(
    slides: bool,
    lines: &[[f64; A]; ENTRIES],
) -> [[f64; B]; ENTRIES] {
    let mut out = gone_back(slides, lines);
    let odd = if slides { A..2 * A } else { 2 * A..3 * A };
    out.iter_mut()
        .flat_map(|entry| &mut entry[odd.clone()])
        .for_each(|x| *x = -*x);
    out
}

/// The functionals that give the cosine and sine of the third joint; of a slide, itself and its
/// square.
fn third(span: &Span<ENTRIES>) -> [Functional; 2] {
    let mut inverse = [[0.0; ENTRIES]; NEAR_SIDE];
    for i in 0..ENTRIES {
        let unit = std::array::from_fn(|j| f64::from(u8::from(i == j)));
        span.coordinates(unit, |j, x| inverse[j][i] = x);
    }
    [1, 2].map(|j| inverse[j])
}

/// Combinations of functionals, those first for which half the kept joint's angle is
/// enough, and how many these are; `M` is twice `N`.
///
/// About the kept axis a line has parts that turn with e^{iθ}, with e^{−iθ} and
/// not at all. Six functionals have four combinations at most that see the second
/// part, so that two at least, and their conjugates, are u + v e^{iθ}: times
/// e^{−iθ/2}, linear in cos θ/2 and sin θ/2.
fn split<const N: usize, const M: usize>(vanishing: &[Functional]) -> (Vec<Functional>, usize) {
    let turning = |v: usize, i: usize| -> [f64; N] { array(|j| vanishing[j][v + i]) };
    let pairs = [0, 3, 6, 9].map(|v| [turning(v, 0), turning(v, 1)]);
    let flat = flat(&pairs);
    let half = unseen::<N, M>(&pairs, &flat);
    let mut taken: Vec<[f64; N]> = flat.clone();
    taken.extend(half.iter().flatten());
    let full: Vec<[f64; N]> = Span::of(taken.len(), |j| taken[j], SEEN)
        .complement()
        .collect();
    let combined = |weights: &[f64; N]| combination(weights, vanishing);
    let mut rows: Vec<Functional> = half.iter().flatten().map(combined).collect();
    rows.extend(
        flat.iter()
            .map(|weights| without_turning(combined(weights))),
    );
    rows.extend(full.iter().map(combined));
    (rows, 2 * half.len())
}

/// The six again, the one last that sees the square of a slide on the other side: with a
/// slide on this side too, the others do not. Where these slides are nearly dependent on other
/// joints, rounding does not tell them apart, and none is last.
fn split_by_square(vanishing: &[Functional]) -> (Vec<Functional>, usize) {
    const BLIND: usize = SIX - 1;
    let seen = |i: usize| -> [f64; SIX] { array(|j| vanishing[j][i]) };
    let sees = Span::of(4, |i| seen(9 + i), SEEN);
    let blind: Vec<[f64; SIX]> = sees.complement().take(BLIND).collect();
    if blind.len() < BLIND {
        return split::<6, 12>(vanishing);
    }
    let combined = |weights: &[f64; SIX]| combination(weights, vanishing);
    let without: Vec<_> = blind
        .iter()
        .map(|it| without_square(combined(it)))
        .collect();
    let (mut rows, half) = split::<BLIND, { 2 * BLIND }>(&without);
    let last = Span::of(BLIND, |j| blind[j], SEEN);
    rows.extend(last.complement().map(|weights| combined(&weights)));
    (rows, half)
}

fn combination(weights: &[f64], functionals: &[Functional]) -> Functional {
    let all = || weights.iter().zip(functionals);
    array(|i| {
        all()
            .map(|(weight, functional)| weight * functional[i])
            .sum()
    })
}

fn without_turning(functional: Functional) -> Functional {
    array(|i| if turns(i) { 0.0 } else { functional[i] })
}

/// Without n and p·p, which alone see the square of a slide.
fn without_square(functional: Functional) -> Functional {
    array(|i| {
        if (9..13).contains(&i) {
            0.0
        } else {
            functional[i]
        }
    })
}

/// What a functional sees of a line's parts that turn, below this, is rounding.
const SEEN: f64 = 1e-10;

fn array<T, const N: usize>(of: impl FnMut(usize) -> T) -> [T; N] {
    std::array::from_fn(of)
}

/// The combinations that see nothing that turns: their equations are the same for
/// all values of the kept joint.
fn flat<const N: usize>(pairs: &[[[f64; N]; 2]; 4]) -> Vec<[f64; N]> {
    let seen = pairs.as_flattened();
    Span::of(seen.len(), |j| seen[j], SEEN)
        .complement()
        .collect()
}

/// The complex combinations a + ib that do not see what turns with e^{−iθ}, at right
/// angles to the flat ones and to each other.
fn unseen<const N: usize, const M: usize>(
    pairs: &[[[f64; N]; 2]; 4],
    flat: &[[f64; N]],
) -> Vec<[[f64; N]; 2]> {
    let complex =
        |a: &[f64; N], b: &[f64; N]| -> [f64; M] { array(|j| if j < N { a[j] } else { b[j - N] }) };
    let mut taken: Vec<[f64; M]> = Vec::new();
    for [x, y] in pairs {
        taken.extend([complex(x, y), complex(&y.map(|y| -y), x)]);
    }
    for flat in flat {
        taken.extend([complex(flat, &[0.0; N]), complex(&[0.0; N], flat)]);
    }
    let mut found = Vec::new();
    loop {
        let span = Span::of(taken.len(), |j| taken[j], SEEN);
        let Some(next) = span.complement().next() else {
            return found;
        };
        let (a, b) = (array(|j| next[j]), array(|j| next[j + N]));
        taken.extend([next, complex(&b.map(|b| -b), &a)]);
        found.push([a, b]);
    }
}
