//! The robots of `robots/` against forward kinematics written down a second
//! time: by Denavit-Hartenberg matrices, closed formulas, or published poses.

use kin_codegen::mechanism::Mechanism;
use kin_codegen::model::{JointKind, Model};
use kin_codegen::spec::{ArmSpec, Source, Spec};
use nalgebra::{
    Isometry3, Matrix3, Matrix4, Rotation3, Translation3, Unit, UnitQuaternion, Vector3,
};
use std::f64::consts::{FRAC_PI_2, PI};
use std::path::Path;

fn robot(file: &str) -> Model {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../robots")
        .join(file);
    let text = std::fs::read_to_string(&path).unwrap();
    let spec = ArmSpec::parse(&Source {
        path: file.into(),
        text,
    });
    Model::new(&spec.unwrap_or_else(|e| panic!("{e}")), None, None)
        .unwrap_or_else(|e| panic!("{e}"))
}

/// The product of exponentials of a model, by nalgebra.
fn fk(model: &Model, q: &[f64]) -> Matrix4<f64> {
    let mut pose = Matrix4::<f64>::identity();
    for joint in &model.joints {
        let value = joint.multiplier * q[joint.variable] + joint.offset;
        let axis = Vector3::from(joint.axis);
        let motion = match joint.kind {
            JointKind::Prismatic => Translation3::from(axis * value).to_homogeneous(),
            JointKind::Revolute => {
                let there = Translation3::from(Vector3::from(joint.point));
                let turn = Rotation3::from_axis_angle(&Unit::new_unchecked(axis), value);
                (there * UnitQuaternion::from(turn) * there.inverse()).to_homogeneous()
            }
        };
        pose *= motion;
    }
    pose * matrix(&model.home)
}

fn matrix(pose: &kin_runtime::Pose) -> Matrix4<f64> {
    Matrix4::from_fn(|i, j| match (i, j) {
        (3, 3) => 1.0,
        (3, _) => 0.0,
        (_, 3) => pose.translation[i],
        _ => pose.rotation[i][j],
    })
}

fn assert_close(a: Matrix4<f64>, b: Matrix4<f64>) {
    assert!((a - b).amax() < 1e-12, "{a}{b}");
}

fn position(pose: &Matrix4<f64>) -> [f64; 3] {
    [pose[(0, 3)], pose[(1, 3)], pose[(2, 3)]]
}

fn assert_position(pose: &Matrix4<f64>, expected: [f64; 3], tolerance: f64) {
    let p = position(pose);
    assert!(
        (0..3).all(|i| (p[i] - expected[i]).abs() < tolerance),
        "{p:?} is not {expected:?}"
    );
}

/// Joint values that reach into every quadrant.
fn samples(n: usize) -> impl Iterator<Item = Vec<f64>> {
    (0..50).map(move |k| {
        (0..n)
            .map(|i| 3.0 * ((k * 7 + i * 3) as f64 * 1.37 + 0.4).sin())
            .collect()
    })
}

fn about_x(angle: f64) -> Matrix4<f64> {
    Rotation3::from_axis_angle(&Vector3::x_axis(), angle).to_homogeneous()
}

fn about_z(angle: f64) -> Matrix4<f64> {
    Rotation3::from_axis_angle(&Vector3::z_axis(), angle).to_homogeneous()
}

fn shift(x: f64, y: f64, z: f64) -> Matrix4<f64> {
    Translation3::new(x, y, z).to_homogeneous()
}

/// Rows of d, a, alpha.
fn standard_dh(rows: &[[f64; 3]], q: &[f64]) -> Matrix4<f64> {
    let links = rows
        .iter()
        .zip(q)
        .map(|(&[d, a, alpha], q)| about_z(*q) * shift(a, 0.0, d) * about_x(alpha));
    links.product()
}

/// Rows of alpha, a, d.
fn modified_dh(rows: &[[f64; 3]], q: &[f64]) -> Matrix4<f64> {
    let links = rows
        .iter()
        .zip(q)
        .map(|(&[alpha, a, d], q)| about_x(alpha) * shift(a, 0.0, d) * about_z(*q));
    links.product()
}

