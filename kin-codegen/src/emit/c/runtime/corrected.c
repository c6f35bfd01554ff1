/* Where Levenberg's method leads from a configuration, and how far that is from the target, metres. */
static double kin_corrected(
    const double q[KIN_SOLVED], int evaluations, const double target[12], const double *given,
    kin_solution *found)
{
    const kin_solved_for joints = {KIN_SOLVED, kin_see_joints, given, 0};
    kin_linearization here;
    for (int i = 0; i < KIN_SOLVED; ++i) {
        here.q[i] = q[i];
    }
    found->singular = kin_correct(&kin_own_metric, &joints, target, evaluations, &here);
    for (int i = 0; i < KIN_SOLVED; ++i) {
        here.q[i] = kin_turns[kin_solved[i]] ? kin_wrap(here.q[i]) : here.q[i];
    }
    kin_whole(here.q, given, found->q);
    found->residual = here.residual;
    return here.residual;
}
