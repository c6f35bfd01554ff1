//! The frames of links that do not move against those of the chain, against
//! the robot file put together a second time, by urdf-rs and nalgebra.

use kinematics::{
    Body, Following, Frame, Kinematics, ParallelKinematics, Pose, Twist, WithBase, WithTool,
};
use nalgebra::{Isometry3, Matrix4, Translation3, Unit, UnitQuaternion, Vector3};
use std::path::Path;

kinematics::kinematics!("frames/cell.urdf", tip = "tool0", ik = none);
// Ends with a joint that follows another.
kinematics::kinematics!(
    "frames/cell.urdf",
    name = Forearm,
    tip = "forearm",
    ik = none
);
// Begins at a link that hangs on another of the same body.
kinematics::kinematics!(
    "frames/cell.urdf",
    name = Upper,
    base = "adapter",
    tip = "tool0",
    ik = none
);
// Ratings of the drives, and none of a joint that closes a loop.
kinematics::kinematics!("frames/rated.urdf", tip = "coupler");
kinematics::kinematics!("../robots/ur5e.urdf");
kinematics::kinematics!("../robots/kr6_r900.yaml");

/// The forearm's joint follows that of the arm, which it is hinged to at its
/// end.
const FOREARM: Body = Body::Following {
    link: Some(1),
    joints: &[Following {
        twist: Twist {
            linear: [0.0, -0.7, 0.0],
            angular: [0.0, 0.0, 1.0],
        },
        coordinate: 1,
        multiplier: -1.0,
        offset: 0.1,
    }],
};

/// The robot file as urdf-rs reads it.
struct Tree(urdf_rs::Robot);

impl Tree {
    fn cell() -> Self {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("frames/cell.urdf");
        Self(urdf_rs::read_file(file).unwrap())
    }

    /// A link's pose in the root, at values of joints by their names.
    fn pose(&self, link: &str, value: &dyn Fn(&str) -> f64) -> Isometry3<f64> {
        let joints = &self.0.joints;
        let Some(joint) = joints.iter().find(|joint| joint.child.link == link) else {
            return Isometry3::identity();
        };
        let [x, y, z] = joint.origin.xyz.0;
        let [roll, pitch, yaw] = joint.origin.rpy.0;
        let turn = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
        let origin = Isometry3::from_parts(Translation3::new(x, y, z), turn);
        self.pose(&joint.parent.link, value) * origin * motion(joint, value)
    }
}

fn motion(joint: &urdf_rs::Joint, value: &dyn Fn(&str) -> f64) -> Isometry3<f64> {
    let q = match &joint.mimic {
        None => value(&joint.name),
        Some(mimic) => {
            let (multiplier, offset) = (mimic.multiplier.unwrap(), mimic.offset.unwrap());
            multiplier * value(&mimic.joint) + offset
        }
    };
    let axis = Vector3::from(joint.axis.xyz.0);
    match joint.joint_type {
        urdf_rs::JointType::Fixed => Isometry3::identity(),
        urdf_rs::JointType::Prismatic => Translation3::from(axis * q).into(),
        _ => {
            let turn = UnitQuaternion::from_axis_angle(&Unit::new_normalize(axis), q);
            Isometry3::from_parts(Translation3::identity(), turn)
        }
    }
}

fn matrix(pose: &Pose) -> Matrix4<f64> {
    Matrix4::from_fn(|i, j| match (i, j) {
        (3, 3) => 1.0,
        (3, _) => 0.0,
        (_, 3) => pose.translation[i],
        _ => pose.rotation[i][j],
    })
}

fn assert_close(found: &Pose, expected: &Isometry3<f64>, what: &str) {
    let difference = (matrix(found) - expected.to_homogeneous()).amax();
    assert!(difference < 8e-15, "{what}: {difference:e}");
}

/// Every link that has a frame is where the file puts it, and no other has one.
fn check<const N: usize, K: Kinematics<N>>(robot: &K, links: &[&str]) {
    let tree = Tree::cell();
    for k in 0..20 {
        let q: [f64; N] = std::array::from_fn(|i| ((3 * k + i) as f64 * 1.618).sin());
        let value = |name: &str| {
            let found = K::JOINT_NAMES.iter().position(|joint| *joint == name);
            // Joints off the chain move nothing that is asked for.
            found.map_or(0.3, |i| q[i])
        };
        let base = tree.pose(K::BASE, &value).inverse();
        for link in &tree.0.links {
            let expected = base * tree.pose(&link.name, &value);
            let frame = robot.frame(&link.name);
            assert_eq!(
                frame.is_some(),
                links.contains(&&link.name[..]),
                "{}",
                link.name
            );
            if let Some(frame) = frame {
                assert_eq!(frame.name, link.name);
                assert_close(&robot.fk_frame(&q, &frame), &expected, &link.name);
            }
        }
        // Also the tip's, by the link that carries it.
        for frame in K::FRAMES {
            let expected = base * tree.pose(frame.name, &value);
            assert_close(&robot.fk_frame(&q, frame), &expected, frame.name);
        }
    }
}

