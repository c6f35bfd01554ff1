//! The same arms in the types of other crates.

use kinematics::Pose;

/// The arm of a URDF, in `k`.
pub struct InK(k::SerialChain<f64>);

impl InK {
    pub fn new(urdf: &str, last_joint: &str) -> Self {
        let tree = k::Chain::<f64>::from_urdf_file(urdf).expect("k reads the URDF");
        let last = tree.find(last_joint).expect("k knows the last joint");
        InK(k::SerialChain::from_end(last))
    }

    pub fn fk(&self, q: &[f64; 6]) -> k::Isometry3<f64> {
        self.0.set_joint_positions_unchecked(q);
        self.0.end_transform()
    }

    pub fn jacobian(&self, q: &[f64; 6]) -> k::nalgebra::DMatrix<f64> {
        self.0.set_joint_positions_unchecked(q);
        k::jacobian(&self.0)
    }
}

/// A pose of `k` as ours.
pub fn from_k(isometry: &k::Isometry3<f64>) -> Pose {
    let matrix = isometry.to_homogeneous();
    Pose::from_matrix(&std::array::from_fn(|i| {
        std::array::from_fn(|j| matrix[(i, j)])
    }))
}

/// What one writes by hand with nalgebra: the fixed transforms of a URDF, and
/// a rotation about z behind each.
pub struct ByHand {
    origins: [nalgebra::Isometry3<f64>; 6],
    tip: nalgebra::Isometry3<f64>,
}

impl ByHand {
    /// The UR5e of `robots/ur5e.urdf`.
    pub fn ur5e() -> Self {
        use nalgebra::{Isometry3, Vector3};
        use std::f64::consts::FRAC_PI_2;
        let origin = |x: f64, y: f64, z: f64, roll: f64| {
            Isometry3::new(Vector3::new(x, y, z), Vector3::x() * roll)
        };
        ByHand {
            origins: [
                origin(0.0, 0.0, 0.0, 0.0),
                origin(0.0, 0.0, 0.1625, FRAC_PI_2),
                origin(-0.425, 0.0, 0.0, 0.0),
                origin(-0.3922, 0.0, 0.0, 0.0),
                origin(0.0, 0.0, 0.1333, FRAC_PI_2),
                origin(0.0, 0.0, 0.0997, 0.0) * origin(0.0, 0.0, 0.0, -FRAC_PI_2),
            ],
            tip: origin(0.0, 0.0, 0.0996, 0.0),
        }
    }

    pub fn fk(&self, q: &[f64; 6]) -> nalgebra::Isometry3<f64> {
        let base = nalgebra::Isometry3::identity();
        let links = self.origins.iter().zip(q);
        let last = links.fold(base, |link, (origin, &angle)| {
            let axis = nalgebra::Vector3::z_axis();
            link * origin * nalgebra::UnitQuaternion::from_axis_angle(&axis, angle)
        });
        last * self.tip
    }
}

/// The KR 6 R900 of `robots/kr6_r900.yaml` in rs-opw-kinematics.
pub fn kr6_in_opw() -> rs_opw_kinematics::kinematics_impl::OPWKinematics {
    use rs_opw_kinematics::parameters::opw_kinematics::Parameters;
    rs_opw_kinematics::kinematics_impl::OPWKinematics::new(Parameters {
        a2: -0.035,
        c4: 0.08,
        ..Parameters::kuka_kr6_r900_2()
    })
}

/// A pose of rs-opw-kinematics as ours.
pub fn from_opw(pose: &rs_opw_kinematics::pose::Pose) -> Pose {
    Pose::from_quaternion(pose.rotation.to_array(), pose.translation.to_array())
}

/// Ours as a pose of rs-opw-kinematics.
pub fn to_opw(pose: &Pose) -> rs_opw_kinematics::pose::Pose {
    use rs_opw_kinematics::glam::{DQuat, DVec3};
    rs_opw_kinematics::pose::Pose::from_parts(
        DVec3::from_array(pose.translation),
        DQuat::from_array(pose.quaternion()),
    )
}

#[cfg(feature = "ik-geo")]
pub use geo::InGeo;

#[cfg(feature = "ik-geo")]
mod geo {
    use super::Pose;
    use ik_geo::inverse_kinematics::auxiliary::{Kinematics, Matrix3x7};
    use ik_geo::robot::{IKSolver, Robot};
    use nalgebra_032::{Matrix3, Matrix3x6, Vector3};

    /// An arm in ik-geo, whose tool frame is the base frame at home.
    pub struct InGeo {
        robot: Robot,
        home: Matrix3<f64>,
    }

    impl InGeo {
        pub fn ur5e(home: &Pose) -> Self {
            let axes = [
                [0, 0, 1],
                [0, -1, 0],
                [0, -1, 0],
                [0, -1, 0],
                [0, 0, -1],
                [0, -1, 0],
            ];
            let steps = [
                [0.0, 0.0, 0.1625],
                [0.0; 3],
                [-0.425, 0.0, 0.0],
                [-0.3922, 0.0, 0.0],
                [0.0, -0.1333, 0.0],
                [0.0, 0.0, -0.0997],
                [0.0, -0.0996, 0.0],
            ];
            let kinematics = kinematics(axes, steps);
            Self::new(Robot::three_parallel_two_intersecting(kinematics), home)
        }

        pub fn kr6(home: &Pose) -> Self {
            let axes = [
                [0, 0, -1],
                [0, 1, 0],
                [0, 1, 0],
                [-1, 0, 0],
                [0, 1, 0],
                [-1, 0, 0],
            ];
            let steps = [
                [0.0, 0.0, 0.4],
                [0.025, 0.0, 0.0],
                [0.455, 0.0, 0.0],
                [0.42, 0.0, 0.035],
                [0.0; 3],
                [0.0; 3],
                [0.08, 0.0, 0.0],
            ];
            let kinematics = kinematics(axes, steps);
            Self::new(Robot::spherical_two_parallel(kinematics), home)
        }

        fn new(robot: Robot, home: &Pose) -> Self {
            let home = Matrix3::from_fn(|i, j| home.rotation[i][j]);
            InGeo { robot, home }
        }

        pub fn fk(&self, q: &[f64; 6]) -> (Matrix3<f64>, Vector3<f64>) {
            self.robot.fk(q)
        }

        /// Its pose, with our tool frame.
        pub fn pose(&self, q: &[f64; 6]) -> Pose {
            let (rotation, translation) = self.fk(q);
            let rotation = rotation * self.home;
            Pose {
                rotation: std::array::from_fn(|i| std::array::from_fn(|j| rotation[(i, j)])),
                translation: translation.into(),
            }
        }

        /// Its exact solutions; it marks those that only come nearest.
        pub fn ik(&self, target: &Pose) -> Vec<[f64; 6]> {
            let rotation = Matrix3::from_fn(|i, j| target.rotation[i][j]) * self.home.transpose();
            let all = self.robot.ik(rotation, target.translation.into());
            let exact = all.into_iter().filter(|(_, least_squares)| !least_squares);
            exact.map(|(q, _)| q.into()).collect()
        }
    }

    fn kinematics(axes: [[i32; 3]; 6], steps: [[f64; 3]; 7]) -> Kinematics<6, 7> {
        let axes = axes.map(|axis| Vector3::from(axis.map(f64::from)));
        let steps = steps.map(Vector3::from);
        let mut kinematics = Kinematics::new();
        kinematics.h = Matrix3x6::from_columns(&axes);
        kinematics.p = Matrix3x7::from_columns(&steps);
        kinematics
    }
}
