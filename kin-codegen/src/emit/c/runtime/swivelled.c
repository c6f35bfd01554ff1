/* A branch that misses its target, corrected; whether it reaches it then. */
static int kin_corrected(
    const kin_lanes *lanes, int k, const double target[12], const double *angle,
    kin_solution *found)
{
    kin_half_plane plane;
    const kin_solved_for joints = {KIN_JOINTS, kin_see_joints, &plane, kin_beside_plane};
    /* Those of an arm's design are farther from the solutions. */
    const int steps = KIN_TAKEN < 0.0 ? 60 : 12;
    kin_linearization here;
    double pose[12], elbow[3];
    kin_half_plane_of(target, *angle, &plane);
    for (int i = 0; i < KIN_JOINTS; ++i) {
        here.q[i] = lanes->q[i][k];
    }
    found->branch = k;
    found->singular = kin_correct(&kin_own_metric, &joints, target, steps, &here)
        || lanes->singular[k] > 0.0;
    for (int i = 0; i < KIN_JOINTS; ++i) {
        found->q[i] = kin_wrap(here.q[i]);
    }
    kin_fk(found->q, pose);
    found->residual = kin_distance(&kin_own_metric, pose, target);
    return here.residual <= KIN_TOLERANCE
        && kin_elbow_along(found->q, plane.direction, elbow) >= -KIN_TOLERANCE;
}
