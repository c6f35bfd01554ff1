/* Cosines and sines that are off by more are those of an extraneous root; by more than the second,
 * they are not of one of several that have almost met; where they are off by less than the third, a
 * null vector is of one solution, and no mixture. */
#define KIN_EXTRANEOUS 0.05
#define KIN_MIXED 0.5
#define KIN_PURE 1e-3
/* The same of a vector that eigenvalues tell from others: of no solution. */
#define KIN_OF_NONE 0.2
/* Where zeros have met is one place, radians, that others are farther from. */
#define KIN_SAME_PLACE 1e-6
/* What is taken to less may be of solutions next to a value of the kept joint. */
#define KIN_NULL 1e-2
/* Relative noise above which no answer is sure. */
#define KIN_UNCERTAIN 1e-9
/* Below this another solution may be so near that roots of the polynomial do not tell the two
 * apart. */
#define KIN_MEETING 3e-3
/* Steps of Newton's method at most; twice as many where it converges slowly. */
#define KIN_NEWTON_STEPS 6

/* What is known of one target. */
typedef struct kin_search {
    kin_problem problem;
    kin_found found;
    /* The branch of the next solution. */
    int branch;
    /* Configurations to start Newton's method from, and those near the target that it led to, and
     * no further. */
    kin_queue starts, stuck;
    /* Below this independence another solution may be near. */
    double meeting;
    /* Whether another target is the one that is meant. */
    int is_beside;
    /* Of so many regular and singular solutions the neighbours were looked for. */
    int looked_at, looked_at_singular;
} kin_search;

/* A target's rotation, made orthonormal by Newton's method where it nearly is. */
static void kin_orthonormalize(double target[12])
{
    if (!(kin_rotation_error(&kin_own_metric, target) <= 0.1)) {
        return;
    }
    for (int step = 0; step < 5; ++step) {
        double dual[9], volume = 0.0;
        for (int i = 0; i < 3; ++i) {
            const double *x = target + 4 * ((i + 1) % 3), *y = target + 4 * ((i + 2) % 3);
            for (int j = 0; j < 3; ++j) {
                const int a = (j + 1) % 3, b = (j + 2) % 3;
                dual[3 * i + j] = x[a] * y[b] - x[b] * y[a];
            }
        }
        for (int j = 0; j < 3; ++j) {
            volume += target[j] * dual[j];
        }
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                target[4 * i + j] = 0.5 * (target[4 * i + j] + dual[3 * i + j] / volume);
            }
        }
    }
}

/* A rotation whose third column is along that of a target (Duff et al., J. Computer Graphics
 * Techniques 6, 2017). */
static void kin_complete_axis(double target[12])
{
    const double x0 = target[2], y0 = target[6], z0 = target[10];
    const double length = sqrt(x0 * x0 + y0 * y0 + z0 * z0);
    const double x = x0 / length, y = y0 / length, z = z0 / length;
    const double sign = copysign(1.0, z), a = -1.0 / (sign + z), b = x * y * a;
    const double rotation[9] = {
        1.0 + sign * x * x * a, b, x, sign * b, sign + y * y * a, y, -sign * x, -y, z};
    for (int i = 0; i < 9; ++i) {
        target[i / 3 * 4 + i % 3] = rotation[i];
    }
}

/* Whether a target is farther away than the arm is long. */
static int kin_is_too_far(const kin_problem *problem)
{
    double squares[8] = {0.0}, reach = 1e-6;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 7; ++j) {
            squares[j] += problem->fixed[j][4 * i + 3] * problem->fixed[j][4 * i + 3];
        }
        squares[7] += problem->target[4 * i + 3] * problem->target[4 * i + 3];
    }
    for (int j = 0; j < 7; ++j) {
        reach += sqrt(squares[j]);
    }
    for (int joint = 0; joint < 6; ++joint) {
        reach = kin_slides[joint] ? HUGE_VAL : reach;
    }
    return sqrt(squares[7]) > reach;
}

