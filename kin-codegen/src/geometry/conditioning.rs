//! How far an arm is from singular: the rank and conditioning of its Jacobian.

use super::{Coupling, along, cross, dot, size, uncoupled};
use crate::model::{Model, configurations};
use kin_runtime::__private::SingularValues;
use kin_runtime::{Chain, Target, Twist};

/// Columns that are all shorter than this, relative to the arm's size, are
/// rounding.
const NOTHING: f64 = 1e-4;
/// Below this conditioning of the Jacobian a configuration counts as singular: its target may
/// have a family of solutions. An arm all of whose configurations are so near to singular is
/// singular, but for the noise of its file.
pub const SINGULAR: f64 = 1e-5;

/// Below this conditioning of the Jacobian of its positions an arm is planar, or as short of a
/// direction in another way, but for the noise of its file.
const FLAT: f64 = 2e-3;

/// What an arm can be asked for: the position of its tip where that alone
/// fixes the joints (a planar 2R arm, the first three joints of a larger one),
/// otherwise the whole pose.
pub fn natural_target(model: &Model) -> Target {
    if model.is_coupled() {
        // Dependent joints have to agree with the rest of a pose.
        return match uncoupled(model) {
            Ok((uncoupled, _)) if uncoupled.joints.len() == model.variables.len() => {
                natural_target(&uncoupled)
            }
            _ => Target::Pose,
        };
    }
    let chain = model.chain();
    let size = size(model);
    let n = model.joints.len();
    let fixed = |q: &Vec<f64>| conditioning(&chain, q, size, Target::Position) > FLAT;
    if n <= 3 && configurations(model).iter().any(fixed) {
        Target::Position
    } else {
        Target::Pose
    }
}

/// In how many ways, in words.
pub(crate) fn in_words(rank: usize) -> String {
    match rank {
        1 => "one way".into(),
        _ => format!("{rank} independent ways"),
    }
}

/// The largest number of independent ways in which the joints change what counts of a target: for
/// whole poses, in which they move the tip.
pub fn rank(model: &Model, target: Target) -> usize {
    let chain = model.chain();
    let size = size(model);
    most(model, |q| lengths(&chain, q, size, target, &[]))
}

/// The same of the coordinates of a chain whose joints depend on them.
pub fn coupled_rank(model: &Model, coupling: &Coupling, target: Target) -> usize {
    let chain = model.chain();
    let size = size(model);
    most(model, |joints| {
        let q = coupling.coordinates(joints);
        coupled_lengths(&chain, coupling, &q, size, target)
    })
}

/// The most columns that are seen to be independent, by their lengths for the values of joints.
fn most(model: &Model, lengths: impl Fn(&[f64]) -> Vec<f64>) -> usize {
    let rank = |q: &Vec<f64>| lengths(q).iter().filter(|x| **x > SINGULAR).count();
    let some = configurations(model).into_iter().take(8);
    some.map(|q| rank(&q)).max().unwrap_or(0)
}

/// The conditioning of the Jacobian for a target: the shortest column that is left
/// when each is made perpendicular to those before it, longest first, relative
/// to the longest. Within a factor of the least singular value.
pub fn conditioning(chain: &Chain, q: &[f64], size: f64, target: Target) -> f64 {
    with_row(chain, q, size, target, &[])
}

/// The same of the coordinates of a chain whose joints depend on them.
pub(super) fn coupled(
    chain: &Chain,
    coupling: &Coupling,
    q: &[f64],
    size: f64,
    target: Target,
) -> f64 {
    let lengths = coupled_lengths(chain, coupling, q, size, target);
    lengths.into_iter().fold(f64::INFINITY, f64::min)
}

/// The same with one more row below the Jacobian, an entry for each joint; none if it is
/// empty.
pub(super) fn with_row(chain: &Chain, q: &[f64], size: f64, target: Target, row: &[f64]) -> f64 {
    lengths(chain, q, size, target, row)
        .into_iter()
        .fold(f64::INFINITY, f64::min)
}

