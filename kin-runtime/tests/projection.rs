//! The tip as projected targets see it, held against finite differences.

use kin_runtime::__private::Projection;
use kin_runtime::{Chain, Jacobian, Pose, Target, Twist};

/// Axes that are off parallel by up to this, radians.
const TILT: f64 = 1e-4;

/// Two turns and a slide about an axis that is none of the base's, and the direction of the first.
fn arm() -> (Chain, [f64; 3]) {
    let axis = [0.0, 0.6, 0.8];
    let tilted = |by: f64| [by, 0.6, (0.64 - by * by).sqrt()];
    let twists = vec![
        Twist::revolute(axis, [0.0; 3]),
        Twist::revolute(tilted(TILT), [0.3, 0.1, 0.0]),
        Twist::prismatic(tilted(-TILT)),
    ];
    let home = Pose::from_axis_angle([1.0, 0.0, 0.0], 0.4, [0.5, 0.2, 0.1]);
    (Chain::new(twists, home), axis)
}

fn spatial(chain: &Chain, q: &[f64; 3]) -> Jacobian<3> {
    let pose = chain.fk(q);
    let columns = chain.geometric_jacobian(q);
    let columns = [0, 1, 2].map(|i| columns[i].geometric_to_spatial(&pose));
    Jacobian::from_columns(columns)
}

#[test]
fn motions_are_the_rates_of_the_pose_that_is_seen() {
    let (chain, axis) = arm();
    let step = 1e-6;
    for counts in Target::ALL {
        let home = *chain.home();
        let seen = Projection { counts, axis, home };
        let q = [0.7, -1.1, 0.2];
        let (pose, jacobian) = seen.fk_jacobian((chain.fk(&q), spatial(&chain, &q)));
        assert_eq!(pose, seen.pose(&chain.fk(&q)));
        let columns = jacobian.spatial_to_geometric(&pose).columns();
        for (i, column) in columns.iter().enumerate() {
            let [before, after] = [-step, step].map(|by| {
                let mut moved = q;
                moved[i] += by;
                seen.pose(&chain.fk(&moved))
            });
            let rate = |a: f64, b: f64| (b - a) / (2.0 * step);
            let turned = |row: usize, of: usize| -> f64 {
                // The skew matrix of the angular velocity: the rate of R times its transpose.
                let rates = (0..3).map(|k| rate(before.rotation[row][k], after.rotation[row][k]));
                rates.zip(pose.rotation[of]).map(|(x, y)| x * y).sum()
            };
            for k in 0..3 {
                let linear = rate(before.translation[k], after.translation[k]);
                assert!((column.linear[k] - linear).abs() < 1e-7, "{counts:?}, {i}");
                let angular = turned((k + 2) % 3, (k + 1) % 3);
                assert!(
                    (column.angular[k] - angular).abs() < 1e-7,
                    "{counts:?}, {i}"
                );
            }
        }
    }
}

/// What is not projected is seen to the last bit.
#[test]
fn other_targets_see_the_tip_as_it_is() {
    let (chain, axis) = arm();
    let q = [0.3, 0.9, -0.1];
    let here = (chain.fk(&q), spatial(&chain, &q));
    for counts in Target::ALL.into_iter().filter(|it| !it.is_projected()) {
        let home = *chain.home();
        let seen = Projection { counts, axis, home };
        assert_eq!(seen.fk_jacobian(here), here);
        assert_eq!(seen.target(&here.0), here.0);
    }
}

/// A matrix that is no rotation is none as it is seen either, by as much.
#[test]
fn an_error_of_the_rotation_is_seen() {
    let (chain, axis) = arm();
    let (counts, home) = (Target::PositionYaw, *chain.home());
    let seen = Projection { counts, axis, home };
    let target = chain.fk(&[0.4, 0.2, 0.1]);
    for stretch in [1e-12, 1e-9, 1e-6, 1e-3] {
        let rotation = target.rotation.map(|row| row.map(|x| x * (1.0 + stretch)));
        let stretched = Pose { rotation, ..target };
        let [error, left] = [stretched, seen.target(&stretched)].map(|it| it.rotation_error());
        assert!(
            (error - left).abs() < 0.01 * error + 1e-14,
            "{stretch:e}: {error:e}, {left:e}"
        );
    }
}