/* Nothing is known of the target yet, which is a rotation. */
static void kin_forget(kin_search *search)
{
    search->found.gap = 0.0;
    search->found.regular_count = search->found.singular_count = 0;
    search->found.again = 0;
    search->found.nearest_by = HUGE_VAL;
    search->branch = search->is_beside = 0;
    search->starts.count = search->stuck.count = 0;
    search->looked_at = search->looked_at_singular = 0;
    search->meeting = KIN_MEETING;
}

/* Of a target, lengths in metres, and what is given with it. */
static void kin_begin(const double target[12], const double *given, kin_search *search)
{
    double *own = search->problem.target;
    kin_fix_frames(given, search->problem.fixed);
    for (int i = 0; i < 12; ++i) {
        own[i] = target[i] * (i % 4 == 3 ? 2.0 / KIN_ARM_SIZE : 1.0);
    }
    if (kin_own_metric.axis) {
        kin_complete_axis(own);
    } else {
        kin_orthonormalize(own);
    }
    kin_forget(search);
    search->found.gap = kin_rotation_error(&kin_own_metric, target);
}

/* Whether the joints behind the tip are at zero. A turn about the tip's axis, where it is free, is one
 * that need not be. */
static int kin_is_at_zero(const double q[6], double within)
{
    int is = 1;
    for (int j = KIN_SOLVED + kin_own_metric.axis; j < 6; ++j) {
        is = is && fabs(q[j]) < within;
    }
    return is;
}

static int kin_insert_new(kin_search *search, const kin_arrived *arrived, int lane)
{
    kin_found *found = &search->found;
    const int before = found->regular_count + found->singular_count;
    const int reached = kin_insert_arrived(found, arrived, lane, search->branch);
    search->branch += found->regular_count + found->singular_count > before;
    return reached;
}

/* The pose of the tip of a problem's six joints, and the spatial Jacobian. */
static void kin_see_frames(const double *q, const void *problem, double pose[12], double jacobian[6][7])
{
    const kin_problem *of = (const kin_problem *)problem;
    for (int i = 0; i < 12; ++i) {
        pose[i] = of->fixed[0][i];
    }
    for (int joint = 0; joint < 6; ++joint) {
        double motion[12] = {1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0}, moved[12];
        for (int i = 0; i < 3; ++i) {
            const int a = 4 * ((i + 1) % 3), b = 4 * ((i + 2) % 3);
            const double along = pose[a + 3] * pose[b + 2] - pose[b + 3] * pose[a + 2];
            jacobian[i][joint] = kin_slides[joint] ? pose[4 * i + 2] : along;
            jacobian[3 + i][joint] = kin_slides[joint] ? 0.0 : pose[4 * i + 2];
        }
        if (kin_slides[joint]) {
            motion[11] = q[joint];
        } else {
            kin_sin_cos(q[joint], &motion[4], &motion[0]);
            motion[1] = -motion[4];
            motion[5] = motion[0];
        }
        kin_compose(pose, motion, moved);
        kin_compose(moved, of->fixed[joint + 1], pose);
    }
}

/* Where Levenberg's method leads from the first lane. */
static void kin_lead(const kin_problem *problem, kin_pack q[6])
{
    /* Half the arm's size is 1. */
    const kin_metric metric = {2.0, 0.0, 1, 1, 0};
    const kin_solved_for joints = {6, kin_see_frames, problem, 0};
    kin_linearization here;
    for (int i = 0; i < 6; ++i) {
        here.q[i] = q[i][0];
    }
    kin_correct(&metric, &joints, problem->target, 40, &here);
    for (int i = 0; i < 6; ++i) {
        kin_fill(q[i], here.q[i]);
    }
}

/* Takes the seed in if it is a singular solution, in front of the others and in place of one that is
 * next to it. Where the Jacobian loses two ranks at once Newton's steps, which divide rounding by both
 * pivots, lead away from one. */
