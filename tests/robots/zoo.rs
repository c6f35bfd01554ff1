//! The robots: all of `robots/`, and some whose files are noisy. A property is
//! a function of one robot; it becomes a test for each of them.

/// Compiles robots, and defines a macro `$for_every!(property)` that makes the
/// generic function `property(&Subject<_, N>)` one test for each of them.
macro_rules! robots {
    ($files:ident $for_every:ident: $($test:ident $name:ident $path:literal)*) => {
        $(kinematics::kinematics!($path);)*

        /// Where they are described.
        pub const $files: &[&str] = &[$($path),*];

        macro_rules! $for_every {
            ($property:ident) => {
                mod $property {
                    use crate::{subject::Subject, zoo};
                    $(#[test]
                    fn $test() {
                        super::$property(&Subject::new(zoo::$name, $path));
                    })*
                }
            };
        }
    };
}

robots! {
    EXACT for_every_robot:
    elbow Elbow "robots/elbow.yaml"
    inverse_elbow InverseElbow "robots/inverse_elbow.yaml"
    irb6640 Irb6640 "robots/irb6640.yaml"
    kr6_r900 Kr6R900 "robots/kr6_r900.yaml"
    planar_2r Planar2r "robots/planar_2r.yaml"
    planar_3r Planar3r "robots/planar_3r.yaml"
    puma560 Puma560 "robots/puma560.yaml"
    scara Scara "robots/scara.yaml"
    stanford Stanford "robots/stanford.yaml"
    tx60 Tx60 "robots/tx60.yaml"
    ur10e Ur10e "robots/ur10e.yaml"
    ur5e Ur5e "robots/ur5e.urdf"
}

robots! {
    NOISY for_every_noisy_robot:
    calibrated Calibrated "tests/robots/noisy/calibrated.yaml"
    rounded_right_angles RoundedRightAngles "tests/robots/noisy/rounded_right_angles.yaml"
    stray_offset StrayOffset "tests/robots/noisy/stray_offset.yaml"
    ten_digits TenDigits "tests/robots/noisy/ten_digits.yaml"
    truncated_pi TruncatedPi "tests/robots/noisy/truncated_pi.yaml"
}

/// The files of a folder, by their paths in the project.
fn files(folder: &str) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut files: Vec<String> = entries
        .map(|entry| format!("{folder}/{}", entry.unwrap().file_name().display()))
        .filter(|file| file.ends_with(".yaml") || file.ends_with(".urdf"))
        .collect();
    files.sort();
    files
}

#[test]
fn no_robot_is_left_out() {
    assert_eq!(files("robots"), EXACT);
    assert_eq!(files("tests/robots/noisy"), NOISY);
}
