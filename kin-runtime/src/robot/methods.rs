//! The methods of [`Kinematics`](crate::Kinematics), once: the trait and the
//! methods of generated robots are made of this list.

/// Hands the list to the macro `$then`, behind `$n`, the number of joints as it
/// is to be written, and what else `$then` takes; of a scalar and of the types of the module in
/// parentheses.
///
/// Robots bring those of `required` and `jacobians`, and may bring those of
/// `inverse`, `derivatives`, `determinant` and `singularities`; all others are
/// provided. The documentation is read in users' crates as well: it links to
/// `Self` alone, and its examples are those of the trait.
#[doc(hidden)]
#[macro_export]
macro_rules! kinematics_methods {
    ($then:ident, $real:ident of ($($root:tt)*), $n:tt $($of:tt)*) => {
        $crate::$then! { [$n $($of)*]
            required {
                /// The tip's pose in the base frame at joint values `q`, radians
                /// and metres.
                fn fk(&self, q: &[$real; $n]) -> $($root)*::Pose;

                /// The pose, in the base frame, of the link behind every joint:
                /// the frame that moves with joint i, for all i. What is fixed
                /// behind the last joint is not included.
                fn fk_links(&self, q: &[$real; $n]) -> [$($root)*::Pose; $n];

                /// The tip's pose and the spatial Jacobian, which share most of
                /// the work.
                fn fk_jacobian(&self, q: &[$real; $n]) -> ($($root)*::Pose, $($root)*::Jacobian<$n>);
            }

            jacobians {
                /// The spatial Jacobian (MLS section 3.4): times the joint rates,
                /// it gives the spatial velocity (v, ω) of the tip, in base axes,
                /// v being that of the point of the tip that passes through the
                /// base's origin.
                fn spatial_jacobian(&self, q: &[$real; $n]) -> $($root)*::Jacobian<$n> {
                    self.fk_jacobian(q).1
                }

                /// The body Jacobian (MLS section 3.4): the velocity of the tip's
                /// origin and the angular velocity, both in tip axes.
                fn body_jacobian(&self, q: &[$real; $n]) -> $($root)*::Jacobian<$n> {
                    let (pose, spatial) = self.fk_jacobian(q);
                    spatial.spatial_to_body(&pose)
                }

                /// The geometric Jacobian, also called hybrid or local world
                /// aligned: the velocity of the tip's origin and the angular
                /// velocity, both in base axes. What ROS users expect.
                fn geometric_jacobian(&self, q: &[$real; $n]) -> $($root)*::Jacobian<$n> {
                    let (pose, spatial) = self.fk_jacobian(q);
                    spatial.spatial_to_geometric(&pose)
                }
            }

            batches {
                /// [`Self::fk`] of many configurations: `poses[i]` of `q[i]`, the same
                /// to the last bit. Generated robots compute several side by side, in
                /// the lanes of vectors; nothing is allocated.
                ///
                /// # Panics
                /// If the slices differ in length.
                fn fk_batch(&self, q: &[[$real; $n]], poses: &mut [$($root)*::Pose]) {
                    assert_eq!(q.len(), poses.len(), "a pose for each configuration");
                    for (q, pose) in q.iter().zip(poses) {
                        *pose = self.fk(q);
                    }
                }

                /// [`Self::fk_jacobian`] of many configurations; as
                /// [`Self::fk_batch`].
                ///
                /// # Panics
                /// If the slices differ in length.
                fn fk_jacobian_batch(
                    &self, q: &[[$real; $n]], results: &mut [($($root)*::Pose, $($root)*::Jacobian<$n>)]
                ) {
                    assert_eq!(q.len(), results.len(), "a result for each configuration");
                    for (q, result) in q.iter().zip(results) {
                        *result = self.fk_jacobian(q);
                    }
                }
            }

            inverse {
                /// All configurations that put the tip at `target` (in the base
                /// frame), as far as the target counts: every isolated one once,
                /// a representative, flagged singular, of each family, and none
                /// if the target is out of reach.
                ///
                /// For an arm that is compiled without inverse kinematics, or has a
                /// parameter beside the target ([`Kinematics::BRANCHES`] is 0), a call
                /// does not compile:
                ///
                /// ```compile_fail
                /// # use kin_runtime::*;
                /// # struct Turntable;
                /// # impl Kinematics<1> for Turntable {
                /// #     const JOINT_NAMES: [&'static str; 1] = ["yaw"];
                /// #     const LIMITS: [JointLimit; 1] = [JointLimit::Continuous];
                /// #     const BASE: &'static str = "floor";
                /// #     const TIP: &'static str = "table";
                /// #     const BRANCHES: usize = 0;
                /// #     fn fk(&self, q: &[f64; 1]) -> Pose { Pose::IDENTITY }
                /// #     fn fk_links(&self, q: &[f64; 1]) -> [Pose; 1] { [Pose::IDENTITY] }
                /// #     fn fk_jacobian(&self, q: &[f64; 1]) -> (Pose, Jacobian<1>) {
                /// #         (Pose::IDENTITY, Jacobian::from_columns([Twist::default()]))
                /// #     }
                /// # }
                /// let solutions = Turntable.ik(&Pose::IDENTITY);
                /// ```
                fn ik(&self, target: &$($root)*::Pose) -> $($root)*::Solutions<$n> {
                    const { has_inverse(Self::BRANCHES) }
                    let _ = target;
                    Solutions::new()
                }

                /// As [`Self::ik`]; a joint that a singular target leaves free
                /// keeps its value in `seed`, so that solutions along a path are
                /// continuous.
                fn ik_seeded(&self, target: &$($root)*::Pose, seed: &[$real; $n])
                    -> $($root)*::Solutions<$n>
                {
                    let _ = seed;
                    self.ik(target)
                }

                /// A solution if there is one, and for a target out of reach what
                /// comes nearest, with its distance as the residual; none if the
                /// target is not a number. Generated robots give the
                /// least-squares solution of their subproblems.
                fn ik_approximate(&self, target: &$($root)*::Pose)
                    -> ::core::option::Option<$($root)*::Solution<$n>>
                {
                    self.ik(target).iter().next().copied()
                }

                /// The solution that moves the joints least from `seed`, radians
                /// and metres, inside the limits of the robot and with full turns
                /// where these lead there; an angle that a singular target leaves
                /// free keeps its value in `seed`. What a controller asks for in
                /// every cycle.
                ///
                /// None if there is none with these values of free angles; [`Self::try_ik_nearest`]
                /// says why.
                fn ik_nearest(&self, target: &$($root)*::Pose, seed: &[$real; $n])
                    -> ::core::option::Option<$($root)*::Solution<$n>>
                {
                    self.ik_nearest_by(target, &Nearest::new(*seed, &self.own_limits()))
                }

                /// As [`Self::ik_nearest`], by limits, weights of the joints and
                /// bounds on their steps that are given.
                fn ik_nearest_by(&self, target: &$($root)*::Pose, nearest: &$($root)*::Nearest<$n>)
                    -> ::core::option::Option<$($root)*::Solution<$n>>
                {
                    self.ik_seeded(target, &nearest.seed).nearest_by(nearest)
                }
            }

            inverse_batches {
                /// [`Self::ik`] of many targets: `solutions[i]` of `targets[i]`, the same
                /// to the last bit. Generated robots with an exact closed form compute
                /// several side by side, in the lanes of vectors; nothing is allocated.
                /// Of an answer a kilobyte is reserved, of which solutions take what they
                /// need: some hundred targets in one call stay in the cache.
                ///
                /// # Panics
                /// If the slices differ in length.
                fn ik_batch(
                    &self, targets: &[$($root)*::Pose], solutions: &mut [$($root)*::Solutions<$n>]
                ) {
                    assert_eq!(
                        targets.len(), solutions.len(),
                        "a place for the solutions of each target"
                    );
                    for (target, solutions) in targets.iter().zip(solutions) {
                        *solutions = self.ik(target);
                    }
                }
            }

            reachable {
                /// As [`Self::ik_nearest_by`], with the reason if there is none:
                /// out of reach, no rotation, outside limits, or beyond a step.
                /// The reason takes some microseconds.
                fn try_ik_nearest(&self, target: &$($root)*::Pose, nearest: &$($root)*::Nearest<$n>)
                    -> ::core::result::Result<$($root)*::Solution<$n>, $($root)*::NoSolution<$n>>
                {
                    self.ik_nearest_by(target, nearest)
                        .ok_or_else(|| NoSolution::of(self, target, nearest))
                }

                /// What the branch is called on which a configuration lies: the
                /// posture of the solution that it is of its own pose. None where
                /// branches have no names, where two have met, and of solutions
                /// beside the branches, which an arm off its design has.
                fn posture(&self, q: &[$real; $n])
                    -> ::core::option::Option<$($root)*::Posture>
                {
                    let solutions = self.ik_seeded(&self.fk(q), q);
                    let solution = solutions.nearest(q, &[JointLimit::Continuous; $n])?;
                    let same = (0..$n).all(|i| (solution.q[i] - q[i]).abs() < SAME);
                    let posture = Self::POSTURES.get(solution.branch as usize)?;
                    (same && !solution.singular).then_some(*posture)
                }

                /// Whether the target is in the complete workspace: whether
                /// [`Self::ik`] has a solution. Positions alone are asked of a
                /// `Workspace`.
                fn is_reachable_pose(&self, target: &$($root)*::Pose) -> bool {
                    !self.ik(target).is_empty()
                }
            }

            derivatives {
                /// J̇_s: the time derivative of the spatial Jacobian at the joint
                /// rates, rad/s and m/s. The tip's spatial acceleration is
                /// V̇_s = J_s q̈ + J̇_s q̇.
                ///
                /// Robots with joints that mimic others have to implement it,
                /// because the Jacobian does not tell those joints apart.
                fn jacobian_dot(&self, q: &[$real; $n], rates: &[$real; $n]) -> $($root)*::Jacobian<$n> {
                    self.spatial_jacobian(q).spatial_dot(rates)
                }

                /// The Hessian of forward kinematics: the derivatives of the
                /// spatial Jacobian by every joint.
                ///
                /// As [`Self::jacobian_dot`], to be implemented where joints
                /// mimic others.
                fn hessian(&self, q: &[$real; $n]) -> $($root)*::Hessian<$n> {
                    self.spatial_jacobian(q).spatial_hessian()
                }
            }

            determinant {
                /// The determinant of the Jacobian, 0 where the arm is singular;
                /// of fewer joints than six, that of the rows that count for
                /// its targets. None where these are not square. m³ for six
                /// revolute joints.
                fn jacobian_determinant(&self, q: &[$real; $n]) -> ::core::option::Option<$real> {
                    self.spatial_jacobian(q).square().map(|square| square.determinant())
                }
            }

            singularities {
                /// How far from each of its singularities the arm is: the factors
                /// of [`Self::jacobian_determinant`], by name. Empty for an arm
                /// of which they are not known.
                fn singularities(&self, q: &[$real; $n]) -> $($root)*::Singularities {
                    let _ = q;
                    Singularities::default()
                }
            }

            provided {
                /// The link of this name, if it is the base, the tip, one that a
                /// joint moves, or fixed to any of these.
                fn frame(&self, name: &str) -> ::core::option::Option<$($root)*::Frame> {
                    let link = Self::LINK_NAMES.iter().position(|&link| link == name);
                    let listed = || Self::FRAMES.iter().find(|frame| frame.name == name).copied();
                    // One that carries a tool is a link as any other, and listed.
                    let tip = || (name == Self::TIP).then(|| Frame::on_tip(Self::TIP, Pose::IDENTITY));
                    match link {
                        _ if name == Self::BASE => Some(Frame::on_base(Self::BASE, Pose::IDENTITY)),
                        Some(i) => Some(Frame::on_link(Self::LINK_NAMES[i], i, Pose::IDENTITY)),
                        None => listed().or_else(tip),
                    }
                }

                /// The pose, in the base frame, of a frame that is fixed to one
                /// of the robot's bodies, metres, at joint values `q`.
                ///
                /// # Panics
                ///
                /// The frame is that of a robot with more links.
                fn fk_frame(&self, q: &[$real; $n], frame: &$($root)*::Frame) -> $($root)*::Pose {
                    match frame.body {
                        Body::Base => frame.pose,
                        Body::Link(link) => self.fk_links(q)[link] * frame.pose,
                        Body::Tip => self.fk(q) * frame.pose,
                        Body::Following { link, joints } => {
                            let start = link.map_or(Pose::IDENTITY, |i| self.fk_links(q)[i]);
                            start * Following::displacement(joints, q) * frame.pose
                        }
                    }
                }

                /// V_s = J_s q̇: the tip's spatial velocity (MLS section 3.4) at
                /// the joint rates, rad/s and m/s; in base axes, v being that of
                /// the point that passes through the base's origin.
                fn spatial_velocity(&self, q: &[$real; $n], rates: &[$real; $n]) -> $($root)*::Twist {
                    self.spatial_jacobian(q).velocity(rates)
                }

                /// V_b = J_b q̇: the velocity of the tip's origin and the angular
                /// velocity, both in tip axes.
                fn body_velocity(&self, q: &[$real; $n], rates: &[$real; $n]) -> $($root)*::Twist {
                    self.body_jacobian(q).velocity(rates)
                }

                /// The velocity of the tip's origin and the angular velocity,
                /// both in base axes.
                fn geometric_velocity(&self, q: &[$real; $n], rates: &[$real; $n]) -> $($root)*::Twist {
                    self.geometric_jacobian(q).velocity(rates)
                }

                /// τ = J_sᵀ F_s (MLS section 3.4.2): the joint torques and forces,
                /// N m and N, that balance a wrench on the tip given in base
                /// coordinates, with the moment about the base's origin.
                fn spatial_torques(&self, q: &[$real; $n], wrench: &$($root)*::Wrench) -> [$real; $n] {
                    self.spatial_jacobian(q).torques(wrench)
                }

                /// τ = J_bᵀ F_t: as [`Self::spatial_torques`], with the wrench in
                /// tip coordinates, as a sensor at the tip reads it.
                fn body_torques(&self, q: &[$real; $n], wrench: &$($root)*::Wrench) -> [$real; $n] {
                    self.body_jacobian(q).torques(wrench)
                }

                /// As [`Self::spatial_torques`], with force and moment in base
                /// axes and the moment about the tip's origin.
                fn geometric_torques(&self, q: &[$real; $n], wrench: &$($root)*::Wrench) -> [$real; $n] {
                    self.geometric_jacobian(q).torques(wrench)
                }

                /// J̇_b: the time derivative of the body Jacobian at the joint
                /// rates, rad/s and m/s.
                fn body_jacobian_dot(&self, q: &[$real; $n], rates: &[$real; $n])
                    -> $($root)*::Jacobian<$n>
                {
                    changing(self, q, rates, |change| change.of_body())
                }

                /// The time derivative of the geometric Jacobian at the joint
                /// rates, rad/s and m/s. The tip's origin accelerates by the
                /// linear part of J q̈ + J̇ q̇.
                fn geometric_jacobian_dot(&self, q: &[$real; $n], rates: &[$real; $n])
                    -> $($root)*::Jacobian<$n>
                {
                    changing(self, q, rates, |change| change.of_geometric())
                }

                /// The derivatives of the body Jacobian by every joint.
                fn body_hessian(&self, q: &[$real; $n]) -> $($root)*::Hessian<$n> {
                    let (pose, spatial) = self.fk_jacobian(q);
                    self.hessian(q).seen(&pose, &spatial, |change| change.of_body())
                }

                /// The derivatives of the geometric Jacobian by every joint.
                fn geometric_hessian(&self, q: &[$real; $n]) -> $($root)*::Hessian<$n> {
                    let (pose, spatial) = self.fk_jacobian(q);
                    self.hessian(q).seen(&pose, &spatial, |change| change.of_geometric())
                }

                /// The wrenches that the structure bears without joint torques:
                /// an orthonormal basis, in base coordinates with the moment
                /// about the base's origin, N and N m. At least 6 − N, and more
                /// where the arm is singular.
                fn structural_wrenches(&self, q: &[$real; $n]) -> $($root)*::Basis<$($root)*::Wrench, 6> {
                    self.spatial_jacobian(q).structural_wrenches()
                }

                /// How far the arm is from a singularity: the measures of the
                /// geometric Jacobian (and of the body Jacobian, which has the
                /// same), metres and radians alike.
                fn manipulability(&self, q: &[$real; $n]) -> $($root)*::Manipulability {
                    self.geometric_jacobian(q).manipulability()
                }

                /// As [`Self::manipulability`], for the velocity of the tip's
                /// origin alone.
                fn translational_manipulability(&self, q: &[$real; $n]) -> $($root)*::Manipulability {
                    self.geometric_jacobian(q).translational_manipulability()
                }

                /// As [`Self::manipulability`], for the angular velocity alone.
                fn rotational_manipulability(&self, q: &[$real; $n]) -> $($root)*::Manipulability {
                    self.geometric_jacobian(q).rotational_manipulability()
                }

                /// How the volume of [`Self::manipulability`] changes with every
                /// joint; 0 at a singularity, where it has a kink.
                fn manipulability_gradient(&self, q: &[$real; $n]) -> [$real; $n] {
                    let jacobian = self.geometric_jacobian(q);
                    jacobian.manipulability_gradient(&self.geometric_hessian(q))
                }

                /// As [`Self::manipulability_gradient`], for the velocity of the
                /// tip's origin alone.
                fn translational_manipulability_gradient(&self, q: &[$real; $n]) -> [$real; $n] {
                    let jacobian = self.geometric_jacobian(q);
                    jacobian.translational_manipulability_gradient(&self.geometric_hessian(q))
                }

                /// As [`Self::manipulability_gradient`], for the angular velocity
                /// alone.
                fn rotational_manipulability_gradient(&self, q: &[$real; $n]) -> [$real; $n] {
                    let jacobian = self.geometric_jacobian(q);
                    jacobian.rotational_manipulability_gradient(&self.geometric_hessian(q))
                }

                /// The joint rates that leave the tip at rest: an orthonormal
                /// basis, rad/s and m/s. One vector for an arm of seven joints
                /// that is not singular.
                fn internal_motions(&self, q: &[$real; $n]) -> $($root)*::Basis<[$real; $n], $n> {
                    self.geometric_jacobian(q).internal_motions()
                }

                /// The internal motion nearest to some joint rates, rad/s and
                /// m/s: a secondary task that does not disturb the tip.
                fn null_space_projection(&self, q: &[$real; $n], rates: &[$real; $n]) -> [$real; $n] {
                    self.geometric_jacobian(q).null_space_projection(rates)
                }
            }
        }
    };
}
