/* All solutions of a target, in the order of the joint that is kept, those of singular targets
 * last; of a singular target some members of each family of solutions. How many there are, or why
 * there are none. */
int kin_ik(const double pose[12], kin_solution solutions[KIN_MAX_SOLUTIONS]);
/* The same; if the seed is a singular solution, it is among them. */
int kin_ik_seeded(
    const double pose[12], const double seed[KIN_JOINTS],
    kin_solution solutions[KIN_MAX_SOLUTIONS]);
/* The solution that moves the joints least from the seed, within the limits, with full turns
 * where these lead there. 1, or why there is none. A joint whose seed is not finite takes no
 * part in what is least. */
int kin_ik_nearest(const double pose[12], const double seed[KIN_JOINTS], kin_solution *solution);
