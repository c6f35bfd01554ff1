/* A branch that misses its target, corrected; whether it reaches it then. */
static int kin_corrected(
    const kin_lanes *lanes, int k, const double target[12], const double *angle,
    kin_solution *found)
{
    /* Those of an arm's design are farther from the solutions. */
    const int steps = KIN_TAKEN < 0.0 ? 60 : 12;
    kin_linearization here;
    kin_given given;
    kin_solved_for joints;
    double q[KIN_JOINTS], slopes[KIN_JOINTS], pose[12];
    for (int i = 0; i < KIN_JOINTS; ++i) {
        q[i] = lanes->q[i][k];
    }
    given.angle = *angle;
    kin_point(target, kin_wrist, given.wrist);
    kin_slopes(q, &given, slopes);
    given.joint = fabs(slopes[1]) > fabs(slopes[0]);
    given.value = q[given.joint];
    for (int i = 0; i < KIN_CORRECTED; ++i) {
        here.q[i] = q[i + (i >= given.joint)];
    }
    found->branch = k;
    joints.count = KIN_CORRECTED;
    joints.see = kin_see_joints;
    joints.given = &given;
    found->singular = kin_correct(&kin_own_metric, &joints, target, steps, &here)
        || lanes->singular[k] > 0.0;
    if (!(here.residual <= KIN_TOLERANCE)) {
        return 0;
    }
    for (int i = 0; i < KIN_CORRECTED; ++i) {
        here.q[i] = kin_wrap(here.q[i]);
    }
    kin_told(here.q, &given, found->q);
    for (int i = 0; i < KIN_JOINTS; ++i) {
        found->q[i] = kin_wrap(found->q[i]);
    }
    /* Where the angle hardly tells its joint, nothing was solved. */
    if (!(fabs(kin_slopes(found->q, &given, slopes)) <= 1e-9)) {
        return 0;
    }
    kin_fk(found->q, pose);
    found->residual = kin_distance(&kin_own_metric, pose, target);
    return found->residual <= KIN_TOLERANCE;
}
