//! a = 1, b = 2.5, c = 2, d = 3: Freudenstein's equation.

use super::{CLOSED, FourBar};
use kinematics::__private::math::wrap;

const A: f64 = 1.0;
const B: f64 = 2.5;
const C: f64 = 2.0;
const D: f64 = 3.0;

/// The rocker's angle at home, where the crank lies along the frame.
fn rocker_at_home() -> f64 {
    let along = ((D - A) * (D - A) + B * B - C * C) / (2.0 * (D - A));
    let across = (B * B - along * along).sqrt();
    across.atan2(A + along - D)
}

#[test]
fn golden_rocker_angles_and_rate_ratios_at_50_degrees() {
    let found = FourBar.fk(&[50_f64.to_radians()]);
    assert_eq!(found.len(), 2);
    for (angle, ratio) in [(-131.12535, -0.495481), (95.11921, 0.193243)] {
        let rocker = |q: &[f64; 4]| (q[2] + rocker_at_home()).to_degrees();
        let near = |q: &[f64; 4]| wrap((rocker(q) - angle).to_radians()).abs() < 1e-7;
        let assembly = found.iter().find(|s| near(&s.q)).unwrap();
        assert!(assembly.residual < CLOSED && !assembly.singular);
        let rates = FourBar.joint_rates(&assembly.q, &[1.0]).unwrap();
        assert!((rates[0] - 1.0).abs() < 1e-14);
        assert!((rates[2] - ratio).abs() < 1e-6, "{rates:?}");
    }
}

#[test]
fn freudenstein_s_equation_holds_for_the_whole_turn() {
    let (k1, k2) = (D / A, D / C);
    let k3 = (A * A - B * B + C * C + D * D) / (2.0 * A * C);
    for degrees in 0..360 {
        let crank = f64::from(degrees).to_radians();
        let found = FourBar.fk(&[crank]);
        assert_eq!(found.len(), 2, "{degrees}");
        for assembly in &found {
            let rocker = assembly.q[2] + rocker_at_home();
            let equation = k1 * rocker.cos() - k2 * crank.cos() + k3 - (crank - rocker).cos();
            assert!(equation.abs() < 1e-13, "{degrees}: {equation:e}");
        }
    }
}

#[test]
fn mobility_is_one() {
    assert_eq!(FourBar::MOBILITY, 1);
    let generic = super::generic("../robots/four_bar.yaml");
    assert_eq!((generic.gruebler(3), generic.gruebler(6)), (1, -2));
}

/// With the rocker driven, the linkage has a dead point where crank and coupler
/// are in line; with the crank driven, as here, where coupler and rocker are,
/// which a crank-rocker never reaches.
#[test]
fn a_crank_rocker_driven_at_the_crank_has_no_actuator_singularity() {
    let least = (0..3600)
        .flat_map(|k| FourBar.fk(&[f64::from(k).to_radians() / 10.0]))
        .map(|s| FourBar.actuator_singularity(&s.q))
        .fold(f64::INFINITY, f64::min);
    assert!(least > 0.1, "{least}");
}
