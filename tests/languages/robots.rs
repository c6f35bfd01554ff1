//! The robots of this repository.

use crate::targets;
use kin_codegen::{Ik, Target};
use kinematics::RobotOptions;

/// A robot file, and how it is compiled.
pub struct Asked {
    pub path: &'static str,
    pub options: RobotOptions,
    /// Whether a polynomial in one joint takes part, or a correction of all branches: what of a
    /// family of solutions is found depends on rounding.
    pub eliminates: bool,
    /// Whether branches of an idealized arm are refined.
    pub refines: bool,
}

impl Asked {
    /// Without.
    pub fn of(path: &'static str, options: RobotOptions) -> Self {
        Asked {
            path,
            options,
            eliminates: false,
            refines: false,
        }
    }
}

const BY_DEFAULT: &[&str] = &[
    targets::UPRIGHT,
    targets::ALONG_RAIL,
    "robots/elbow.yaml",
    "robots/iiwa14.yaml",
    "robots/inverse_elbow.yaml",
    "robots/irb6640.yaml",
    "robots/kr6_r900.yaml",
    "robots/panda.yaml",
    "robots/planar_2r.yaml",
    "robots/planar_3r.yaml",
    "robots/puma560.yaml",
    "robots/scara.yaml",
    "robots/stanford.yaml",
    "robots/tx60.yaml",
    "robots/ur10e.yaml",
    "robots/ur5e.urdf",
    "tests/robots/coupled/finger.yaml",
    "tests/robots/coupled/palletizer.yaml",
    "tests/robots/coupled/palletizer_on_rail.yaml",
    "tests/robots/coupled/parallelogram.yaml",
    "tests/robots/coupled/rack.yaml",
    "tests/robots/coupled/remote_centre.yaml",
    "tests/robots/redundant/column.yaml",
    "tests/robots/redundant/rail.yaml",
    "tests/robots/table/concurrent_345.yaml",
    "tests/robots/table/parallel_123.yaml",
    "tests/robots/table/parallel_234.yaml",
    "tests/robots/table/slide_of_rrp.yaml",
    "tests/robots/table/slides_of_prp.yaml",
    "tests/robots/table/three_slides.yaml",
    "tests/robots/table/wrist_alone.yaml",
    "tests/robots/table/wrist_over_base.yaml",
    "tests/robots/targets/antenna.yaml",
    "tests/robots/targets/crank.yaml",
    "tests/robots/targets/cylindrical.yaml",
    "tests/robots/targets/gimbal.yaml",
    "tests/robots/targets/palletizer.yaml",
    "tests/robots/targets/polar.yaml",
];

/// Solved by a polynomial in one joint: of six joints, of seven one of which is given, and of five.
const ELIMINATED: &[(&str, Option<Target>)] = &[
    ("robots/sawyer.yaml", None),
    ("robots/xarm6.yaml", None),
    ("tests/robots/folding.yaml", None),
    ("tests/robots/crx10ial.yaml", None),
    (targets::FOLDED, None),
    ("tests/robots/table/one_slide.yaml", None),
    (
        "tests/robots/targets/desk_arm.yaml",
        Some(Target::PositionAxis),
    ),
    ("tests/robots/targets/five_skew.yaml", None),
    (
        "tests/robots/targets/five_skew.yaml",
        Some(Target::PositionAxis),
    ),
    ("tests/ui/robots/general.yaml", None),
];

/// Off their design, or with steps that degenerate where they do not or miss singular targets: the branches
/// of a closed form, refined, and a polynomial beside it.
const REFINED: &[(&str, Option<Target>)] = &[
    ("tests/robots/noisy/calibrated.yaml", None),
    ("tests/languages/humanoid.yaml", None),
    ("tests/robots/noisy/stray_offset.yaml", None),
    ("tests/robots/noisy/truncated_pi.yaml", None),
    (targets::NEXT_TO_AXIS_1, None),
    ("tests/robots/targets/welder.yaml", None),
];

