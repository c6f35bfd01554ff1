//! Where an arm can go, how, and how well it moves there.

use crate::arguments;
use kin_codegen::expr::Graph;
use kin_codegen::geometry::{Line, axes, size};
use kin_codegen::model::{JointKind, Model};
use kin_codegen::singularity::Singular;
use kin_codegen::solver::ClosedForm;
use kin_codegen::verify::chain;
use kin_codegen::{Compiled, Target};
use kin_runtime::{Pose, scattered_rotations};
use std::f64::consts::TAU;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// A plane through the workspace: two base axes and a point.
pub struct Slice {
    /// By its axes.
    pub name: &'static str,
    /// The base axis along the rows of the picture, x = 0.
    pub across: usize,
    /// The one up its columns.
    pub up: usize,
    /// Its middle.
    pub centre: [f64; 3],
}

/// What is tried.
pub struct Sampling<'a> {
    form: &'a ClosedForm,
    singular: Option<&'a Singular>,
    model: &'a Model,
    /// xz, yz, xy.
    pub slices: [Slice; 3],
    cells: usize,
    /// Between neighbouring points, metres.
    pub step: f64,
    /// At every point.
    pub orientations: Vec<Pose>,
    /// Of the coordinates, if only answers within them count.
    pub limits: Option<Vec<Option<[f64; 2]>>>,
}

/// What was found: values by slice, row from below, and column.
pub struct Map {
    /// Points along a side of a slice.
    pub cells: usize,
    /// The share of the orientations that were reached.
    pub share: Vec<f64>,
    /// |det J| of the best branch, its mean over the orientations reached; 0
    /// where there is no determinant.
    pub manipulability: Vec<f64>,
}

impl Map {
    /// One slice of the values.
    pub fn slice<'v>(&self, values: &'v [f64], slice: usize) -> &'v [f64] {
        let area = self.cells * self.cells;
        &values[slice * area..(slice + 1) * area]
    }
}

impl<'a> Sampling<'a> {
    /// None if targets have no position.
    pub fn new(compiled: &'a Compiled, arguments: &arguments::Workspace) -> Option<Self> {
        let form = compiled.inverse.as_ref()?;
        let model = &compiled.model;
        let axes = axes(model);
        let planar = is_planar(model, &axes);
        let orientations = match form.plan.target {
            Target::Orientation | Target::Direction => return None,
            Target::Position => vec![Pose::IDENTITY],
            Target::PositionYaw | Target::Planar => turns(model, &axes[0], arguments.samples),
            Target::Pose | Target::PositionAxis if planar => {
                turns(model, &axes[0], arguments.samples)
            }
            Target::Pose | Target::PositionAxis => scattered_rotations(arguments.samples).collect(),
        };
        let centre = centre(model, &axes, planar);
        let slice = |name, across, up| Slice {
            name,
            across,
            up,
            centre,
        };
        let limits = model.variables.iter().map(|variable| variable.limits);
        Some(Self {
            form,
            singular: compiled.singular.as_ref(),
            model,
            slices: [slice("xz", 0, 2), slice("yz", 1, 2), slice("xy", 0, 1)],
            cells: arguments.cells,
            step: 2.0 * reach(model, centre) / arguments.cells as f64,
            orientations,
            limits: arguments.limits.then(|| limits.collect()),
        })
    }

    /// How many points are tried.
    pub fn points(&self) -> usize {
        3 * self.cells * self.cells
    }

    /// A point by its number.
    fn point(&self, number: usize) -> [f64; 3] {
        let area = self.cells * self.cells;
        let slice = &self.slices[number / area];
        let (row, column) = (number % area / self.cells, number % self.cells);
        let middle = (self.cells as f64 - 1.0) / 2.0;
        let mut point = slice.centre;
        point[slice.across] += (column as f64 - middle) * self.step;
        point[slice.up] += (row as f64 - middle) * self.step;
        point
    }

    /// Tries all points on all processors. `progress` is told how many are done
    /// since it was told last.
    pub fn map(&self, progress: &(dyn Fn(usize) + Sync)) -> Map {
        let next = AtomicUsize::new(0);
        let found = Mutex::new(vec![[0.0; 2]; self.points()]);
        let work = || {
            let mut values = Vec::new();
            loop {
                // A row at once.
                let from = next.fetch_add(self.cells, Ordering::Relaxed);
                let row = from..self.points().min(from + self.cells);
                if row.is_empty() {
                    break;
                }
                let seen: Vec<[f64; 2]> = (row.clone())
                    .map(|number| self.try_point(self.point(number), &mut values))
                    .collect();
                if let Ok(mut found) = found.lock() {
                    found[row.clone()].copy_from_slice(&seen);
                }
                progress(row.len());
            }
        };
        let threads = thread::available_parallelism().map_or(1, usize::from);
        thread::scope(|scope| {
            for _ in 0..threads {
                scope.spawn(work);
            }
        });
        let found = found
            .into_inner()
            .unwrap_or_else(|poison| poison.into_inner());
        Map {
            cells: self.cells,
            share: found.iter().map(|cell| cell[0]).collect(),
            manipulability: found.iter().map(|cell| cell[1]).collect(),
        }
    }