static void kin_keep(kin_search *search, const double *seed)
{
    kin_found *found = &search->found;
    kin_six others[KIN_MOST_FOUND];
    const int count = found->singular_count;
    int kept;
    kin_pack from[6];
    kin_arrived start, arrived;
    for (int i = 0; i < 6; ++i) {
        const double unit = kin_slides[i] ? 2.0 / KIN_ARM_SIZE : 1.0;
        kin_fill(from[i], i < KIN_SOLVED ? unit * seed[i % KIN_SOLVED] : 0.0);
    }
    kin_polish(&search->problem, from, KIN_NEWTON_STEPS, &arrived);
    if (!(arrived.residual[0] <= KIN_REACHED)) {
        kin_polish(&search->problem, from, 0, &start);
        if (start.residual[0] < 1e-2) {
            kin_lead(&search->problem, from);
            kin_polish(&search->problem, from, 0, &arrived);
        }
    }
    if (!(arrived.independence[0] < KIN_SINGULAR)) {
        return;
    }
    for (int k = 0; k < count; ++k) {
        others[k] = found->singular[k];
    }
    found->singular_count = 0;
    kin_insert_arrived(found, &arrived, 0, search->branch);
    kept = found->singular_count;
    for (int k = 0; k < count && found->singular_count < KIN_MOST_FOUND; ++k) {
        if (!kept || !kin_are_within(KIN_FAMILY, found->singular[0].q, others[k].q)) {
            found->singular[found->singular_count++] = others[k];
        }
    }
}

/* Keeps where Newton's method has come near to a target that it converges to slowly, or that is out
 * of reach by little. */
static void kin_stick(kin_search *search, kin_arrived *arrived, int lane)
{
    double q[6];
    if (!(arrived->residual[lane] < 1e-3)) {
        return;
    }
    kin_in_lane(arrived->q, lane, q);
    for (int k = 0; k < search->stuck.count; ++k) {
        if (kin_are_within(KIN_FAMILY, search->stuck.q[k], q)) {
            return;
        }
    }
    kin_enqueue(&search->stuck, q);
}

/* Starts Newton's method from the configurations that wait. */
static void kin_arrive(kin_search *search)
{
    if (search->starts.count > 0) {
        kin_pack from[6];
        kin_arrived arrived;
        const int count = kin_dequeue(&search->starts, from);
        kin_polish(&search->problem, from, 2 * KIN_NEWTON_STEPS, &arrived);
        for (int k = 0; k < count; ++k) {
            if (!kin_insert_new(search, &arrived, k)) {
                kin_stick(search, &arrived, k);
            }
        }
    }
}

/* The same from one more, as soon as there are enough of them. */
static void kin_start(kin_search *search, const double q[6])
{
    kin_enqueue(&search->starts, q);
    if (search->starts.count == KIN_LANES) {
        kin_arrive(search);
    }
}

/* The same, if it may be near a solution that is not known: if it is off by no more. */
static void kin_start_unknown(kin_search *search, kin_starts *starts, int lane, double off)
{
    double q[6];
    kin_in_lane(starts->q, lane, q);
    if (starts->inconsistency[lane] < off
        && !kin_is_known(&search->found, q, search->meeting)) {
        kin_start(search, q);
    }
}

/* A root near which there may be several solutions. */
typedef struct kin_candidate {
    double angle;
    /* Whether it is two, and whether nobody knows how many it is. */
    int is_twice, is_several;
    kin_zeros zeros;
    /* Whether these have met there. */
    int is_met;
} kin_candidate;

typedef struct kin_candidates {
    kin_candidate all[KIN_MOST_ROOTS];
    int count;
} kin_candidates;

