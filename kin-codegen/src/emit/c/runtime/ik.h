/* All solutions of a target, in the order of their branches; of a joint that a singular target
 * leaves free the one with zero. How many there are, or why there are none. */
int kin_ik(const double pose[12], kin_solution solutions[KIN_MAX_SOLUTIONS]);
/* The same; a free joint keeps its value in the seed, so that solutions along a path are
 * continuous. */
int kin_ik_seeded(
    const double pose[12], const double seed[KIN_JOINTS],
    kin_solution solutions[KIN_MAX_SOLUTIONS]);
/* The solution that moves the joints least from the seed, within the limits, with full turns
 * where these lead there. 1, or why there is none. A joint whose seed is not finite takes no
 * part in what is least. */
int kin_ik_nearest(const double pose[12], const double seed[KIN_JOINTS], kin_solution *solution);
