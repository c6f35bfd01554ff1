//! The fourth and sixth axis in line.

use crate::follow::passes;
use crate::path::{circle, cross, line, unit};
use crate::{Puma560, Ur5e};
use kinematics::Kinematics;

const STRAIGHT: [f64; 6] = [0.3, -0.6, 0.8, 0.4, 0.0, -0.9];

fn through<K: Kinematics<6>>(arm: &K, rate: f64) {
    let pose = arm.fk(&STRAIGHT);
    let along = unit([0.5, 0.3, 0.8]);
    let towards = unit(cross(along, [0.0, 0.0, 1.0]));
    passes(arm, STRAIGHT, line(pose, along), rate);
    passes(arm, STRAIGHT, circle(pose, along, towards), rate);
}

#[test]
fn of_a_spherical_wrist() {
    through(&Puma560, 15.0);
}

#[test]
fn of_a_universal_robot() {
    through(&Ur5e, 5.0);
}
