/* Of an arm of fewer than six joints, the solutions among those that were found with others behind
 * its tip: those that have these at zero, with what is given. How many there are. */
static int kin_to_solutions(
    const double target[12], const kin_found *found, const double *given, kin_solution *solutions)
{
    const kin_solved_for joints = {KIN_SOLVED, kin_see_joints, given};
    int count = 0;
    for (int i = 0; i < found->regular_count + found->singular_count && i < KIN_MOST_FOUND; ++i) {
        const kin_six *six = i < found->regular_count ? &found->regular[i]
            : &found->singular[i - found->regular_count];
        kin_linearization here;
        kin_solution solution;
        /* Where six joints are nearly singular, a target that is off by rounding is reached with
         * the joints behind the tip this far from zero. */
        if (!kin_is_at_zero(six->q, 1e-2)) {
            continue;
        }
        for (int j = 0; j < KIN_SOLVED; ++j) {
            here.q[j] = kin_slides[j] ? 0.5 * KIN_ARM_SIZE * six->q[j] : six->q[j];
        }
        /* A regular solution takes two evaluations. */
        solution.singular = kin_correct(&kin_own_metric, &joints, target, 24, &here);
        for (int j = 0; j < KIN_SOLVED; ++j) {
            here.q[j] = kin_slides[j] ? here.q[j] : kin_wrap(here.q[j]);
        }
        kin_whole(here.q, given, solution.q);
        solution.residual = here.residual;
        solution.branch = six->branch;
        if (solution.residual <= 1e-9 * KIN_ARM_SIZE) {
            count = kin_insert(&solution, solutions, count);
        }
    }
    return count;
}
