//! The constants and methods of [`ParallelKinematics`](crate::ParallelKinematics),
//! once: the trait and the methods of generated mechanisms are made of this list.

/// Hands the list to the macro `$then`, behind `$n`, `$m` and `$k`, the numbers of
/// joints, actuated joints and chains as they are to be written, and what else
/// `$then` takes.
///
/// Mechanisms bring `required`, and may bring `inverse` and `forward`; all others
/// are provided. The documentation is read in users' crates as well: it links to
/// `Self` alone.
#[doc(hidden)]
#[macro_export]
macro_rules! parallel_methods {
    ($then:ident, $n:tt $m:tt $k:tt $($of:tt)*) => {
        $crate::$then! { [$n $m $k $($of)*]
            constants {
                /// The joints' names, chain after chain, from base to platform.
                const JOINT_NAMES: [&'static str; $n];
                /// The joints' kinds and travel.
                const LIMITS: [$crate::JointLimit; $n];
                /// How fast the joints may move, rad/s, and m/s of prismatic joints;
                /// infinity where that is not known.
                const VELOCITY_LIMITS: [f64; $n] = [f64::INFINITY; $n];
                /// What the joints' drives may exert, N m, and N of prismatic joints;
                /// infinity where that is not known.
                const EFFORT_LIMITS: [f64; $n] = [f64::INFINITY; $n];
                /// The first joint of every chain, and one past its last.
                const CHAINS: [[usize; 2]; $k];
                /// Which joints are actuated, by number.
                const ACTUATED: [usize; $m];
                /// The frame that poses are given in.
                const BASE: &'static str;
                /// The frame that poses are of.
                const PLATFORM: &'static str;
                /// The characteristic length, which an angle of one radian is worth: how
                /// far the platform is at home from the farthest axis, metres.
                const LENGTH: f64;
                /// How many independent motions the mechanism has where it is regular.
                const MOBILITY: usize;
                /// How many branches each chain's inverse kinematics looks at; 0 if it was
                /// not generated.
                const BRANCHES: [usize; $k];
                /// How many assembly modes closed-form forward kinematics finds at most; 0 if there
                /// is none, and [`Self::fk_near`] has to do.
                const ASSEMBLY_MODES: usize;
            }

            required {
                /// Where each chain puts the platform, and the spatial twist of each joint,
                /// displaced by those before it in its chain: J₁, J₂, … side by side.
                fn chains(&self, q: &[f64; $n]) -> ([$crate::Pose; $k], [$crate::Twist; $n]);
            }

            inverse {
                /// All configurations that hold the platform at `target`; none if one of
                /// the chains cannot reach it. Limits are not applied, see
                /// `Postures::nearest`.
                fn ik(&self, target: &$crate::Pose) -> $crate::Postures<$n, $k> {
                    self.ik_seeded(target, &[0.0; $n])
                }

                /// As [`Self::ik`]; an angle that a singular target leaves
                /// free keeps its value in `seed`.
                fn ik_seeded(&self, target: &$crate::Pose, seed: &[f64; $n])
                    -> $crate::Postures<$n, $k>
                {
                    const {
                        assert!(
                            $k == 0 || Self::BRANCHES[0] == 0,
                            "a mechanism with branches has to implement `ik_seeded`"
                        );
                        assert!(
                            $k > 0 && Self::BRANCHES[0] > 0,
                            "this mechanism was generated without inverse kinematics (`ik = none`)"
                        );
                    }
                    let _ = (target, seed);
                    Postures::new(Self::CHAINS)
                }
            }

            forward {
                /// All assembly modes with the given values of the actuated joints, radians and
                /// metres, by closed form. Of the ways to hold one platform pose with the
                /// same actuated joints, the nearest to q = 0 stands for all.
                fn fk(&self, actuated: &[f64; $m]) -> $crate::Solutions<$n> {
                    const {
                        assert!(
                            Self::ASSEMBLY_MODES == 0,
                            "a mechanism with assembly modes has to implement `fk`"
                        );
                        assert!(
                            Self::ASSEMBLY_MODES > 0,
                            "this mechanism has no closed form of its forward kinematics: use `fk_near`"
                        );
                    }
                    let _ = actuated;
                    Solutions::new()
                }
            }

            provided {
                /// The assembly with the given values of the actuated joints that Newton's
                /// method finds from `seed`, whose own actuated values are not read. At
                /// most 60 steps; none if the loops do not close to 1e-12 of the
                /// mechanism's length by then.
                fn fk_near(&self, actuated: &[f64; $m], seed: &[f64; $n])
                    -> ::core::option::Option<$crate::Solution<$n>>
                {
                    let mut q = *seed;
                    for (joint, value) in Self::ACTUATED.iter().zip(actuated) {
                        q[*joint] = *value;
                    }
                    let task = Task {
                        chains: &Self::CHAINS,
                        actuated: &Self::ACTUATED,
                        length: Self::LENGTH,
                    };
                    let evaluate = |q: &[f64], poses: &mut [Pose], twists: &mut [Twist]| {
                        let (p, t) = self.chains(&core::array::from_fn(|i| q[i]));
                        poses.copy_from_slice(&p);
                        twists.copy_from_slice(&t);
                    };
                    let (mut poses, mut twists) = ([Pose::IDENTITY; $k], [Twist::default(); $n]);
                    let (mut best, mut limbs) = ([0.0; $n], [Limb::NONE; $k]);
                    let (poses, twists) = (&mut poses, &mut twists);
                    let gap = close(task, evaluate, &mut q, &mut best, poses, twists, &mut limbs);
                    (gap <= 1e-12 * Self::LENGTH).then(|| Solution {
                        q,
                        residual: gap,
                        branch: 0,
                        singular: self.actuator_singularity(&q) < 1e-6,
                    })
                }

                /// The platform's pose by the first chain; by all of them where the loops
                /// are closed.
                fn platform(&self, q: &[f64; $n]) -> $crate::Pose {
                    self.chains(q).0[0]
                }

                /// The values of the actuated joints.
                fn actuated(&self, q: &[f64; $n]) -> [f64; $m] {
                    Self::ACTUATED.map(|joint| q[joint])
                }

                /// The structure equation: the spatial twist that takes each chain's end to
                /// that of the first. All zero where the loops are closed.
                fn structure_equation(&self, q: &[f64; $n]) -> [$crate::Twist; $k] {
                    let poses = self.chains(q).0;
                    poses.map(|pose| (poses[0] * pose.inverse()).log())
                }

                /// How far the ends of the chains are apart, the larger of the translation
                /// and the angle times [`Self::LENGTH`]; metres.
                fn gap(&self, q: &[f64; $n]) -> f64 {
                    posture::<Self, _, _, _, _>(self, q, |posture| posture.gap())
                }

                /// The spatial Jacobians of the chains side by side, as the structure equation
                /// has them (MLS section 3.5.2): the columns of chain k are Jₖ, and
                /// J₁ θ̇₁ = J₂ θ̇₂ = … is the platform's spatial velocity.
                fn structure_jacobian(&self, q: &[f64; $n]) -> $crate::Jacobian<$n> {
                    Jacobian::from_columns(self.chains(q).1)
                }

                /// From actuated rates to the platform's spatial velocity; none if the
                /// platform can move while the actuated joints are locked, or where these
                /// cannot be chosen freely, since the others of a chain lose a motion.
                fn forward_jacobian(&self, q: &[f64; $n])
                    -> ::core::option::Option<$crate::Jacobian<$m>>
                {
                    posture::<Self, _, _, _, _>(self, q, |posture| {
                        posture.forward_jacobian().map(Jacobian::from_columns)
                    })
                }

                /// From the platform's spatial velocity to actuated rates: row a times
                /// (v, ω) is the rate of the a-th actuated joint, for all velocities that
                /// the mechanism allows. None if an actuated joint's motion is one that the
                /// others of its chain can do without it.
                fn inverse_jacobian(&self, q: &[f64; $n])
                    -> ::core::option::Option<[[f64; 6]; $m]>
                {
                    posture::<Self, _, _, _, _>(self, q, |posture| {
                        let mut rows = [[0.0; 6]; $m];
                        for (a, row) in rows.iter_mut().enumerate() {
                            *row = posture.inverse_row(a)?;
                        }
                        Some(rows)
                    })
                }

                /// The rates of all joints while the actuated ones move at the given rates,
                /// rad/s and m/s; none where there is no forward Jacobian. A passive joint whose
                /// motion the other passive ones of its chain can undo stays at rest.
                fn joint_rates(&self, q: &[f64; $n], actuated: &[f64; $m])
                    -> ::core::option::Option<[f64; $n]>
                {
                    let velocity = self.forward_jacobian(q)?.velocity(actuated);
                    let mut rates = [0.0; $n];
                    posture::<Self, _, _, _, _>(self, q, |posture| {
                        posture.joint_rates(actuated, &velocity, &mut rates);
                    });
                    Some(rates)
                }

                /// How far from a kinematic singularity, where the structure equation's
                /// Jacobian loses rank and the loops allow more motions than
                /// [`Self::MOBILITY`]: the least singular value that has to
                /// stay above zero, relative to the largest.
                fn kinematic_singularity(&self, q: &[f64; $n]) -> f64 {
                    let (mut square, mut row, mut values) = ([[0.0; $n]; $n], [0.0; $n], [0.0; $n]);
                    posture::<Self, _, _, _, _>(self, q, |posture| {
                        posture.structure(square.as_flattened_mut(), &mut row, &mut values);
                    });
                    match values.get($n.wrapping_sub(Self::MOBILITY + 1)) {
                        Some(least) if values[0] > 0.0 => least / values[0],
                        _ => 0.0,
                    }
                }

                /// How far from an actuator singularity, where the platform can move while
                /// the actuated joints are locked: the least singular value of the wrenches
                /// of length 1 that the chains can bear, 0 at the singularity.
                fn actuator_singularity(&self, q: &[f64; $n]) -> f64 {
                    posture::<Self, _, _, _, _>(self, q, |posture| posture.held()[5])
                }
            }
        }
    };
}
