//! One run of the Levenberg-Marquardt method towards a target pose.

use alloc::{vec, vec::Vec};

use crate::chain::at_point;
use crate::search::Goal;
use crate::vector::{add, cross, dot, norm, scale, sub};
use crate::{Chain, Pose, Twist, cholesky};

/// A run ends after this many steps. Regular solutions take about ten; double
/// ones converge linearly and take forty.
const STEPS: usize = 60;

/// Steps before it is asked whether a run gets anywhere.
const PATIENCE: usize = 8;

/// Below this error, relative to the arm's size, the next steps only polish.
const CONVERGED: f64 = 1e-12;

/// What is to be reached by which chain.
#[derive(Clone, Copy)]
pub(crate) struct Task<'a> {
    pub(crate) chain: &'a Chain,
    pub(crate) target: &'a Pose,
    pub(crate) goal: Goal,
    /// Metres that weigh as much as one radian: the arm's size.
    pub(crate) length: f64,
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

/// A configuration, where it puts the tool and how the tool would move.
struct State {
    q: Vec<f64>,
    /// The geometric Jacobian, its angular part multiplied by the length.
    columns: Vec<Twist>,
    /// Towards the target, metres; the angular part is the axis times the sine
    /// of the angle between, times the length.
    error: Twist,
    /// Squared translation, and squared chord of the rotation angle.
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
            let polished = self.converged() && self.current.cost > 0.01 * before;
            if polished || self.current.cost == 0.0 {
                break;
            }
            if count % PATIENCE == 0 {
                if self.current.cost > 0.5 * earlier {
                    break;
                }
                earlier = self.current.cost;
            }
        }
        self.converged()
    }

    /// The configuration reached.
    pub(crate) fn q(&self) -> &[f64] {
        &self.current.q
    }

    /// The error of the configuration reached, metres: the larger of the
    /// translation and the rotation times the length.
    pub(crate) fn residual(&self) -> f64 {
        let error = &self.current.error;
        norm(error.linear).max(norm(error.angular))
    }

    /// The least singular value of the Jacobian by its Frobenius norm; by
    /// inverse iteration on JᵀJ, so that what is below 1e-8 counts as 0.
    pub(crate) fn conditioning(&mut self) -> f64 {
        self.linearize();
        let n = self.step.len();
        let trace: f64 = (0..n).map(|i| self.gram[i * n + i]).sum();
        self.damped.copy_from_slice(&self.gram);
        if !cholesky::factor(&mut self.damped, n) {
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
            self.slope[i] = product(&columns[i], error);
            for j in 0..=i {
                let entry = product(&columns[i], &columns[j]);
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
        if !cholesky::factor(&mut self.damped, n) {
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
            columns: vec![Twist::default(); n],
            error: Twist::default(),
            cost: f64::INFINITY,
        }
    }
}

impl Task<'_> {
    /// Fills in the rest of a state from its configuration.
    fn visit(&self, state: &mut State) {
        let mut before = Pose::IDENTITY;
        let moved = self.chain.displacements(&state.q).zip(self.chain.twists());
        for (column, (after, twist)) in state.columns.iter_mut().zip(moved) {
            *column = before.adjoint(twist);
            before = after;
        }
        let tool = before * *self.chain.home();
        let weight = self.angular_weight();
        for column in &mut state.columns {
            *column = at_point(column, tool.translation);
            column.angular = scale(weight, column.angular);
        }
        (state.error, state.cost) = self.compare(&tool);
    }

    fn angular_weight(&self) -> f64 {
        match self.goal {
            Goal::Pose => self.length,
            Goal::Position => 0.0,
        }
    }

    /// The error of a tool pose and its cost, whose half the error is the
    /// gradient of.
    fn compare(&self, tool: &Pose) -> (Twist, f64) {
        let weight = self.angular_weight();
        let linear = sub(self.target.translation, tool.translation);
        let (sine, cosine) = rotation_between(tool, self.target);
        let angular = scale(weight, sine);
        // 2 − 2 cos θ, which close to zero is had more exactly from the sine.
        let chord = if cosine > 0.0 {
            2.0 * dot(angular, angular) / (1.0 + cosine)
        } else {
            weight * weight * (2.0 - 2.0 * cosine)
        };
        (Twist { linear, angular }, dot(linear, linear) + chord)
    }
}

/// The rotation that takes the first orientation to the second: axis times
/// sine, and cosine.
fn rotation_between(from: &Pose, to: &Pose) -> ([f64; 3], f64) {
    let (a, b) = (&from.rotation, &to.rotation);
    let (mut doubled_sine, mut trace) = ([0.0; 3], 0.0);
    for i in 0..3 {
        let (x, y) = ([a[0][i], a[1][i], a[2][i]], [b[0][i], b[1][i], b[2][i]]);
        doubled_sine = add(doubled_sine, cross(x, y));
        trace += dot(x, y);
    }
    (scale(0.5, doubled_sine), 0.5 * (trace - 1.0))
}

/// The inner product in six dimensions.
fn product(a: &Twist, b: &Twist) -> f64 {
    dot(a.linear, b.linear) + dot(a.angular, b.angular)
}
