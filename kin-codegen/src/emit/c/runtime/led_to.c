/* Adds what branches lead to that have led to none of the solutions yet. */
static int kin_add_led_to(
    kin_lanes *lanes, const double target[12], const double seed[KIN_SOLVED], const double *given,
    kin_solution *solutions, int count)
{
    kin_solution more[KIN_MAX_SOLUTIONS];
    int found;
    for (int k = 0; k < count; ++k) {
        lanes->invalid[solutions[k].branch] = 1.0;
    }
    found = kin_reaching(lanes, target, seed, given, more);
    for (int k = 0; k < found; ++k) {
        if (kin_known_place(more[k].q, solutions, count) < 0) {
            count = kin_insert(&more[k], solutions, count);
        }
    }
    return count;
}

/* What the branches lead to. The angle of a vector that is nearly nothing may be given up for one that leaves
 * later steps a root, or be the one that the target asks for. And where a free joint is at right angles to what
 * the target is off, no step of Newton's method tells that it has to turn: neither one of the turns, nor two or
 * three of them together, is nearly a multiple of a quarter turn. */
static int kin_solve(
    const double target[12], const double seed[KIN_SOLVED], const double *given,
    kin_solution *solutions)
{
    static const double elsewhere[2] = {0.65, 1.9};
    kin_lanes lanes;
    double from[KIN_SOLVED];
    const int moves = kin_compute_branches(target, seed, given, &lanes);
    int begin = 0, count = kin_reaching(&lanes, target, seed, given, solutions);
    if (moves) {
        kin_turn_seed(seed, 0.0, from);
        kin_compute_lanes(target, from, given, 1e-22, &lanes);
    }
    for (int k = 0; k < KIN_BRANCHES; ++k) {
        begin += lanes.invalid[k] <= 0.0 && lanes.residual[k] <= KIN_NEARLY;
    }
    if (moves) {
        count = kin_add_led_to(&lanes, target, seed, given, solutions, count);
    }
    for (int i = 0; i < 2 && count < begin; ++i) {
        kin_turn_seed(seed, elsewhere[i], from);
        kin_compute_lanes(target, from, given, 1e-16, &lanes);
        count = kin_add_led_to(&lanes, target, seed, given, solutions, count);
    }
    return count > 0 ? count : kin_why_none(&kin_own_metric, target);
}
