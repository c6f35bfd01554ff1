//! A point that three unknowns or fewer carry around the loop and back to
//! itself, prismatic joints among them: Newton's method from many places, which
//! knows nothing of how the compiler solves it.

use crate::closed_loop::{ClosedLoop, Object, Vec3, dot, sub, wrapped};
use kin_codegen::plan::{Atom, Relation};
use kin_codegen::random::Random;
use std::f64::consts::PI;

const STARTS: usize = 60;
const STEPS: usize = 40;
/// Of the loop, metres.
const CLOSED: f64 = 1e-11;

/// All values of the unknowns that close the loop.
pub fn point(closed: &ClosedLoop, relation: &Relation, unknowns: &[Atom]) -> Vec<Vec<f64>> {
    let from = &relation.from;
    let object = Object::from(from);
    let arc = closed.over_target(from.joints.end, from.joints.start);
    let gap = |values: &[f64]| {
        let mut closed = closed.clone();
        for (&unknown, &value) in unknowns.iter().zip(values) {
            closed.set(unknown, value);
        }
        sub(closed.transport(&arc, object).point, object.point)
    };
    let turns = |i: usize| closed.turns(closed.extent(unknowns[i]).0);
    let mut random = Random(0x2545_f491);
    let mut found: Vec<Vec<f64>> = Vec::new();
    for _ in 0..STARTS {
        let start = (0..unknowns.len()).map(|_| random.between(-PI, PI));
        let Some(mut values) = newton(start.collect(), gap) else {
            continue;
        };
        for i in (0..values.len()).filter(|&i| turns(i)) {
            values[i] = wrapped(values[i]);
        }
        let near = |other: &Vec<f64>| {
            let apart = |i: usize| match turns(i) {
                true => wrapped(other[i] - values[i]).abs(),
                false => (other[i] - values[i]).abs(),
            };
            (0..values.len()).all(|i| apart(i) < 1e-6)
        };
        if !found.iter().any(near) {
            found.push(values);
        }
    }
    found
}

/// Gauss and Newton, with differences for derivatives.
fn newton(mut values: Vec<f64>, gap: impl Fn(&[f64]) -> Vec3) -> Option<Vec<f64>> {
    for _ in 0..STEPS {
        let here = gap(&values);
        if dot(here, here).sqrt() < CLOSED {
            return Some(values);
        }
        let columns: Vec<Vec3> = (0..values.len())
            .map(|i| {
                let mut moved = values.clone();
                moved[i] += 1e-6;
                sub(gap(&moved), here).map(|x| x / 1e-6)
            })
            .collect();
        for (value, step) in values.iter_mut().zip(least_squares(&columns, here)) {
            *value -= step.clamp(-1.0, 1.0);
        }
    }
    None
}

/// x that makes Σ xᵢ columnᵢ nearest to b: Gauss and Jordan on the normal equations.
fn least_squares(columns: &[Vec3], b: Vec3) -> Vec<f64> {
    let n = columns.len();
    let mut a: Vec<Vec<f64>> = (columns.iter())
        .map(|u| {
            let mut row: Vec<f64> = columns.iter().map(|v| dot(*u, *v)).collect();
            row.push(dot(*u, b));
            row
        })
        .collect();
    for i in 0..n {
        a[i][i] += 1e-14;
        for j in 0..n {
            if i != j {
                let factor = a[j][i] / a[i][i];
                for k in 0..=n {
                    a[j][k] -= factor * a[i][k];
                }
            }
        }
    }
    (0..n).map(|i| a[i][n] / a[i][i]).collect()
}
