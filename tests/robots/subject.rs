//! A generated robot beside the generic one of the same file.

use crate::aim::{freed, projected, seen};
use crate::measure::{self, angle_between, largest};
use crate::random::Random;
use kin_codegen::model::{JointKind, Model};
use kin_codegen::spec::{ArmSpec, Source};
use kin_codegen::{Target, geometry};
use kinematics::{Chain, ChainSolution, Kinematics, Pose, SearchOptions, Solution};
use std::f64::consts::{FRAC_PI_2, PI};

pub struct Subject<K, const N: usize> {
    /// Where the file is.
    pub path: &'static str,
    /// What the macro made of the file.
    pub arm: K,
    /// The product of exponentials that the file describes.
    pub chain: Chain,
    /// What of a target counts.
    pub counts: Target,
    /// The chain with joints for what does not count.
    freed: Chain,
    /// Its size, metres.
    pub size: f64,
    /// The travel of a sliding joint; none for one that turns.
    travel: [Option<[f64; 2]>; N],
}

impl<K: Kinematics<N>, const N: usize> Subject<K, N> {
    pub fn new(arm: K, path: &'static str) -> Self {
        let model = read(path);
        let (chain, counts) = (model.chain(), geometry::natural_target(&model));
        Subject {
            path,
            arm,
            freed: freed(&chain, counts),
            chain,
            counts,
            size: geometry::size(&model),
            travel: std::array::from_fn(|i| travel(&model, i)),
        }
    }

    /// The same robot with targets of which counts what an option names.
    pub fn counting(self, option: &str) -> Self {
        let counts = Target::from_word(option).unwrap();
        Subject {
            freed: freed(&self.chain, counts),
            counts,
            ..self
        }
    }

    /// The generated inverse kinematics.
    pub fn ik(&self, target: &Pose) -> Vec<Solution<N>> {
        self.arm.ik(target).iter().copied().collect()
    }

    /// All that the numerical search finds.
    pub fn search(&self, target: &Pose) -> Vec<ChainSolution> {
        let options = SearchOptions {
            target: self.counts,
            ..SearchOptions::default()
        };
        self.chain.ik_all(target, &options)
    }

    /// The whole pose that a target stands for.
    fn whole(&self, target: &Pose) -> Pose {
        projected(&self.chain, self.counts, target)
    }

    /// How far `q` leaves the tool from the target, relative to the arm's
    /// size.
    pub fn miss(&self, q: &[f64; N], target: &Pose) -> f64 {
        let [found, target] = [&self.chain.fk(q), target].map(|pose| self.whole(pose));
        measure::distance(&found, &target, self.counts, self.size) / self.size
    }

    /// The largest difference of two joint values: angles on the circle,
    /// lengths in units of the arm's size.
    pub fn apart(&self, a: &[f64], b: &[f64]) -> f64 {
        largest((0..N).map(|i| match self.travel[i] {
            None => angle_between(a[i], b[i]),
            Some(_) => (a[i] - b[i]) / self.size,
        }))
    }

    /// The least of [`measure::singular_values`]: how little the tool moves for
    /// a unit of joint motion.
    pub fn conditioning(&self, q: &[f64]) -> f64 {
        self.least_singular_values(q)[0]
    }

    /// The least two of [`measure::singular_values`].
    pub fn least_singular_values(&self, q: &[f64]) -> [f64; 2] {
        let mut all = q.to_vec();
        all.resize(self.freed.twists().len(), 0.0);
        let columns = self.freed.geometric_jacobian(&all);
        let jacobian: Vec<_> = columns
            .iter()
            .map(|column| seen(&self.chain, self.counts, column))
            .collect();
        let values = measure::singular_values(&jacobian, self.counts, self.size);
        let from_end = |i: usize| values.iter().rev().nth(i).copied();
        [
            from_end(0).unwrap_or(0.0),
            from_end(1).unwrap_or(f64::INFINITY),
        ]
    }

    /// Whether joint i turns.
    pub fn turns(&self, i: usize) -> bool {
        self.travel[i].is_none()
    }

    /// Seeded configurations, angles over the whole turn.
    pub fn random(&self, count: usize) -> impl Iterator<Item = [f64; N]> {
        let mut random = Random::new(N as u64);
        (0..count).map(move |_| std::array::from_fn(|i| self.place(i, random.angle())))
    }

    /// Home; all joints at one multiple of π/2, any mixture of multiples;
    /// random ones but for one joint at a multiple.
    pub fn structured(&self) -> impl Iterator<Item = [f64; N]> {
        const RIGHT: [f64; 4] = [0.0, FRAC_PI_2, -FRAC_PI_2, PI];
        let all = RIGHT.into_iter().map(|angle| [angle; N]);
        let mut random = Random::new(17);
        let mixed = (0..60).map(move |_| std::array::from_fn(|_| random.right_angle()));
        let mut random = Random::new(18);
        let one = (0..4 * N).map(move |k| {
            let mut q = std::array::from_fn(|_| random.angle());
            q[k / 4] = RIGHT[k % 4];
            q
        });
        let angles = all.chain(mixed).chain(one);
        angles.map(|angles: [f64; N]| std::array::from_fn(|i| self.place(i, angles[i])))
    }

    /// Multiples of π/2 but for up to 1e-10 to 1e-6 in each joint: where steps are singular one next to
    /// another.
    pub fn nearly_structured(&self, count: usize) -> impl Iterator<Item = [f64; N]> {
        let mut random = Random::new(19);
        (0..count).map(move |_| {
            let off = 10f64.powf(random.between(-10.0, -6.0));
            std::array::from_fn(|i| {
                let angle = random.right_angle() + off * random.between(-1.0, 1.0);
                self.place(i, angle)
            })
        })
    }

    /// A joint value from an angle; a full turn is all of a slide's travel.
    fn place(&self, i: usize, angle: f64) -> f64 {
        match self.travel[i] {
            None => angle,
            Some([lower, upper]) => lower + (upper - lower) * (angle + PI) / (2.0 * PI),
        }
    }
}

/// The chain that a robot file describes.
fn read(path: &str) -> Model {
    let text = std::fs::read_to_string(path).unwrap();
    let path = path.into();
    let spec = ArmSpec::parse(&Source { path, text }).unwrap();
    Model::new(&spec, None, None).unwrap()
}

fn travel(model: &Model, i: usize) -> Option<[f64; 2]> {
    let finite = |limits: &[f64; 2]| limits.iter().all(|x| x.is_finite());
    let limits = model.variables[i].limits.filter(finite);
    (model.joints[i].kind == JointKind::Prismatic).then(|| limits.unwrap_or([-0.5, 0.5]))
}
