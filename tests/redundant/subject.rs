//! A generated robot with a parameter beside the generic chain of the same file.

use crate::random::Random;
use crate::swivel::Shoulder;
use kin_codegen::model::{JointKind, Model};
use kin_codegen::spec::{ArmSpec, Source};
use kin_codegen::{Target, geometry};
use kinematics::{Chain, ChainSolution, Parameter, Pose, RedundantKinematics, SearchOptions};
use std::f64::consts::{PI, TAU};

pub struct Subject<K, const N: usize> {
    /// Where the file is.
    pub path: &'static str,
    /// What the macro made of the file.
    pub arm: K,
    /// The product of exponentials that the file describes.
    pub chain: Chain,
    /// What of a target counts; of a turn of the tool, the pose that it makes.
    pub counts: Target,
    /// Its size, metres.
    pub size: f64,
    /// Of every joint; of one that slides its travel.
    slides: [Option<[f64; 2]>; N],
}

impl<K: RedundantKinematics<N>, const N: usize> Subject<K, N> {
    pub fn new(arm: K, path: &'static str, counts: Target) -> Self {
        let text = std::fs::read_to_string(path).unwrap();
        let source = Source {
            path: path.into(),
            text,
        };
        let spec = ArmSpec::parse(&source).unwrap();
        let model = Model::new(&spec, None, None).unwrap();
        let slides = |i: usize| {
            let slides = model.joints[i].kind == JointKind::Prismatic;
            slides.then(|| model.variables[i].limits.unwrap())
        };
        Subject {
            path,
            arm,
            chain: model.chain(),
            counts,
            size: geometry::size(&model),
            slides: std::array::from_fn(slides),
        }
    }

    /// All that the numerical search finds.
    pub fn search(&self, target: &Pose, parameter: f64) -> Vec<ChainSolution> {
        let options = SearchOptions {
            target: self.counts,
            given: &[(K::PARAMETER, parameter)],
            ..SearchOptions::default()
        };
        self.chain.ik_all(target, &options)
    }

    /// The least singular value of the Jacobian of the joints that are not given, by the
    /// largest, lengths in units of the arm's size.
    pub fn conditioning(&self, q: &[f64]) -> f64 {
        let mut columns: Vec<_> = self.chain.geometric_jacobian(q);
        if let Parameter::Joint(joint) = K::PARAMETER {
            columns.remove(joint);
        }
        let mut least = f64::INFINITY;
        let mut along = vec![0.0; columns.len()];
        if let Parameter::Swivel(swivel) = K::PARAMETER {
            // The elbow moves along its circle, and where that has no side there is no angle.
            let shoulder = Shoulder::new(&self.arm, &swivel);
            let (radius, pole) = shoulder.distances(&self.chain, q);
            least = radius.min(pole) / self.size;
            // Also where there is no number: steps are no longer than the distance.
            if least.is_nan() || least < 1e-5 {
                return 0.0;
            }
            let step = 1e-6;
            let angle = |joint: usize, by: f64| {
                let mut moved = q.to_vec();
                moved[joint] += by;
                shoulder.angle(&self.chain, &moved, &self.chain.fk(q))
            };
            for (joint, along) in along.iter_mut().enumerate() {
                let way = angle(joint, step) - angle(joint, -step);
                let way = (way + PI).rem_euclid(TAU) - PI;
                *along = radius / self.size * way / (2.0 * step);
            }
        }
        let z = [0, 1, 2].map(|i| self.chain.fk(q).rotation[i][2]);
        let column = |twist: &kinematics::Twist| {
            let (v, w) = (twist.linear.map(|x| x / self.size), twist.angular);
            let about: f64 = (0..3).map(|i| z[i] * w[i]).sum();
            let spun = if self.counts == Target::PositionAxis {
                about
            } else {
                0.0
            };
            [
                v[0],
                v[1],
                v[2],
                w[0] - spun * z[0],
                w[1] - spun * z[1],
                w[2] - spun * z[2],
            ]
        };
        let rows: Vec<[f64; 6]> = columns.iter().map(column).collect();
        let matrix = nalgebra::DMatrix::from_fn(7, rows.len(), |i, j| match i {
            6 => along[j],
            _ => rows[j][i],
        });
        let values = singular_values::of(matrix);
        least.min(values[rows.len() - 1] / values[0])
    }

