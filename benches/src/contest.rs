//! Timing several implementations in turn.

use std::hint::black_box;
use std::time::Instant;

/// How often every contestant runs over all inputs.
const ROUNDS: usize = 41;

/// An input that can be made to depend on the output before it.
pub trait Input: Copy + 'static {
    /// The same, moved by `by`.
    fn nudged(&self, by: f64) -> Self;
}

impl Input for [f64; 6] {
    fn nudged(&self, by: f64) -> Self {
        let mut moved = *self;
        moved[0] += by;
        moved
    }
}

impl Input for kinematics::Pose {
    fn nudged(&self, by: f64) -> Self {
        let mut moved = *self;
        moved.translation[0] += by;
        moved
    }
}

/// Implementations of one function, timed on the same inputs.
pub struct Contest<'a, I> {
    title: &'a str,
    inputs: &'a [I],
    contestants: Vec<Contestant<'a>>,
}

struct Contestant<'a> {
    name: &'a str,
    throughput: Box<dyn FnMut() + 'a>,
    latency: Box<dyn FnMut() + 'a>,
}

impl<'a, I: Input> Contest<'a, I> {
    pub fn new(title: &'a str, inputs: &'a [I]) -> Self {
        let contestants = Vec::new();
        Contest {
            title,
            inputs,
            contestants,
        }
    }

    /// Adds an implementation. `number` reads any number off its output, for
    /// the chain of calls in which each waits for the one before.
    pub fn with<O>(
        mut self,
        name: &'a str,
        solve: impl Fn(&I) -> O + Copy + 'a,
        number: impl Fn(&O) -> f64 + 'a,
    ) -> Self {
        let inputs = self.inputs;
        let throughput = move || {
            for input in inputs {
                // By reference: moving eight solutions elsewhere is no part of finding them.
                black_box(&solve(black_box(input)));
            }
        };
        let latency = move || {
            let mut before = 0.0;
            for input in inputs {
                // Too small to change the input, and the compiler cannot know.
                before = 1e-300 * number(&solve(&input.nudged(before)));
            }
            black_box(before);
        };
        self.contestants.push(Contestant {
            name,
            throughput: Box::new(throughput),
            latency: Box::new(latency),
        });
        self
    }

    /// Runs all in turn and prints a table; ratios are to the first.
    pub fn run(mut self) {
        let count = self.inputs.len() as f64;
        let mut times = vec![[Vec::new(), Vec::new()]; self.contestants.len()];
        for _ in 0..ROUNDS {
            for (contestant, times) in self.contestants.iter_mut().zip(&mut times) {
                times[0].push(nanoseconds(&mut contestant.throughput) / count);
                times[1].push(nanoseconds(&mut contestant.latency) / count);
            }
        }
        let medians: Vec<[f64; 2]> = times.into_iter().map(|both| both.map(median)).collect();
        println!("\n{:38} throughput           latency", self.title);
        for (contestant, ns) in self.contestants.iter().zip(&medians) {
            let cell = |k: usize| format!("{:8.1} ns {:6.1}x", ns[k], ns[k] / medians[0][k]);
            println!("  {:32} {} {}", contestant.name, cell(0), cell(1));
        }
    }
}

fn nanoseconds(run: &mut dyn FnMut()) -> f64 {
    let start = Instant::now();
    run();
    start.elapsed().as_nanos() as f64
}

/// The middle one.
pub fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers[numbers.len() / 2]
}
