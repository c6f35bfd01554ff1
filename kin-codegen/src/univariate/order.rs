//! Which equations become rows of the matrix, and in which order rows and columns
//! are eliminated.

use kin_runtime::__private::univariate::{EQUATIONS, Elimination, Frames};

use super::turning::turns;
use crate::random::Random;
use std::f64::consts::PI;

/// Targets and angles at which pivots are looked at.
const SAMPLES: usize = 24;
/// Rows whose pivots would be below this depend on those taken.
const DEPENDENT: f64 = 1e-6;
/// Of an arm that has its relations nearly, rows vanish with them: without those whose pivots are
/// below this there is less noise, but a higher degree, and with it roots that are no solutions.
const WEAK: f64 = 1e-2;
const SIZE: usize = 16;
/// What a functional costs that sees all that turns.
const FULL: usize = 2;

/// Coefficients below this are rounding.
const ROUNDING: f64 = 1e-11;

/// A candidate row: which functional, and times which half tangents; behind the functionals,
/// which monomial alone.
type Row = [u8; 2];

/// The monomials that are there, by power of the last joint and of the last but one, and up to
/// which powers there are all.
struct Monomials {
    has: fn(usize, usize) -> bool,
    powers: [u8; 2],
}

/// Chooses rows and columns by elimination at sample targets of arms that differ in what the
/// functionals do not depend on: next is always the
/// pivot that is largest on the average, of the functionals that raise the degree
/// least.
///
/// The high powers of slides have solutions at infinity: with two slides there are not rows
/// enough for all monomials, but for fewer of them, of which some sets tell more than others.
pub fn orders(elimination: &Elimination, samples: &[Frames]) -> Vec<Elimination> {
    let frames = &samples[0];
    let [before, last] = [4, 5].map(|i| frames.slides(elimination.joints[i].into()));
    let set = |has, powers| Monomials { has, powers };
    let mut sets = vec![set(|_, _| true, [3, 3])];
    sets.extend(match (before, last) {
        (false, false) => Vec::new(),
        (false, true) => vec![set(|i, _| i < 3, [2, 3]), set(|i, _| i < 2, [1, 3])],
        (true, false) => vec![set(|_, j| j < 3, [3, 2]), set(|_, j| j < 2, [3, 1])],
        (true, true) => vec![
            set(|i, j| i + j < 3, [1, 1]),
            set(|i, j| i + j < 4, [2, 1]),
            set(|i, j| i + j < 5, [2, 2]),
        ],
    });
    let of = |set: Monomials| {
        let with = |least: f64| {
            let mut elimination = Elimination {
                powers: set.powers,
                ..*elimination
            };
            order(&mut elimination, samples, set.has, least).map(|()| elimination)
        };
        let mut both: Vec<Elimination> = [WEAK, DEPENDENT].into_iter().filter_map(with).collect();
        both.dedup();
        both
    };
    sets.into_iter().flat_map(of).collect()
}

/// The same for a set of monomials; a row that raises the degree less than others do has a pivot of
/// this size at least.
fn order(
    elimination: &mut Elimination,
    arms: &[Frames],
    has: fn(usize, usize) -> bool,
    least: f64,
) -> Option<()> {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let missing = (0..SIZE as u8).filter(|&c| !has(usize::from(c % 4), usize::from(c / 4)));
    let missing: Vec<u8> = missing.collect();
    let mut candidates: Vec<Row> = (0..EQUATIONS as u8 - 1)
        .flat_map(|f| (0..4).map(move |shift| [f, shift]))
        .collect();
    let sees_missing = |row: &Row| {
        let frames = &arms[0];
        let target = frames.forward(&[0.4, -1.1, 0.7, 1.9, -0.6, 1.3]);
        let row = spread(&elimination.coefficients(frames, &target, 0.9), *row);
        missing
            .iter()
            .any(|&c| row[usize::from(c)].abs() > ROUNDING)
    };
    candidates.retain(|row| !sees_missing(row));
    candidates.extend(missing.iter().map(|&c| [EQUATIONS as u8 - 1, c]));
    let arms = arms.iter().cycle().take(SAMPLES);
    let samples: Vec<Vec<[f64; SIZE]>> = arms
        .map(|frames| {
            let q = std::array::from_fn(|_| random.between(-PI, PI));
            let kept = random.between(-PI, PI);
            let equations = elimination.coefficients(frames, &frames.forward(&q), kept);
            candidates
                .iter()
                .map(|&row| spread(&equations, row))
                .collect()
        })
        .collect();
    let costs = candidates
        .iter()
        .map(|&[functional, _]| cost(elimination, functional.into()));
    let costs: Vec<usize> = costs.collect();
    let halves =
        |(rows, _): &(Vec<usize>, Vec<usize>)| rows.iter().filter(|&&row| costs[row] == 1).count();
    let pivots = |most_half: usize| {
        let order = Order {
            candidates: &candidates,
            costs: &costs,
            samples: samples.clone(),
            most_half,
            least,
            rows: Vec::new(),
            columns: Vec::new(),
        };
        order.run()
    };
    let mut chosen = pivots(SIZE)?;
    // With an odd number of them the determinant would change its sign in a turn.
    if halves(&chosen) % 2 == 1 {
        chosen = pivots(halves(&chosen) - 1)?;
    }
    let (rows, columns) = chosen;
    elimination.degree = (rows.iter().map(|&row| costs[row]).sum::<usize>() / 2) as u8;
    for (place, row) in rows.into_iter().enumerate() {
        elimination.rows[place] = candidates[row];
    }
    for (place, column) in columns.into_iter().enumerate() {
        elimination.columns[column] = place as u8;
    }
    Some(())
}

