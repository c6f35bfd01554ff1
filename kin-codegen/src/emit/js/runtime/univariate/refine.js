/* Whether solutions are sought from a branch: if it exists or reaches the target. */
const $begins = (form, lanes, k) => lanes.invalid[k] <= 0.0 || lanes.residual[k] <= form.nearly;

/* Whether there may be solutions beside a branch that no other one tells: where it is singular, or is
 * none but reaches the target, as where an ill-conditioned step misses a double root. */
const $is_degenerate = (form, lanes, k) =>
    $begins(form, lanes, k) && (lanes.singular[k] > 0.0 || !(lanes.invalid[k] <= 0.0));

/* Moves the branches of the idealized arm to solutions of this one, in the order of their numbers. Where
 * one is flagged, lost, or too near to another one to tell them apart, eliminations are asked for the
 * others, which are numbered from the number of branches on; the seed is the first of them if it is a
 * singular solution. */
const $refined = (form, target, seed, lanes) => {
    const { size, near_singular } = form.search;
    const search = $begin(form, target);
    if (!(search.gap <= 1e-9) || $is_too_far(form.search, search.target)) {
        return { solutions: [], nearest: null };
    }
    /* Where a root of the plan is flagged, the two solutions that differ by its sign may be as far from
     * each other. */
    search.meeting = $max($MEETING, 4.0 * near_singular);
    search.branch = form.branches;
    let is_clear = true;
    let some = false;
    let reaching = null;
    for (let k = 0; k < form.branches; ++k) {
        if (!$begins(form, lanes, k)) {
            continue;
        }
        some = true;
        const residual = lanes.residual[k];
        /* Of arms of fewer joints branches need not reach the target. Those that do are off by less,
         * unless a root is nearly double. */
        const is_certain = residual <= search.meeting * size;
        const from = $in_units(form.search, lanes.q.map((lane) => lane[k]));
        reaching ??= residual <= $NEXT_TO * size ? { q: from, branch: k } : null;
        const arrived = $polish(form.search, search.target, from, $NEWTON_STEPS);
        const before = search.regular.length;
        if (!$insert_arrived(search, arrived, k)) {
            $stick(search, arrived);
        }
        const is_told = search.regular.length > before || !is_certain;
        is_clear = is_clear && is_told && !$is_degenerate(form, lanes, k);
    }
    /* Where six joints are nearly singular another solution is near, and those behind the tip of a
     * shorter arm may be farther from zero. */
    const is_solution = (it) => $is_at_zero(form, it.q, 1e-12);
    is_clear = is_clear && (!some || search.regular.some(is_solution));
    if (!is_clear) {
        $keep(form, search, seed);
        search.branch += 1;
    }
    if (!is_clear) {
        $ask_in_turn(search);
    }
    const found = [...search.regular, ...search.singular].slice(0, $MOST_FOUND);
    /* Where the ideal arm is singular, Newton's steps lead away from a branch that reaches the target but
     * for the noise. */
    return {
        solutions: found.sort((a, b) => a.branch - b.branch),
        nearest: search.nearest ?? reaching,
    };
};

/* The solutions of a target by the branches of a plan and eliminations beside them: of an arm off its
 * design always, otherwise where a step degenerates, or where no branch reaches the target and one
 * nearly does. */
const $solve_refining = (arm, target, seed, given) => {
    const { form } = arm;
    const { completion } = form.search;
    const lanes = $branches(form, target, seed, given);
    const degenerates = lanes.singular.some((_, k) => $is_degenerate(form, lanes, k));
    if (completion === "unanswered" || (completion === "degenerate" && !degenerates)) {
        const told = $reaching(arm, target, given, seed, lanes);
        const nearly_reach = lanes.residual.some((residual) => residual <= form.nearly);
        if (completion === "degenerate" || told.length > 0 || !nearly_reach) {
            return told;
        }
    }
    const from = $carried(form.search, target, given);
    const found = $refined($at_given(form, given), from, seed, lanes);
    return $to_solutions(arm, target, given, found);
};
