//! Limits that can be meant, and what they say about each coordinate.

use super::Variable;
use super::chain::Chain;
use super::mimic::Drives;
use crate::spec::{ArmSpec, Collector, Joint, JointType, Limits, Rating};

/// Numbers of this size, as limits of an angle, are degrees if they are whole or of quarters: 45 rad
/// are seven turns.
const DEGREES: std::ops::RangeInclusive<f64> = 45.0..=720.0;

/// Of radians few limits are beyond two turns to both sides; a flange often turns more than once.
const TWO_TURNS: f64 = 12.6;

/// Strokes of this size are millimetres.
const MILLIMETRES: std::ops::RangeInclusive<f64> = 100.0..=FARTHEST;

/// Beyond it people write "no limit", metres.
pub(super) const FARTHEST: f64 = 10_000.0;

/// To both sides of zero these say "no limit" as well, radians or metres: of virtual joints under a
/// robot, of motors and of wheels.
const BOUNDLESS: [f64; 5] = [100.0, 500.0, 1000.0, 5000.0, 10_000.0];

/// Reports every moving joint of the chain whose limits are missing,
/// empty, or in another unit.
pub(super) fn check(spec: &ArmSpec, chain: &Chain, diagnostics: &mut Collector) {
    for &j in &chain.joints {
        let joint = &spec.joints[j];
        if matches!(joint.kind, JointType::Revolute | JointType::Prismatic) {
            check_joint(joint, diagnostics);
        }
    }
    check_travel(spec, chain, diagnostics);
}

/// Warns where no joint turns as far from zero as radians read as degrees do.
fn check_travel(spec: &ArmSpec, chain: &Chain, diagnostics: &mut Collector) {
    let farthest = |&j: &usize| match (spec.joints[j].kind, spec.joints[j].limits) {
        (JointType::Revolute, Limits::Range { lower, upper, .. }) => {
            Some(lower.abs().max(upper.abs()))
        }
        (JointType::Revolute, _) => Some(f64::INFINITY),
        _ => None,
    };
    let travels: Vec<f64> = chain.joints.iter().filter_map(farthest).collect();
    let most = travels.iter().copied().fold(0.0, f64::max);
    if travels.len() > 1 && most > 0.0 && most < TWO_TURNS.to_radians() {
        let reason = format!(
            "no joint turns farther than {:.2} degrees from zero: this looks like radians, read as \
             degrees",
            most.to_degrees()
        );
        let remedy = "write limits in the unit of the file: radians in a URDF, in YAML what `units` \
                      states";
        diagnostics.warn_whole(reason, remedy);
    }
}

