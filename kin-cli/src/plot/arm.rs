//! Paths of an arm.

use super::figure::Figure;
use super::line::Line;
use super::path::{Curves, Joint, Path, Subject, least_motion};
use super::table::{self, Rows, Table};
use crate::table::Fault;
use kin_codegen::model::Model;
use kin_codegen::spec::one_line;
use kin_runtime::__private::math;
use kinematics::{Parameter, Robot};

/// A shorter line is rounding: the way is a turn alone; metres.
const SHORTEST: f64 = 1e-9;

/// Who it is.
pub fn subject(robot: &Robot) -> Subject {
    let joints = robot.joint_names().into_iter().zip(robot.limits());
    let joints = joints.map(|(name, limit)| Joint {
        name: one_line(name),
        limit: *limit,
        is_shown: true,
    });
    Subject {
        name: one_line(robot.name()),
        tip: one_line(robot.tip()),
        joints: joints.collect(),
        measure: ["least singular value of the Jacobian", "metres, radians"],
    }
}

/// It at the ends of a path, and where its tip goes.
pub fn figures(model: &Model, robot: &Robot, path: &Path) -> (Vec<Figure>, Vec<[f64; 3]>) {
    let taken = || path.taken.iter().flatten();
    let ends = taken().next().into_iter().chain(taken().last());
    let way = taken().map(|q| robot.fk(q).translation);
    (ends.map(|q| Figure::arm(model, q)).collect(), way.collect())
}

fn begun(robot: &Robot, axis: String) -> Path {
    Path {
        axis,
        way: Vec::new(),
        curves: Curves::new(robot.limits().iter().copied()),
        taken: Vec::new(),
        measure: Vec::new(),
    }
}

fn measured(robot: &Robot, q: Option<&Vec<f64>>) -> Option<f64> {
    q.map(|q| robot.manipulability(q).sigma_min)
}

/// The way of a parameter, of a turn the short one.
fn way(robot: &Robot, place: usize, way: f64) -> f64 {
    match robot.parameter(place) {
        Some(Parameter::Joint(joint)) if !robot.limits()[joint].is_revolute() => way,
        _ => math::wrap(way),
    }
}

/// From one configuration's pose to another's, the origin along a line and the rotation about
/// one axis; parameters go from the one's to the other's. The arm starts from `from`.
pub fn along_line(robot: &Robot, from: &[f64], to: &[f64], steps: usize) -> Path {
    let ends = [robot.fk(from), robot.fk(to)];
    let parameters = [(&ends[0], from), (&ends[1], to)].map(|(pose, q)| robot.redundancy(pose, q));
    let line = Line::new(&ends[0], &ends[1]);
    let (length, unit) = match line.length > SHORTEST {
        true => (1000.0 * line.length, "mm"),
        false => (line.angle.to_degrees(), "°"),
    };
    let mut path = begun(robot, format!("along the path in {unit}"));
    let mut seed = from.to_vec();
    for k in 0..=steps {
        let share = k as f64 / steps as f64;
        let target = line.at(share);
        let given = |place: usize| {
            let [from, to] = [0, 1].map(|end| parameters[end][place]);
            from + share * way(robot, place, to - from)
        };
        let given: Vec<f64> = (0..robot.parameters()).map(given).collect();
        path.way.push(share * length);
        for answer in robot.ik_at(&target, &given).iter() {
            path.curves.push(k, answer.branch as usize, answer.q);
        }
        let nearest = robot.ik_nearest_at(&target, &given, &seed);
        let nearest = nearest.map(|found| found.q);
        path.measure.push(measured(robot, nearest.as_ref()));
        if let Some(q) = &nearest {
            seed.clone_from(q);
        }
        path.taken.push(nearest);
    }
    path
}

/// What a table has: poses, whose solutions are computed, these solutions as `kin ik` writes
/// them, or the values of the joints.
///
/// # Errors
///
/// The table has none of these, or too much.
pub fn of_table(robot: &Robot, table: Table) -> Result<Path, Fault> {
    let solutions = match table.rows(robot)? {
        Rows::Configurations(rows) => return Ok(of_configurations(robot, rows)),
        Rows::Solutions(solutions) => solutions,
    };
    let limits = robot.limits();
    let mut path = begun(robot, table::TARGETS.into());
    let mut layers = Vec::new();
    for (target, answers) in solutions {
        // A target that is missing, or several, are a gap.
        if let Some(last) = path.way.last()
            && target as f64 > last + 1.0
        {
            path.way.push(last + 1.0);
            layers.push(Vec::new());
        }
        for (branch, q) in &answers {
            path.curves.push(path.way.len(), *branch, q);
        }
        path.way.push(target as f64);
        layers.push(answers.into_iter().map(|(_, q)| q).collect());
    }
    path.taken = least_motion(&layers, limits);
    let measures = path.taken.iter().map(|q| measured(robot, q.as_ref()));
    path.measure = measures.collect();
    Ok(path)
}

/// The values of the joints, and beside them all other solutions for the poses that they make.
fn of_configurations(robot: &Robot, rows: Vec<Option<Vec<f64>>>) -> Path {
    let mut path = begun(robot, table::ROWS.into());
    for (k, q) in rows.into_iter().enumerate() {
        path.way.push(k as f64);
        if let Some(q) = &q {
            let pose = robot.fk(q);
            for answer in robot.ik_at(&pose, &robot.redundancy(&pose, q)).iter() {
                path.curves.push(k, answer.branch as usize, answer.q);
            }
        }
        path.measure.push(measured(robot, q.as_ref()));
        path.taken.push(q);
    }
    path
}