fn names<const N: usize, K: Kinematics<N>>(_: &K) -> Vec<(&'static str, Body)> {
    K::FRAMES
        .iter()
        .map(|frame| (frame.name, frame.body))
        .collect()
}

#[test]
fn links_before_between_and_behind_joints_are_where_the_file_puts_them() {
    assert_eq!(Cell::LINK_NAMES, ["column", "arm", "rail", "wrist"]);
    assert_eq!(
        names(&Cell),
        [
            ("pedestal", Body::Base),
            ("beacon", Body::Base),
            ("camera_mount", Body::Link(0)),
            ("camera_optical_frame", Body::Link(0)),
            ("adapter", Body::Link(0)),
            ("forearm", FOREARM),
            ("forearm_sensor", FOREARM),
            ("tool_changer", Body::Link(3)),
            ("tool0", Body::Link(3)),
        ]
    );
    let links: Vec<&str> = [&["world"][..], &Cell::LINK_NAMES].concat();
    let fixed = Cell::FRAMES.iter().map(|frame| frame.name);
    check(&Cell, &links.into_iter().chain(fixed).collect::<Vec<_>>());
    // What fingers carry moves.
    for name in ["finger", "finger_pad", "nothing", ""] {
        assert_eq!(Cell.frame(name), None, "{name}");
    }
}

#[test]
fn behind_a_last_joint_that_follows_others_the_tip_carries() {
    assert_eq!(Forearm::LINK_NAMES, ["column", "arm"]);
    let sensor = Forearm.frame("forearm_sensor").unwrap();
    assert_eq!(sensor.body, Body::Tip);
    assert_eq!(sensor.pose.translation, [0.2, 0.05, 0.0]);
    let links = [
        "world",
        "pedestal",
        "beacon",
        "column",
        "camera_mount",
        "camera_optical_frame",
        "adapter",
        "arm",
        "forearm",
        "forearm_sensor",
    ];
    check(&Forearm, &links);
}

#[test]
fn a_base_that_hangs_on_its_body_carries_the_rest_of_it() {
    assert_eq!(
        names(&Upper)[..3],
        [
            ("column", Body::Base),
            ("camera_mount", Body::Base),
            ("camera_optical_frame", Body::Base),
        ]
    );
    let links = [
        "adapter",
        "column",
        "camera_mount",
        "camera_optical_frame",
        "arm",
        "forearm",
        "forearm_sensor",
        "rail",
        "wrist",
        "tool_changer",
        "tool0",
    ];
    check(&Upper, &links);
}

#[test]
fn tools_and_bases_keep_the_frames_of_the_robot() {
    let q = [0.4, -0.3, 0.2, 1.1];
    let base = Pose::from_rpy([0.3, -0.2, 0.9], [0.5, 0.1, -0.7]);
    let tool = Pose::from_translation([0.0, 0.1, 0.2]);
    for frame in [Cell.frame("camera_mount"), Cell.frame("tool0")] {
        let frame: Frame = frame.unwrap();
        let own = Cell.fk_frame(&q, &frame);
        let robot = WithTool { robot: Cell, tool };
        assert_eq!(robot.fk_frame(&q, &frame), own);
        assert_eq!(WithBase { robot, base }.fk_frame(&q, &frame), base * own);
    }
}

#[test]
fn the_tip_of_a_ur5e_and_of_a_kr_6_is_a_frame_of_the_last_link() {
    let q = [0.3, -1.2, 1.5, -0.7, 1.1, 0.4];
    let ahead = Pose::from_translation([0.0, 0.0, 0.0996]);
    assert_eq!(Ur5e::FRAMES, [Frame::on_link("tool0", 5, ahead)]);
    let [tool0] = Kr6R900::FRAMES else {
        panic!("{:?}", Kr6R900::FRAMES)
    };
    // Turned by a quarter about y.
    let rotation = [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]];
    let translation = [0.0; 3];
    let turned = Pose {
        rotation,
        translation,
    };
    assert_eq!(*tool0, Frame::on_link("tool0", 5, turned));
    let tips = [
        (Ur5e.fk_frame(&q, &Ur5e::FRAMES[0]), Ur5e.fk(&q)),
        (Kr6R900.fk_frame(&q, tool0), Kr6R900.fk(&q)),
    ];
    for (found, tip) in tips {
        assert!(
            (matrix(&found) - matrix(&tip)).amax() < 2e-15,
            "{found:?} {tip:?}"
        );
    }
}

#[test]
fn mechanisms_have_the_ratings_of_their_joints() {
    assert_eq!(
        Rated::JOINT_NAMES,
        ["driven", "pin", "following", "closing"]
    );
    const NONE: f64 = f64::INFINITY;
    assert_eq!(Rated::VELOCITY_LIMITS, [2.5, 3.0, NONE, NONE]);
    assert_eq!(Rated::EFFORT_LIMITS, [40.0, NONE, NONE, NONE]);
    fn seen<P: ParallelKinematics<4, 1, 2>>(_: P) -> [[f64; 4]; 2] {
        [P::VELOCITY_LIMITS, P::EFFORT_LIMITS]
    }
    assert_eq!(seen(Rated), [Rated::VELOCITY_LIMITS, Rated::EFFORT_LIMITS]);
}
