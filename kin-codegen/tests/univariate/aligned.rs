//! Targets that line the last joint's axis up with the first one's, as a tool that points straight down
//! does. Solutions share values of the kept joint there, real ones and complex ones.

use std::fmt::Display;

use super::*;

/// Where a configuration puts the tip, turned so that the two axes are this far from parallel, radians.
fn aligned(frames: &Frames, q: &[f64; 6], off: f64) -> Pose {
    let axis = |pose: &Pose| pose.rotation.map(|row| row[2]);
    let behind = frames.fixed[6];
    // z taken to the first axis, and half a turn about x before every other one.
    let first = frames.fixed[0];
    let over = [0.0, PI][usize::from(q[0] > 0.0)];
    let turned = |axis, angle| Pose::from_axis_angle(axis, angle, [0.0; 3]);
    let last = first * turned([1.0, 0.0, 0.0], over + off) * turned([0.0, 0.0, 1.0], q[5]);
    let pose = Pose {
        rotation: (last * behind).rotation,
        ..frames.forward(q)
    };
    let [a, b] = [axis(&first), axis(&(pose * behind.inverse()))];
    let along: f64 = (0..3).map(|i| a[i] * b[i]).sum();
    assert!((along.abs() - off.cos()).abs() < 1e-12);
    pose
}

fn arm(text: &str) -> Arm {
    let path = "arm.yaml".into();
    let spec = ArmSpec::parse(&Source {
        path,
        text: text.into(),
    })
    .unwrap();
    let model = Model::new(&spec, None, None).unwrap();
    Arm::new(&Linkage::new(&model)).unwrap()
}

/// Of an exact arm, of the same with right angles of 1.5708, and of another one.
fn arms() -> [Arm; 3] {
    let xarm6 = include_str!("../../../robots/xarm6.yaml");
    let rounded = xarm6.replace("90, ", "90.00021, ");
    assert_ne!(xarm6, rounded);
    let crx10ial = include_str!("../../../tests/robots/crx10ial.yaml");
    [arm(xarm6), arm(&rounded), arm(crx10ial)]
}

/// Of every elimination alone: whether it is sure of a target, and how many solutions it finds. Where one
/// is sure, no other one finds more.
fn said_alone(
    frames: &Frames,
    eliminations: &[Elimination],
    target: &Pose,
    case: &dyn Display,
) -> Vec<(bool, usize)> {
    let univariate = Univariate {
        frames: *frames,
        size: 2.0,
        counts: Target::Pose,
        eliminations: &[],
    };
    let outcomes = eliminations.iter().map(|it| univariate.outcome(it, target));
    let said: Vec<_> = outcomes
        .map(|(outcome, found)| (outcome.certain, found.len()))
        .collect();
    let most = said.iter().map(|(_, found)| *found).max().unwrap();
    for ((certain, found), elimination) in said.iter().zip(eliminations) {
        let joints = elimination.joints;
        assert!(
            !certain || *found == most,
            "{case}, {joints:?}: {found} of {most}"
        );
    }
    said
}

/// At quarter turns, or next to them, of an arm with a wrist and of a cobot: families of solutions, and
/// others next to each other, have one value of the joint that is kept.
#[test]
fn a_family_is_not_taken_for_complex_solutions() {
    for text in [
        include_str!("../../../robots/kr6_r900.yaml"),
        include_str!("../../../robots/ur10e.yaml"),
    ] {
        let arm = arm(text);
        let frames = &arm.frames;
        let alone: Vec<Elimination> = arm.alone().map(|arm| arm.kept[0].elimination).collect();
        let mut random = Random(0xfa11);
        let mut sure = 0;
        for k in 0..1500 {
            let off = 10f64.powf(random.between(-12.0, -1.0));
            let mut quarter =
                || random.below(4) as f64 * FRAC_PI_2 + off * random.between(-1.0, 1.0);
            let q: [f64; 6] = std::array::from_fn(|_| quarter());
            let target = frames.forward(&q);
            let said = said_alone(frames, &alone, &target, &k);
            sure += said.iter().filter(|(certain, _)| *certain).count();
        }
        assert!(sure > 1500, "{sure}");
    }
}

/// What an elimination does not know it says: where it is sure, no other one finds more.
#[test]
fn no_elimination_finds_more_than_one_that_is_sure() {
    for (i, arm) in arms().iter().enumerate() {
        let frames = &arm.frames;
        let alone: Vec<Elimination> = arm.alone().map(|arm| arm.kept[0].elimination).collect();
        let mut random = Random(0xa119);
        let (mut reached, mut sure) = (0, 0);
        for k in 0..1500 {
            let q = anywhere(&mut random);
            let off = 10f64.powf(random.between(-9.0, -2.0));
            let target = match k % 3 {
                0 => aligned(frames, &q, 0.0),
                1 => aligned(frames, &q, off),
                _ => frames.forward(&q),
            };
            let said = said_alone(frames, &alone, &target, &format!("{i}: {k}"));
            if k % 3 == 0 && said.iter().any(|(_, found)| *found > 0) {
                reached += 1;
                sure += usize::from(said[0].0);
            }
        }
        // A fifth, and of the rounded one two fifths, were to be asked again.
        assert!(10 * sure > 9 * reached, "{i}: {sure} of {reached}");
    }
}