/// By how many halves a functional raises the degree.
fn cost(elimination: &Elimination, functional: usize) -> usize {
    let Some(functional_of) = elimination.functionals.get(functional) else {
        return 0;
    };
    let mut entries = functional_of.iter().enumerate();
    let turns = entries.any(|(i, x)| turns(i) && *x != 0.0);
    match (functional < usize::from(elimination.half), turns) {
        (true, _) => 1,
        (false, false) => 0,
        (false, true) => FULL,
    }
}

/// A row of the matrix: the coefficients of an equation, shifted by the half
/// tangents that it is multiplied by.
fn spread(equations: &[[f64; 9]; EQUATIONS], [functional, shift]: Row) -> [f64; SIZE] {
    let mut out = [0.0; SIZE];
    if usize::from(functional) == EQUATIONS - 1 {
        out[usize::from(shift)] = 1.0;
        return out;
    }
    let (i0, j0) = (usize::from(shift & 1), usize::from(shift >> 1));
    for (k, x) in equations[usize::from(functional)].iter().enumerate() {
        out[k / 3 + i0 + 4 * (k % 3 + j0)] = *x;
    }
    out
}

/// The power of the last joint.
fn power(monomial: usize) -> usize {
    monomial % 4
}

/// The order of elimination: the pivots so far, and what is left of the samples.
struct Order<'a> {
    candidates: &'a [Row],
    costs: &'a [usize],
    samples: Vec<Vec<[f64; SIZE]>>,
    /// So many rows of half angles are allowed.
    most_half: usize,
    /// What the pivots of rows are at least that raise the degree less than others.
    least: f64,
    rows: Vec<usize>,
    columns: Vec<usize>,
}

impl Order<'_> {
    /// First the monomials that only rows have which are not multiplied by the last
    /// joint's half tangent, then those that only the others have, then the rest: four,
    /// four and eight pivots. None where fewer than sixteen rows are independent.
    fn run(mut self) -> Option<(Vec<usize>, Vec<usize>)> {
        let shifted = |[functional, by]: Row| match usize::from(functional) + 1 == EQUATIONS {
            true => power(by.into()) == 3,
            false => by & 1 == 1,
        };
        for _ in 0..4 {
            self.next(|row| !shifted(row), |column| power(column) == 0)?;
        }
        for _ in 0..4 {
            self.next(shifted, |column| power(column) == 3)?;
        }
        for _ in 0..8 {
            self.next(|_| true, |column| matches!(power(column), 1 | 2))?;
        }
        Some((self.rows, self.columns))
    }

    /// Takes the largest pivot of the rows that raise the degree least.
    fn next(&mut self, rows: impl Fn(Row) -> bool, columns: impl Fn(usize) -> bool) -> Option<()> {
        let halves = self
            .rows
            .iter()
            .filter(|&&row| self.costs[row] == 1)
            .count();
        let allowed = [0, 1, 2]
            .into_iter()
            .filter(|&cost| cost != 1 || halves < self.most_half);
        let columns: Vec<usize> = (0..SIZE)
            .filter(|column| columns(*column) && !self.columns.contains(column))
            .collect();
        let (row, column) = allowed
            .filter_map(|cost| {
                let least = if cost < FULL { self.least } else { DEPENDENT };
                let open = (0..self.costs.len()).filter(|row| {
                    self.costs[*row] == cost
                        && rows(self.candidates[*row])
                        && !self.rows.contains(row)
                });
                largest(&self.samples, open, &columns, least)
            })
            .next()?;
        for m in &mut self.samples {
            let pivot = m[row];
            for other in (0..m.len()).filter(|other| *other != row && !self.rows.contains(other)) {
                let factor = m[other][column] / pivot[column];
                for (x, p) in m[other].iter_mut().zip(&pivot) {
                    *x -= factor * p;
                }
                m[other][column] = 0.0;
            }
        }
        self.rows.push(row);
        self.columns.push(column);
        Some(())
    }
}

/// The pivot whose logarithm is largest on the average; none where it is rounding.
fn largest(
    samples: &[Vec<[f64; SIZE]>],
    rows: impl Iterator<Item = usize>,
    columns: &[usize],
    least: f64,
) -> Option<(usize, usize)> {
    let mut best = (least.ln(), None);
    for row in rows {
        for &column in columns {
            let size = |m: &Vec<[f64; SIZE]>| (m[row][column].abs() + f64::MIN_POSITIVE).ln();
            let mean = samples.iter().map(size).sum::<f64>() / samples.len() as f64;
            if mean > best.0 {
                best = (mean, Some((row, column)));
            }
        }
    }
    best.1
}
