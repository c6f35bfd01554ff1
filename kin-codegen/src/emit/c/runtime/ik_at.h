/* All solutions of a target with these parameters, in the order of their branches. How many
 * there are, or why there are none. */
int kin_ik_at(
    const double pose[12], const double parameters[KIN_PARAMETERS],
    kin_solution solutions[KIN_MAX_SOLUTIONS]);
/* The same; a joint that a singular target leaves free keeps its value in the seed, so that
 * solutions along a path are continuous. */
int kin_ik_seeded_at(
    const double pose[12], const double parameters[KIN_PARAMETERS],
    const double seed[KIN_JOINTS], kin_solution solutions[KIN_MAX_SOLUTIONS]);
/* Of these the one that moves the joints least from the seed, within the limits, with full turns
 * where these lead there. 1, or why there is none. A joint whose seed is not finite takes no
 * part in what is least. */
int kin_ik_nearest_at(
    const double pose[12], const double parameters[KIN_PARAMETERS],
    const double seed[KIN_JOINTS], kin_solution *solution);
/* The parameters with which kin_ik_at has q among the solutions of pose, if q puts the tip
 * there; pose is read only where the turn of the tool is a parameter. */
void kin_redundancy(
    const double pose[12], const double q[KIN_JOINTS], double parameters[KIN_PARAMETERS]);
