//! Section 3.5: parallel mechanisms, compiled, against textbook formulas of
//! each, the generic mechanism of the runtime, and differences.

mod delta;
mod five_bar;
mod four_bar;
mod led;
mod loop_joints;
mod properties;
mod slider_crank;
mod stewart;

kinematics::kinematics!("../robots/delta.yaml");
kinematics::kinematics!("../robots/five_bar.yaml");
kinematics::kinematics!("../robots/four_bar.yaml");
kinematics::kinematics!("../robots/slider_crank.yaml");
kinematics::kinematics!("../robots/stewart.yaml");
kinematics::kinematics!("robots/led.yaml");

use kin_codegen::mechanism::Mechanism;
use kin_codegen::spec::{MechanismSpec, Source};
use std::path::Path;

/// Loops count as closed below this, relative to the mechanism's length.
const CLOSED: f64 = 1e-12;

/// A robot of the project as the runtime's generic mechanism.
fn generic(file: &str) -> kinematics::Mechanism {
    let source = Source::read(file, Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap();
    let spec = MechanismSpec::parse(&source).unwrap();
    Mechanism::new(&spec, None, None).unwrap().generic()
}

/// Whether two configurations are the same, angles modulo a turn.
fn same<const N: usize>(a: &[f64; N], b: &[f64; N], tolerance: f64) -> bool {
    (0..N).all(|i| kinematics::__private::math::wrap(a[i] - b[i]).abs() < tolerance)
}
