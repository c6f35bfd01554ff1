//! Square roots and angles: what is out of domain, double, free, or rounding.

use super::{Level, MayBeFree, Writer};
use crate::expr::linear::{Trig, Vector};
use crate::expr::{Expr, Node};
use crate::plan::{Atom, Target};
use crate::scalar::Tolerances;

/// Where a root may change its sign, and targets are no whole poses, its branches start as if its
/// argument were this share of what it may change by. Newton's method keeps each on its side (from x
/// it goes to half of x + a/x, where a is the argument on the given arm), so that it finds both roots
/// wherever there are two. Starting in one place it finds one; much farther apart, it is led astray
/// where another step is in doubt too, as the wrists are of arms for whole poses.
const APART: f64 = 1.0 / 32.0;

/// a² + b² − d² of a cosine-sine equation.
#[derive(Clone, Copy)]
pub(super) struct Discriminant {
    pub value: Expr,
    /// Relative to a² + b², below this it is rounding.
    pub noise: f64,
    /// Its factors √(a² + b²) ∓ d, where the first is a sum of squares: rounding keeps its digits,
    /// and only where the other is nothing is the root double by it.
    pub factors: Option<[Expr; 2]>,
}

impl Discriminant {
    /// Whether there is no cancellation in it: of its digits rounding takes none, however small it is.
    pub fn keeps_digits(&self, tolerances: &Tolerances) -> bool {
        self.noise <= tolerances.nearly_free
    }

    /// A sum of squares, which is never below zero.
    pub fn is_sum_of_squares(&self, tolerances: &Tolerances) -> bool {
        self.noise == tolerances.free_below
    }
}

