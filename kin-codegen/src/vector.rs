//! Vectors of three numbers.

/// A point or a vector, in the coordinates and units that its name says.
pub type Vec3 = [f64; 3];

/// a · b.
pub fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// a × b.
pub fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// a − b.
pub fn sub(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// p + t v.
pub fn along(p: Vec3, t: f64, v: Vec3) -> Vec3 {
    [p[0] + t * v[0], p[1] + t * v[1], p[2] + t * v[2]]
}

/// |a|.
pub fn norm(a: Vec3) -> f64 {
    dot(a, a).sqrt()
}

/// The angle between the lines along two vectors, from 0 to π/2, exact also where it is small.
pub fn angle(a: Vec3, b: Vec3) -> f64 {
    norm(cross(a, b)).atan2(dot(a, b).abs())
}

/// a / |a|, for a vector that has a direction.
pub fn unit(a: Vec3) -> Vec3 {
    let n = norm(a);
    a.map(|x| x / n)
}
