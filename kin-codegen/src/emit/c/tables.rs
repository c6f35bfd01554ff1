//! Tables of numbers that Rust computes as constants, in `generated/univariate` of the runtime,
//! and C has no way to.

use super::language::signed;
use kin_runtime::__private::math;
use std::f64::consts::TAU;

/// Parts of a turn: 24 and 32 samples, their halves and 16 arcs are on it.
const PARTS: usize = 192;

/// The tangent of a quarter of an arc, `REACH` of `bernstein.rs`.
const REACH: f64 = 0.098_491_403_357_164_25;

/// The tables as C; those of degrees above 8 where there are any.
pub fn all(is_high: bool) -> String {
    let cosines: Vec<f64> = (0..PARTS).map(cosine).collect();
    let high = match is_high {
        true => table("kin_high_basis", &basis(12)),
        false => "#define kin_high_basis kin_low_basis\n".into(),
    };
    format!(
        "/* Cosines of parts of a turn. */\n{}\n/* Of cos k a, and of sin k a by i, their \
         coefficients in Bernstein's basis on an arc about\n * a = 0: by place, one half of all, and k. \
         */\n{}{high}",
        table("kin_cosines", &cosines),
        table("kin_low_basis", &basis(8)),
    )
}

fn table(name: &str, values: &[f64]) -> String {
    let lines: Vec<String> = values
        .chunks(4)
        .map(|line| {
            let line: Vec<String> = line.iter().map(|&x| signed(x)).collect();
            line.join(", ")
        })
        .collect();
    let (count, lines) = (values.len(), lines.join(",\n    "));
    format!("static const double {name}[{count}] = {{\n    {lines}}};\n")
}

/// cos 2πi/192, from an angle of an eighth of a turn at most.
fn cosine(i: usize) -> f64 {
    let octant = PARTS / 8;
    let angle = |i: usize| TAU * i as f64 / PARTS as f64;
    let (sine, cosine) = (|i| math::sin_cos(angle(i)).0, |i| math::sin_cos(angle(i)).1);
    match i / octant {
        0 => cosine(i),
        1 => sine(2 * octant - i),
        2 => -sine(i - 2 * octant),
        3 => -cosine(4 * octant - i),
        _ if i == PARTS / 2 => -1.0,
        _ => self::cosine(PARTS - i),
    }
}

/// cos kφ + i sin kφ = (1 + it)ᵈ⁺ᵏ (1 − it)ᵈ⁻ᵏ / (1 + t²)ᵈ on an arc about φ = 0: the coefficients of
/// the numerator's real and imaginary part in Bernstein's basis. Products of polynomials are
/// convolutions of these times binomials.
fn basis(d: usize) -> Vec<f64> {
    let count = 2 * d + 1;
    let mut all = vec![[0.0; 2]; (d + 1) * (d + 1)];
    for k in 0..=d {
        let mut product = vec![[0.0; 2]; count];
        product[0] = [1.0, 0.0];
        for factor in 0..2 * d {
            let reach = if factor < d + k { REACH } else { -REACH };
            for i in (0..=factor + 1).rev() {
                let [x, y] = product[i];
                let mut next = [x + reach * y, y - reach * x];
                if i > 0 {
                    let [x, y] = product[i - 1];
                    next = [next[0] + x - reach * y, next[1] + y + reach * x];
                }
                product[i] = next;
            }
        }
        let mut binomial = 1.0;
        for (i, product) in product.iter().enumerate().take(d + 1) {
            all[(d + 1) * i + k] = product.map(|x| x / binomial);
            binomial = binomial * (2 * d - i) as f64 / (i + 1) as f64;
        }
    }
    all.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use kin_runtime::__private::univariate::Eliminant;

    /// The runtime's, from harmonics that are a cosine or a sine about the middle of the first
    /// arc.
    #[test]
    fn coefficients_are_those_of_the_runtime() {
        let middle = 0.0371;
        for (d, degree) in [(8, 8), (12, 10), (12, 12)] {
            let basis = basis(d);
            for k in 0..=degree {
                let (s, c) = (k as f64 * middle).sin_cos();
                for (part, [a, b]) in [[c, s], [-s, c]].into_iter().enumerate() {
                    let mut harmonics = [0.0; Eliminant::HARMONICS];
                    harmonics[k] = a;
                    if k > 0 {
                        harmonics[Eliminant::HARMONICS / 2 + k] = b;
                    }
                    let (arcs, count) = Eliminant::new(degree, harmonics, 0.0).on_arcs();
                    assert_eq!(count, 2 * d + 1);
                    for i in 0..=d {
                        let [here, there] = [i, 2 * d - i].map(|i| arcs[0][i]);
                        let expected = if part == 0 {
                            here + there
                        } else {
                            here - there
                        };
                        let written = basis[2 * ((d + 1) * i + k) + part];
                        assert!(
                            (0.5 * expected - written).abs() < 1e-14,
                            "{d} {k} {i} {part}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn cosines_are_those_of_a_turn() {
        for i in 0..PARTS {
            // An angle of up to a turn is itself rounded, by up to 9e-16.
            let angle = TAU * i as f64 / PARTS as f64;
            assert!((cosine(i) - angle.cos()).abs() < 1e-15, "{i}");
        }
        assert_eq!([0, 48, 96, 144].map(cosine), [1.0, 0.0, -1.0, 0.0]);
    }
}
