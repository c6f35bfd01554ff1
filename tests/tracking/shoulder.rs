//! The wrist above the first axis, or as near to it as the arm's offset lets
//! it.

use crate::follow::{passes, singular_near};
use crate::path::{Vector, circle, cross, line, unit};
use crate::{Elbow, Puma560, Ur5e};
use kinematics::Kinematics;

/// Nothing is offset: the wrist passes over the axis in any direction.
#[test]
fn over_the_axis() {
    let start = [0.3, 1.2, 0.2, 0.4, 0.7, -0.9];
    let above = singular_near(&Elbow, start, 2, 1.0);
    let pose = Elbow.fk(&above);
    let along = unit([0.5, 0.3, 0.8]);
    let towards = unit(cross(along, [0.0, 0.0, 1.0]));
    passes(&Elbow, above, line(pose, along), 25.0);
    passes(&Elbow, above, circle(pose, along, towards), 25.0);
}

/// An offset shoulder cannot bring the wrist nearer to the axis than a
/// cylinder: touches it.
fn along_the_cylinder<K: Kinematics<6>>(arm: &K, touching: [f64; 6], wrist: Vector, rate: f64) {
    let pose = arm.fk(&touching);
    let outwards = unit([wrist[0], wrist[1], 0.0]);
    let around = cross([0.0, 0.0, 1.0], outwards);
    let up = unit([around[0], around[1], 0.4]);
    passes(arm, touching, line(pose, around), rate);
    passes(arm, touching, line(pose, up), rate);
    passes(arm, touching, circle(pose, around, outwards), rate);
}

#[test]
fn along_the_cylinder_of_a_puma() {
    let start = [0.3, -1.2, 0.8, 0.4, 0.7, -0.9];
    let touching = singular_near(&Puma560, start, 1, 0.5);
    along_the_cylinder(&Puma560, touching, Puma560.fk(&touching).translation, 25.0);
}

#[test]
fn along_the_cylinder_of_a_universal_robot() {
    let start = [0.3, -1.2, 1.5, -0.7, 1.1, 0.4];
    let touching = singular_near(&Ur5e, start, 1, -1.5);
    let pose = Ur5e.fk(&touching);
    // Where the last two axes meet, 99.6 mm behind the flange.
    let wrist = pose.transform_point([0.0, 0.0, -0.0996]);
    along_the_cylinder(&Ur5e, touching, wrist, 25.0);
}
