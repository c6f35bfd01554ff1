//! The robots. A property is a function of one robot; it becomes a test for
//! each of them.

/// Compiles the robots, and defines `for_every_robot!(property)`.
macro_rules! robots {
    ($($test:ident $name:ident $path:literal)*) => {
        $(kinematics::kinematics!($path);)*

        /// The files that are tested.
        pub const FILES: &[&str] = &[$($path),*];

        /// The generic function `$property(&Subject<_, N>)` as one test for
        /// every robot.
        macro_rules! for_every_robot {
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

#[test]
fn no_robot_is_left_out() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/robots");
    let entries = std::fs::read_dir(folder).unwrap();
    let mut files: Vec<String> = entries
        .map(|entry| format!("robots/{}", entry.unwrap().file_name().display()))
        .filter(|file| file.ends_with(".yaml") || file.ends_with(".urdf"))
        .collect();
    files.sort();
    assert_eq!(files, FILES);
}