/// How much of the space of targets the joints that are not locked sweep for each unit that they move:
/// the volume that their columns of the Jacobian span, lengths in units of the arm's size.
pub fn volume(chain: &Chain, q: &[f64], size: f64, target: Target, locked: &[usize]) -> f64 {
    let columns = chain.geometric_jacobian(q).into_iter().enumerate();
    let solved = columns.filter(|(joint, _)| !locked.contains(joint));
    let motions: Vec<Motion> = solved.map(|(_, twist)| Motion::of(twist)).collect();
    let lengths = absolute(&motions, chain, q, size, target, &[]);
    lengths.into_iter().product()
}

/// The motion of six joints that moves the tip least, of length 1; none of more or fewer.
pub fn weak_motion(chain: &Chain, q: &[f64], size: f64) -> Option<[f64; 6]> {
    let columns: [Twist; 6] = chain.geometric_jacobian(q).try_into().ok()?;
    let values = SingularValues::<6, 6>::new(&unitless_rows(&columns, size));
    Some(values.right(5))
}

/// The rows of a Jacobian with these columns, lengths in units of the arm's size.
pub(super) fn unitless_rows(columns: &[Twist; 6], size: f64) -> [[f64; 6]; 6] {
    let entry = |row: usize, twist: &Twist| match row {
        0..3 => twist.linear[row] / size,
        _ => twist.angular[row - 3],
    };
    std::array::from_fn(|row| columns.each_ref().map(|twist| entry(row, twist)))
}

/// The lengths of the Jacobian's columns when each is made perpendicular to
/// those before it, longest first, relative to the longest. Lengths are in
/// units of the arm's size. `row` is one more below the Jacobian.
fn lengths(chain: &Chain, q: &[f64], size: f64, target: Target, row: &[f64]) -> Vec<f64> {
    let columns = chain.geometric_jacobian(q).into_iter();
    let motions: Vec<Motion> = columns.map(Motion::of).collect();
    relative(absolute(&motions, chain, q, size, target, row))
}

/// The same of the coordinates of a chain whose joints depend on them.
fn coupled_lengths(
    chain: &Chain,
    coupling: &Coupling,
    q: &[f64],
    size: f64,
    target: Target,
) -> Vec<f64> {
    let joints = coupling.joints(q);
    let mut motions = vec![Motion::default(); q.len()];
    for (twist, row) in chain.geometric_jacobian(&joints).iter().zip(&coupling.rows) {
        for (motion, &weight) in motions.iter_mut().zip(&row.weights) {
            motion.turns |= weight != 0.0 && turns(twist);
            motion.twist = motion.twist + *twist * weight;
        }
    }
    relative(absolute(&motions, chain, &joints, size, target, &[]))
}

/// How a coordinate moves the tip.
#[derive(Clone, Copy, Default)]
struct Motion {
    twist: Twist,
    /// Whether it is an angle: it turns a joint, though the tip may only be shifted by several.
    turns: bool,
}

impl Motion {
    /// A joint's own.
    fn of(twist: Twist) -> Self {
        Self {
            twist,
            turns: turns(&twist),
        }
    }
}

fn turns(twist: &Twist) -> bool {
    twist.angular != [0.0; 3]
}

fn relative(lengths: Vec<f64>) -> Vec<f64> {
    let longest = lengths.first().copied().unwrap_or(0.0).max(NOTHING);
    lengths.into_iter().map(|x| x / longest).collect()
}

