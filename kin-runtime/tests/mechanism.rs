//! Parallel mechanisms against formulas of their own, nalgebra's singular
//! values, and differences.

use kin_runtime::{Chain, Mechanism, Pose, Twist};
use nalgebra::{DMatrix, Vector3};

const Z: [f64; 3] = [0.0, 0.0, 1.0];

fn turn(x: f64, y: f64) -> Twist {
    Twist::revolute(Z, [x, y, 0.0])
}

/// Ground pins at (0, 0) and (d, 0), crank a, coupler b, rocker c, assembled
/// at the crank angle `at` with the rocker on the given side.
fn four_bar(a: f64, b: f64, c: f64, d: f64, at: f64, side: f64) -> Mechanism {
    let p = [a * at.cos(), a * at.sin()];
    let (u, v) = (d - p[0], -p[1]);
    let diagonal = u.hypot(v);
    let along = (diagonal * diagonal + b * b - c * c) / (2.0 * diagonal);
    let across = side * (b * b - along * along).sqrt();
    let (u, v) = (u / diagonal, v / diagonal);
    let r = [p[0] + along * u - across * v, p[1] + along * v + across * u];
    let coupler = Pose::from_translation([p[0], p[1], 0.0]);
    Mechanism::new(
        vec![
            Chain::new(vec![turn(0.0, 0.0), turn(p[0], p[1])], coupler),
            Chain::new(vec![turn(d, 0.0), turn(r[0], r[1])], coupler),
        ],
        vec![0],
    )
}

/// A 6-6 Stewart platform: UPS legs, hexagons with the given half angles
/// between the points of a pair, platform at the height 1.
fn stewart(base: f64, platform: f64, height: f64) -> (Mechanism, [[f64; 3]; 6], [[f64; 3]; 6]) {
    let hexagon = |radius: f64, half: f64, middle: f64| {
        std::array::from_fn(|i| {
            let pair = middle + (i / 2) as f64 * 2.0 * std::f64::consts::FRAC_PI_3;
            let angle = pair + if i % 2 == 0 { -half } else { half };
            [radius * angle.cos(), radius * angle.sin(), 0.0]
        })
    };
    let a: [[f64; 3]; 6] = hexagon(1.0, base, 0.0);
    let mut b: [[f64; 3]; 6] = hexagon(0.6, platform, std::f64::consts::FRAC_PI_3);
    // Leg i joins neighbours: the second point of a pair leads to the next pair.
    b.rotate_right(1);
    let home = Pose::from_translation([0.0, 0.0, height]);
    let chains = (0..6).map(|i| {
        let (foot, head) = (
            Vector3::from(a[i]),
            Vector3::from(b[i]) + Vector3::z() * height,
        );
        let leg = (head - foot).normalize();
        let first = leg.cross(&Vector3::z()).normalize();
        let second = leg.cross(&first);
        let axes = [first, second].map(|axis| Twist::revolute(axis.into(), a[i]));
        let ball = [Z, [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]];
        let ball = ball.map(|axis| Twist::revolute(axis, head.into()));
        let slide = Twist::prismatic(leg.into());
        Chain::new([&axes[..], &[slide], &ball].concat(), home)
    });
    let chains: Vec<Chain> = chains.collect();
    let actuated = (0..6).map(|i| 6 * i + 2).collect();
    (Mechanism::new(chains, actuated), a, b)
}

#[test]
fn mobility_by_gruebler_and_by_rank() {
    let linkage = four_bar(1.0, 2.5, 2.0, 3.0, 0.9, 1.0);
    assert_eq!(linkage.motion_dimension(), 3);
    assert_eq!((linkage.gruebler(3), linkage.gruebler(6)), (1, -2));
    assert_eq!(linkage.mobility(), 1);
    let (platform, ..) = stewart(0.2, 0.3, 1.0);
    assert_eq!(platform.motion_dimension(), 6);
    assert_eq!((platform.gruebler(6), platform.mobility()), (6, 6));
}

#[test]
fn a_triangle_of_three_bars_is_stuck() {
    let apex = Pose::from_translation([1.0, 1.0, 0.0]);
    let triangle = Mechanism::new(
        vec![
            Chain::new(vec![turn(0.0, 0.0), turn(1.0, 1.0)], apex),
            Chain::new(vec![turn(2.0, 0.0)], apex),
        ],
        vec![0],
    );
    assert_eq!((triangle.gruebler(3), triangle.mobility()), (0, 0));
    assert!(!triangle.is_mobile());
}