fn check_joint(joint: &Joint, diagnostics: &mut Collector) {
    let name = &joint.name;
    let turns = joint.kind == JointType::Revolute;
    let unit = if turns { "rad" } else { "m" };
    let (lower, upper, at) = match joint.limits {
        Limits::Unlimited => return,
        Limits::Missing => {
            let reason =
                format!("joint `{name}` has no <limit>, which other programs read as 0..0");
            let continuous = if turns {
                ", or make it type=\"continuous\" if it turns freely"
            } else {
                ""
            };
            let remedy = format!(
                "add <limit lower=\"...\" upper=\"...\" effort=\"...\" velocity=\"...\"/>{continuous}"
            );
            return diagnostics.at(joint.at, reason, remedy);
        }
        Limits::Range { lower, upper, at } => (lower, upper, at),
    };
    let round = [lower, upper].iter().all(|end| (4.0 * end).fract() == 0.0);
    let largest = lower.abs().max(upper.abs());
    if lower > upper {
        diagnostics.at(
            at,
            format!(
                "joint `{name}` has the lower limit {lower} {unit} above the upper limit {upper} {unit}"
            ),
            match turns {
                true => {
                    "swap them if that is what is meant; where it means no limits, as some \
                     simulators read it, make the joint continuous (in YAML, leave out `limits`)"
                }
                false => {
                    "swap them if that is what is meant; where it means no limits, as some \
                     simulators read it, write how far the joint slides"
                }
            },
        );
    } else if lower == 0.0 && upper == 0.0 {
        let reason = format!(
            "joint `{name}` has the limits 0..0, so it cannot move; usually the real ones are missing"
        );
        diagnostics.warn(
            at,
            reason,
            "write its limits, or make it fixed (or continuous, if it turns freely)",
        );
    } else if lower == -upper && BOUNDLESS.contains(&upper) {
        let (moves, remedy) = match turns {
            true => (
                "turns",
                "make it continuous if it turns freely (in YAML, leave out `limits`); if degrees are \
                 meant, write radians",
            ),
            false => (
                "slides",
                "write how far it slides; if millimetres are meant, write metres",
            ),
        };
        let reason = format!(
            "joint `{name}` {moves} {lower}..{upper} {unit}, which is as good as no limits"
        );
        diagnostics.warn(at, reason, remedy);
    } else if turns && round && DEGREES.contains(&largest) {
        let reason =
            format!("joint `{name}` has the limits {lower}..{upper} rad: this looks like degrees");
        diagnostics.at(
            at,
            reason,
            "write radians (180 degrees are 3.141592653589793), or state `angle: deg` in YAML; if it \
             turns freely, make it continuous (in YAML, leave out `limits`)",
        );
    } else if !turns && MILLIMETRES.contains(&largest) {
        let reason =
            format!("joint `{name}` slides {lower}..{upper} m: this looks like millimetres");
        diagnostics.at(
            at,
            reason,
            "write metres; if there is no stop, more than 10000 to both sides",
        );
    }
}

/// The coordinates of the chain. A coordinate that moves several joints has
/// the range in which all of them are within their limits.
pub(super) fn variables(
    spec: &ArmSpec,
    drives: &Drives,
    diagnostics: &mut Collector,
) -> Vec<Variable> {
    let mut variables = Vec::new();
    // By coordinate: the range in which all that it moves stay.
    let mut ranges: Vec<Option<[f64; 2]>> = vec![None; drives.leaders.len()];
    let mut narrow_by = |v: usize, j: usize, multiplier: f64, offset: f64| {
        if let Limits::Range { lower, upper, .. } = spec.joints[j].limits {
            let ends = [lower, upper].map(|end| (end - offset) / multiplier);
            ranges[v] = Some(narrow(
                ranges[v],
                [ends[0].min(ends[1]), ends[0].max(ends[1])],
            ));
        }
    };
    let mut ratings: Vec<Rating> = drives
        .leaders
        .iter()
        .map(|&j| spec.joints[j].rating)
        .collect();
    for (j, drive) in drives.all() {
        narrow_by(drive.variable, j, drive.multiplier, drive.offset);
        let velocity = &mut ratings[drive.variable].velocity;
        let own = spec.joints[j].rating.velocity;
        let followed = own.map(|own| own / drive.multiplier.abs());
        *velocity = [*velocity, followed].into_iter().flatten().reduce(f64::min);
    }
    for ((&leader, limits), rating) in drives.leaders.iter().zip(ranges).zip(ratings) {
        let joint = &spec.joints[leader];
        if limits.is_some_and(|[lower, upper]: [f64; 2]| lower > upper) {
            let reason = format!(
                "no value of joint `{}` keeps the joints that mimic it within their limits",
                joint.name
            );
            diagnostics.at(
                joint.at,
                reason,
                "correct the limits, or the multiplier and offset of its mimics",
            );
        }
        variables.push(Variable {
            name: joint.name.clone(),
            limits,
            rating,
        });
    }
    variables
}

/// The common part of two ranges. Ends that differ by rounding count as equal.
fn narrow(range: Option<[f64; 2]>, other: [f64; 2]) -> [f64; 2] {
    const ROUNDING: f64 = 1e-9;
    let Some([lower, upper]) = range else {
        return other;
    };
    [
        if other[0] > lower + ROUNDING {
            other[0]
        } else {
            lower
        },
        if other[1] < upper - ROUNDING {
            other[1]
        } else {
            upper
        },
    ]
}