static void kin_push_candidate(kin_candidates *candidates, const kin_roots *roots, int number)
{
    kin_candidate *candidate = &candidates->all[candidates->count++ % KIN_MOST_ROOTS];
    candidate->angle = roots->angles[number];
    candidate->is_twice = roots->twice >> number & 1;
    candidate->is_several = roots->several >> number & 1;
    candidate->zeros = kin_untold;
    candidate->is_met = 0;
}

/* Leaves one candidate where a few zeros have met, at the angle where they have. */
static void kin_gather(const kin_harmonics *f, kin_candidates *candidates)
{
    int kept = 0;
    for (int i = 0; i < candidates->count; ++i) {
        kin_candidate *it = &candidates->all[i];
        const int few = it->zeros.count >= 2 && it->zeros.count <= KIN_SHARING;
        double angle;
        int known = 0;
        if (few && (it->is_twice || it->is_several) && kin_find_meeting(f, &it->zeros, &angle)) {
            it->angle = angle;
            it->is_met = 1;
            for (int j = 0; j < kept; ++j) {
                const kin_candidate *other = &candidates->all[j];
                known |= other->is_met && fabs(kin_wrap(other->angle - angle)) < KIN_SAME_PLACE;
            }
        }
        if (!known) {
            candidates->all[kept++] = *it;
        }
    }
    candidates->count = kept;
}

/* The zeros near candidates; not where a root of all targets was taken from the polynomial. */
static void kin_count_zeros(
    const kin_elimination *elimination, const kin_harmonics *f, kin_candidates *candidates)
{
    for (int i = 0; i < candidates->count; ++i) {
        kin_zeros *zeros = &candidates->all[i].zeros;
        const double angle = candidates->all[i].angle;
        int known = 0;
        while (known < i && !kin_cover(&candidates->all[known].zeros, angle)) {
            ++known;
        }
        if (known < i) {
            *zeros = candidates->all[known].zeros;
        } else {
            kin_find_zeros(f, angle, zeros);
        }
        if (elimination->has_fold && kin_are_near(zeros, elimination->fold)) {
            zeros->count = -1;
        }
    }
    /* Next to a target with a family of solutions what is nearly taken to zero is more than theirs. */
    if (f->noise < KIN_NOISY) {
        kin_gather(f, candidates);
    }
}

/* The kept joint's value at a regular solution. */
static double kin_kept_at(
    const kin_search *search, const kin_elimination *elimination, int solution)
{
    const double q = search->found.regular[solution].q[elimination->joints[0]];
    return elimination->backwards ? -q : q;
}

/* Whether one of some regular solutions is near a root. */
static int kin_is_near_root(
    const kin_search *search, const kin_elimination *elimination, unsigned places, double root)
{
    for (int i = 0; i < search->found.regular_count; ++i) {
        const double kept = kin_kept_at(search, elimination, i);
        if ((places >> i & 1) && fabs(kin_wrap(kept - root)) < KIN_CLUSTER) {
            return 1;
        }
    }
    return 0;
}

/* Whether more is taken to zero at a root than what is of a solution: then a vector need not be. */
static int kin_is_of_several(const kin_recovery *recovery, double root)
{
    kin_pack kept, space[2][16], lengths[2];
    for (int k = 0; k < KIN_LANES; ++k) {
        kept[k] = root;
    }
    kin_find_null_space(recovery, kept, 2, space, lengths);
    return lengths[0][0] < KIN_NULL && lengths[1][0] < KIN_NULL;
}

