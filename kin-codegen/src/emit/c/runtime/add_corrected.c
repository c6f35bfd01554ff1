/* How far two configurations are apart, radians and metres: the square of it. */
static double kin_squared_distance(const double a[KIN_JOINTS], const double b[KIN_JOINTS])
{
    double square = 0.0;
    for (int i = 0; i < KIN_JOINTS; ++i) {
        const double by = kin_joint_distance(i, a[i], b[i]);
        square += by * by;
    }
    return square;
}

/* Whether a solution is no farther from a seed, radians and metres, than what this misses the target by,
 * metres, accounts for. */
static int kin_is_next_to(const double q[KIN_JOINTS], const double seed[KIN_JOINTS], double missed)
{
    const double allowed = 1e-6 + 100.0 / KIN_SIZE * missed;
    double square = 0.0;
    for (int i = 0; i < KIN_JOINTS; ++i) {
        square += (q[i] - seed[i]) * (q[i] - seed[i]);
    }
    return square <= allowed * allowed;
}

/* A singular solution stands for its neighbours as well, which rounding does not tell apart. Where none is
 * next to a seed that all but reaches the target, the one to which Levenberg's method leads from there takes
 * the place of the nearest. */
static void kin_stay_at_seed(
    const double seed[KIN_SOLVED], const double target[12], const double *given,
    kin_solution *solutions, int count)
{
    kin_solution there;
    double from[KIN_JOINTS], least = HUGE_VAL;
    int nearest = -1, known;
    const double missed = kin_corrected(seed, 0, target, given, &there);
    if (!(missed <= 2e-2 * KIN_SIZE)) {
        return;
    }
    kin_whole(seed, given, from);
    for (int k = 0; k < count; ++k) {
        if (solutions[k].singular && kin_is_next_to(solutions[k].q, from, missed)) {
            return;
        }
    }
    /* Most take four; beside a fold each may halve what is left. */
    if (!(kin_corrected(seed, 40, target, given, &there) <= 1e-13 * KIN_SIZE)) {
        return;
    }
    for (int k = 0; k < count; ++k) {
        const double apart = kin_squared_distance(solutions[k].q, there.q);
        /* Of two that mirror each other, as near as rounding tells, the first. */
        if (solutions[k].singular && apart < 0.9 * least) {
            least = apart;
            nearest = k;
        }
    }
    known = kin_known_place(there.q, solutions, count);
    /* One that is known may be a whole turn away, which limits may leave no other answer than. */
    if (nearest >= 0 && there.singular && (known < 0 || known == nearest)
        && kin_squared_distance(there.q, from) <= kin_squared_distance(solutions[nearest].q, from)) {
        there.branch = solutions[nearest].branch;
        solutions[nearest] = there;
    }
}

/* Adds the branches that rounding, or idealization, keeps from their target, corrected; of
 * singular ones those that are next to the seed. */
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
    for (int k = 0; k < count; ++k) {
        if (solutions[k].singular) {
            kin_stay_at_seed(seed, target, given, solutions, count);
            break;
        }
    }
    return count;
}
