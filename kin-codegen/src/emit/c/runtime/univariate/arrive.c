/* Where Levenberg's method leads of the joints that are solved for, in at most so many evaluations, with
 * what is given; whether it reaches the target. */
static int kin_arrive_from(const double target[12], const kin_six *six, const double *given,
    int evaluations, kin_solution *solution)
{
    const kin_solved_for joints = {KIN_SOLVED, kin_see_joints, given, 0};
    kin_linearization here;
    for (int j = 0; j < KIN_SOLVED; ++j) {
        here.q[j] = kin_slides[j] ? 0.5 * KIN_ARM_SIZE * six->q[j] : six->q[j];
    }
    solution->singular = kin_correct(&kin_own_metric, &joints, target, evaluations, &here);
    for (int j = 0; j < KIN_SOLVED; ++j) {
        here.q[j] = kin_slides[j] ? here.q[j] : kin_wrap(here.q[j]);
    }
    kin_whole(here.q, given, solution->q);
    solution->residual = here.residual;
    solution->branch = six->branch;
    return here.residual <= 1e-9 * KIN_ARM_SIZE;
}

/* Where there are no solutions, what comes nearest is led on: where the Jacobian has lost two ranks, or
 * one next to a family of solutions, Newton's steps are at a loss. */
static int kin_lead_nearest(
    const double target[12], const kin_found *found, const double *given, kin_solution *solutions)
{
    /* Where six joints are nearly singular, a target that is off by rounding is reached with the
     * joints behind the tip this far from zero. */
    return found->nearest_by <= KIN_NEXT_TO && kin_is_at_zero(found->nearest.q, 1e-2)
        && kin_arrive_from(target, &found->nearest, given, 96, solutions);
}
