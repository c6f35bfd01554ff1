/* Of an arm of fewer than six joints, the solutions among those that were found with others behind
 * its tip: those that have these at zero, with what is given. How many there are. */
static int kin_to_solutions(
    const double target[12], const kin_found *found, const double *given, kin_solution *solutions)
{
    int count = 0;
    for (int i = 0; i < found->regular_count + found->singular_count && i < KIN_MOST_FOUND; ++i) {
        const kin_six *six = i < found->regular_count ? &found->regular[i]
            : &found->singular[i - found->regular_count];
        kin_solution solution;
        /* Where six joints are nearly singular, a target that is off by rounding is reached with
         * the joints behind the tip this far from zero; a regular solution takes two evaluations. */
        if (kin_is_at_zero(six->q, 1e-2) && kin_arrive_from(target, six, given, 24, &solution)) {
            count = kin_insert(&solution, solutions, count);
        }
    }
    return count > 0 ? count : kin_lead_nearest(target, found, given, solutions);
}
