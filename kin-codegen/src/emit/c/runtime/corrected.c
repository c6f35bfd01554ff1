/* Adds the branches that rounding keeps from their target, corrected. */
static int kin_add_corrected(
    const kin_lanes *lanes, const double target[12], const double *given,
    kin_solution *solutions, int count)
{
    const kin_solved_for joints = {KIN_SOLVED, kin_see_joints, given};
    if (!(kin_rotation_error(&kin_own_metric, target) * KIN_SIZE <= KIN_TOLERANCE)) {
        return count;
    }
    for (int k = 0; k < KIN_BRANCHES; ++k) {
        const double residual = lanes->residual[k];
        if (lanes->invalid[k] <= 0.0 && residual > KIN_TOLERANCE && residual <= 1e-5 * KIN_SIZE) {
            kin_linearization here;
            kin_solution found;
            for (int i = 0; i < KIN_SOLVED; ++i) {
                here.q[i] = lanes->q[i][k];
            }
            found.singular = kin_correct(&kin_own_metric, &joints, target, 12, &here) || lanes->singular[k] > 0.0;
            for (int i = 0; i < KIN_SOLVED; ++i) {
                here.q[i] = kin_turns[kin_solved[i]] ? kin_wrap(here.q[i]) : here.q[i];
            }
            kin_whole(here.q, given, found.q);
            found.residual = here.residual;
            found.branch = k;
            if (found.residual <= KIN_TOLERANCE) {
                count = kin_insert(&found, solutions, count);
            }
        }
    }
    return count;
}
