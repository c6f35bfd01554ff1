//! One run of the Levenberg-Marquardt method towards a target pose.

use alloc::{vec, vec::Vec};

use super::chain::at_point;
use super::half_plane::HalfPlane;
use crate::linear::cholesky;
use crate::linear::vector::scale;
use crate::types::projection::Projection;
use crate::{Chain, Pose, Twist};

/// A run ends after this many steps. Regular solutions take about ten; double
/// ones converge linearly and take forty.
const STEPS: usize = 60;

/// Steps before it is asked whether a run gets anywhere.
const PATIENCE: usize = 8;

/// Below this error, relative to the characteristic length, the next steps only refine.
const CONVERGED: f64 = 1e-12;

/// What is to be reached by which chain.
#[derive(Clone, Copy)]
pub(crate) struct Task<'a> {
    pub(crate) chain: &'a Chain,
    /// As it is seen.
    pub(crate) target: Pose,
    /// What of the target counts, and how that sees the tip.
    pub(crate) projection: Projection,
    /// Metres that weigh as much as one radian: the characteristic length.
    pub(crate) length: f64,
    /// Where the elbow has to be, if a swivel angle is given.
    pub(super) elbow: Option<HalfPlane>,
}

/// Six coordinates of a motion, its angular part multiplied by the length, and that of an
/// elbow out of its plane, metres.
type Row = [f64; 7];

fn dot(a: &Row, b: &Row) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// A descent and the memory that it reuses between runs.
pub(crate) struct Descent<'a> {
    task: Task<'a>,
    current: State,
    trial: State,
    gram: Vec<f64>,
    damped: Vec<f64>,
    slope: Vec<f64>,
    step: Vec<f64>,
}

/// A configuration, where it puts the tip and how the tip would move.
struct State {
    q: Vec<f64>,
    spatial: Vec<Twist>,
    /// What counts of the geometric Jacobian.
    columns: Vec<Row>,
    /// What is missing: minus half the gradient of the cost in the coordinates of the
    /// columns.
    error: Row,
    /// The squared distance from the target.
    cost: f64,
}

impl<'a> Descent<'a> {
    pub(crate) fn new(task: Task<'a>) -> Self {
        let n = task.chain.twists().len();
        Descent {
            task,
            current: State::new(n),
            trial: State::new(n),
            gram: vec![0.0; n * n],
            damped: vec![0.0; n * n],
            slope: vec![0.0; n],
            step: vec![0.0; n],
        }
    }

    /// Descends from `start` and tells whether it arrived.
    pub(crate) fn run(&mut self, start: &[f64]) -> bool {
        self.trial.q.copy_from_slice(start);
        self.task.visit(&mut self.trial);
        core::mem::swap(&mut self.current, &mut self.trial);
        let mut damping = 1e-2;
        let mut earlier = f64::INFINITY;
        for count in 1..=STEPS {
            let before = self.current.cost;
            self.linearize();
            if !self.improve(&mut damping) {
                break;
            }
            let refined = self.converged() && self.current.cost > 0.01 * before;
            if refined || self.current.cost == 0.0 {
                break;
            }
            if count % PATIENCE == 0 {
                if self.current.cost > 0.5 * earlier {
                    break;
                }
                earlier = self.current.cost;
            }
        }
        self.converged() && self.task.has(&self.current.q)
    }

    /// The configuration reached.
    pub(crate) fn q(&self) -> &[f64] {
        &self.current.q
    }

    /// How far the configuration reached is from the target, metres.
    pub(crate) fn residual(&self) -> f64 {
        libm::sqrt(self.current.cost)
    }

    /// The least singular value of the Jacobian by its Frobenius norm; by
    /// inverse iteration on JᵀJ, so that what is below 1e-8 counts as 0.
    pub(crate) fn conditioning(&mut self) -> f64 {
        self.linearize();
        let n = self.step.len();
        let trace: f64 = (0..n).map(|i| self.gram[i * n + i]).sum();
        self.damped.copy_from_slice(&self.gram);
        if !cholesky::factor(&mut self.damped, n, 0.0) {
            return 0.0;
        }
        self.step.fill(1.0);
        let mut growth = 1.0;
        for _ in 0..8 {
            let length = libm::sqrt(self.step.iter().map(|x| x * x).sum());
            self.step.iter_mut().for_each(|x| *x /= length);
            cholesky::solve(&self.damped, &mut self.step);
            growth = libm::sqrt(self.step.iter().map(|x| x * x).sum());
        }
        libm::sqrt(1.0 / (growth * trace))
    }

