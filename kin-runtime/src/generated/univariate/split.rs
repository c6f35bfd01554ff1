//! Where the other solutions near a nearly singular one are.

use super::frames::Frames;
use super::lanes::{InLanes, LANES, Lanes, dot, in_lanes};
use super::polish::{Factored, Forward, Rows, across, of_numbers};
use crate::Pose;
use core::f64::consts::FRAC_1_SQRT_2;

/// How far the second derivative is taken, radians.
const BEND: f64 = 1e-3;

/// So far the second order may tell anything, radians.
const FARTHEST: f64 = 0.5;

/// Near a nearly singular configuration, the three others at which the target may be reached, to second
/// order.
///
/// Where J loses one or two ranks, what is missing is e = J δ + ½ H(δ, δ) with δ = α₁ v₁ + α₂ v₂ + …
/// along the two directions that J takes nearest to zero, where Qₖ = vₖ·J⁻¹H make α + ½ Q(α, α) = ε of
/// it, two conics: the bifurcation equations of Lyapunov and Schmidt to second order (M. Golubitsky and
/// D. G. Schaeffer, Singularities and Groups in Bifurcation Theory I, 1985, chapter I). From a solution,
/// where ε = 0, the others are in the directions of three u to which Q(u, u) is parallel. So is nearly v₁
/// where J loses one rank alone. Along u the farther root of t + ½ t² u·Q(u, u) = u·ε is taken, for
/// Newton's method leads to the nearer; where there is none, or two of the directions are complex, what
/// is between the two. H is a second difference.
#[inline(never)]
pub(super) fn split(
    frames: &Frames,
    target: &Pose,
    q: &[[f64; LANES]; 6],
) -> [[[f64; LANES]; 6]; 3] {
    in_lanes::<Split, _>((frames, target, q))
}

struct Split;

impl InLanes<(&Frames, &Pose, &[[f64; LANES]; 6])> for Split {
    type Output = [[[f64; LANES]; 6]; 3];

    #[inline(always)]
    fn run<L: Lanes>((frames, target, q): (&Frames, &Pose, &[[f64; LANES]; 6])) -> Self::Output {
        apart::<L>(frames, target, q)
    }
}

#[inline(always)]
fn apart<L: Lanes>(
    frames: &Frames,
    target: &Pose,
    q: &[[f64; LANES]; 6],
) -> [[[f64; LANES]; 6]; 3] {
    let q = of_numbers::<L>(q);
    let (mut forward, mut jacobian) = (Forward::EMPTY, Factored::EMPTY);
    forward.compute(frames, target, &q);
    jacobian.factor(frames, &forward);
    let here = forward.error;
    let v = jacobian.weak(&[]);
    let w = jacobian.weak(&[v]);
    let weakest = [v, w];
    // H(v, v), H(v, w) and H(w, w), then J⁻¹ of them.
    let mut bent = [[L::ZERO; 6]; 3];
    let both = moved(&v, &w, L::ONE);
    for (bent, along) in bent.iter_mut().zip([&v, &both, &w]) {
        for i in 0..6 {
            bent[i] = here[i] + here[i];
        }
        for by in [BEND, -BEND] {
            forward.compute(frames, target, &moved(&q, along, L::splat(by)));
            for i in 0..6 {
                bent[i] = bent[i] - forward.error[i];
            }
        }
    }
    for i in 0..6 {
        bent[1][i] = (bent[1][i] - bent[0][i] - bent[2][i]).scaled(0.5);
    }
    // By the two directions: ε and Q, and what of both is across.
    let mut step = jacobian.solve(here);
    let e = [dot(&v, &step), dot(&w, &step)];
    across(&mut step, &weakest);
    let mut conics = [[L::ZERO; 3]; 2];
    for (i, bent) in bent.iter_mut().enumerate() {
        for bent in bent.iter_mut() {
            *bent = bent.scaled(1.0 / (BEND * BEND));
        }
        *bent = jacobian.solve(*bent);
        for (conic, v) in conics.iter_mut().zip(&weakest) {
            conic[i] = dot(v, bent);
        }
        across(bent, &weakest);
    }
    let mut out = [[[0.0; LANES]; 6]; 3];
    for (out, [x, y]) in out.iter_mut().zip(directions(parallel(&conics))) {
        let squares = [x * x, (x * y).scaled(2.0), y * y];
        let mut a = L::ZERO;
        for i in 0..3 {
            a = a.plus(&squares[i], &(x * conics[0][i]).plus(&y, &conics[1][i]));
        }
        let e = (x * e[0]).plus(&y, &e[1]);
        let root = L::ONE.plus(&(a + a), &e).max(L::ZERO).sqrt();
        let by = -(L::ONE + root) * a.inverse();
        let by = by.min(L::splat(FARTHEST)).max(L::splat(-FARTHEST));
        let half_square = (by * by).scaled(0.5);
        for i in 0..6 {
            let mut there = (q[i] + step[i]).plus(&by, &(x * v[i]).plus(&y, &w[i]));
            for (square, bent) in squares.iter().zip(&bent) {
                there = there.minus(&half_square, &(*square * bent[i]));
            }
            out[i] = there.numbers();
        }
    }
    out
}

/// The cubic form in u, by falling powers of its first number, that is zero where Q(u, u) is parallel to u.
#[inline(always)]
fn parallel<L: Lanes>([first, second]: &[[L; 3]; 2]) -> [L; 4] {
    [
        second[0],
        second[1] + second[1] - first[0],
        second[2] - first[1] - first[1],
        -first[2],
    ]
}

/// Steps of Newton's method towards a cubic's root from above: each is a third of the way at least.
const STEPS: usize = 20;

