//! Which equations become rows of the matrix, and in which order rows and columns
//! are eliminated.

use kin_runtime::__private::univariate::Elimination;
use kin_runtime::Pose;

use super::frames::forward;
use super::turning::turns;
use crate::random::Random;
use std::f64::consts::PI;

/// Targets and angles at which pivots are looked at.
const SAMPLES: usize = 24;
/// Rows whose pivots would be below this depend on those taken.
const DEPENDENT: f64 = 1e-6;
/// A row that raises the degree less than others do is not worth a pivot below this:
/// of an arm that has its relations nearly, those that vanish with them.
const WEAK: f64 = 1e-2;
const SIZE: usize = 16;
/// What a functional costs that sees all that turns.
const FULL: usize = 2;

/// A candidate row: which functional, and times which half tangents.
type Row = [u8; 2];

/// Chooses rows and columns by elimination at sample targets: next is always the
/// pivot that is largest on the average, of the functionals that raise the degree
/// least.
pub fn order(elimination: &mut Elimination, frames: &[Pose; 7]) -> Option<()> {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let candidates: Vec<Row> = (0..6)
        .flat_map(|f| (0..4).map(move |shift| [f, shift]))
        .collect();
    let samples: Vec<Vec<[f64; SIZE]>> = (0..SAMPLES)
        .map(|_| {
            let q = std::array::from_fn(|_| random.between(-PI, PI));
            let kept = random.between(-PI, PI);
            let equations = elimination.coefficients(frames, &forward(frames, &q), kept);
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
    let mut entries = elimination.functionals[functional].iter().enumerate();
    let turns = entries.any(|(i, x)| turns(i) && *x != 0.0);
    match (functional < usize::from(elimination.half), turns) {
        (true, _) => 1,
        (false, false) => 0,
        (false, true) => FULL,
    }
}

/// A row of the matrix: the coefficients of an equation, shifted by the half
/// tangents that it is multiplied by.
fn spread(equations: &[[f64; 9]; 6], [functional, shift]: Row) -> [f64; SIZE] {
    let mut out = [0.0; SIZE];
    let (i0, j0) = (usize::from(shift & 1), usize::from(shift >> 1));
    for (k, x) in equations[usize::from(functional)].iter().enumerate() {
        out[k / 3 + i0 + 4 * (k % 3 + j0)] = *x;
    }
    out
}

/// The order of elimination: the pivots so far, and what is left of the samples.
struct Order<'a> {
    candidates: &'a [Row],
    costs: &'a [usize],
    samples: Vec<Vec<[f64; SIZE]>>,
    /// So many rows of half angles are allowed.
    most_half: usize,
    rows: Vec<usize>,
    columns: Vec<usize>,
}

impl Order<'_> {
    /// First the monomials that only rows have which are not multiplied by the last
    /// joint's half tangent, then those that only the others have, then the rest: four,
    /// four and eight pivots. None where fewer than sixteen rows are independent.
    fn run(mut self) -> Option<(Vec<usize>, Vec<usize>)> {
        let shifted = |row: Row| row[1] & 1 == 1;
        let power = |column: usize| column % 4;
        for _ in 0..4 {
            self.next(|row| !shifted(row), |column| power(column) == 0)?;
        }
        for _ in 0..4 {
            self.next(shifted, |column| power(column) == 3)?;
        }
        for _ in 0..8 {
            self.next(|_| true, |column| power(column) % 3 != 0)?;
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
                let least = if cost < FULL { WEAK } else { DEPENDENT };
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