/* Adds the solution at every root that is one, if it has one; those that may have more. */
static void kin_one_each(
    kin_search *search, const kin_recovery *recovery, const kin_roots *roots,
    kin_candidates *unclear)
{
    kin_found *found = &search->found;
    int ones[KIN_MOST_ROOTS], left = 0;
    unclear->count = 0;
    for (int i = 0; i < roots->count; ++i) {
        if ((roots->twice | roots->several) >> i & 1) {
            kin_push_candidate(unclear, roots, i);
        } else {
            ones[left++] = i;
        }
    }
    for (int first = 0; first < left; first += KIN_LANES) {
        const int rest = left - first, count = rest < KIN_LANES ? rest : KIN_LANES;
        kin_pack kept, from[6];
        kin_starts starts;
        kin_queue fresh;
        kin_arrived arrived;
        int candidates[KIN_LANES], waiting;
        for (int k = 0; k < KIN_LANES; ++k) {
            kept[k] = roots->angles[ones[k < count ? first + k : first]];
        }
        kin_recover(recovery, kept, &starts);
        fresh.count = 0;
        for (int k = 0; k < count; ++k) {
            const int candidate = ones[first + k];
            const unsigned before = found->again;
            const double off = starts.inconsistency[k];
            double q[6];
            int known, mixed;
            kin_in_lane(starts.q, k, q);
            known = kin_is_known(found, q, search->meeting);
            /* Next to another one a root is known to half of its digits. */
            mixed = off >= KIN_EXTRANEOUS && kin_has_neighbour(roots, candidate);
            if ((known && (found->again == before || off > KIN_PURE)) || mixed) {
                kin_push_candidate(unclear, roots, candidate);
            } else if (!known && off < KIN_EXTRANEOUS) {
                candidates[fresh.count] = candidate;
                kin_enqueue(&fresh, q);
            } else if (!known && kin_is_of_several(recovery, kept[k])) {
                kin_push_candidate(unclear, roots, candidate);
            }
        }
        if (fresh.count == 0) {
            continue;
        }
        waiting = kin_dequeue(&fresh, from);
        kin_polish(&search->problem, from, KIN_NEWTON_STEPS, &arrived);
        for (int k = 0; k < waiting; ++k) {
            const unsigned before = found->again;
            const double root = roots->angles[candidates[k]];
            kin_insert_new(search, &arrived, k);
            /* It may have led to the solution at another root. */
            if (!kin_is_near_root(search, recovery->elimination, found->again & ~before, root)) {
                kin_push_candidate(unclear, roots, candidates[k]);
            }
        }
    }
}

/* Whether two of them are one. */
static int kin_is_same(double a, double b) { return fabs(kin_wrap(a - b)) < 1e-9; }

/* How many regular solutions share a value of the kept joint. */
static int kin_sharing(const kin_search *search, const kin_elimination *elimination, double value)
{
    int count = 0;
    for (int i = 0; i < search->found.regular_count; ++i) {
        count += kin_is_same(kin_kept_at(search, elimination, i), value);
    }
    return count;
}

/* A root of several is known to a quarter of its digits, and what is nearly taken to zero there mixes
 * the solutions that share it. Those that are found have all digits of it, and there what is taken to
 * zero tells whether some are missing, which other ratios may tell apart. */
static void kin_share_exactly(
    kin_search *search, const kin_recovery *recovery, const kin_candidates *unclear)
{
    const kin_elimination *elimination = recovery->elimination;
    kin_pack kept = {0.0}, space[KIN_SHARING][16], lengths[KIN_SHARING];
    kin_starts starts[KIN_SHARING];
    kin_eigenvalues values;
    int count = 0;
    for (int i = 0; i < unclear->count; ++i) {
        const kin_candidate *candidate = &unclear->all[i];
        for (int j = 0; j < search->found.regular_count && count < KIN_LANES; ++j) {
            const double value = kin_kept_at(search, elimination, j);
            int is_new = candidate->is_several
                && fabs(kin_wrap(value - candidate->angle)) < KIN_CLUSTER;
            for (int k = 0; k < count; ++k) {
                is_new = is_new && !kin_is_same(kept[k], value);
            }
            if (is_new && kin_sharing(search, elimination, value) < KIN_SHARING) {
                kept[count++] = value;
            }
        }
    }
    if (count == 0) {
        return;
    }
    kin_find_null_space(recovery, kept, KIN_SHARING, space, lengths);
    for (int ratio = 0; ratio < KIN_RATIOS; ++ratio) {
        int missing[KIN_LANES], any = 0;
        for (int k = 0; k < count; ++k) {
            int dimension = 0;
            for (int i = 0; i < KIN_SHARING; ++i) {
                dimension += lengths[i][k] < KIN_NULL;
            }
            missing[k] = ratio == 0 || dimension > kin_sharing(search, elimination, kept[k]);
            any |= missing[k];
        }
        if (!any) {
            return;
        }
        kin_recover_sharing(recovery, kept, space, KIN_SHARING, ratio, starts, &values);
        for (int k = 0; k < count; ++k) {
            for (int i = 0; i < KIN_SHARING && missing[k]; ++i) {
                kin_start_unknown(search, &starts[i], k, KIN_MIXED);
            }
        }
        kin_arrive(search);
    }
}

