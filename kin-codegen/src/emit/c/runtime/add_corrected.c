/* Adds the branches that rounding, or idealization, keeps from their target, corrected. */
static int kin_add_corrected(
    const kin_lanes *lanes, const double target[12], const double *given,
    kin_solution *solutions, int count)
{
    if (!(kin_rotation_error(&kin_own_metric, target) * KIN_SIZE <= KIN_TOLERANCE)) {
        return count;
    }
    for (int k = 0; k < KIN_BRANCHES; ++k) {
        const double residual = lanes->residual[k];
        kin_solution found;
        if (lanes->invalid[k] <= 0.0 && residual > KIN_TAKEN && residual <= KIN_NEARLY
            && kin_corrected(lanes, k, target, given, &found)) {
            count = kin_insert(&found, solutions, count);
        }
    }
    return count;
}