    fn converged(&self) -> bool {
        let close = CONVERGED * self.task.length;
        self.current.cost <= close * close
    }

    /// JᵀJ and Jᵀe of the current state.
    fn linearize(&mut self) {
        let State { columns, error, .. } = &self.current;
        let n = columns.len();
        for i in 0..n {
            self.slope[i] = dot(&columns[i], error);
            for j in 0..=i {
                let entry = dot(&columns[i], &columns[j]);
                self.gram[i * n + j] = entry;
                self.gram[j * n + i] = entry;
            }
        }
    }

    /// Raises the damping until a step lowers the cost, and takes it; `false`
    /// if none does, or only rounding is left to lower.
    fn improve(&mut self, damping: &mut f64) -> bool {
        while *damping < 1e6 {
            if self.propose(*damping) {
                self.task.visit(&mut self.trial);
                if self.trial.cost < self.current.cost {
                    core::mem::swap(&mut self.current, &mut self.trial);
                    *damping = (*damping * 0.1).max(1e-15);
                    return true;
                }
            }
            if self.converged() {
                return false;
            }
            *damping *= 10.0;
        }
        false
    }

    /// Solves (JᵀJ + damping · diagonal) step = Jᵀe and applies the step.
    fn propose(&mut self, damping: f64) -> bool {
        let n = self.step.len();
        let largest = (0..n).map(|i| self.gram[i * n + i]).fold(0.0, f64::max);
        self.damped.copy_from_slice(&self.gram);
        for i in 0..n {
            self.damped[i * n + i] += damping * (self.gram[i * n + i] + 1e-6 * largest);
        }
        if !cholesky::factor(&mut self.damped, n, 0.0) {
            return false;
        }
        self.step.copy_from_slice(&self.slope);
        cholesky::solve(&self.damped, &mut self.step);
        for i in 0..n {
            self.trial.q[i] = self.current.q[i] + self.step[i];
        }
        true
    }
}

impl State {
    fn new(n: usize) -> State {
        State {
            q: vec![0.0; n],
            spatial: vec![Twist::default(); n],
            columns: vec![[0.0; 7]; n],
            error: [0.0; 7],
            cost: f64::INFINITY,
        }
    }
}

impl Task<'_> {
    /// Fills in the rest of a state from its configuration.
    fn visit(&self, state: &mut State) {
        let mut before = Pose::IDENTITY;
        let moved = self.chain.displacements(&state.q).zip(self.chain.twists());
        for (spatial, (after, twist)) in state.spatial.iter_mut().zip(moved) {
            *spatial = before.adjoint(twist);
            before = after;
        }
        let tip = before * *self.chain.home();
        let counts = self.projection.counts;
        let seen = self.projection.pose(&tip);
        for (column, spatial) in state.columns.iter_mut().zip(&state.spatial) {
            let velocity = at_point(spatial, tip.translation);
            let velocity = self.projection.velocity(&velocity);
            *column = self.weighed(counts.counting(&seen, &velocity));
        }
        state.error = self.weighed(counts.missing(&seen, &self.target));
        let distance = counts.distance(&seen, &self.target, self.length);
        state.cost = distance * distance;
        if let Some(elbow) = &self.elbow {
            let (below, lifts) = elbow.row(self.chain, &state.q);
            for (joint, twist) in state.spatial.iter().enumerate() {
                state.columns[joint][6] = lifts(joint, twist);
            }
            state.error[6] = below;
            state.cost += below * below;
        }
    }

    /// Whether a solution of the equations is one of the task.
    fn has(&self, q: &[f64]) -> bool {
        let elbow = self.elbow.as_ref();
        elbow.is_none_or(|elbow| elbow.has(self.chain, q))
    }

    /// With angles as lengths.
    fn weighed(&self, twist: Twist) -> Row {
        let ([x, y, z], [a, b, c]) = (twist.linear, scale(self.length, twist.angular));
        [x, y, z, a, b, c, 0.0]
    }
}
