/* The solutions that were found, lengths in metres, with what is given. How many there are. */
static int kin_to_solutions(
    const double target[12], const kin_found *found, const double *given, kin_solution *solutions)
{
    int count = 0;
    for (int i = 0; i < found->regular_count + found->singular_count; ++i) {
        const kin_six *six = i < found->regular_count ? &found->regular[i]
            : &found->singular[i - found->regular_count];
        double q[KIN_SOLVED];
        if (count == KIN_MAX_SOLUTIONS) {
            break;
        }
        for (int j = 0; j < KIN_SOLVED; ++j) {
            q[j] = kin_slides[j] ? 0.5 * KIN_ARM_SIZE * six->q[j] : six->q[j];
        }
        kin_whole(q, given, solutions[count].q);
        solutions[count].residual = six->residual;
        solutions[count].branch = six->branch;
        solutions[count].singular = six->singular;
        ++count;
    }
    return count > 0 ? count : kin_lead_nearest(target, found, given, solutions);
}
