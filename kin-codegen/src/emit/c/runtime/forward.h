/* The pose of the tip in the base frame. Limits are not applied; a joint value that is not
 * finite gives numbers that are none, here and below. */
void kin_fk(const double q[KIN_JOINTS], double pose[12]);
/* The pose in the base frame of the link that each joint moves, one behind the other, in the
 * order of q. */
void kin_fk_links(const double q[KIN_JOINTS], double poses[12 * KIN_JOINTS]);
/* The spatial Jacobian (Murray, Li, Sastry, section 3.4.1): times joint rates, the velocity
 * of the point of the tip that passes the base's origin, and the angular velocity, both in
 * base axes. */
void kin_spatial_jacobian(const double q[KIN_JOINTS], double jacobian[6 * KIN_JOINTS]);
/* The body Jacobian: the velocity of the tip's origin and the angular velocity, both in tip
 * axes. */
void kin_body_jacobian(const double q[KIN_JOINTS], double jacobian[6 * KIN_JOINTS]);
/* The geometric Jacobian, which ROS uses: the same in base axes. */
void kin_geometric_jacobian(const double q[KIN_JOINTS], double jacobian[6 * KIN_JOINTS]);
/* kin_fk and kin_spatial_jacobian, computed together. */
void kin_fk_jacobian(const double q[KIN_JOINTS], double pose[12], double jacobian[6 * KIN_JOINTS]);
/* Whether all joints are within their limits, to 1e-9, and the values there: angles outside
 * are moved by full turns where that helps, joints that are within keep their value. */
int kin_within_limits(const double q[KIN_JOINTS], double moved[KIN_JOINTS]);
