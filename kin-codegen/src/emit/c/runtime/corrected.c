/* A branch that misses its target, corrected; whether it reaches it then. */
static int kin_corrected(
    const kin_lanes *lanes, int k, const double target[12], const double *given,
    kin_solution *found)
{
    const kin_solved_for joints = {KIN_SOLVED, kin_see_joints, given, 0};
    /* Those of an arm's design are farther from the solutions. */
    const int steps = KIN_TAKEN < 0.0 ? 60 : 12;
    kin_linearization here;
    for (int i = 0; i < KIN_SOLVED; ++i) {
        here.q[i] = lanes->q[i][k];
    }
    /* Branches of a design say where the arm may be singular. */
    found->singular = kin_correct(&kin_own_metric, &joints, target, steps, &here)
        || (KIN_TAKEN >= 0.0 && lanes->singular[k] > 0.0);
    for (int i = 0; i < KIN_SOLVED; ++i) {
        here.q[i] = kin_turns[kin_solved[i]] ? kin_wrap(here.q[i]) : here.q[i];
    }
    kin_whole(here.q, given, found->q);
    found->residual = here.residual;
    found->branch = k;
    return found->residual <= KIN_TOLERANCE;
}
