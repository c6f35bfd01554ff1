/* A singular solution stands for its neighbours as well, which rounding does not tell apart: if the seed is
 * one that reaches the target, it takes the place of the nearest. */
static void kin_stay_at_seed(
    const double seed[KIN_SOLVED], const double target[12], const double *given,
    kin_solution *solutions, int count)
{
    kin_solution there;
    double q[KIN_JOINTS], least = HUGE_VAL;
    int nearest = -1, known;
    kin_whole(seed, given, q);
    for (int k = 0; k < count; ++k) {
        double apart = 0.0;
        for (int i = 0; i < KIN_JOINTS; ++i) {
            const double by = kin_joint_distance(i, solutions[k].q[i], q[i]);
            apart += by * by;
        }
        if (solutions[k].singular && apart < least) {
            least = apart;
            nearest = k;
        }
    }
    if (nearest < 0 || !(kin_corrected(seed, 0, target, given, &there)
            <= kin_max(solutions[nearest].residual, 1e-14 * KIN_SIZE))) {
        return;
    }
    known = kin_known_place(there.q, solutions, count);
    /* One that is known may be a whole turn away, which limits may leave no other answer than. */
    if (there.singular && (known < 0 || known == nearest)) {
        there.branch = solutions[nearest].branch;
        solutions[nearest] = there;
    }
}

/* Adds the branches that rounding, or idealization, keeps from their target, corrected; where one
 * is singular, the seed may be as well. */
static int kin_add_corrected(
    const kin_lanes *lanes, const double target[12], const double seed[KIN_SOLVED],
    const double *given, kin_solution *solutions, int count)
{
    /* Those of an arm's design are farther from the solutions. */
    const int evaluations = KIN_TAKEN < 0.0 ? 60 : 12;
    if (!(kin_rotation_error(&kin_own_metric, target) * KIN_SIZE <= KIN_TOLERANCE)) {
        return count;
    }
    for (int k = 0; k < KIN_BRANCHES; ++k) {
        const double residual = lanes->residual[k];
        double q[KIN_SOLVED];
        kin_solution found;
        for (int i = 0; i < KIN_SOLVED; ++i) {
            q[i] = lanes->q[i][k];
        }
        if (lanes->invalid[k] <= 0.0 && residual > KIN_TAKEN && residual <= KIN_NEARLY
            && kin_corrected(q, evaluations, target, given, &found) <= KIN_TOLERANCE) {
            found.branch = k;
            /* Branches of a design say where the arm may be singular. */
            found.singular = found.singular || (KIN_TAKEN >= 0.0 && lanes->singular[k] > 0.0);
            count = kin_insert(&found, solutions, count);
        }
    }
    kin_stay_at_seed(seed, target, given, solutions, count);
    return count;
}
