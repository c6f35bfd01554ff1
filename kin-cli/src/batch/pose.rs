//! Poses as columns.

use crate::table::{Column, Fault, Header, Kind, number_for_name};
use kin_runtime::{Pose, Target};
use std::path::Path;

/// What the three columns of a position may be called, metres.
const POSITIONS: [[&str; 3]; 5] = [
    ["x", "y", "z"],
    ["tx", "ty", "tz"],
    ["px", "py", "pz"],
    ["position.x", "position.y", "position.z"],
    ["m03", "m13", "m23"],
];

/// What the four columns of a quaternion may be called.
const QUATERNIONS: [[&str; 4]; 2] = [
    ["qx", "qy", "qz", "qw"],
    [
        "orientation.x",
        "orientation.y",
        "orientation.z",
        "orientation.w",
    ],
];

/// What the nine columns of a rotation matrix may be called, row by row.
const MATRICES: [[&str; 9]; 2] = [
    [
        "r00", "r01", "r02", "r10", "r11", "r12", "r20", "r21", "r22",
    ],
    [
        "m00", "m01", "m02", "m10", "m11", "m12", "m20", "m21", "m22",
    ],
];

/// The last row of a homogeneous matrix, which may be left out.
const LAST_ROW: [&str; 4] = ["m30", "m31", "m32", "m33"];

/// A quaternion or a matrix that is farther from a rotation than this was meant as none: of
/// files with three digits, one is nearer.
const ROTATION: f64 = 1e-2;

/// Where poses are in the columns that were selected.
pub struct PoseColumns {
    /// The places in the file to select, this first.
    pub selected: Vec<usize>,
    has_position: bool,
    rotation: Rotation,
    has_last_row: bool,
}

/// Where a rotation is in a file.
enum Rotation {
    None,
    Quaternion(Vec<usize>),
    Matrix(Vec<usize>),
}

/// The places of the rotation in a homogeneous matrix, row by row.
const UPPER_LEFT: [usize; 9] = [0, 1, 2, 4, 5, 6, 8, 9, 10];

impl PoseColumns {
    /// Finds what counts of poses for targets of this kind.
    ///
    /// `given` are the columns of what is given beside a pose, which an array without names has
    /// behind it.
    ///
    /// # Errors
    ///
    /// It is not there, or twice.
    pub fn find(
        path: &Path,
        header: &Header,
        target: Target,
        given: &[&str],
    ) -> Result<Self, Fault> {
        match header {
            Header::Names(names) => Self::by_name(path, names, target, given),
            Header::Width(width) => Self::by_width(path, *width, target, given.len()),
        }
    }

    fn by_width(path: &Path, width: usize, target: Target, given: usize) -> Result<Self, Fault> {
        let (position, rotation, last_row) = match width.checked_sub(given) {
            Some(3) if !target.has_rotation() => ([0, 1, 2], Rotation::None, vec![]),
            Some(7) => ([0, 1, 2], Rotation::Quaternion(vec![3, 4, 5, 6]), vec![]),
            Some(12) => ([3, 7, 11], Rotation::Matrix(UPPER_LEFT.to_vec()), vec![]),
            Some(16) => (
                [3, 7, 11],
                Rotation::Matrix(UPPER_LEFT.to_vec()),
                vec![12, 13, 14, 15],
            ),
            _ => {
                let reason = format!("rows of {width} numbers are no poses");
                let behind = match given {
                    0 => String::new(),
                    _ => format!(", and {given} more for what is given beside a target"),
                };
                let remedy = format!(
                    "let rows have 7 numbers (x, y, z, qx, qy, qz, qw), or the 12 or 16 of a \
                     homogeneous matrix row by row{behind}"
                );
                return Err(Fault::whole(path, reason, remedy));
            }
        };
        Ok(Self::new(
            target,
            Some(position.to_vec()),
            rotation,
            last_row,
        ))
    }