    /// The share of orientations reached at a point, and the mean of the best
    /// determinants there.
    fn try_point(&self, point: [f64; 3], values: &mut Vec<f64>) -> [f64; 2] {
        let (mut reached, mut sum) = (0, 0.0);
        for rotation in &self.orientations {
            let target = Pose {
                translation: point,
                ..*rotation
            };
            let answers = self.form.answers(&target);
            let within = answers.iter().filter(|answer| self.is_within(&answer.q));
            let best = within
                .map(|answer| self.determinant(&answer.q, values))
                .reduce(f64::max);
            if let Some(best) = best {
                reached += 1;
                sum += best;
            }
        }
        let share = f64::from(reached) / self.orientations.len() as f64;
        [share, sum / f64::from(reached.max(1))]
    }

    fn is_within(&self, q: &[f64]) -> bool {
        let Some(limits) = &self.limits else {
            return true;
        };
        (q.iter().zip(limits).enumerate()).all(|(i, (&value, limit))| {
            let ways = if self.model.turns(i) {
                &[-TAU, 0.0, TAU][..]
            } else {
                &[0.0]
            };
            let inside = |[low, high]: [f64; 2]| {
                ways.iter().any(|way| (low..=high).contains(&(value + way)))
            };
            limit.is_none_or(inside)
        })
    }

    fn determinant(&self, q: &[f64], values: &mut Vec<f64>) -> f64 {
        let Some(singular) = self.singular else {
            return 0.0;
        };
        let graph: &Graph = &singular.graph;
        graph.evaluate(q, 0, values);
        values[singular.determinant.product.index()].abs()
    }
}

/// All turning joints about parallel axes.
fn is_planar(model: &Model, axes: &[Line]) -> bool {
    let turning = (model.joints.iter().zip(axes))
        .filter(|(joint, _)| joint.kind == JointKind::Revolute)
        .map(|(_, axis)| axis.direction);
    let along = |d: [f64; 3]| {
        let first = axes[0].direction;
        let cosine: f64 = (0..3).map(|i| d[i] * first[i]).sum();
        cosine.abs() > 1.0 - 1e-6
    };
    turning.into_iter().all(along)
}

/// The tip's orientation at home, turned about the first axis.
fn turns(model: &Model, first: &Line, count: usize) -> Vec<Pose> {
    let turn = |k: usize| {
        let angle = TAU * k as f64 / count as f64;
        let home = Pose {
            translation: [0.0; 3],
            ..model.home
        };
        Pose::from_axis_angle(first.direction, angle, [0.0; 3]) * home
    };
    (0..count).map(turn).collect()
}

/// The shoulder: where the second axis is nearest to the first, or at the
/// height of the tip if all are parallel.
fn centre(model: &Model, axes: &[Line], planar: bool) -> [f64; 3] {
    match axes {
        _ if planar => axes[0].nearest(model.home.translation),
        [first, second, ..] if first.distance(second).is_finite() => {
            first.nearest(second.nearest(first.nearest(second.point)))
        }
        _ => axes[0].nearest(model.home.translation),
    }
}

/// How far from the middle the tip can be, and a little more. In the angle of
/// one joint, the squared distance is a sine wave, whose crest three values
/// give; joint after joint from several starts, the farthest point is found.
fn reach(model: &Model, centre: [f64; 3]) -> f64 {
    const STARTS: usize = 12;
    const ROUNDS: usize = 40;
    let chain = chain(model);
    let n = model.variables.len();
    let squared = |q: &[f64]| {
        let tip = chain.fk(q).translation;
        (0..3).map(|i| (tip[i] - centre[i]).powi(2)).sum::<f64>()
    };
    let farthest = |start: usize| {
        let mut q: Vec<f64> = (0..n)
            .map(|i| (1.3 * start as f64 + 0.7 * i as f64) % TAU)
            .collect();
        for joint in (0..n).cycle().take(ROUNDS * n) {
            let mut at = |value: f64| {
                q[joint] = value;
                squared(&q)
            };
            q[joint] = if model.turns(joint) {
                let [zero, quarter, half] = [0.0, TAU / 4.0, TAU / 2.0].map(&mut at);
                let mean = 0.5 * (zero + half);
                (quarter - mean).atan2(zero - mean)
            } else {
                let [low, high] = travel(model, joint);
                if at(low) > at(high) { low } else { high }
            };
        }
        squared(&q).sqrt()
    };
    1.04 * (0..STARTS).map(farthest).fold(0.0, f64::max)
}

/// How far a joint slides; half the arm's size both ways if nothing stops it.
fn travel(model: &Model, joint: usize) -> [f64; 2] {
    let finite = |limits: &[f64; 2]| limits.iter().all(|x| x.is_finite());
    let half = 0.5 * size(model);
    model.variables[joint]
        .limits
        .filter(finite)
        .unwrap_or([-half, half])
}
