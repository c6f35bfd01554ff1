/* The joint that is kept first, by which solutions are ordered. */
static double kin_kept_joint(const kin_six *solution)
{
    return solution->q[kin_eliminations[0].joints[0]];
}

/* The solutions of a target as the joints that are solved for see it: the regular ones, then the
 * singular ones that were found first, as far as there is room. If the seed is a singular solution, it
 * is among them. */
static void kin_search_target(
    const double target[12], const double *seed, const double *given, kin_search *search)
{
    kin_found *found = &search->found;
    int room;
    kin_begin(target, given, search);
    if (seed) {
        kin_keep(search, seed);
    }
    if (found->gap <= 1e-9 && !kin_is_too_far(&search->problem)) {
        kin_ask_in_turn(search);
    }
    room = KIN_MOST_FOUND - found->regular_count;
    found->singular_count = found->singular_count < room ? found->singular_count : room;
    kin_sort(found->regular, found->regular_count, kin_kept_joint);
    kin_sort(found->singular, found->singular_count, kin_kept_joint);
}
