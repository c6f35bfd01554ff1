//! Paths of the tool at constant orientation, by their arc length.

use kinematics::Pose;

pub type Vector = [f64; 3];

/// Half of the length that is followed with a step, metres.
pub const STEPS: [(f64, f64); 2] = [(1e-3, 0.05), (1e-5, 0.005)];

/// Metres.
const RADIUS: f64 = 0.1;

/// Through a pose at s = 0.
pub fn line(through: Pose, along: Vector) -> impl Fn(f64) -> Pose {
    move |s| moved(&through, along.map(|x| s * x))
}

/// Through a pose at s = 0; `towards` the centre.
pub fn circle(through: Pose, along: Vector, towards: Vector) -> impl Fn(f64) -> Pose {
    move |s| {
        let (sine, cosine) = (s / RADIUS).sin_cos();
        let point = |i: usize| RADIUS * (sine * along[i] + (1.0 - cosine) * towards[i]);
        moved(&through, std::array::from_fn(point))
    }
}

fn moved(pose: &Pose, by: Vector) -> Pose {
    let translation = std::array::from_fn(|i| pose.translation[i] + by[i]);
    Pose {
        translation,
        ..*pose
    }
}

pub fn unit(v: Vector) -> Vector {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    v.map(|x| x / length)
}

pub fn cross(a: Vector, b: Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}
