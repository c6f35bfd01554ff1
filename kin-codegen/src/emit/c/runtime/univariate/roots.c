/* All real roots of a trigonometric polynomial. Descartes' rule of signs in Bernstein's basis
 * bounds the number of roots on an interval and has its parity (Collins and Akritas, SYMSAC 1976;
 * Lane and Riesenfeld, BIT 21, 1981): no change of sign means none, one means one. Halving does the
 * rest, with a bound on its steps; where there may be two on an interval with one extremum, the
 * sign at that tells; intervals on which the signs are those of rounding end at a width. */

/* Candidates at most: more than a polynomial of the highest degree has roots. */
#define KIN_MOST_ROOTS 32
/* Halvings at most, in all, and intervals that wait at a time. */
#define KIN_HALVINGS 192
#define KIN_WAITING 16
/* In multiples of the noise, what a coefficient may be without having a sign. */
#define KIN_UNSIGNED 256.0
/* Below this an interval, radians, on which there may be several roots is one candidate. */
#define KIN_NARROW 4e-4
/* Where all is noise, candidates are this far apart at most, radians. */
#define KIN_BLIND 0.05
/* Clusters that are nearer to each other are one, radians. */
#define KIN_CLUSTER 5e-3
/* Steps towards a root at most. */
#define KIN_ROOT_STEPS 60

/* Where an arm may have a solution. */
typedef struct kin_roots {
    double angles[KIN_MOST_ROOTS];
    int count;
    /* Bit i is set where candidate i is two; where it may be none, or any number; and where the
     * polynomial hardly changes. */
    unsigned twice, several, flat;
    /* Whether there was no place for all of them. */
    int incomplete;
} kin_roots;

/* Whether another root is near a candidate, complex ones included. */
static int kin_has_neighbour(const kin_roots *roots, int i)
{
    int near_ = roots->flat >> i & 1;
    for (int j = 0; j < roots->count; ++j) {
        const double apart = fabs(kin_wrap(roots->angles[j] - roots->angles[i]));
        near_ = near_ || (j != i && apart < KIN_CLUSTER);
    }
    return near_;
}

static void kin_push_root(double angle, kin_roots *roots)
{
    if (roots->count == KIN_MOST_ROOTS) {
        roots->incomplete = 1;
        return;
    }
    roots->angles[roots->count] = angle;
    ++roots->count;
}

/* Where there are several, nobody knows how many, unless a neighbour tells of them. */
static void kin_push_cluster(double angle, kin_roots *roots)
{
    for (int i = 0; i < roots->count; ++i) {
        if ((roots->several >> i & 1) && fabs(roots->angles[i] - angle) < KIN_CLUSTER) {
            return;
        }
    }
    roots->several |= 1u << roots->count % KIN_MOST_ROOTS;
    kin_push_root(angle, roots);
}

/* What coefficients say of the number of roots. */
typedef enum kin_signs { KIN_NO_ROOT, KIN_ONE_ROOT, KIN_TWO_ROOTS, KIN_MANY_ROOTS } kin_signs;

/* Also the share of the interval at which one root is, about. */
static kin_signs kin_count_signs(const double *coefficients, int count, double noise, double *share)
{
    int before = 0, changes = 0;
    if (!(fabs(coefficients[0]) > noise && fabs(coefficients[count - 1]) > noise)) {
        return KIN_MANY_ROOTS;
    }
    for (int i = 1; i < count; ++i) {
        const double a = coefficients[before], b = coefficients[i];
        if (!(fabs(b) > noise)) {
            continue;
        }
        /* One without a sign between two of different signs changes nothing; more may hide two
         * roots. */
        if (a * b < 0.0 && i <= before + 2) {
            ++changes;
            *share = (before + a / (a - b) * (i - before)) / (count - 1.0);
        } else if (i > before + 1) {
            return KIN_MANY_ROOTS;
        }
        before = i;
    }
    return changes == 0 ? KIN_NO_ROOT
        : changes == 1 ? KIN_ONE_ROOT : changes == 2 ? KIN_TWO_ROOTS : KIN_MANY_ROOTS;
}

/* Part of an arc, by its ends in t. */
typedef struct kin_interval {
    double coefficients[KIN_COEFFICIENTS], low, high;
} kin_interval;

typedef struct kin_isolation {
    const kin_harmonics *f;
    /* How many coefficients there are, and what they may be without having a sign. */
    int coefficients;
    double noise;
    /* The middle of the arc. */
    double middle;
    /* Intervals with one root: their ends and where it may be, radians, and 1 where the polynomial
     * rises, -1 where it falls. */
    double low[KIN_MOST_ROOTS], high[KIN_MOST_ROOTS], guess[KIN_MOST_ROOTS], rises[KIN_MOST_ROOTS];
    int count;
    int halvings;
    /* Intervals that are looked at later. */
    kin_interval waiting[KIN_WAITING];
} kin_isolation;

static double kin_arc_angle(const kin_isolation *search, double t)
{
    return search->middle + 2.0 * kin_atan2(t, 1.0);
}

static double kin_between(const kin_interval *interval, double share)
{
    return interval->low + share * (interval->high - interval->low);
}

