//! A straight line of the tip, and all solutions along it.

use kin_runtime::__private::math;
use kin_runtime::Pose;
use kinematics::Robot;

/// Solutions of one branch at neighbouring points this far apart, radians, are not one curve: one
/// has gone through a turn, or the branch has ended and begun again.
const APART: f64 = 0.5;
/// A shorter line is rounding: the way is a turn alone; metres.
const SHORTEST: f64 = 1e-9;

/// All solutions along a line, and the ones that an arm on it takes.
pub struct Path {
    /// Whether the way is a length, metres; else it is an angle, radians.
    pub is_length: bool,
    /// How far each point is along it.
    pub way: Vec<f64>,
    /// By branch, pieces of curves: the point's number and the joint values.
    pub curves: Vec<Vec<Curve>>,
    /// Within limits and nearest to the point before, as far as there is one.
    pub taken: Vec<Option<Vec<f64>>>,
    /// The least singular value of the geometric Jacobian there.
    pub least: Vec<Option<f64>>,
}

/// Points of a branch without a gap.
pub type Curve = Vec<(usize, Vec<f64>)>;

impl Path {
    /// From one configuration's pose to another's, the origin along a line and the rotation about
    /// one axis; parameters go from the one's to the other's. The arm starts from `from`.
    pub fn new(robot: &Robot, from: &[f64], to: &[f64], steps: usize) -> Self {
        let ends = [robot.fk(from), robot.fk(to)];
        let parameters =
            [(&ends[0], from), (&ends[1], to)].map(|(pose, q)| robot.redundancy(pose, q));
        let line = Line::new(&ends[0], &ends[1]);
        let is_length = line.length > SHORTEST;
        let scale = if is_length { line.length } else { line.angle };
        let mut path = Path {
            is_length,
            way: Vec::new(),
            curves: Vec::new(),
            taken: Vec::new(),
            least: Vec::new(),
        };
        let mut seed = from.to_vec();
        for k in 0..=steps {
            let share = k as f64 / steps as f64;
            let target = line.at(share);
            let mix = |(a, b): (&f64, &f64)| a + share * math::wrap(b - a);
            let given: Vec<f64> = parameters[0].iter().zip(&parameters[1]).map(mix).collect();
            path.way.push(share * scale);
            for answer in robot.ik_at(&target, &given).iter() {
                let branch = answer.branch as usize;
                if path.curves.len() <= branch {
                    path.curves.resize(branch + 1, Vec::new());
                }
                let pieces = &mut path.curves[branch];
                let turns = robot.limits();
                let goes_on =
                    pieces
                        .last()
                        .and_then(|piece| piece.last())
                        .is_some_and(|(last, q)| {
                            *last + 1 == k
                                && q.iter().zip(answer.q).zip(turns).all(|((a, b), limit)| {
                                    !limit.is_revolute() || (a - b).abs() < APART
                                })
                        });
                if !goes_on {
                    pieces.push(Vec::new());
                }
                if let Some(piece) = pieces.last_mut() {
                    piece.push((k, answer.q.to_vec()));
                }
            }
            let nearest = robot
                .ik_nearest_at(&target, &given, &seed)
                .map(|found| found.q);
            path.least
                .push(nearest.as_ref().map(|q| robot.manipulability(q).sigma_min));
            if let Some(q) = &nearest {
                seed.clone_from(q);
            }
            path.taken.push(nearest);
        }
        path
    }

    /// Where the arm on the line takes another branch than before, or begins again: the points
    /// at which a joint jumps.
    pub fn jumps(&self) -> Vec<usize> {
        let far = |a: &[f64], b: &[f64]| a.iter().zip(b).any(|(a, b)| (a - b).abs() > APART);
        let jumps = |&k: &usize| match (&self.taken[k - 1], &self.taken[k]) {
            (Some(before), Some(after)) => far(before, after),
            _ => false,
        };
        (1..self.taken.len()).filter(jumps).collect()
    }
}