/* Whether near a candidate as many solutions are known as there are zeros: no two have one. */
static int kin_is_settled(
    kin_search *search, const kin_elimination *elimination, const kin_candidate *candidate)
{
    unsigned places = 0;
    int count = 0;
    for (int i = 0; i < search->found.regular_count; ++i) {
        if (kin_are_near(&candidate->zeros, kin_kept_at(search, elimination, i))) {
            places |= 1u << i;
            ++count;
        }
    }
    if (count != candidate->zeros.count) {
        return 0;
    }
    search->found.again |= places;
    return 1;
}

/* Leaves the candidates that other solutions than those that are known may be near. */
static void kin_settle(
    kin_search *search, const kin_elimination *elimination, kin_candidates *unclear)
{
    int kept = 0;
    for (int i = 0; i < unclear->count; ++i) {
        if (!kin_is_settled(search, elimination, &unclear->all[i])) {
            unclear->all[kept++] = unclear->all[i];
        }
    }
    unclear->count = kept;
}

/* Whether there may be more than two solutions at a candidate that nobody knows the number of. */
static int kin_may_be_more(const kin_candidate *candidate)
{
    return candidate->is_several && candidate->zeros.count > 2;
}

static int kin_is_pair(const kin_candidate *candidate) { return !kin_may_be_more(candidate); }

static int kin_is_twice(const kin_candidate *candidate) { return candidate->is_twice; }

static int kin_is_several(const kin_candidate *candidate) { return candidate->is_several; }

static int kin_is_any(const kin_candidate *candidate)
{
    (void)candidate;
    return 1;
}

/* Adds the solutions of so many that share a value of the kept joint at the candidates that are
 * wanted. */
static void kin_share(
    kin_search *search, const kin_recovery *recovery, kin_candidates *unclear,
    int (*is_wanted)(const kin_candidate *), int sharing, double off)
{
    kin_pack kept = {0.0}, space[KIN_SHARING][16], lengths[KIN_SHARING];
    kin_starts starts[KIN_SHARING];
    kin_eigenvalues values;
    int places[KIN_LANES], count = 0, left = 0;
    for (int i = 0; i < unclear->count; ++i) {
        left += is_wanted(&unclear->all[i]);
    }
    for (int i = 0; i < unclear->count; ++i) {
        if (!is_wanted(&unclear->all[i])) {
            continue;
        }
        for (int k = count; k < KIN_LANES; ++k) {
            kept[k] = unclear->all[i].angle;
        }
        places[count++] = i;
        --left;
        if (count < KIN_LANES && left > 0) {
            continue;
        }
        kin_find_null_space(recovery, kept, sharing, space, lengths);
        kin_recover_sharing(recovery, kept, space, sharing, 0, starts, &values);
        for (int k = 0; k < count; ++k) {
            kin_candidate *candidate = &unclear->all[places[k]];
            if (candidate->is_met && candidate->zeros.count == sharing) {
                candidate->zeros.count -=
                    kin_extraneous(starts, sharing, lengths, &values, k, KIN_OF_NONE);
            }
            for (int n = 0; n < sharing; ++n) {
                if (!kin_is_complex(&values, n, k)) {
                    kin_start_unknown(search, &starts[n], k, off);
                }
            }
        }
        count = 0;
    }
    kin_arrive(search);
    kin_settle(search, recovery->elimination, unclear);
}