/// For what of a target counts.
const AIMED: &[(&str, Target)] = &[
    ("robots/planar_3r.yaml", Target::Planar),
    ("robots/iiwa14.yaml", Target::PositionAxis),
    ("robots/scara.yaml", Target::PositionYaw),
    ("robots/ur5e.urdf", Target::PositionAxis),
    ("tests/robots/targets/antenna.yaml", Target::Direction),
    ("tests/robots/targets/gimbal.yaml", Target::Orientation),
    ("tests/robots/targets/polar.yaml", Target::Position),
    ("tests/robots/targets/rounded_planar.yaml", Target::Planar),
    (
        "tests/robots/targets/rounded_scara.yaml",
        Target::PositionYaw,
    ),
    ("tests/robots/targets/welder.yaml", Target::PositionAxis),
];

/// The same with some given in front of them and behind too.
pub const LIFTED: (&str, &[&str]) = (
    "tests/languages/lifted.yaml",
    &["lift", "right_j4", "table"],
);

/// With joints given between those that are solved for by a polynomial in one joint, alone and beside
/// the branches of a design: which, and whether of these.
const BETWEEN: &[(&str, &[&str], bool)] = &[
    ("robots/sawyer.yaml", &["right_j4"], false),
    ("tests/languages/skew.yaml", &["middle"], false),
    (LIFTED.0, LIFTED.1, false),
    (
        "tests/robots/redundant/stray_iiwa.yaml",
        &["joint_a3"],
        true,
    ),
    ("tests/robots/redundant/telescope.yaml", &["inner"], true),
];

/// Without inverse kinematics; it has joints that follow others, with frames on their links.
const FORWARD_ALONE: &[&str] = &["tests/frames/cell.urdf"];

/// With these given beside a target.
pub fn given(free: &[&str]) -> RobotOptions {
    RobotOptions {
        free: free.iter().map(|&joint| joint.into()).collect(),
        ..RobotOptions::default()
    }
}

fn aimed_at(target: Option<Target>) -> RobotOptions {
    RobotOptions {
        target,
        ..RobotOptions::default()
    }
}

/// All of them.
pub fn all() -> Vec<Asked> {
    let by_default = BY_DEFAULT.iter();
    let by_default = by_default.map(|&path| Asked::of(path, RobotOptions::default()));
    let eliminated = ELIMINATED.iter().map(|&(path, target)| Asked {
        eliminates: true,
        ..Asked::of(path, aimed_at(target))
    });
    let refined = REFINED.iter().map(|&(path, target)| Asked {
        eliminates: true,
        refines: true,
        ..Asked::of(path, aimed_at(target))
    });
    let aimed = AIMED.iter();
    let aimed = aimed.map(|&(path, target)| Asked::of(path, aimed_at(Some(target))));
    let seven = Asked::of("robots/iiwa14.yaml", given(&["joint_a3"]));
    // Turned about all axes: no angle is a half turn but for its last digit, where the languages differ.
    let gun = RobotOptions {
        tool: Some([0.1, -0.05, 0.31, 0.3, -0.6, 0.25]),
        ..aimed_at(Some(Target::PositionAxis))
    };
    let gun = Asked::of("robots/kr6_r900.yaml", gun);
    // Off its design, and no elimination stands beside its branches.
    let swivelled = Asked {
        eliminates: true,
        refines: true,
        ..Asked::of("tests/robots/redundant/stray_iiwa.yaml", given(&["swivel"]))
    };
    let between = BETWEEN.iter().map(|&(path, free, refines)| Asked {
        eliminates: true,
        refines,
        ..Asked::of(path, given(free))
    });
    let carried = Asked {
        eliminates: true,
        refines: true,
        ..Asked::of(
            "tests/robots/redundant/calibrated_rail.yaml",
            given(&["rail"]),
        )
    };
    let forward_alone = FORWARD_ALONE.iter().map(|&path| {
        let options = RobotOptions {
            ik: Ik::None,
            ..RobotOptions::default()
        };
        Asked::of(path, options)
    });
    let all = by_default
        .chain(eliminated)
        .chain(refined)
        .chain(aimed)
        .chain(between)
        .chain([seven, gun, swivelled, carried]);
    all.chain(forward_alone).collect()
}