    /// How far `q` leaves the tip from what is asked, or the parameter, metres.
    pub fn miss(&self, q: &[f64; N], target: &Pose, parameter: f64) -> f64 {
        let target = match K::PARAMETER {
            Parameter::Turn => target.turned(parameter),
            Parameter::Joint(_) | Parameter::Swivel(_) => *target,
        };
        let held = match K::PARAMETER {
            Parameter::Joint(joint) => self.apart_at(joint, q[joint], parameter),
            Parameter::Turn => 0.0,
            Parameter::Swivel(swivel) => {
                let shoulder = Shoulder::new(&self.arm, &swivel);
                let (radius, pole) = shoulder.distances(&self.chain, q);
                let own = shoulder.angle(&self.chain, q, &self.chain.fk(q));
                let apart = (own - parameter + PI).rem_euclid(TAU) - PI;
                // Of targets next to the line of the first axis, a digit turns the angle.
                match radius.min(pole) < 1e-7 * self.size {
                    true => 0.0,
                    false => apart.abs() * radius * (pole / self.size).min(1.0),
                }
            }
        };
        let found = self.chain.fk(q);
        self.counts.distance(&found, &target, self.size).max(held)
    }

    /// The difference of two values of a joint: angles on the circle.
    fn apart_at(&self, joint: usize, a: f64, b: f64) -> f64 {
        let d = (a - b).abs();
        match self.slides[joint] {
            Some(_) => d,
            None => (d % TAU).min(TAU - d % TAU),
        }
    }

    /// The largest difference of two joint values.
    pub fn apart(&self, a: &[f64], b: &[f64]) -> f64 {
        let each = (0..N).map(|i| self.apart_at(i, a[i], b[i]));
        each.fold(0.0, f64::max)
    }

    /// Seeded configurations, angles over the whole turn.
    pub fn random(&self, count: usize) -> impl Iterator<Item = [f64; N]> {
        let mut random = Random::new(N as u64);
        (0..count).map(move |_| std::array::from_fn(|i| self.place(i, random.angle())))
    }

    /// Mixtures of multiples of π/2, and random ones but for one joint at a multiple.
    pub fn structured(&self) -> impl Iterator<Item = [f64; N]> {
        let mut random = Random::new(17);
        let mixed = (0..100).map(move |_| std::array::from_fn(|_| random.right_angle()));
        let mut random = Random::new(18);
        let one = (0..8 * N).map(move |k| {
            let mut q = std::array::from_fn(|_| random.angle());
            q[k % N] = random.right_angle();
            q
        });
        let angles = mixed.chain(one);
        angles.map(|angles: [f64; N]| std::array::from_fn(|i| self.place(i, angles[i])))
    }

    /// Values of the parameter that have nothing to do with a target.
    pub fn parameters(&self, count: usize) -> impl Iterator<Item = f64> {
        let mut random = Random::new(5);
        let joint = match K::PARAMETER {
            Parameter::Joint(joint) => Some(joint),
            Parameter::Turn | Parameter::Swivel(_) => None,
        };
        let place = move |angle| joint.map_or(angle, |joint| self.place(joint, angle));
        (0..count).map(move |_| place(random.angle()))
    }

    /// A joint value from an angle; a full turn is all of a slide's travel.
    fn place(&self, i: usize, angle: f64) -> f64 {
        match self.slides[i] {
            None => angle,
            Some([lower, upper]) => lower + (upper - lower) * (angle + PI) / (2.0 * PI),
        }
    }
}