#[test]
fn universal_robots_by_standard_parameters() {
    let ur5e = [
        [0.1625, 0.0, FRAC_PI_2],
        [0.0, -0.425, 0.0],
        [0.0, -0.3922, 0.0],
        [0.1333, 0.0, FRAC_PI_2],
        [0.0997, 0.0, -FRAC_PI_2],
        [0.0996, 0.0, 0.0],
    ];
    let ur10e = [
        [0.1807, 0.0, FRAC_PI_2],
        [0.0, -0.6127, 0.0],
        [0.0, -0.57155, 0.0],
        [0.17415, 0.0, FRAC_PI_2],
        [0.11985, 0.0, -FRAC_PI_2],
        [0.11655, 0.0, 0.0],
    ];
    for (file, rows) in [("ur5e.urdf", ur5e), ("ur10e.yaml", ur10e)] {
        let model = robot(file);
        samples(6).for_each(|q| assert_close(fk(&model, &q), standard_dh(&rows, &q)));
    }
}

#[test]
fn the_frames_of_parameters_are_the_link_frames() {
    let model = robot("ur10e.yaml");
    let shoulder = model.joints[0].frame;
    assert_eq!(shoulder.translation, [0.0, 0.0, 0.1807]);
    assert_eq!(
        shoulder.rotation,
        [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]
    );
    assert_eq!(model.joints[5].frame, model.home);
}

#[test]
fn puma_by_modified_parameters() {
    let rows = [
        [0.0, 0.0, 0.0],
        [-FRAC_PI_2, 0.0, 0.2435],
        [0.0, 0.4318, -0.0934],
        [FRAC_PI_2, -0.0203, 0.4331],
        [-FRAC_PI_2, 0.0, 0.0],
        [FRAC_PI_2, 0.0, 0.0],
    ];
    let model = robot("puma560.yaml");
    samples(6).for_each(|q| assert_close(fk(&model, &q), modified_dh(&rows, &q)));
}

#[test]
fn irb6640_by_axes_and_offsets() {
    let axes = [
        Vector3::z(),
        Vector3::y(),
        Vector3::y(),
        Vector3::x(),
        Vector3::y(),
        Vector3::x(),
    ];
    let offsets = [
        [0.32, 0.0, 0.78],
        [0.0, 0.0, 1.075],
        [1.1425, 0.0, 0.2],
        [0.0; 3],
        [0.0; 3],
        [0.2, 0.0, 0.0],
    ];
    let model = robot("irb6640.yaml");
    for q in samples(6) {
        let mut rotation = Matrix3::identity();
        let mut p = Vector3::zeros();
        for i in 0..6 {
            rotation *= Rotation3::from_axis_angle(&Unit::new_unchecked(axes[i]), q[i]).matrix();
            p += rotation * Vector3::from(offsets[i]);
        }
        let mut expected = rotation.to_homogeneous();
        expected.fixed_view_mut::<3, 1>(0, 3).copy_from(&p);
        assert_close(fk(&model, &q), expected);
    }
}

/// KUKA's data sheet draws the arm with A2 = -90 and A3 = 90 degrees.
#[test]
fn kr6_at_the_pose_of_its_data_sheet() {
    let pose = fk(
        &robot("kr6_r900.yaml"),
        &[0.0, -FRAC_PI_2, FRAC_PI_2, 0.0, 0.0, 0.0],
    );
    assert_position(&pose, [0.525, 0.0, 0.890], 1e-12);
    let out_of_the_flange = pose.column(2).xyz();
    assert!((out_of_the_flange - Vector3::x()).amax() < 1e-12);
    // A1 turns clockwise seen from above, as on the real arm.
    let turned = fk(
        &robot("kr6_r900.yaml"),
        &[FRAC_PI_2, 0.0, 0.0, 0.0, 0.0, 0.0],
    );
    assert_position(&turned, [0.0, -0.98, 0.435], 1e-12);
}

#[test]
fn tx60_by_its_dimensions() {
    let model = robot("tx60.yaml");
    let up = fk(&model, &[0.0; 6]);
    assert_position(&up, [0.0, 0.02, 0.375 + 0.29 + 0.31 + 0.07], 1e-12);
    let elbow_bent = fk(&model, &[0.0, 0.0, FRAC_PI_2, 0.0, 0.0, 0.0]);
    assert_position(&elbow_bent, [0.38, 0.02, 0.375 + 0.29], 1e-12);
}

const L0: f64 = 0.5;
const L1: f64 = 0.4;
const L2: f64 = 0.3;

#[test]
fn scara_as_in_the_book() {
    let model = robot("scara.yaml");
    for q in samples(4) {
        let (a, b) = (q[0], q[0] + q[1]);
        let p = [
            -L1 * a.sin() - L2 * b.sin(),
            L1 * a.cos() + L2 * b.cos(),
            L0 + q[3],
        ];
        assert_close(fk(&model, &q), shift(p[0], p[1], p[2]) * about_z(b + q[2]));
    }
    let golden = fk(&model, &[0.3, -0.5, 0.7, 0.1]);
    assert_position(&golden, [-0.058607283, 0.676154569, 0.6], 1e-9);
}

