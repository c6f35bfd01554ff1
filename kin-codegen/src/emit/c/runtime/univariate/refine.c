/* Starts Newton's method from branches of the idealized arm; whether all that are certain to reach
 * the target lead to regular solutions, each to one of its own. */
static int kin_refine_some(kin_search *search, const int *numbers, const int *certain)
{
    kin_found *found = &search->found;
    kin_pack from[6];
    kin_arrived arrived;
    const int count = kin_dequeue(&search->starts, from);
    int all = 1;
    kin_polish(&search->problem, from, KIN_NEWTON_STEPS, &arrived);
    for (int k = 0; k < count; ++k) {
        const int before = found->regular_count;
        if (!kin_insert_arrived(found, &arrived, k, numbers[k])) {
            kin_stick(search, &arrived, k);
        }
        all = all && (found->regular_count > before || !certain[k]);
    }
    return all;
}

/* Whether one is a regular solution. Where six joints are nearly singular another is near, and those
 * behind the tip of a shorter arm may be farther from zero. */
static int kin_has_solution(const kin_found *found)
{
    int has = 0;
    for (int i = 0; i < found->regular_count; ++i) {
        has = has || kin_is_at_zero(found->regular[i].q, 1e-12);
    }
    return has;
}

static double kin_branch_of(const kin_six *solution)
{
    return solution->branch;
}

/* Whether solutions are sought from a branch: if it exists or reaches the target. */
static int kin_begins(const kin_lanes *lanes, int k)
{
    return lanes->invalid[k] <= 0.0 || lanes->residual[k] <= KIN_NEARLY;
}

/* Whether there may be solutions beside a branch that no other one tells: where it is singular, or is
 * none but reaches the target, as where an ill-conditioned step misses a double root. */
static int kin_is_degenerate(const kin_lanes *lanes, int k)
{
    return kin_begins(lanes, k) && (lanes->singular[k] > 0.0 || !(lanes->invalid[k] <= 0.0));
}

/* Moves the branches of the idealized arm to solutions of this one, in the order of their numbers.
 * Where one is flagged, lost, or too near to another one to tell them apart, eliminations are asked
 * for the others, which are numbered from KIN_BRANCHES on; the seed is the first of them if it is a
 * singular solution. */
static void kin_refine(
    const double target[12], const double *seed, const double *given, const kin_lanes *lanes,
    kin_search *search)
{
    kin_found *found = &search->found;
    int numbers[KIN_LANES], certain[KIN_LANES], clear = 1, some = 0;
    int reaching = -1;
    kin_six first = {{0.0, 0.0, 0.0, 0.0, 0.0, 0.0}, 0.0, 0, 0};
    kin_begin(target, given, search);
    if (!(found->gap <= 1e-9) || kin_is_too_far(&search->problem)) {
        return;
    }
    /* Where a root of the plan is flagged, the two solutions that differ by its sign may be as far
     * from each other. */
    search->meeting = kin_max(KIN_MEETING, 4.0 * KIN_NEAR_SINGULAR);
    search->branch = KIN_BRANCHES;
    for (int k = 0; k < KIN_BRANCHES; ++k) {
        double q[6];
        if (!kin_begins(lanes, k)) {
            continue;
        }
        some = 1;
        clear = clear && !kin_is_degenerate(lanes, k);
        for (int i = 0; i < 6; ++i) {
            q[i] = i < KIN_SOLVED ? lanes->q[i % KIN_SOLVED][k] : 0.0;
            q[i] *= kin_slides[i] ? 2.0 / KIN_ARM_SIZE : 1.0;
        }
        if (reaching < 0 && lanes->residual[k] <= KIN_NEXT_TO * KIN_ARM_SIZE) {
            reaching = first.branch = k;
            for (int i = 0; i < 6; ++i) {
                first.q[i] = q[i];
            }
        }
        /* Of arms of fewer joints branches need not reach the target. Those that do are off by less,
         * unless a root is nearly double. */
        certain[search->starts.count] = lanes->residual[k] <= search->meeting * KIN_ARM_SIZE;
        numbers[search->starts.count] = k;
        kin_enqueue(&search->starts, q);
        if (search->starts.count == KIN_LANES) {
            clear = kin_refine_some(search, numbers, certain) && clear;
        }
    }
    if (search->starts.count > 0) {
        clear = kin_refine_some(search, numbers, certain) && clear;
    }
    clear = clear && (!some || kin_has_solution(found));
    if (!clear) {
        kin_keep(search, seed);
        ++search->branch;
    }
    if (!clear) {
        kin_ask_in_turn(search);
    }
    /* Where the ideal arm is singular, Newton's steps lead away from a branch that reaches the target but
     * for the noise. */
    if (!(found->nearest_by <= KIN_NEXT_TO) && reaching >= 0) {
        found->nearest = first;
        found->nearest_by = 0.0;
    }
    for (int i = 0; i < found->singular_count && found->regular_count < KIN_MOST_FOUND; ++i) {
        found->regular[found->regular_count++] = found->singular[i];
    }
    found->singular_count = 0;
    kin_sort(found->regular, found->regular_count, kin_branch_of);
}
