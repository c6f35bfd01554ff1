//! What the field calls singularities.

use super::Singularity;
use crate::expr::determinant::Factor;
use crate::geometry::cross;
use crate::geometry::norm;
use crate::model::Model;

/// The shoulder of a six-axis arm is in its first three joints, the wrist in
/// its last three, and the elbow between them. Smaller arms have an elbow
/// between two parallel axes; anything else is called by its joints.
pub(super) fn of(model: &Model, factor: &Factor, coordinates: &[usize]) -> String {
    if let (6, Some(name)) = (model.variables.len(), of_six(factor, coordinates)) {
        return name.into();
    }
    match coordinates {
        [joint] if is_elbow(model, *joint) => "elbow".into(),
        _ => by_joints(coordinates),
    }
}

fn of_six(factor: &Factor, coordinates: &[usize]) -> Option<&'static str> {
    let (first, last) = (*coordinates.first()?, *coordinates.last()?);
    let has = |column| factor.columns.contains(&column);
    match (first, last) {
        (2, 2) | (3, 3) => Some("elbow"),
        (_, ..=2) => Some("shoulder"),
        (3.., _) => Some("wrist"),
        // Between the first axis and the wrist's centre, or the other way round.
        _ if has(0) && !has(5) => Some("shoulder"),
        _ if has(5) && !has(0) => Some("wrist"),
        (1, 3) => Some("shoulder"),
        (2, 4) => Some("wrist"),
        _ => None,
    }
}

fn is_elbow(model: &Model, joint: usize) -> bool {
    let turns = |i: usize| model.joints[i].is_revolute();
    let parallel = |i: usize, j: usize| {
        turns(i) && turns(j) && norm(cross(model.joints[i].axis, model.joints[j].axis)) < 1e-6
    };
    joint > 0 && parallel(joint - 1, joint)
}

fn by_joints(coordinates: &[usize]) -> String {
    let numbers: Vec<String> = coordinates.iter().map(|i| (i + 1).to_string()).collect();
    match &numbers[..] {
        [only] => format!("joint {only}"),
        all => format!("joints {}", all.join(", ")),
    }
}

/// Tells equal names apart.
pub(super) fn distinct(singularities: &mut [Singularity]) {
    for i in 0..singularities.len() {
        let repeated = singularities[..i]
            .iter()
            .any(|singularity| singularity.name == singularities[i].name);
        if repeated {
            let joints = by_joints(&singularities[i].coordinates);
            singularities[i].name = format!("{} ({joints})", singularities[i].name);
        }
    }
}