#[test]
fn elbow_as_in_the_book() {
    let model = robot("elbow.yaml");
    for q in samples(6) {
        let reach = L1 * q[1].cos() + L2 * (q[1] + q[2]).cos();
        let p = [
            -q[0].sin() * reach,
            q[0].cos() * reach,
            L0 - L1 * q[1].sin() - L2 * (q[1] + q[2]).sin(),
        ];
        assert_position(&fk(&model, &q), p, 1e-12);
    }
    let golden = fk(&model, &[0.1, 0.2, 0.3, 0.4, 0.5, 0.6]);
    assert_position(&golden, [-0.065420978, 0.652027622, 0.276704606], 1e-9);
    let row = golden.fixed_view::<1, 3>(0, 0);
    assert!(
        (row - nalgebra::RowVector3::new(0.878680246, -0.387910292, 0.278292347)).amax() < 1e-9
    );
    let other = [
        0.1,
        0.456825217,
        5.983185307,
        0.517850781,
        0.808784714,
        0.790954174,
    ];
    assert!((fk(&model, &other) - golden).amax() < 1e-8);
}

#[test]
fn inverse_elbow_inverts_the_elbow() {
    let (elbow, inverse) = (robot("elbow.yaml"), robot("inverse_elbow.yaml"));
    for q in samples(6) {
        let reversed: Vec<f64> = q.iter().rev().map(|q| -q).collect();
        assert_close(
            fk(&elbow, &q) * fk(&inverse, &reversed),
            Matrix4::identity(),
        );
    }
}

#[test]
fn stanford_as_in_the_book() {
    let model = robot("stanford.yaml");
    assert_eq!(model.joints[2].kind, JointKind::Prismatic);
    for q in samples(6) {
        let reach = (L1 + q[2]) * q[1].cos();
        let p = [
            -q[0].sin() * reach,
            q[0].cos() * reach,
            L0 - (L1 + q[2]) * q[1].sin(),
        ];
        assert_position(&fk(&model, &q), p, 1e-12);
    }
    let golden = fk(&model, &[0.1, 0.2, 0.3, 0.4, 0.5, 0.6]);
    assert_position(&golden, [-0.068490377, 0.682619229, 0.360931468], 1e-9);
}

#[test]
fn planar_arms_by_trigonometry() {
    let arms = [
        ("planar_2r.yaml", &[0.4, 0.3][..]),
        ("planar_3r.yaml", &[0.5, 0.3, 0.1]),
    ];
    for (file, lengths) in arms {
        let model = robot(file);
        for q in samples(lengths.len()) {
            let mut turned = 0.0;
            let mut p = [0.0; 3];
            for (length, q) in lengths.iter().zip(&q) {
                turned += q;
                p[0] += length * f64::cos(turned);
                p[1] += length * f64::sin(turned);
            }
            assert_close(fk(&model, &q), shift(p[0], p[1], 0.0) * about_z(turned));
        }
    }
}

#[test]
fn the_makers_ranges_are_in_radians() {
    let kuka = robot("kr6_r900.yaml");
    let limits = kuka.variables[1].limits.unwrap();
    assert!(
        (limits[0] + 190.0 / 180.0 * PI).abs() < 1e-15
            && (limits[1] - FRAC_PI_2 / 2.0).abs() < 1e-15
    );
    assert_eq!(
        robot("ur5e.urdf").variables[0].limits,
        Some([-2.0 * PI, 2.0 * PI])
    );
    assert_eq!(robot("elbow.yaml").variables[0].limits, None);
}

#[test]
fn every_robot_is_read_and_says_where_its_numbers_come_from() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../robots");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        let source = Source {
            path: name.into(),
            text: text.clone(),
        };
        match Spec::parse(&source).unwrap() {
            Spec::Mechanism(spec) => {
                assert!(Mechanism::new(&spec, None, None).unwrap().legs.len() > 1);
            }
            Spec::Arm(_) => {
                let model = robot(name);
                assert!(!model.joints.is_empty());
                let home = Isometry3::identity().to_homogeneous();
                assert_eq!(matrix(&model.home).row(3), home.row(3));
            }
        }
        assert!(
            text.starts_with('#') || text.contains("<!--"),
            "{name} has no comment"
        );
        count += 1;
    }
    assert!(count >= 17);
}