impl Writer<'_> {
    /// u · Rz(θ) w = d as a cos θ + b sin θ = d′.
    pub(super) fn cosine_sine(&mut self, u: Vector, w: Vector, d: Expr) -> (Expr, Expr, Expr) {
        let [xx, yy] = [self.g.mul(u[0], w[0]), self.g.mul(u[1], w[1])];
        let [yx, xy] = [self.g.mul(u[1], w[0]), self.g.mul(u[0], w[1])];
        let zz = self.g.mul(u[2], w[2]);
        (self.g.add(xx, yy), self.g.sub(yx, xy), self.g.sub(d, zz))
    }

    /// a cos θ + b sin θ = d, both roots. `known` is its discriminant where
    /// there is a better way to compute it, `unit` what the coefficients are
    /// multiples of.
    pub(super) fn angle_with(
        &mut self,
        unknown: Atom,
        a: Expr,
        b: Expr,
        d: Expr,
        known: Option<Discriminant>,
        unit: f64,
    ) -> Trig {
        let [aa, bb] = [self.g.square(a), self.g.square(b)];
        let amplitude = self.g.add(aa, bb);
        let discriminant = known.unwrap_or_else(|| {
            let dd = self.g.square(d);
            let value = self.g.sub(amplitude, dd);
            Discriminant {
                value,
                noise: self.tolerances.noise,
                factors: None,
            }
        });
        let exact = discriminant.is_sum_of_squares(&self.tolerances);
        self.step.level = (!exact).then_some(Level {
            d,
            amplitude,
            discriminant: discriminant.value,
        });
        let sign = self.g.sign();
        let root = self.root(sign, discriminant, amplitude, unit);
        // Out of domain the nearest angle is that of d at its limit.
        let level = d;
        let d = if exact { d } else { self.clamped(d, amplitude) };
        let [ad, br] = [self.g.mul(a, d), self.g.mul(b, root)];
        let [bd, ar] = [self.g.mul(b, d), self.g.mul(a, root)];
        let trig = Trig {
            sin: self.g.add(bd, ar),
            cos: self.g.sub(ad, br),
        };
        let scale = self.g.constant(unit * unit);
        if self.g.value(amplitude).is_none() {
            // Where the angle is free its two roots are one.
            let nothing = self.free_below(scale);
            let zero = self.g.zero();
            let minus = self.g.neg(sign);
            let second = self.g.select_less(amplitude, nothing, minus, zero);
            self.refuse(second);
        }
        let angle = self.divided(unknown, trig, amplitude, scale);
        // Of a cos θ + b sin θ = d, where b cos θ − a sin θ is minus the root.
        self.turns(angle, |g, direction| {
            let one = g.one();
            let inverse = g.div(one, root);
            let [a, b, d] = [a, b, level].map(|it| direction.of(g, it));
            let [ac, bs] = [g.mul(a, angle.cos), g.mul(b, angle.sin)];
            let moved = g.add(ac, bs);
            let more = g.sub(moved, d);
            g.mul(more, inverse)
        });
        angle
    }

    /// d within ±√limit.
    fn clamped(&mut self, d: Expr, limit: Expr) -> Expr {
        let limit = self.g.sqrt(limit);
        let lower = self.g.neg(limit);
        let minus = self.g.neg(d);
        // min(d, limit) = −max(−d, −limit), and a NaN stays one.
        let below = self.g.max(lower, minus);
        let below = self.g.neg(below);
        let clamped = self.g.max(lower, below);
        self.follow(clamped, d);
        clamped
    }

    /// ± the square root, with what it says about the branch: out of domain is
    /// invalid, a double root is singular and keeps its first branch only.
    pub(super) fn root(
        &mut self,
        sign: Expr,
        discriminant: Discriminant,
        amplitude: Expr,
        unit: f64,
    ) -> Expr {
        let Discriminant {
            value,
            noise,
            factors,
        } = discriminant;
        if !discriminant.is_sum_of_squares(&self.tolerances) {
            let margin = self.scaled(unit.powi(-2), value);
            self.narrow(margin);
            if let (Some(arguments), Node::Sign(choice)) =
                (&mut self.branch.arguments, self.g.node(sign))
            {
                arguments.push((choice, margin));
            }
        }
        if self.deviation.is_some() {
            return self.idealized_root(sign, discriminant, amplitude, unit);
        }
        // Out of domain both branches go to the nearest angle, and the residual
        // tells whether the target is in reach.
        let zero = self.g.zero();
        let minus = self.g.neg(sign);
        let [near, double] =
            [noise.max(self.tolerances.double_root), noise].map(|k| self.scaled(k, amplitude));
        // The root of a sum of squares is double where its vector is nothing.
        let double = match discriminant.keeps_digits(&self.tolerances) {
            true => self.free_below(amplitude),
            false => double,
        };
        self.watch(value, near);
        let (least, double) = match factors {
            None => (value, double),
            Some([squares, other]) => {
                let nothing = self.g.constant(0.5 * unit);
                let nothing = self.free_below(nothing);
                let invalid = self.g.select_less(squares, nothing, minus, zero);
                self.refuse(invalid);
                let length = self.g.sqrt(amplitude);
                (other, self.scaled(0.5 * noise, length))
            }
        };
        if !discriminant.keeps_digits(&self.tolerances) {
            // Where the other factor is small, the one that keeps its digits is twice the length.
            let difference = match factors {
                None => value,
                Some([_, other]) => {
                    let length = self.g.sqrt(amplitude);
                    let length = self.scaled(2.0, length);
                    self.g.mul(length, other)
                }
            };
            let difference = self.scaled(unit.powi(-2), difference);
            // Each passes on what the one before has lost.
            self.branch.difference = Some(match self.branch.difference {
                None => difference,
                Some(before) => self.g.mul(before, difference),
            });
        }
        let invalid = self.g.select_less(least, double, minus, zero);
        self.refuse(invalid);
        let kept = self.g.select_less(least, double, zero, value);
        let root = self.g.sqrt(kept);
        self.g.mul(sign, root)
    }

    /// Takes the margin of a root into that of the branch: the lesser.
    pub(super) fn narrow(&mut self, margin: Expr) {
        let lesser = self.branch.margin.map(|before| {
            let [a, b] = [before, margin].map(|e| self.g.neg(e));
            let larger = self.g.max(a, b);
            self.g.neg(larger)
        });
        self.branch.margin = Some(lesser.unwrap_or(margin));
    }

    /// The root on an idealized arm. Where it may change its sign, both branches start, each on its
    /// side of where they meet, and none is dropped by what comes behind.
    fn idealized_root(
        &mut self,
        sign: Expr,
        discriminant: Discriminant,
        amplitude: Expr,
        unit: f64,
    ) -> Expr {
        let Discriminant { value, noise, .. } = discriminant;
        let least = self.scaled(noise.max(self.tolerances.double_root), amplitude);
        let square = self.g.constant(unit * unit);
        let is_part = self.target != Target::Pose;
        let change = is_part.then(|| self.change_of(value, square, least));
        self.doubt(value, square, least);
        let [zero, one] = [self.g.zero(), self.g.one()];
        let invalid = self.g.select_less(value, zero, one, zero);
        self.refuse(invalid);
        let apart = change.flatten().map_or(least, |square| {
            let change = self.g.sqrt(square);
            self.scaled(APART, change)
        });
        let kept = self.g.max(value, apart);
        self.follow(kept, value);
        let root = self.g.sqrt(kept);
        self.g.mul(sign, root)
    }

    pub(super) fn scaled(&mut self, k: f64, x: Expr) -> Expr {
        let k = self.g.constant(k);
        self.g.mul(k, x)
    }

    /// Below this a factor leaves its angle free, and roots of a sum of squares
    /// are one.
    fn free_below(&mut self, scale: Expr) -> Expr {
        let free = self.step.free;
        self.g.mul(free, scale)
    }

    /// Drops the branches in which a value is positive.
    pub(super) fn refuse(&mut self, invalid: Expr) {
        self.branch.invalid = if self.g.is(self.branch.invalid, 0.0) {
            invalid
        } else {
            self.g.max(self.branch.invalid, invalid)
        };
    }

    /// Flags branches in which a value is below a threshold as singular, unless
    /// it is held against a larger one already.
    pub(super) fn watch(&mut self, value: Expr, threshold: Expr) {
        let covered = self.branch.watched.iter().any(|(watched, already)| {
            let (new, old) = (self.g.value(threshold), self.g.value(*already));
            *watched == value && new.is_some() && new <= old
        });
        if covered {
            return;
        }
        self.branch.watched.push((value, threshold));
        let [zero, one] = [self.g.zero(), self.g.one()];
        let singular = self.g.select_less(value, threshold, one, zero);
        self.flag(singular);
    }

    /// Flags branches in which a value is positive as singular.
    pub(super) fn flag(&mut self, singular: Expr) {
        self.branch.singular = match self.g.value(self.branch.singular) {
            Some(0.0) => singular,
            _ => self.g.max(self.branch.singular, singular),
        };
    }

    /// The angle of (sin, cos) over a common factor; a factor of nothing leaves it free, and the
    /// seed's stands for all of them.
    pub(super) fn normalized(
        &mut self,
        unknown: Atom,
        trig: Trig,
        factor: Expr,
        scale: Expr,
    ) -> Trig {
        let angle = self.divided(unknown, trig, factor, scale);
        let (zero, one) = (self.g.zero(), self.g.one());
        let inverse = self.g.div(one, factor);
        let nothing = self.free_below(scale);
        let is_part = self.target != Target::Pose;
        self.turns(angle, |g, direction| {
            let [y, x] = [trig.sin, trig.cos].map(|it| direction.of(g, it));
            let [yc, xs] = [g.mul(y, angle.cos), g.mul(x, angle.sin)];
            let across = g.sub(yc, xs);
            let rate = g.mul(across, inverse);
            // Where it is free the branch is in doubt already; but of targets that are no whole poses
            // starts depend on it.
            match is_part {
                true => g.select_less(factor, nothing, zero, rate),
                false => rate,
            }
        });
        angle
    }

    /// The same, which changes as what it is computed from.
    fn divided(&mut self, unknown: Atom, trig: Trig, factor: Expr, scale: Expr) -> Trig {
        if self.g.value(factor).is_some() {
            return Trig {
                sin: self.g.div(trig.sin, factor),
                cos: self.g.div(trig.cos, factor),
            };
        }
        let one = self.g.one();
        let nothing = self.flag_free(&[unknown], factor, scale);
        let inverse = self.g.div(one, factor);
        let sin = self.g.mul(trig.sin, inverse);
        let cos = self.g.mul(trig.cos, inverse);
        let seeded = self.seeded(unknown);
        Trig {
            sin: self.g.select_less(factor, nothing, seeded.sin, sin),
            cos: self.g.select_less(factor, nothing, seeded.cos, cos),
        }
    }

    /// Flags branches in which a factor leaves its joints free, unless they are held against more,
    /// and returns below what it does. As a share of `scale` the factor is the square of the sine
    /// that tells the angle.
    pub(super) fn flag_free(&mut self, unknowns: &[Atom], factor: Expr, scale: Expr) -> Expr {
        let nothing = self.free_below(scale);
        let free = unknowns.iter().map(|&unknown| MayBeFree {
            unknown,
            factor,
            scale,
            nothing: self.step.is_told_by_roots.then_some(nothing),
        });
        self.step.may_be_free.extend(free);
        if !self.doubt(factor, scale, nothing) {
            let flagged_below = match self.flags_badly_told {
                true => self.scaled(self.tolerances.badly_told, scale),
                false => nothing,
            };
            self.watch(factor, flagged_below);
        }
        nothing
    }
}
