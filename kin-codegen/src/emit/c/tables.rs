//! Tables of numbers that Rust computes as constants, in `generated/univariate` of the runtime,
//! and C has no way to.

use super::language::signed;
use crate::emit::curly::data::PARTS;
use kin_runtime::__private::univariate::{coefficients_on_arc, cosine_of_turn};

/// The tables as C; those of degrees above 8 where there are any.
pub fn all(is_high: bool) -> String {
    let cosines: Vec<f64> = (0..PARTS).map(|i| cosine_of_turn(i, PARTS)).collect();
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

/// By place, and of each the cosines' and sines' by k.
fn basis(degree: usize) -> Vec<f64> {
    (0..=degree)
        .flat_map(|i| (0..=degree).flat_map(move |k| coefficients_on_arc(degree > 8, i, k)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use kin_runtime::__private::univariate::Eliminant;
    use std::f64::consts::TAU;

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
            assert!(
                (cosine_of_turn(i, PARTS) - angle.cos()).abs() < 1e-15,
                "{i}"
            );
        }
        assert_eq!(
            [0, 48, 96, 144].map(|i| cosine_of_turn(i, PARTS)),
            [1.0, 0.0, -1.0, 0.0]
        );
    }
}
