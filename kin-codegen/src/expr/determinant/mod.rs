//! The determinant of the Jacobian as a product.
//!
//! A determinant is the same in every frame and for every reference point, but
//! its entries are not: where the axes of a wrist meet, their linear part
//! vanishes; along parallel axes, half of the rest. Every link of the arm and
//! every point on an axis is tried. In each the zeros are used twice: a matrix
//! that is block-triangular after permuting rows and columns is a product of
//! smaller determinants, and these are expanded along the row or column that
//! has the most zeros, every minor once. What is left as a factor is a
//! singularity.

mod matrix;
mod product;

use super::axes::{AxesInFrame, FIRST, tip_frame};
use super::{Expr, Graph};
use crate::geometry::Linkage;
use crate::plan::Target;
use matrix::{Block, BlockProduct, Matrix};
use product::Product;

/// A determinant: `coefficient` times the product of the factors.
#[derive(Clone, Debug)]
pub struct Determinant {
    /// The constant part.
    pub coefficient: f64,
    /// What depends on q.
    pub factors: Vec<Factor>,
    /// The whole product.
    pub product: Expr,
    /// How the rows are called.
    pub rows: Rows,
}

/// A factor of a determinant.
#[derive(Clone, Debug, PartialEq)]
pub struct Factor {
    /// Its value, up to sign.
    pub expression: Expr,
    /// How often it occurs.
    pub power: usize,
    /// The coordinates whose columns it is made of, from 0.
    pub columns: Vec<usize>,
    /// In which power of metres it is, if that is known; 0 for the sine of an
    /// angle.
    pub metres: Option<usize>,
}

/// The rows of a square Jacobian.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rows {
    /// All six.
    All,
    /// As many as there are joints; the others are zero in every
    /// configuration.
    Moving,
    /// Those of what counts of a target.
    Counting(Target),
}

/// The determinant of the Jacobian with the rows that a target has; none if it
/// has not as many as the arm has coordinates. The inputs of `g` are q.
pub fn determinant(
    g: &mut Graph,
    linkage: &Linkage,
    q: &[Expr],
    target: Target,
) -> Option<Determinant> {
    // An arm whose joints all move in one subgroup of motions has its own rows,
    // whatever its targets are: x, y, z and yaw for a SCARA.
    let whole = moves_in_subgroup(linkage, q.len()).then_some(Target::Pose);
    let part = Some(target).filter(|target| *target != Target::Pose);
    let ways = whole.into_iter().chain(part);
    ways.into_iter()
        .find_map(|target| by_rows(g, linkage, q, target))
}

/// Whether all motions of the tip lie in a space of as many dimensions as there
/// are joints, the same in every configuration.
fn moves_in_subgroup(linkage: &Linkage, n: usize) -> bool {
    if n >= 6 {
        return n == 6;
    }
    let mut g = Graph::new();
    let q: Vec<Expr> = (1..=n).map(|i| g.input(format!("q{i}"))).collect();
    let seen = AxesInFrame::new(&mut g, linkage, &q, FIRST);
    let origin = g.vector([0.0; 3]);
    let columns = seen.columns(&mut g, linkage, origin);
    let mut basis: Vec<[f64; 6]> = Vec::new();
    let mut values = Vec::new();
    for probe in PROBES {
        g.evaluate(&probe[..n], 0, &mut values);
        for column in &columns {
            let mut rest = column.map(|e| values[e.index()]);
            for known in &basis {
                let along: f64 = (0..6).map(|i| rest[i] * known[i]).sum();
                rest = std::array::from_fn(|i| rest[i] - along * known[i]);
            }
            let norm = rest.iter().map(|x| x * x).sum::<f64>().sqrt();
            if norm > 1e-9 {
                basis.push(rest.map(|x| x / norm));
            }
        }
    }
    basis.len() == n
}

fn by_rows(g: &mut Graph, linkage: &Linkage, q: &[Expr], target: Target) -> Option<Determinant> {
    let views = views(linkage, q.len(), target);
    let most = views.iter().map(|view| view.best_split()).max()?;
    let (best, split) = (views.iter())
        .filter_map(|view| view.cheapest(most))
        .min_by_key(|(cost, ..)| *cost)
        .map(|(_, view, split)| (view, split))?;
    let mut product = Product::default();
    for block in &split.blocks {
        let (view, parts, minus) = cheapest_equal(&views, best, block);
        let inputs: Vec<(Expr, Expr)> =
            view.inputs.iter().copied().zip(q.iter().copied()).collect();
        product.sign(minus);
        for part in parts {
            let expression = g.import(&view.graph, part, &inputs);
            product.take(g, expression, &block.columns, block.metres);
        }
    }
    product.sign(split.odd);
    let rows = match target {
        Target::Pose if q.len() == 6 => Rows::All,
        Target::Pose => Rows::Moving,
        other => Rows::Counting(other),
    };
    Some(product.finish(g, rows))
}

/// The Jacobian as seen from one link, by all reference points.
struct View {
    graph: Graph,
    inputs: Vec<Expr>,
    products: Vec<BlockProduct>,
    /// The values of all nodes at some configurations.
    values: Vec<Vec<f64>>,
}

