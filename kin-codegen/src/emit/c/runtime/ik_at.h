/* All solutions of a target with these parameters, in the order of their branches. How many
 * there are, or why there are none. */
int kin_ik_at(
    const double pose[12], const double parameters[KIN_PARAMETERS],
    kin_solution solutions[KIN_MAX_SOLUTIONS]);
/* The parameters with which kin_ik_at has q among the solutions of pose, if q puts the tip
 * there; pose is read only where the turn of the tool is a parameter. */
void kin_redundancy(
    const double pose[12], const double q[KIN_JOINTS], double parameters[KIN_PARAMETERS]);