/// In a row, three bars may move instantly, and yet not at all.
#[test]
fn a_flat_triangle_is_stuck_although_its_rank_is_lost() {
    let apex = Pose::from_translation([1.0, 0.0, 0.0]);
    let triangle = Mechanism::new(
        vec![
            Chain::new(vec![turn(0.0, 0.0), turn(1.0, 0.0)], apex),
            Chain::new(vec![turn(2.0, 0.0)], apex),
        ],
        vec![0],
    );
    assert_eq!(triangle.mobility_at(&[0.0; 3]), 1);
    assert!(!triangle.is_mobile());
}

/// Bennett's linkage: Grübler's formula denies it, and it moves. Opposite
/// links have length a and twist α, b and β, with a sin β = b sin α.
#[test]
fn bennett_s_linkage_moves_against_gruebler() {
    // Four skew axes of a closed configuration, by Denavit-Hartenberg with
    // tan(θ₁/2) tan(θ₂/2) = sin((β + α)/2) / sin((β − α)/2).
    let (alpha, beta, a) = (0.6_f64, 1.1_f64, 1.0);
    let b = a * beta.sin() / alpha.sin();
    let first = 1.0_f64;
    let ratio = ((beta + alpha) / 2.0).sin() / ((beta - alpha) / 2.0).sin();
    let second = 2.0 * (ratio / (first / 2.0).tan()).atan();
    let frame = |theta: f64, a: f64, alpha: f64| {
        let turned = Pose::from_axis_angle(Z, theta, [0.0; 3]);
        turned * Pose::from_axis_angle([1.0, 0.0, 0.0], alpha, [a, 0.0, 0.0])
    };
    let angles = [first, second, -first, -second];
    let links = [(a, alpha), (b, beta), (a, alpha), (b, beta)];
    let mut frames = vec![Pose::IDENTITY];
    for (theta, (a, alpha)) in angles.into_iter().zip(links) {
        let last = *frames.last().unwrap();
        frames.push(last * frame(theta, a, alpha));
    }
    assert!(
        frames[4].translation_distance(&frames[0]) < 1e-12,
        "{:?}",
        frames[4]
    );
    assert!(frames[4].rotation_distance(&frames[0]) < 1e-12);
    let axis = |i: usize| {
        let r = frames[i].rotation;
        Twist::revolute([r[0][2], r[1][2], r[2][2]], frames[i].translation)
    };
    let linkage = Mechanism::new(
        vec![
            Chain::new(vec![axis(0), axis(1)], frames[2]),
            Chain::new(vec![axis(3), axis(2)], frames[2]),
        ],
        vec![0],
    );
    assert_eq!((linkage.gruebler(6), linkage.mobility()), (-2, 1));
    assert!(linkage.is_mobile());
    let mut q = vec![0.0; 4];
    for k in 1..50 {
        q = linkage.fk_near(&[0.01 * f64::from(k)], &q).unwrap();
        assert!(linkage.gap(&q) < 1e-12);
    }
}

#[test]
fn loops_stay_closed_along_a_whole_turn_of_the_crank() {
    let linkage = four_bar(1.0, 2.5, 2.0, 3.0, 0.9, 1.0);
    let mut q = vec![0.0; 4];
    for k in 0..=720 {
        let crank = f64::from(k).to_radians() / 2.0;
        q = linkage.fk_near(&[crank], &q).unwrap();
        assert!(linkage.gap(&q) < 1e-12, "{crank}");
    }
    // Back to where it was, on the same branch.
    assert!(q[2].abs() < 1e-9, "{q:?}");
}

#[test]
fn a_four_bar_has_two_assembly_modes_or_none() {
    let linkage = four_bar(1.0, 2.5, 2.0, 3.0, 0.9, 1.0);
    for crank in [-2.0, -0.3, 0.0, 0.7, 2.5] {
        let found = linkage.assembly_modes(&[crank]);
        assert_eq!(found.len(), 2, "{crank}");
        assert!(found.iter().all(|q| linkage.gap(q) < 1e-12));
    }
    // A long crank cannot come close to the far side.
    let rocking = four_bar(2.5, 1.0, 2.0, 3.0, 0.5, 1.0);
    assert!(rocking.assembly_modes(&[2.6]).is_empty());
}

#[test]
fn a_five_bar_has_two_assembly_modes_for_its_actuators() {
    let tip = Pose::from_translation([0.5, 1.2, 0.0]);
    let five_bar = Mechanism::new(
        vec![
            Chain::new(vec![turn(0.0, 0.0), turn(-0.3, 0.7)], tip),
            Chain::new(vec![turn(1.0, 0.0), turn(1.3, 0.7), turn(0.5, 1.2)], tip),
        ],
        vec![0, 2],
    );
    assert_eq!((five_bar.gruebler(3), five_bar.mobility()), (2, 2));
    assert_eq!(five_bar.assembly_modes(&[0.1, -0.2]).len(), 2);
}