/* An interval with one root, and where it may be. */
static void kin_bracket(
    kin_isolation *search, double low, double high, double guess, int rises, kin_roots *found)
{
    const int place = search->count;
    if (place == KIN_MOST_ROOTS) {
        found->incomplete = 1;
        return;
    }
    search->low[place] = kin_arc_angle(search, low);
    search->high[place] = kin_arc_angle(search, high);
    search->guess[place] = kin_arc_angle(search, guess);
    search->rises[place] = rises ? 1.0 : -1.0;
    ++search->count;
}

/* Where g = (1 + t^2)^degree f has its only extremum on an interval, with f and f'' there: Newton's
 * method on g', halving where it leaves the bracket. `opens` tells the sign of g''. */
static double kin_steady(
    const kin_isolation *search, const kin_interval *interval, double t, int opens,
    double *value, double *curvature)
{
    const double degree = search->coefficients / 2;
    double from = interval->low, to = interval->high;
    for (int step = 0; step < KIN_ROOT_STEPS; ++step) {
        double f[3], g, change, next, moved;
        kin_derivatives(search->f, kin_arc_angle(search, t), f);
        *value = f[0];
        *curvature = f[2];
        /* But for powers of 1 + t^2. */
        g = f[1] + degree * t * f[0];
        change = (f[2] + degree * t * f[1]) * 2.0 / (1.0 + t * t) + degree * f[0];
        *((g < 0.0) == opens ? &from : &to) = t;
        next = t - g / change;
        if (!(next > from && next < to)) {
            next = 0.5 * (from + to);
        }
        moved = fabs(next - t);
        t = next;
        /* As a share of a radian: values there to its square. */
        if (moved < 1e-7) {
            break;
        }
    }
    return t;
}

/* The roots on an interval with two or none, if g has one extremum there: the sign at that tells
 * which. 0 if it may have more. */
static int kin_at_extremum(kin_isolation *search, const kin_interval *interval, kin_roots *found)
{
    const int count = search->coefficients - 1;
    double rise[KIN_COEFFICIENTS], share, f, curvature, t;
    int opens;
    for (int i = 0; i < count; ++i) {
        rise[i] = interval->coefficients[i + 1] - interval->coefficients[i];
    }
    if (kin_count_signs(rise, count, search->noise, &share) != KIN_ONE_ROOT) {
        return 0;
    }
    opens = rise[0] < 0.0;
    t = kin_steady(search, interval, kin_between(interval, share), opens, &f, &curvature);
    /* Two roots that are nearer to each other than twice the root of 1e-12 are one candidate. */
    if (!(fabs(f) > 2.0 * search->noise + 0.5e-12 * fabs(curvature))) {
        const double at = kin_arc_angle(search, t);
        /* Of three roots or more, the curvature would be what rounding leaves. */
        if (fabs(curvature) > 1e-4) {
            found->twice |= 1u << found->count % KIN_MOST_ROOTS;
            kin_push_root(at, found);
        } else {
            kin_push_cluster(at, found);
        }
    } else if (f * interval->coefficients[0] < 0.0) {
        /* Where a parabola has them. */
        const double apart = 0.5 * sqrt(fabs(2.0 * f / curvature));
        const double low = interval->low, high = interval->high;
        kin_bracket(search, low, t, kin_max(t - apart, low), !opens, found);
        kin_bracket(search, t, high, -kin_max(-(t + apart), -high), opens, found);
    } else if (fabs(f) <= 2.0 * KIN_UNSIGNED * search->f->shift) {
        /* Next to a family of solutions what the target is rounded by parts two that meet. */
        found->twice |= 1u << found->count % KIN_MOST_ROOTS;
        kin_push_root(kin_arc_angle(search, t), found);
    }
    return 1;
}

/* Leaves the upper part of an interval, and gives the lower, by de Casteljau's algorithm; not quite
 * halves, since roots like to be in the middle. */
static void kin_halve(kin_interval *upper, kin_interval *lower, int count)
{
    const double share = 0.4871, cut = kin_between(upper, share);
    lower->low = upper->low;
    lower->high = upper->low = cut;
    for (int i = 0; i < count; ++i) {
        lower->coefficients[i] = upper->coefficients[0];
        for (int j = 0; j < count - 1 - i; ++j) {
            const double a = upper->coefficients[j], b = upper->coefficients[j + 1];
            upper->coefficients[j] = a + share * (b - a);
        }
    }
}

/* Whether all that is known of the polynomial on an interval is noise. */
static int kin_is_unsigned(const kin_interval *interval, int count, double noise)
{
    int is = 1;
    for (int i = 0; i < count; ++i) {
        is = is && fabs(interval->coefficients[i]) <= noise;
    }
    return is;
}