/* Adds the solutions that share a value of the kept joint, and leaves the candidates that may have
 * more. Where a pivot is nearly zero at all its values, as next to a target with a family of
 * solutions, so is what it leaves alone, and the space of two solutions has more dimensions. */
static void kin_several_each(
    kin_search *search, const kin_recovery *recovery, int is_noisy, kin_candidates *unclear)
{
    kin_settle(search, recovery->elimination, unclear);
    kin_share(search, recovery, unclear, kin_is_pair, 2, KIN_EXTRANEOUS);
    kin_share(
        search, recovery, unclear, is_noisy ? kin_is_any : kin_is_several, KIN_SHARING, KIN_MIXED);
    kin_share(search, recovery, unclear, kin_may_be_more, 2, KIN_EXTRANEOUS);
    kin_share_exactly(search, recovery, unclear);
    kin_settle(search, recovery->elimination, unclear);
    /* What else is nearly taken to zero mixes with the two. */
    kin_share(search, recovery, unclear, kin_is_twice, KIN_SHARING, KIN_EXTRANEOUS);
}

/* Adds the solutions that nearly singular ones have nearly met, and those between which Newton's
 * method got stuck; where several meet, each shows the next. */
static void kin_meet(kin_search *search)
{
    kin_found *found = &search->found;
    kin_queue points = search->stuck;
    search->stuck.count = 0;
    for (int round = 0; round < 4; ++round) {
        kin_pack from[6], apart[3][6];
        int count;
        for (; points.count < KIN_LANES && search->looked_at < found->regular_count;
             ++search->looked_at) {
            if (found->independence[search->looked_at] < search->meeting) {
                kin_enqueue(&points, found->regular[search->looked_at].q);
            }
        }
        for (; points.count < KIN_LANES && search->looked_at_singular < found->singular_count;
             ++search->looked_at_singular) {
            kin_enqueue(&points, found->singular[search->looked_at_singular].q);
        }
        count = kin_dequeue(&points, from);
        if (count == 0) {
            break;
        }
        kin_split(&search->problem, from, apart);
        for (int i = 0; i < 3; ++i) {
            for (int k = 0; k < count; ++k) {
                double q[6];
                kin_in_lane(apart[i], k, q);
                kin_start(search, q);
            }
        }
        kin_arrive(search);
    }
    if (!search->is_beside) {
        search->stuck.count = 0;
    }
}

static int kin_ask(kin_search *search, const kin_elimination *elimination);

/* Where a family of solutions makes a polynomial of zeros, those of targets beside this one are
 * none, and the regular solutions there are beside those here. */
static void kin_ask_beside(kin_search *search, const kin_elimination *elimination)
{
    /* A turn by 1e-4 about (0.36, 0.48, 0.8), and lengths in units of half the arm's size. */
    const double x = 0.36 * 0.5e-4, y = 0.48 * 0.5e-4, z = 0.8 * 0.5e-4, w = 1.0;
    const double s = 2.0 / (x * x + y * y + z * z + w * w);
    const double there[12] = {
        1.0 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w), 3e-5,
        s * (x * y + z * w), 1.0 - s * (x * x + z * z), s * (y * z - x * w), -5e-5,
        s * (x * z - y * w), s * (y * z + x * w), 1.0 - s * (x * x + y * y), 8e-5};
    if (search->is_beside) {
        return;
    }
    /* Where solutions have met, one of the two is out of reach. */
    for (int way = 0; way < 2; ++way) {
        kin_search beside;
        double back[12];
        kin_invert(there, back);
        beside.problem = search->problem;
        kin_compose(search->problem.target, way == 0 ? there : back, beside.problem.target);
        kin_forget(&beside);
        beside.is_beside = 1;
        kin_ask(&beside, elimination);
        for (int i = 0; i < beside.found.regular_count; ++i) {
            kin_start(search, beside.found.regular[i].q);
        }
        for (int i = 0; i < beside.found.singular_count; ++i) {
            kin_start(search, beside.found.singular[i].q);
        }
        /* Of a family that leads nowhere else these are next to its members. */
        for (int i = 0; i < beside.stuck.count; ++i) {
            kin_start(search, beside.stuck.q[i]);
        }
    }
    kin_arrive(search);
    kin_meet(search);
}