    fn by_name(
        path: &Path,
        names: &[String],
        target: Target,
        given: &[&str],
    ) -> Result<Self, Fault> {
        let own = |name: &String| match given.contains(&name.as_str()) {
            true => String::new(),
            false => name.clone(),
        };
        let own: Vec<String> = names.iter().map(own).collect();
        let position = only(path, "position", &own, &POSITIONS)?;
        let quaternion = only(path, "rotation", &own, &QUATERNIONS)?;
        let matrix = only(path, "rotation", &own, &MATRICES)?;
        let rotation = match (quaternion, matrix) {
            (Some(_), Some(_)) => {
                let reason = "a row has its rotation twice, as a quaternion and as a matrix";
                return Err(Fault::whole(path, reason, ONE_OF_THEM));
            }
            (Some(places), None) => Rotation::Quaternion(places),
            (None, Some(places)) => Rotation::Matrix(places),
            (None, None) => Rotation::None,
        };
        if position.is_none() && target.has_translation() {
            return Err(missing(
                path,
                "position",
                names,
                given,
                POSITIONS.as_flattened().chunks(3),
            ));
        }
        if matches!(rotation, Rotation::None) && target.has_rotation() {
            let quaternions = QUATERNIONS.as_flattened().chunks(4);
            let forms = quaternions.chain(MATRICES.as_flattened().chunks(9));
            return Err(missing(path, "rotation", names, given, forms));
        }
        let last_row = find(path, &own, &LAST_ROW)?.unwrap_or_default();
        Ok(Self::new(target, position, rotation, last_row))
    }

    /// Of all that is there, what counts for targets of this kind.
    fn new(
        target: Target,
        position: Option<Vec<usize>>,
        rotation: Rotation,
        last_row: Vec<usize>,
    ) -> Self {
        let position = position.filter(|_| target.has_translation());
        let rotation = match target.has_rotation() {
            true => rotation,
            false => Rotation::None,
        };
        let last_row = match rotation {
            Rotation::Matrix(_) => last_row,
            _ => Vec::new(),
        };
        let turned = match &rotation {
            Rotation::None => &[],
            Rotation::Quaternion(places) | Rotation::Matrix(places) => &places[..],
        };
        Self {
            selected: [position.as_deref().unwrap_or_default(), turned, &last_row].concat(),
            has_position: position.is_some(),
            rotation,
            has_last_row: !last_row.is_empty(),
        }
    }

    /// The pose of a row.
    ///
    /// # Errors
    ///
    /// It is none, in words.
    pub fn pose(&self, columns: &[Vec<f64>], row: usize) -> Result<Pose, &'static str> {
        let columns = &columns[..self.selected.len()];
        if columns.iter().any(|column| !column[row].is_finite()) {
            return Err("a value is missing, or no finite number");
        }
        let mut values = columns.iter().map(|column| column[row]);
        let mut next = || values.next().unwrap_or(0.0);
        let translation = if self.has_position {
            std::array::from_fn(|_| next())
        } else {
            [0.0; 3]
        };
        let pose = match &self.rotation {
            Rotation::None => Pose::from_translation(translation),
            Rotation::Quaternion(_) => {
                let quaternion: [f64; 4] = std::array::from_fn(|_| next());
                let square: f64 = quaternion.iter().map(|part| part * part).sum();
                if (square.sqrt() - 1.0).abs() > ROTATION {
                    return Err("the quaternion has not the length 1");
                }
                Pose::from_quaternion(quaternion, translation)
            }
            Rotation::Matrix(_) => {
                let entries = std::array::from_fn(|_| std::array::from_fn(|_| next()));
                let read = Pose {
                    rotation: entries,
                    translation,
                };
                let near = read.rotation_error() <= ROTATION;
                let mended = near.then(|| read.orthonormalized()).flatten();
                mended.ok_or("the matrix is no rotation")?
            }
        };
        let mut is_next = |entry: f64| (next() - entry).abs() <= ROTATION;
        if self.has_last_row && [0.0, 0.0, 0.0, 1.0].map(&mut is_next) != [true; 4] {
            return Err("the last row of the matrix is not 0, 0, 0, 1: it may be transposed");
        }
        Ok(pose)
    }
}

const ONE_OF_THEM: &str = "leave one of them out, or give it other names";

/// The places of these names; none if not all of them are there.
fn find(path: &Path, names: &[String], wanted: &[&str]) -> Result<Option<Vec<usize>>, Fault> {
    let own = |name: &&String, wanted: &str| name.strip_prefix("pose.").unwrap_or(name) == wanted;
    let place = |wanted: &&str| names.iter().position(|name| own(&name, wanted));
    let Some(places) = wanted.iter().map(place).collect::<Option<Vec<usize>>>() else {
        return Ok(None);
    };
    for wanted in wanted {
        let mut called = names.iter().filter(|name| own(name, wanted));
        if let (Some(one), Some(other)) = (called.next(), called.next()) {
            let reason = match one == other {
                true => format!("two columns are called `{one}`"),
                false => format!("the columns `{one}` and `{other}` are the same"),
            };
            return Err(Fault::whole(path, reason, "leave one of them out"));
        }
    }
    Ok(Some(places))
}