/// Jacobians of closed mechanisms against differences of closed positions.
#[test]
fn forward_jacobians_are_the_derivatives_of_newton_s_poses() {
    let (platform, ..) = stewart(0.2, 0.3, 1.0);
    let at: Vec<f64> = vec![0.05, -0.02, 0.03, 0.01, 0.04, -0.03];
    let q = platform.fk_near(&at, &[0.0; 36]).unwrap();
    let jacobian = platform.forward_jacobian(&q).unwrap();
    let rows = platform.inverse_jacobian(&q).unwrap();
    let step = 1e-6;
    for (i, column) in jacobian.iter().enumerate() {
        let pose = |sign: f64| {
            let mut moved = at.clone();
            moved[i] += sign * step;
            let q = platform.fk_near(&moved, &q).unwrap();
            platform.poses(&q)[0]
        };
        let difference = (pose(1.0) * pose(-1.0).inverse()).log() * (0.5 / step);
        let off = (difference - *column).to_array();
        assert!(off.iter().all(|x| x.abs() < 1e-8), "{off:?}");
        for (j, row) in rows.iter().enumerate() {
            let product: f64 = row.iter().zip(column.to_array()).map(|(a, b)| a * b).sum();
            assert!((product - f64::from(u8::from(i == j))).abs() < 1e-12);
        }
    }
}

/// Row i of a Stewart platform's inverse Jacobian is (u, R b × u) about the
/// platform's origin: (u, p × u + R b × u) about the base's.
#[test]
fn a_stewart_platform_has_the_textbook_s_inverse_jacobian() {
    let (platform, a, b) = stewart(0.2, 0.3, 1.0);
    let q = platform
        .fk_near(&[0.05, -0.02, 0.03, 0.01, 0.04, -0.03], &[0.0; 36])
        .unwrap();
    let pose = platform.poses(&q)[0];
    for (i, row) in platform.inverse_jacobian(&q).unwrap().iter().enumerate() {
        let head = Vector3::from(pose.transform_point(b[i]));
        let u = (head - Vector3::from(a[i])).normalize();
        let moment = head.cross(&u);
        let expected = [u.x, u.y, u.z, moment.x, moment.y, moment.z];
        for k in 0..6 {
            assert!(
                (row[k] - expected[k]).abs() < 1e-12,
                "{i}: {row:?} {expected:?}"
            );
        }
    }
}

#[test]
fn singular_values_are_nalgebra_s() {
    let (platform, ..) = stewart(0.2, 0.3, 1.0);
    let mut linkages = vec![four_bar(1.0, 2.5, 2.0, 3.0, 0.9, 1.0), platform];
    linkages.push(four_bar(1.0, 1.0, 1.0, 1.0, 1e-4, 1.0));
    for linkage in linkages {
        let q = vec![0.0; linkage.joints()];
        let rows = linkage.constraint_jacobian(&q);
        let matrix = DMatrix::from_fn(rows.len(), q.len(), |i, j| rows[i][j]);
        let mut expected: Vec<f64> = matrix.singular_values().iter().copied().collect();
        expected.resize(q.len(), 0.0);
        expected.sort_by(|x, y| y.total_cmp(x));
        let found = linkage.structure(&q);
        for (x, y) in found.iter().zip(&expected) {
            assert!(
                (x - y).abs() < 1e-13 * expected[0],
                "{found:?} {expected:?}"
            );
        }
    }
}

/// The crank is stuck, or the coupler free, where coupler and rocker are in
/// line; there the measure is zero, and nowhere else.
#[test]
fn a_driven_crank_loses_the_coupler_where_it_is_in_line_with_the_rocker() {
    let (a, b, c, d) = (2.0_f64, 1.0_f64, 1.5_f64, 2.2_f64);
    // Law of cosines: the diagonal is b + c.
    let crank = ((a * a + d * d - (b + c) * (b + c)) / (2.0 * a * d)).acos();
    let measure = |off: f64| {
        let linkage = four_bar(a, b, c, d, crank - off, 1.0);
        linkage.actuator_singularity(&[0.0; 4])
    };
    assert!(measure(1e-12) < 1e-5, "{}", measure(1e-12));
    let (near, far) = (measure(1e-6), measure(1e-4));
    // The sine of the angle between them grows with the root.
    assert!((far / near - 10.0).abs() < 0.1, "{near} {far}");
    assert!(
        four_bar(a, b, c, d, crank - 1e-12, 1.0)
            .forward_jacobian(&[0.0; 4])
            .is_some()
    );
}

/// A four-bar with all pins in one line can turn either way.
#[test]
fn a_flat_parallelogram_loses_the_rank_of_its_structure_equation() {
    let linkage = four_bar(1.0, 2.0, 1.0, 2.0, 1e-13, 1.0);
    assert!(linkage.kinematic_singularity(&[0.0; 4], 1) < 1e-6);
    assert_eq!(linkage.mobility(), 1);
    let regular = four_bar(1.0, 2.0, 1.0, 2.0, 1.0, 1.0);
    assert!(regular.kinematic_singularity(&[0.0; 4], 1) > 0.05);
}