/// A way between two poses.
struct Line {
    from: Pose,
    shift: [f64; 3],
    /// Metres.
    length: f64,
    axis: [f64; 3],
    /// Radians.
    angle: f64,
}

impl Line {
    fn new(from: &Pose, to: &Pose) -> Self {
        let turned = Pose {
            translation: [0.0; 3],
            ..*to
        } * Pose {
            translation: [0.0; 3],
            ..*from
        }
        .inverse();
        let turn = turned.log().angular;
        let norm = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let angle = norm(turn);
        let shift: [f64; 3] = std::array::from_fn(|i| to.translation[i] - from.translation[i]);
        Line {
            from: *from,
            shift,
            length: norm(shift),
            axis: if angle > 0.0 {
                turn.map(|x| x / angle)
            } else {
                [0.0, 0.0, 1.0]
            },
            angle,
        }
    }

    fn at(&self, share: f64) -> Pose {
        let turn = Pose::from_axis_angle(self.axis, share * self.angle, [0.0; 3]);
        let rotation = (turn
            * Pose {
                translation: [0.0; 3],
                ..self.from
            })
        .rotation;
        Pose {
            rotation,
            translation: std::array::from_fn(|i| self.from.translation[i] + share * self.shift[i]),
        }
    }
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
        let solutions = path.curves.iter().flatten().flatten();
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
        let path = Path::new(&arm, &from, &to, 100);
        is_straight(&arm, &path);
        assert!(path.is_length && path.jumps().is_empty());
        let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9);
        assert!(near(path.taken[0].as_ref().unwrap(), &from));
        assert!(near(path.taken[100].as_ref().unwrap(), &to));
        for k in [0, 100] {
            let points = path.curves.iter().flatten().flatten();
            assert_eq!(points.filter(|(point, _)| *point == k).count(), 8);
        }
    }

    #[test]
    fn a_joint_to_spare_goes_along() {
        let arm = robot("robots/panda.yaml");
        let from = [0.3, 0.5, -0.2, -1.8, 0.4, 1.9, 0.6];
        let to = [0.4, 0.4, -0.1, -1.7, 0.3, 2.0, 0.9];
        let path = Path::new(&arm, &from, &to, 40);
        is_straight(&arm, &path);
        let sevenths = path.taken.iter().flatten().map(|q| q[6]);
        let expected = (0..=40).map(|k| 0.6 + 0.3 * f64::from(k) / 40.0);
        assert!(sevenths.zip(expected).all(|(q, x)| (q - x).abs() < 1e-12));
    }

    #[test]
    fn curves_end_where_branches_do() {
        // From stretched to one side to stretched to the other, past where the arm is folded.
        let arm = robot("robots/planar_2r.yaml");
        let path = Path::new(&arm, &[0.2, 0.1], &[2.9, 0.1], 60);
        assert_eq!(path.curves.len(), 2);
        let seen = path.curves[0].iter().flatten().count();
        let taken = path.taken.iter().flatten().count();
        assert!(seen >= taken && taken > 10);
        assert!(path.curves.iter().flatten().all(|piece| !piece.is_empty()));
        assert_eq!(
            path.taken.iter().map(Option::is_some).collect::<Vec<_>>(),
            path.least.iter().map(Option::is_some).collect::<Vec<_>>()
        );
    }

    #[test]
    fn a_way_may_be_a_turn_alone() {
        let arm = robot("robots/puma560.yaml");
        let from = [0.2, -1.0, 0.9, 0.4, 0.7, -0.3];
        let to = [0.2, -1.0, 0.9, 0.4, 0.7, 0.9];
        let path = Path::new(&arm, &from, &to, 20);
        assert!(!path.is_length && (path.way[20] - 1.2).abs() < 1e-9);
        assert!((path.taken[20].as_ref().unwrap()[5] - 0.9).abs() < 1e-9);
    }
}