/// The directions, of length 1, of a cubic form's zeros, the real parts of two that are complex.
#[inline(always)]
fn directions<L: Lanes>(form: [L; 4]) -> [[L; 2]; 3] {
    // By a direction d in which the form is no less than in others, a zero is r d and the one at a right
    // angle to it.
    let (mut d, mut most) = ([L::ONE, L::ZERO], form[0].abs());
    for [x, y] in [
        [0.0, 1.0],
        [FRAC_1_SQRT_2, FRAC_1_SQRT_2],
        [FRAC_1_SQRT_2, -FRAC_1_SQRT_2],
    ] {
        let other = [L::splat(x), L::splat(y)];
        let size = value(&form, &other).abs();
        for i in 0..2 {
            d[i] = most.where_less(size, other[i], d[i]);
        }
        most = most.max(size);
    }
    let beside = [-d[1], d[0]];
    let by_lead = value(&form, &d).inverse();
    let a = slope(&form, &d, &beside) * by_lead;
    let b = slope(&form, &beside, &d) * by_lead;
    let c = value(&form, &beside) * by_lead;
    // y³ + p y + q = 0 of y = r + a/3: the root of the other sign than q is alone, the others are on
    // both sides of half of it, if they are real.
    let third = a.scaled(1.0 / 3.0);
    let p = b.minus(&a, &third);
    let q = (third * third * third).scaled(2.0).minus(&third, &b) + c;
    let size = q.abs();
    let mut y = L::ONE + p.abs() + size;
    for _ in 0..STEPS {
        let square = y * y;
        let rise = p.plus_scaled(&square, 3.0);
        y = (square * y).scaled(2.0).plus(&size, &L::ONE) * rise.inverse();
    }
    let y = q.where_less(L::ZERO, y, -y);
    let gap = (-p).plus_scaled(&(y * y), -0.75).max(L::ZERO).sqrt();
    let middle = y.scaled(-0.5);
    let mut out = [d; 3];
    for (out, y) in out.iter_mut().zip([y, middle + gap, middle - gap]) {
        let r = y - third;
        let share = L::ONE.plus(&r, &r).sqrt().inverse();
        for i in 0..2 {
            out[i] = beside[i].plus(&r, &d[i]) * share;
        }
    }
    out
}

#[inline(always)]
fn value<L: Lanes>(form: &[L; 4], [x, y]: &[L; 2]) -> L {
    let first = (*x * form[0]).plus(y, &form[1]);
    let last = (*x * form[2]).plus(y, &form[3]);
    (*x * *x * first).plus(&(*y * *y), &last)
}

/// How fast it grows from u in a direction.
#[inline(always)]
fn slope<L: Lanes>(form: &[L; 4], [x, y]: &[L; 2], [along_x, along_y]: &[L; 2]) -> L {
    let (xx, xy, yy) = (*x * *x, (*x * *y).scaled(2.0), *y * *y);
    let by_x = (xx * form[0])
        .scaled(3.0)
        .plus(&xy, &form[1])
        .plus(&yy, &form[2]);
    let by_y = (yy * form[3])
        .scaled(3.0)
        .plus(&xy, &form[2])
        .plus(&xx, &form[1]);
    (*along_x * by_x).plus(along_y, &by_y)
}

/// q + by v.
#[inline(always)]
fn moved<L: Lanes>(q: &Rows<L>, v: &Rows<L>, by: L) -> Rows<L> {
    let mut out = *q;
    for (out, v) in out.iter_mut().zip(v) {
        *out = out.plus(&by, v);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::super::lanes::Portable;
    use super::*;

    /// Of forms that are products of linear ones: three real, which may be the directions that are
    /// tried, or the same; and one with two complex ones, whose real part is told.
    #[test]
    fn directions_are_the_zeros_of_the_form() {
        let product = |[a, b, c]: [f64; 3], last: [f64; 3]| {
            let at = |t: f64| [t.cos(), t.sin()];
            let [[xa, ya], [xb, yb], [xc, yc]] = [at(a), at(b), at(c)];
            let square = match last {
                [0.0, 0.0, 0.0] => [yb * yc, -(xb * yc + yb * xc), xb * xc],
                other => other,
            };
            let [s0, s1, s2] = square;
            [ya * s0, ya * s1 - xa * s0, ya * s2 - xa * s1, -xa * s2]
        };
        let quarter = core::f64::consts::FRAC_PI_4;
        let mut tried = 0;
        for zeros in [
            [0.3, 1.2, 2.5],
            [0.0, 2.0 * quarter, quarter],
            [0.0, 2.0 * quarter, 3.0 * quarter],
            [0.0, 1e-3, 2.0 * quarter],
            [1.0, 1.0, 2.0],
            [2.9, 2.9, 2.9],
        ] {
            let form = product(zeros, [0.0; 3]).map(|x| Portable::splat(1e5 * x));
            let found = directions(form).map(|[x, y]| (y.numbers()[3] / x.numbers()[3]).atan());
            for zero in zeros {
                let off = |x: &f64| (x - zero).sin().abs();
                let nearest = found.iter().map(off).fold(1.0, f64::min);
                // A root of three is known to a third of the digits.
                assert!(nearest < 2e-3, "{zeros:?}: {found:?}");
                tried += usize::from(nearest < 1e-7);
            }
        }
        assert!(tried > 12, "{tried}");
        // x² + y²: from d = (1, 0) its zeros are ± i, from the first of the form.
        let form = product([0.7, 0.0, 0.0], [1.0, 0.0, 1.0]).map(Portable::splat);
        let found = directions(form).map(|u| u.map(|x| x.numbers()[0]));
        assert!((found[0][1] / found[0][0] - 0.7_f64.tan()).abs() < 1e-12);
        assert_eq!(found[1], found[2]);
    }
}