#[cfg(test)]
mod tests {
    use super::*;
    use kinematics::{RobotOptions, RobotSource};

    fn robot(file: &str) -> Robot {
        let root = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
        let source = RobotSource::read(file, root).unwrap();
        Robot::load(&source, &RobotOptions::default()).unwrap()
    }

    /// That the tip of all solutions is on the line, and turns evenly.
    fn is_straight(robot: &Robot, path: &Path) {
        let solutions = path.curves.pieces.iter().flat_map(|it| &it.points);
        let steps = (path.way.len() - 1) as f64;
        let taken = path.taken.iter().enumerate();
        let taken = taken.filter_map(|(k, q)| Some((k, q.as_ref()?)));
        let all: Vec<(usize, &Vec<f64>)> = solutions.map(|(k, q)| (*k, q)).chain(taken).collect();
        let place = |k: usize| {
            let q = path.taken[k].as_ref().unwrap();
            robot.fk(q)
        };
        let (first, last) = (place(0), place(path.way.len() - 1));
        for (k, q) in all {
            let pose = robot.fk(q);
            let share = k as f64 / steps;
            for i in 0..3 {
                let [a, b] = [&first, &last].map(|end| end.translation[i]);
                assert!((pose.translation[i] - a - share * (b - a)).abs() < 1e-8);
            }
            let turned = share * first.rotation_distance(&last);
            assert!((pose.rotation_distance(&first) - turned).abs() < 1e-6);
        }
    }

    #[test]
    fn all_branches_are_along_the_line() {
        let arm = robot("robots/ur5e.urdf");
        let (from, to) = (
            [0.3, -1.2, 1.5, -0.7, 1.1, 0.4],
            [1.3, -1.6, 1.1, -1.0, 0.6, 0.2],
        );
        let path = along_line(&arm, &from, &to, 100);
        is_straight(&arm, &path);
        assert!(path.axis.ends_with("in mm") && path.jumps().is_empty());
        let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9);
        assert!(near(path.taken[0].as_ref().unwrap(), &from));
        assert!(near(path.taken[100].as_ref().unwrap(), &to));
        for k in [0, 100] {
            let points = path.curves.pieces.iter().flat_map(|it| &it.points);
            assert_eq!(points.filter(|(point, _)| *point == k).count(), 8);
        }
    }

    #[test]
    fn a_joint_to_spare_goes_along() {
        let arm = robot("robots/panda.yaml");
        let from = [0.3, 0.5, -0.2, -1.8, 0.4, 1.9, 0.6];
        let to = [0.4, 0.4, -0.1, -1.7, 0.3, 2.0, 0.9];
        let path = along_line(&arm, &from, &to, 40);
        is_straight(&arm, &path);
        let sevenths = path.taken.iter().flatten().map(|q| q[6]);
        let expected = (0..=40).map(|k| 0.6 + 0.3 * f64::from(k) / 40.0);
        assert!(sevenths.zip(expected).all(|(q, x)| (q - x).abs() < 1e-12));
    }

    #[test]
    fn a_slide_goes_the_whole_way() {
        let root = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."));
        let mut rail = RobotSource::read("tests/robots/redundant/rail.yaml", root).unwrap();
        rail.text = rail.text.replace("[-1500, 1500]", "[-3000, 3000]");
        let options = RobotOptions {
            free: vec!["rail".into()],
            ..RobotOptions::default()
        };
        let arm = Robot::load(&rail, &options).unwrap();
        let from = [-2.0, 0.3, -1.2, 1.5, -0.7, 1.1, 0.4];
        let to = [2.0, 0.3, -1.2, 1.5, -0.7, 1.1, 0.4];
        let path = along_line(&arm, &from, &to, 40);
        is_straight(&arm, &path);
        let slides = path.taken.iter().flatten().map(|q| q[0]);
        let expected = (0..=40).map(|k| -2.0 + f64::from(k) / 10.0);
        assert!(slides.zip(expected).all(|(q, x)| (q - x).abs() < 1e-12));
    }

    #[test]
    fn curves_end_where_branches_do() {
        // From stretched to one side to stretched to the other, past where the arm is folded.
        let arm = robot("robots/planar_2r.yaml");
        let path = along_line(&arm, &[0.2, 0.1], &[2.9, 0.1], 60);
        assert_eq!(path.curves.branches(), [0, 1]);
        let first = path.curves.pieces.iter().filter(|it| it.branch == Some(0));
        let seen: usize = first.map(|it| it.points.len()).sum();
        let taken = path.taken.iter().flatten().count();
        assert!(seen >= taken && taken > 10);
        assert_eq!(
            path.taken.iter().map(Option::is_some).collect::<Vec<_>>(),
            path.measure.iter().map(Option::is_some).collect::<Vec<_>>()
        );
    }

    #[test]
    fn a_way_may_be_a_turn_alone() {
        let arm = robot("robots/puma560.yaml");
        let from = [0.2, -1.0, 0.9, 0.4, 0.7, -0.3];
        let to = [0.2, -1.0, 0.9, 0.4, 0.7, 0.9];
        let path = along_line(&arm, &from, &to, 20);
        assert!(path.axis.ends_with("in °") && (path.way[20].to_radians() - 1.2).abs() < 1e-9);
        assert!((path.taken[20].as_ref().unwrap()[5] - 0.9).abs() < 1e-9);
    }
}