/// The same in units of the arm's size.
fn absolute(
    motions: &[Motion],
    chain: &Chain,
    q: &[f64],
    size: f64,
    target: Target,
    row: &[f64],
) -> Vec<f64> {
    let z = match target {
        Target::PositionAxis | Target::Direction => chain.fk(q).rotation.map(|row| row[2]),
        _ => [0.0; 3],
    };
    let first = chain.twists().iter().find(|twist| turns(twist));
    let yaw = first.map_or([0.0; 3], |twist| twist.angular);
    let rows = |&Motion { twist, turns }: &Motion| -> Column {
        // A slide goes as far as the arm is long where a joint turns by one radian.
        let unit = if turns { size } else { 1.0 };
        let v = twist.linear.map(|x| x / unit);
        let w = twist.angular;
        let about = dot(w, yaw);
        match target {
            Target::Pose => column([v, w]),
            Target::Position => column([v, [0.0; 3]]),
            Target::PositionAxis => column([v, cross(w, z)]),
            Target::Direction => column([cross(w, z), [0.0; 3]]),
            Target::Orientation => column([w, [0.0; 3]]),
            Target::PositionYaw => column([v, [about, 0.0, 0.0]]),
            Target::Planar => column([along(v, -dot(v, yaw), yaw), [about, 0.0, 0.0]]),
        }
    };
    let mut columns: Vec<Column> = motions.iter().map(rows).collect();
    for (column, &entry) in columns.iter_mut().zip(row) {
        column[6] = entry;
    }
    let mut lengths: Vec<f64> = Vec::with_capacity(columns.len());
    while let Some((place, square)) = longest(&columns) {
        let next = columns.swap_remove(place);
        lengths.push(square.sqrt());
        for column in columns.iter_mut().filter(|_| square > 0.0) {
            let along = product(column, &next) / square;
            for (x, y) in column.iter_mut().zip(&next) {
                *x -= along * y;
            }
        }
    }
    lengths
}

/// A column of the Jacobian: the rows that count, one more below them, and zeros.
type Column = [f64; 7];

fn column([[a, b, c], [d, e, f]]: [[f64; 3]; 2]) -> Column {
    [a, b, c, d, e, f, 0.0]
}

/// The place of the longest one and the square of its length.
fn longest(columns: &[Column]) -> Option<(usize, f64)> {
    let all = columns.iter().map(|column| product(column, column));
    all.enumerate().max_by(|(_, a), (_, b)| a.total_cmp(b))
}

fn product(a: &Column, b: &Column) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::{ArmSpec, Source};

    /// An upper arm that one angle turns and another turns back, so that it shifts what it carries:
    /// an angle all the same, whatever the unit of length.
    #[test]
    fn a_parallelogram_is_moved_by_an_angle() {
        let arm = |unit: f64| {
            let joint = |name, parent, xyz: [f64; 3], axis, more| {
                let [x, y, z] = xyz.map(|x| x * unit);
                format!(
                    "<link name=\"{name}\"/><joint name=\"to_{name}\" type=\"continuous\">\
                     <parent link=\"{parent}\"/><child link=\"{name}\"/>\
                     <origin xyz=\"{x} {y} {z}\"/><axis xyz=\"{axis}\"/>{more}</joint>"
                )
            };
            let back = "<mimic joint=\"to_c\" multiplier=\"-1\"/>";
            let joints = [
                joint("a", "base", [0.0, 0.0, 0.6], "0 0 1", ""),
                joint("b", "a", [0.1, 0.0, 0.0], "0 1 0", back),
                joint("c", "b", [0.0, 0.0, 0.7], "0 1 0", ""),
                joint("d", "c", [0.4, 0.0, 0.0], "0 1 0", ""),
            ];
            let tool = format!(
                "<link name=\"tool0\"/><joint name=\"tool\" type=\"fixed\"><parent link=\"d\"/>\
                 <child link=\"tool0\"/><origin xyz=\"{} 0 0\"/></joint>",
                0.3 * unit
            );
            let source = Source {
                path: "arm.urdf".into(),
                text: format!(
                    "<robot name=\"arm\"><link name=\"base\"/>{}{tool}</robot>",
                    joints.concat()
                ),
            };
            Model::new(&ArmSpec::parse(&source).unwrap(), None, None).unwrap()
        };
        for unit in [1.0, 1e-6] {
            let (model, linkage) = uncoupled(&arm(unit)).unwrap();
            let coupling = linkage.coupling.unwrap();
            assert_eq!(
                coupled_rank(&model, &coupling, Target::Position),
                3,
                "{unit}"
            );
        }
    }
}