/// Configurations at which expressions of different views are compared.
const PROBES: [[f64; 6]; 3] = [
    [0.3, -1.1, 0.7, 1.9, -0.4, 2.3],
    [-2.1, 0.6, 1.3, -0.8, 2.7, -1.6],
    [1.2, 2.2, -0.9, 0.5, 1.1, 0.8],
];

fn views(linkage: &Linkage, n: usize, target: Target) -> Vec<View> {
    let last = tip_frame(linkage);
    let from = match target {
        Target::Pose | Target::Position | Target::Orientation => 0..=last,
        // The rows are those of the tip's own axes,
        Target::PositionAxis | Target::Direction => last..=last,
        // or of the first joint's that turns.
        Target::PositionYaw | Target::Planar => match linkage.first_turn() {
            Some(joint) => FIRST + joint..=FIRST + joint,
            None => return Vec::new(),
        },
    };
    if n > 6 {
        return Vec::new();
    }
    let views = from.map(|frame| View::new(linkage, n, target, frame));
    views.filter(|view| !view.products.is_empty()).collect()
}

impl View {
    fn new(linkage: &Linkage, n: usize, target: Target, frame: usize) -> Self {
        let mut g = Graph::new();
        let inputs: Vec<Expr> = (1..=n).map(|i| g.input(format!("q{i}"))).collect();
        let seen = AxesInFrame::new(&mut g, linkage, &inputs, frame);
        let mut references = seen.points();
        if matches!(
            target,
            Target::Pose | Target::Orientation | Target::Direction
        ) {
            // The order decides between equals only.
            references.sort();
            references.dedup();
        } else {
            references.drain(..references.len() - 1);
        }
        let wanted: &[usize] = match target {
            Target::Pose => &[0, 1, 2, 3, 4, 5],
            Target::Position => &[0, 1, 2],
            Target::Orientation => &[3, 4, 5],
            Target::PositionAxis => &[0, 1, 2, 3, 4],
            Target::Direction => &[3, 4],
            Target::PositionYaw | Target::Planar => &[0, 1, 2, 5],
        };
        let mut products = Vec::new();
        for reference in references {
            let columns = seen.columns(&mut g, linkage, reference);
            let zero = |row: usize, g: &Graph| columns.iter().all(|column| g.is(column[row], 0.0));
            let rows: Vec<usize> = (wanted.iter().copied())
                .filter(|&row| !zero(row, &g))
                .collect();
            if rows.len() == n {
                products.extend(Matrix::new(columns, rows).block_product(&mut g));
            }
        }
        let mut view = Self {
            graph: g,
            inputs,
            products,
            values: Vec::new(),
        };
        for probe in PROBES {
            let mut values = Vec::new();
            view.graph.evaluate(&probe[..n], 0, &mut values);
            view.values.push(values);
        }
        view
    }

    /// The largest number of blocks.
    fn best_split(&self) -> usize {
        let blocks = self.products.iter().map(|product| product.blocks.len());
        blocks.max().unwrap_or(0)
    }

    /// The cheapest of the products into so many blocks.
    fn cheapest(&self, blocks: usize) -> Option<(usize, &View, &BlockProduct)> {
        (self.products.iter())
            .filter(|product| product.blocks.len() == blocks)
            .map(|product| (self.cost(product), self, product))
            .min_by_key(|(cost, ..)| *cost)
    }

    fn cost(&self, product: &BlockProduct) -> usize {
        let outputs: Vec<Expr> = product
            .blocks
            .iter()
            .map(|block| block.expression)
            .collect();
        self.graph.operations(&outputs).weight()
    }

    /// The product of some expressions at the probes.
    fn probed(&self, parts: &[Expr]) -> [f64; 3] {
        [0, 1, 2].map(|k| parts.iter().map(|e| self.values[k][e.index()]).product())
    }
}

/// The same block, up to its sign, as another view may have it with fewer
/// operations: as one block or several. The sign is put right.
fn cheapest_equal<'v>(
    views: &'v [View],
    own: &'v View,
    block: &Block,
) -> (&'v View, Vec<Expr>, bool) {
    let wanted = own.probed(&[block.expression]);
    let cost = |view: &View, parts: &[Expr]| view.graph.operations(parts).weight();
    let start = vec![block.expression];
    let mut best = (cost(own, &start), own, start, false);
    for view in views {
        for product in &view.products {
            let Some(parts) = product.blocks_of(&block.columns) else {
                continue;
            };
            let cost = cost(view, &parts);
            if cost >= best.0 {
                continue;
            }
            let found = view.probed(&parts);
            let equal = |sign: f64| {
                let pairs = found.into_iter().zip(wanted);
                pairs
                    .into_iter()
                    .all(|(a, b)| (a * sign - b).abs() <= 1e-12 * b.abs())
            };
            if equal(1.0) || equal(-1.0) {
                best = (cost, view, parts, equal(-1.0));
            }
        }
    }
    (best.1, best.2, best.3)
}
