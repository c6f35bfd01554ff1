//! Robots in `f32` against the same in `f64`, and against what was certified.

#[path = "../random.rs"]
mod random;

mod forward;
mod inverse;
mod refused;
mod subject;

use subject::Subject;

macro_rules! robot {
    ($name:ident, $file:literal) => {
        mod $name {
            pub mod double {
                kinematics::kinematics!($file, name = Arm);
            }
            pub mod single {
                kinematics::kinematics!($file, name = Arm, scalar = f32);
            }

            #[test]
            fn forward_kinematics_has_seven_digits() {
                crate::forward::has_seven_digits(&super::Subject::new(
                    single::Arm,
                    double::Arm,
                    $file,
                ));
            }

            #[test]
            fn no_solution_is_lost_or_invented() {
                crate::inverse::loses_nothing(&super::Subject::new(
                    single::Arm,
                    double::Arm,
                    $file,
                ));
            }

            #[test]
            fn what_is_generated_is_what_was_certified() {
                crate::inverse::is_certified(&super::Subject::new(single::Arm, double::Arm, $file));
            }

            #[test]
            fn the_nearest_is_that_of_all() {
                crate::inverse::chooses(&super::Subject::new(single::Arm, double::Arm, $file));
            }
        }
    };
}

robot!(three_parallel_axes, "../robots/ur5e.urdf");
robot!(spherical_wrist, "../robots/kr6_r900.yaml");
robot!(offset_shoulder, "../robots/puma560.yaml");
robot!(slide, "../robots/stanford.yaml");
robot!(four_joints, "../robots/scara.yaml");

#[test]
fn a_straight_wrist_rests() {
    use {offset_shoulder as puma, spherical_wrist as kr6};
    let file = "../robots/kr6_r900.yaml";
    inverse::rests(&Subject::new(kr6::single::Arm, kr6::double::Arm, file));
    let file = "../robots/puma560.yaml";
    inverse::rests(&Subject::new(puma::single::Arm, puma::double::Arm, file));
}
