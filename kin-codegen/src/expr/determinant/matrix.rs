//! Square matrices with many zeros.

use super::product::sum_factored;
use crate::expr::{Expr, Graph};
use std::collections::HashMap;

/// A determinant as a product of smaller ones.
pub(super) struct BlockProduct {
    pub blocks: Vec<Block>,
    /// Whether the product has the opposite sign.
    pub odd: bool,
}

pub(super) struct Block {
    pub expression: Expr,
    pub columns: Vec<usize>,
    /// How many of its rows are linear.
    pub metres: usize,
}

impl BlockProduct {
    /// The blocks that have exactly these columns.
    pub fn blocks_of(&self, columns: &[usize]) -> Option<Vec<Expr>> {
        let within = |block: &&Block| block.columns.iter().all(|c| columns.contains(c));
        let blocks = self.blocks.iter().filter(within);
        let covered: usize = blocks.clone().map(|block| block.columns.len()).sum();
        (covered == columns.len()).then(|| blocks.map(|block| block.expression).collect())
    }
}

/// A square matrix by columns, with the rows that count.
pub(super) struct Matrix {
    columns: Vec<[Expr; 6]>,
    rows: Vec<usize>,
}

/// Rows or columns, by bit.
type Set = u8;

impl Matrix {
    pub fn new(columns: Vec<[Expr; 6]>, rows: Vec<usize>) -> Self {
        Self { columns, rows }
    }

    fn size(&self) -> usize {
        self.rows.len()
    }

    fn entry(&self, row: usize, column: usize) -> Expr {
        self.columns[column][self.rows[row]]
    }

    fn is_zero(&self, g: &Graph, row: usize, column: usize) -> bool {
        g.is(self.entry(row, column), 0.0)
    }

    /// None if the zeros make it singular everywhere.
    pub fn block_product(&self, g: &mut Graph) -> Option<BlockProduct> {
        let n = self.size();
        let (mut rows, mut columns): (Set, Set) = ((1 << n) - 1, (1 << n) - 1);
        let mut order: [Vec<usize>; 2] = [Vec::new(), Vec::new()];
        let mut blocks = Vec::new();
        let mut minors = HashMap::new();
        while columns != 0 {
            let (r, c) = self.smallest_block(g, rows, columns)?;
            rows &= !r;
            columns &= !c;
            order[0].extend(members(r));
            order[1].extend(members(c));
            blocks.push(Block {
                expression: self.minor(g, r, c, &mut minors),
                columns: members(c).collect(),
                metres: members(r).filter(|&row| self.rows[row] < 3).count(),
            });
        }
        let odd = is_odd(&order[0]) != is_odd(&order[1]);
        Some(BlockProduct { blocks, odd })
    }

    /// The fewest columns whose entries lie in as many rows, or the other way
    /// round. None if some lie in fewer.
    fn smallest_block(&self, g: &Graph, rows: Set, columns: Set) -> Option<(Set, Set)> {
        let filled = |row, column| !self.is_zero(g, row, column);
        let touched_rows = |set| select(rows, |row| members(set).any(|c| filled(row, c)));
        let touched_columns =
            |set| select(columns, |column| members(set).any(|r| filled(r, column)));
        let mut best: Option<(Set, Set)> = None;
        for set in 1..1 << self.size() {
            let by_columns = (set & !columns == 0).then(|| (touched_rows(set), set));
            let by_rows = (set & !rows == 0).then(|| (set, touched_columns(set)));
            for (r, c) in by_columns.into_iter().chain(by_rows) {
                if r.count_ones().min(c.count_ones()) < set.count_ones() {
                    return None;
                }
                let smaller = best.is_none_or(|(_, known)| c.count_ones() < known.count_ones());
                if r.count_ones() == c.count_ones() && smaller {
                    best = Some((r, c));
                }
            }
        }
        best
    }

    /// The determinant of some rows and columns, by Laplace.
    fn minor(
        &self,
        g: &mut Graph,
        rows: Set,
        columns: Set,
        known: &mut HashMap<(Set, Set), Expr>,
    ) -> Expr {
        if rows == 0 {
            return g.one();
        }
        if let Some(&minor) = known.get(&(rows, columns)) {
            return minor;
        }
        let entries_of_row = |row| {
            members(columns)
                .filter(|&column| !self.is_zero(g, row, column))
                .count()
        };
        let entries_of_column = |column| {
            members(rows)
                .filter(|&row| !self.is_zero(g, row, column))
                .count()
        };
        let row = members(rows).map(|row| (entries_of_row(row), row)).min();
        let column = members(columns)
            .map(|column| (entries_of_column(column), column))
            .min();
        let by_row = row.map(|(count, _)| count) <= column.map(|(count, _)| count);
        let (line, across) = match (by_row, row, column) {
            (true, Some((_, row)), _) => (row, columns),
            (_, _, Some((_, column))) => (column, rows),
            _ => unreachable!("as many rows as columns"),
        };
        let along = if by_row { rows } else { columns };
        let place = |set: Set, member: usize| members(set).take_while(|&m| m < member).count();
        let mut sum = g.zero();
        for other in members(across) {
            let (row, column) = if by_row { (line, other) } else { (other, line) };
            if self.is_zero(g, row, column) {
                continue;
            }
            let rest = self.minor(g, rows & !(1 << row), columns & !(1 << column), known);
            let entry = self.entry(row, column);
            let term = g.mul(entry, rest);
            sum = match (place(along, line) + place(across, other)) % 2 {
                0 => sum_factored(g, sum, term, false),
                _ => sum_factored(g, sum, term, true),
            };
        }
        known.insert((rows, columns), sum);
        sum
    }
}

fn members(set: Set) -> impl Iterator<Item = usize> + Clone {
    (0..Set::BITS as usize).filter(move |i| set & (1 << i) != 0)
}

fn select(set: Set, holds: impl Fn(usize) -> bool) -> Set {
    members(set)
        .filter(|&i| holds(i))
        .fold(0, |all, i| all | 1 << i)
}

fn is_odd(order: &[usize]) -> bool {
    let inversions = (0..order.len())
        .flat_map(|i| (i + 1..order.len()).map(move |j| (i, j)))
        .filter(|&(i, j)| order[i] > order[j])
        .count();
    inversions % 2 == 1
}