#[test]
fn similar_hexagons_are_singular_everywhere() {
    let (similar, ..) = {
        // Legs from each point to the one that corresponds to it.
        let (platform, a, _) = stewart(0.2, 0.2, 1.0);
        let chains = (0..6).map(|i| {
            let head = [0.6 * a[i][0], 0.6 * a[i][1], 1.0];
            let leg = (Vector3::from(head) - Vector3::from(a[i])).normalize();
            let first = leg.cross(&Vector3::z()).normalize();
            let axes = [first, leg.cross(&first)].map(|x| Twist::revolute(x.into(), a[i]));
            let ball = [Z, [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]].map(|x| Twist::revolute(x, head));
            let slide = Twist::prismatic(leg.into());
            Chain::new(
                [&axes[..], &[slide], &ball].concat(),
                Pose::from_translation([0.0, 0.0, 1.0]),
            )
        });
        (
            Mechanism::new(chains.collect(), platform.actuated().to_vec()),
            a,
        )
    };
    assert!(similar.actuator_singularity(&[0.0; 36]) < 1e-14);
    assert!(similar.forward_jacobian(&[0.0; 36]).is_none());
    let (regular, ..) = stewart(0.2, 0.3, 1.0);
    assert!(regular.actuator_singularity(&[0.0; 36]) > 0.1);
}

/// Numbers from −1 to 1, always the same.
fn random(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// Next to where their legs are stretched few configurations close.
#[test]
fn a_platform_on_nearly_straight_legs_moves() {
    for bend in [
        0.3, 0.1, 0.03, 0.01, 0.005, 0.003, -0.003, -0.005, -0.01, -0.1, -0.3,
    ] {
        let legs = [0.2, 2.4, 4.4].map(|angle: f64| {
            let [foot, head] =
                [1.0, 0.3].map(|far| Vector3::new(angle.cos(), angle.sin(), 0.0) * far);
            let across = Vector3::z().cross(&(head - foot)) * (bend / 4.0);
            let knee = (foot + head) / 2.0 + across;
            let axes = [foot, knee, head].map(|at| turn(at.x, at.y));
            Chain::new(axes.to_vec(), Pose::IDENTITY)
        });
        let platform = Mechanism::new(legs.to_vec(), vec![0, 3, 6]);
        assert!(platform.is_mobile(), "{bend}");
        assert_eq!(platform.mobility(), 3, "{bend}");
    }
}

/// Cranks and rods, at random: some knees are nearly stretched.
#[test]
fn hexapods_move() {
    for seed in 1..=60 {
        let mut random = random(seed);
        let mut near = |point: [f64; 3], by: f64| Vector3::from(point.map(|x| x + by * random()));
        let legs: Vec<Chain> = (0..6)
            .map(|i| {
                let (sin, cos) = (std::f64::consts::FRAC_PI_3 * f64::from(i)).sin_cos();
                let foot = near([cos, sin, 0.0], 0.2);
                let knee = near([1.2 * cos, 1.2 * sin, 0.3], 0.2);
                let head = near([0.5 * cos, 0.5 * sin, 0.9], 0.2);
                let rod = (head - knee).normalize();
                let drive = near([0.0; 3], 1.0).cross(&(knee - foot)).normalize();
                let first = rod.cross(&near([0.0; 3], 1.0)).normalize();
                let knees = [first, rod.cross(&first)]
                    .map(|axis| Twist::revolute(axis.into(), knee.into()));
                let ball = [Z, [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]];
                let ball = ball.map(|axis| Twist::revolute(axis, head.into()));
                let drive = Twist::revolute(drive.into(), foot.into());
                let home = Pose::from_translation([0.0, 0.0, 0.9]);
                Chain::new([&[drive], &knees[..], &ball].concat(), home)
            })
            .collect();
        let hexapod = Mechanism::new(legs, (0..6).map(|i| 6 * i).collect());
        assert!(hexapod.is_mobile(), "{seed}");
        assert_eq!(hexapod.mobility(), 6, "{seed}");
    }
}

/// Slides move by lengths, which may be short.
#[test]
fn a_small_stage_moves() {
    for size in [1.0, 0.02, 5e-3, 2e-4] {
        let [x, y] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(Twist::prismatic);
        let home = Pose::from_translation([size, 0.0, 0.0]);
        let stage = Mechanism::new(
            vec![
                Chain::new(vec![x, y, turn(0.0, 0.0)], home),
                Chain::new(vec![y, x], home),
            ],
            vec![0, 1],
        );
        assert!(stage.is_mobile(), "{size}");
        assert_eq!(stage.mobility(), 2, "{size}");
    }
}