/* What is on an arc on which there may be more roots than one. */
static void kin_halve_arc(kin_isolation *search, kin_roots *found)
{
    const int n = search->coefficients;
    for (int waiting = 1; waiting > 0;) {
        kin_interval *interval = &search->waiting[--waiting];
        const double width = 2.0 * (interval->high - interval->low);
        const double middle = 0.5 * (interval->low + interval->high);
        double share = 0.0;
        const kin_signs signs = kin_count_signs(interval->coefficients, n, search->noise, &share);
        if (signs == KIN_NO_ROOT) {
            continue;
        }
        if (signs == KIN_ONE_ROOT) {
            kin_bracket(search, interval->low, interval->high, kin_between(interval, share),
                interval->coefficients[0] < 0.0, found);
        } else if (signs == KIN_TWO_ROOTS && kin_at_extremum(search, interval, found)) {
            continue;
        } else if (width < KIN_NARROW) {
            kin_push_cluster(kin_arc_angle(search, middle), found);
        } else if (signs == KIN_MANY_ROOTS && kin_is_unsigned(interval, n, search->noise)) {
            const double parts = ceil(width / KIN_BLIND);
            for (int part = 0; part < (int)parts; ++part) {
                const double t = kin_between(interval, (part + 0.5) / parts);
                kin_push_cluster(kin_arc_angle(search, t), found);
            }
        } else if (search->halvings == KIN_HALVINGS || waiting + 2 > KIN_WAITING) {
            kin_push_cluster(kin_arc_angle(search, middle), found);
            found->incomplete = 1;
        } else {
            ++search->halvings;
            kin_halve(interval, &search->waiting[waiting + 1], n);
            waiting += 2;
        }
    }
}

/* Newton's method in eight brackets at once, halving where it leaves them; the slopes there. */
KIN_INLINE void kin_find_simple_roots_of(
    const kin_harmonics *f, kin_pack low, kin_pack high, const kin_pack rises, kin_pack x,
    kin_pack slope)
{
    for (int step = 0; step < KIN_ROOT_STEPS; ++step) {
        kin_pack value, moved;
        double largest = 0.0;
        kin_value_and_slope(f, x, value, slope);
        for (int k = 0; k < KIN_LANES; ++k) {
            const double height = value[k] * rises[k], newton = x[k] - value[k] / slope[k];
            double next;
            low[k] = kin_select(0.0, height, low[k], x[k]);
            high[k] = kin_select(0.0, height, x[k], high[k]);
            next = 0.5 * (low[k] + high[k]);
            next = ((newton >= low[k]) & (newton <= high[k])) ? newton : next;
            moved[k] = fabs(next - x[k]);
            x[k] = next;
        }
        for (int k = 0; k < KIN_LANES; ++k) {
            largest = kin_max(largest, moved[k]);
        }
        /* Newton's method on the arm does the rest. */
        if (largest < 1e-9) {
            break;
        }
    }
}
KIN_BY_PROCESSOR(kin_find_simple_roots,
    (const kin_harmonics *f, kin_pack low, kin_pack high, const kin_pack rises, kin_pack x,
     kin_pack slope),
    (f, low, high, rises, x, slope))

/* The roots in the brackets. */
static void kin_leave_brackets(const kin_isolation *search, kin_roots *found)
{
    for (int first = 0; first < search->count; first += KIN_LANES) {
        const int rest = search->count - first, count = rest < KIN_LANES ? rest : KIN_LANES;
        kin_pack low, high, rises, x, slope;
        for (int k = 0; k < KIN_LANES; ++k) {
            const int i = first + (k < count ? k : count - 1);
            low[k] = search->low[i];
            high[k] = search->high[i];
            rises[k] = search->rises[i];
            x[k] = search->guess[i];
            slope[k] = 0.0;
        }
        kin_find_simple_roots(search->f, low, high, rises, x, slope);
        for (int k = 0; k < count; ++k) {
            /* Roots that are complex may be so near that their solutions mix with this one. */
            found->flat |= (unsigned)(fabs(slope[k]) < 1e-3) << found->count % KIN_MOST_ROOTS;
            kin_push_root(x[k], found);
        }
    }
}

/* The roots, in no order, in (-pi, 2 pi]; a few that are none may be with them. */
static void kin_find_roots(const kin_harmonics *f, kin_roots *found)
{
    kin_isolation search;
    kin_arcs arcs;
    found->count = found->incomplete = 0;
    found->twice = found->several = found->flat = 0;
    kin_find_arcs(f, &arcs);
    search.f = f;
    search.coefficients = arcs.count;
    search.noise = KIN_UNSIGNED * f->noise;
    search.count = search.halvings = 0;
    for (int arc = 0; arc < KIN_ARCS; ++arc) {
        const int is_signed = arcs.least[arc] > search.noise;
        kin_interval *whole = &search.waiting[0];
        if (is_signed && arcs.changes[arc] == 0.0) {
            continue;
        }
        search.middle = kin_middle(arc);
        whole->low = -KIN_REACH;
        whole->high = KIN_REACH;
        for (int i = 0; i < arcs.count; ++i) {
            whole->coefficients[i] = arcs.coefficients[i][arc];
        }
        if (is_signed && arcs.changes[arc] == 1.0) {
            kin_bracket(&search, whole->low, whole->high, kin_between(whole, arcs.share[arc]),
                whole->coefficients[0] < 0.0, found);
        } else {
            kin_halve_arc(&search, found);
        }
    }
    kin_leave_brackets(&search, found);
}
