/* The joints' names, and those of base and platform. In UTF-8. */
extern const char *const kin_joint_names[KIN_JOINTS];
extern const char *const kin_base;
extern const char *const kin_platform;
/* The first joint of every chain, and one past the last; which joints are actuated. */
extern const int kin_chains[KIN_CHAINS + 1];
extern const int kin_actuated[KIN_ACTUATED];
/* Whether joints turn, 1, or slide, 0. */
extern const int kin_turns[KIN_JOINTS];
/* Radians and metres, rad/s and m/s, N m and N; infinite where the robot file has none. */
extern const double kin_lower_limits[KIN_JOINTS];
extern const double kin_upper_limits[KIN_JOINTS];
extern const double kin_velocity_limits[KIN_JOINTS];
extern const double kin_effort_limits[KIN_JOINTS];

/* Where each chain puts the platform: the first one's pose, and the others behind it; equal where
 * the loops are closed. Limits are not applied; a joint value that is not finite gives numbers that
 * are none, here and below. */
void kin_chain_poses(const double q[KIN_JOINTS], double poses[12 * KIN_CHAINS]);
/* How far the ends of the chains are apart, the larger of the translation and the angle at the
 * distance of KIN_LENGTH; metres. */
double kin_gap(const double q[KIN_JOINTS]);
/* The spatial twists of all joints as columns, displaced by those before them in their chain: of
 * every chain they give, times its joints' rates, the platform's spatial velocity. */
void kin_structure_jacobian(const double q[KIN_JOINTS], double jacobian[6 * KIN_JOINTS]);
/* From actuated rates to the platform's spatial velocity, 6 rows. 1, or 0 where the platform can
 * move while the actuated joints are locked, or these cannot be chosen freely. */
int kin_forward_jacobian(const double q[KIN_JOINTS], double jacobian[6 * KIN_ACTUATED]);
/* From the platform's spatial velocity to actuated rates, a row of 6 for each, for all velocities
 * that the mechanism allows. 1, or 0 where an actuated joint's motion is one that the others
 * of its chain can do without it. */
int kin_inverse_jacobian(const double q[KIN_JOINTS], double jacobian[6 * KIN_ACTUATED]);
/* The rates of all joints while the actuated ones move at the given rates; a passive joint whose
 * motion the other passive ones of its chain can undo stays at rest. 1, or 0 where there is no
 * forward Jacobian. */
int kin_joint_rates(
    const double q[KIN_JOINTS], const double actuated[KIN_ACTUATED], double rates[KIN_JOINTS]);
/* How far from where the platform can move while the actuated joints are locked: the least singular
 * value of the wrenches of length 1 that the chains can bear, 0 there. */
double kin_actuator_singularity(const double q[KIN_JOINTS]);
/* How far from where the loops allow more motions than KIN_MOBILITY: the least singular value of
 * their equations' Jacobian that has to stay above zero, relative to the largest. */
double kin_kinematic_singularity(const double q[KIN_JOINTS]);
/* The assembly with the given values of the actuated joints that Newton's method finds from a seed,
 * whose own actuated values are not read, in 60 steps at most: 1, or 0 if the loops do not close to
 * 1e-12 of KIN_LENGTH by then, and q is the nearest to it. */
int kin_fk_near(
    const double actuated[KIN_ACTUATED], const double seed[KIN_JOINTS], double q[KIN_JOINTS]);
/* Whether all joints are within their limits, to 1e-9, and the values there: angles outside
 * are moved by full turns where that helps, joints that are within keep their value. */
int kin_within_limits(const double q[KIN_JOINTS], double moved[KIN_JOINTS]);