/// The places of the only form that is there; none if none is.
fn only<const N: usize>(
    path: &Path,
    what: &str,
    names: &[String],
    forms: &[[&str; N]],
) -> Result<Option<Vec<usize>>, Fault> {
    let mut found = Vec::new();
    for form in forms {
        found.extend(find(path, names, form)?.map(|places| (form, places)));
    }
    let mut found = found.into_iter();
    let first = found.next();
    match (&first, found.next()) {
        (Some((one, _)), Some((other, _))) => {
            let reason = format!(
                "a row has its {what} twice, as `{}` and `{}`",
                one[0], other[0]
            );
            Err(Fault::whole(path, reason, ONE_OF_THEM))
        }
        _ => Ok(first.map(|(_, places)| places)),
    }
}

fn missing<'a>(
    path: &Path,
    what: &str,
    names: &[String],
    given: &[&str],
    forms: impl Iterator<Item = &'a [&'a str]>,
) -> Fault {
    let forms: Vec<&[&str]> = forms.collect();
    // A joint that is given has the name of one of these columns.
    let is_given = |name: &&&str| given.contains(*name) && names.iter().any(|it| it == **name);
    if let Some(name) = forms.iter().copied().flatten().find(is_given) {
        return Fault::whole(
            path,
            format!(
                "the column `{name}` has the values of the joint `{name}`, not what poses have so"
            ),
            "call the columns of the pose `px`, `py`, `pz` or `m00` to `m23`, and leave this one to \
             the joint; or give the joint for all poses by `--at`",
        );
    }
    let forms = forms.iter().map(|form| format!("`{}`", form.join(",")));
    let forms: Vec<String> = forms.collect();
    number_for_name(path, names).unwrap_or_else(|| {
        let reason = format!("no columns for the {what}; there are {}", list(names));
        Fault::whole(path, reason, format!("name them {}", forms.join(" or ")))
    })
}

/// Names for a message, not too many, and of long ones the start.
pub fn list(names: &[String]) -> String {
    const SHOWN: usize = 20;
    const LONGEST: usize = 80;
    let short = |name: &String| {
        let start: String = name.chars().take(LONGEST).collect();
        let rest = if start.len() < name.len() { " …" } else { "" };
        format!("`{}`{rest}", kin_codegen::spec::one_line(&start))
    };
    let mut shown: Vec<String> = names.iter().take(SHOWN).map(short).collect();
    if names.len() > SHOWN {
        shown.push(format!("{} more", names.len() - SHOWN));
    }
    shown.join(", ")
}

/// How poses are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Written {
    /// x, y, z, qx, qy, qz, qw.
    Quaternion,
    /// Three rows of the homogeneous matrix.
    Matrix,
}

impl Written {
    /// The columns.
    pub fn columns(self) -> Vec<Column> {
        let real = |name: &str| Column {
            name: name.into(),
            kind: Kind::Real,
        };
        match self {
            Written::Quaternion => POSITIONS[0]
                .iter()
                .chain(&QUATERNIONS[0])
                .map(|it| real(it))
                .collect(),
            Written::Matrix => {
                let entry = |i: usize| real(&format!("m{}{}", i / 4, i % 4));
                (0..12).map(entry).collect()
            }
        }
    }

    /// The values of a pose, in the order of the columns.
    pub fn values(self, pose: &Pose) -> impl Iterator<Item = f64> + use<> {
        let values: [f64; 12] = match self {
            Written::Quaternion => {
                let ([x, y, z], [qx, qy, qz, qw]) = (pose.translation, pose.quaternion());
                [x, y, z, qx, qy, qz, qw, 0.0, 0.0, 0.0, 0.0, 0.0]
            }
            Written::Matrix => {
                let matrix = pose.to_matrix();
                std::array::from_fn(|i| matrix[i / 4][i % 4])
            }
        };
        let count = match self {
            Written::Quaternion => 7,
            Written::Matrix => 12,
        };
        values.into_iter().take(count)
    }
}
