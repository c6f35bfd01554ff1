//! Slices of a workspace, point by point.

use kin_runtime::Pose;
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

/// What is sent to the points of the map.
pub trait Robot: Sync {
    /// How well it moves at a pose, 0 if that is not told; none if the pose is
    /// out of reach. `values` is scratch.
    fn try_pose(&self, target: &Pose, values: &mut Vec<f64>) -> Option<f64>;
    /// What that number is called, and what it is.
    fn measure(&self) -> [&'static str; 2];
    /// How the orientations were chosen.
    fn choice(&self) -> String;
}

/// What is tried.
pub struct Sampling<'a> {
    /// An arm or a mechanism.
    pub robot: Box<dyn Robot + 'a>,
    /// xz, yz, xy.
    pub slices: [Slice; 3],
    /// Points along a side of a slice.
    pub cells: usize,
    /// Between neighbouring points, metres.
    pub step: f64,
    /// At every point.
    pub orientations: Vec<Pose>,
    /// Whether only solutions within the joints' limits count.
    pub limited: bool,
}

/// What was found: values by slice, row from below, and column.
pub struct Map {
    /// Points along a side of a slice.
    pub cells: usize,
    /// The share of the orientations that were reached.
    pub share: Vec<f64>,
    /// [`Robot::measure`], its mean over the orientations reached.
    pub measure: Vec<f64>,
}

impl Map {
    /// One slice of the values.
    pub fn slice<'v>(&self, values: &'v [f64], slice: usize) -> &'v [f64] {
        let area = self.cells * self.cells;
        &values[slice * area..(slice + 1) * area]
    }
}

/// xz, yz and xy through a point.
pub fn slices(centre: [f64; 3]) -> [Slice; 3] {
    let slice = |name, across, up| Slice {
        name,
        across,
        up,
        centre,
    };
    [slice("xz", 0, 2), slice("yz", 1, 2), slice("xy", 0, 1)]
}

impl Sampling<'_> {
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
            measure: found.iter().map(|cell| cell[1]).collect(),
        }
    }

    /// The share of orientations reached at a point, and the mean of the
    /// measure there.
    fn try_point(&self, point: [f64; 3], values: &mut Vec<f64>) -> [f64; 2] {
        let (mut reached, mut sum) = (0, 0.0);
        for rotation in &self.orientations {
            let target = Pose {
                translation: point,
                ..*rotation
            };
            if let Some(measure) = self.robot.try_pose(&target, values) {
                reached += 1;
                sum += measure;
            }
        }
        let share = f64::from(reached) / self.orientations.len() as f64;
        [share, sum / f64::from(reached.max(1))]
    }

    /// Moves the slices in their planes to the middle of what of `map` is in reach, and gives
    /// back half the side, metres, of squares that hold it.
    pub fn look_at(&mut self, map: &Map) -> f64 {
        let middle = (self.cells as f64 - 1.0) / 2.0;
        let mut half = 0.0_f64;
        for number in 0..self.slices.len() {
            let share = map.slice(&map.share, number);
            let reached = (0..share.len()).filter(|cell| share[*cell] > 0.0);
            let places: Vec<[usize; 2]> = reached
                .map(|cell| [cell % self.cells, cell / self.cells])
                .collect();
            let slice = &mut self.slices[number];
            for (i, axis) in [slice.across, slice.up].into_iter().enumerate() {
                let ends = places.iter().map(|place| place[i] as f64);
                let (low, high) = ends.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| {
                    (a.min(x), b.max(x))
                });
                if low <= high {
                    slice.centre[axis] += self.step * (0.5 * (low + high) - middle);
                    half = half.max(self.step * (0.5 * (high - low) + 1.0));
                }
            }
        }
        half
    }
}