/* Where a family of solutions makes a polynomial of zeros, every value that the kept joint has in the
 * family is a root: adds the members at some, which are alone there or two. */
static void kin_take_members(kin_search *search, const kin_recovery *recovery)
{
    kin_pack kept, space[KIN_SHARING][16], lengths[KIN_SHARING];
    kin_starts alone, starts[KIN_SHARING];
    kin_eigenvalues values;
    const int before = search->found.singular_count;
    for (int half = 0; half < 2; ++half) {
        for (int k = 0; k < KIN_LANES; ++k) {
            kept[k] = (k + 0.5 * half) * (6.283185307179586 / KIN_LANES);
        }
        kin_recover(recovery, kept, &alone);
        for (int k = 0; k < KIN_LANES; ++k) {
            kin_start_unknown(search, &alone, k, KIN_EXTRANEOUS);
        }
        kin_arrive(search);
        if (search->found.singular_count > before) {
            return;
        }
        kin_find_null_space(recovery, kept, 2, space, lengths);
        kin_recover_sharing(recovery, kept, space, 2, 0, starts, &values);
        for (int n = 0; n < 2; ++n) {
            for (int k = 0; k < KIN_LANES; ++k) {
                kin_start_unknown(search, &starts[n], k, KIN_EXTRANEOUS);
            }
        }
        kin_arrive(search);
        if (search->found.singular_count > before) {
            return;
        }
    }
}

/* Whether there is nothing left to look for, and what was known before was found again. */
static int kin_has_all(const kin_search *search, const kin_candidates *unclear)
{
    return unclear->count == 0 && search->found.again == (1u << search->found.regular_count) - 1u;
}

/* Adds what one elimination finds; whether all solutions are sure to be among those found. */
static int kin_ask(kin_search *search, const kin_elimination *elimination)
{
    kin_recovery recovery;
    kin_harmonics f;
    kin_roots roots;
    kin_candidates unclear;
    int may_be_certain;
    kin_begin_recovery(elimination, &search->problem, &recovery);
    kin_polynomial(&recovery, &f);
    if (!(f.noise < 1e-3)) {
        kin_take_members(search, &recovery);
        kin_ask_beside(search, elimination);
        return 0;
    }
    kin_find_roots(&f, &roots);
    search->found.again = 0;
    kin_one_each(search, &recovery, &roots, &unclear);
    may_be_certain = !roots.incomplete && f.noise < KIN_UNCERTAIN;
    if (may_be_certain) {
        kin_count_zeros(elimination, &f, &unclear);
    }
    kin_several_each(search, &recovery, f.noise >= KIN_NOISY, &unclear);
    if (!may_be_certain || !kin_has_all(search, &unclear)) {
        if (roots.incomplete || f.noise > 1e-7) {
            kin_ask_beside(search, elimination);
        }
        kin_meet(search);
        kin_settle(search, elimination, &unclear);
    }
    return may_be_certain && kin_has_all(search, &unclear);
}

/* Asks the eliminations in turn until one is sure of its answer. */
static void kin_ask_in_turn(kin_search *search)
{
    for (int i = 0; i < KIN_ELIMINATIONS; ++i) {
        if (kin_ask(search, &kin_eliminations[i])) {
            return;
        }
    }
}
