/* Where Levenberg's method leads from a configuration, and how far that is from the target and the half
 * plane, metres; infinitely far if the elbow is on the other side of it. */
static double kin_corrected(
    const double q[KIN_SOLVED], int evaluations, const double target[12], const double *angle,
    kin_solution *found)
{
    kin_half_plane plane;
    const kin_solved_for joints = {KIN_JOINTS, kin_see_joints, &plane, kin_beside_plane};
    kin_linearization here;
    double pose[12], elbow[3];
    kin_half_plane_of(target, *angle, &plane);
    for (int i = 0; i < KIN_JOINTS; ++i) {
        here.q[i] = q[i];
    }
    found->singular = kin_correct(&kin_own_metric, &joints, target, evaluations, &here);
    for (int i = 0; i < KIN_JOINTS; ++i) {
        found->q[i] = kin_wrap(here.q[i]);
    }
    kin_fk(found->q, pose);
    found->residual = kin_distance(&kin_own_metric, pose, target);
    return kin_elbow_along(found->q, plane.direction, elbow) >= -KIN_TOLERANCE
        ? here.residual : HUGE_VAL;
}
