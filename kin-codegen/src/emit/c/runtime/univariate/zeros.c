/* How many zeros a trigonometric polynomial has near an angle, complex ones included: along a circle the
 * argument of f makes as many turns as there are zeros within, and so does that of a function that
 * differs from f by less than |f| there. In t = tan((x - angle) / 2) a circle about zero is its own
 * mirror image, as f is: half of it tells all. */

/* Points on half a circle. */
#define KIN_POINTS (2 * KIN_LANES)
/* Between two of them the argument is followed where it turns by less, radians. */
#define KIN_FOLLOWED 2.0
/* In multiples of its noise, the least of |f| on a circle that tells: more than f may be at an extremum
 * that is taken for roots, so that beyond the circle, where it is farther from it, there are none of
 * these. */
#define KIN_TELLING (2.5 * KIN_UNSIGNED)
/* So far from the roots that it stands for a candidate may be, radians. */
#define KIN_STANDS_FOR (KIN_CLUSTER + KIN_NARROW)
/* Where zeros have met: the derivative before the last one that is zero there, as a multiple of the next, so
 * that their angles are 3e-5 apart at most, radians; and so near to it that is known. */
#define KIN_MET 1e-10
#define KIN_SETTLED_AT 1e-9
/* Radii of circles, tangents of half an angle. */
#define KIN_RADII 6
static const double kin_radii[KIN_RADII] = {1.5e-3, 3e-3, 6e-3, 1.2e-2, 2.4e-2, 4.8e-2};

/* The zeros near an angle. */
typedef struct kin_zeros {
    /* With their multiplicities; -1 where they were not told. */
    int count;
    /* Where, and no others are as near to that. */
    double angle, within;
} kin_zeros;

static const kin_zeros kin_untold = {-1, 0.0, 0.0};

/* Whether an angle is one of them if it is a zero. */
static int kin_are_near(const kin_zeros *zeros, double angle)
{
    return zeros->count >= 0 && fabs(kin_wrap(angle - zeros->angle)) < zeros->within;
}

/* Whether all that a candidate at an angle stands for are among them. */
static int kin_cover(const kin_zeros *zeros, double angle)
{
    const double apart = fabs(kin_wrap(angle - zeros->angle));
    return zeros->count >= 0 && apart + KIN_STANDS_FOR < zeros->within;
}

/* f as a function of the angle that is left: a sum of exp(i k x) times these numbers and of their mirror
 * images. */
typedef struct kin_about {
    int degree;
    double re[KIN_DEGREE + 1], im[KIN_DEGREE + 1];
    /* No smaller value tells. */
    double least;
} kin_about;

static void kin_turn_harmonics(const kin_harmonics *f, double angle, kin_about *about)
{
    double sine, cosine, c = 1.0, s = 0.0;
    kin_sin_cos(angle, &sine, &cosine);
    about->degree = f->degree;
    about->least = KIN_TELLING * f->noise;
    for (int k = 0; k <= f->degree; ++k) {
        const double a = 0.5 * f->cosines[k], b = -0.5 * f->sines[k];
        const double turned = c * cosine - s * sine;
        about->re[k] = a * c - b * s;
        about->im[k] = a * s + b * c;
        s = c * sine + s * cosine;
        c = turned;
    }
}

/* Complex numbers: (p + a) z, in place. */
KIN_INLINE void kin_add_and_multiply(
    double *re, double *im, double a, double b, const double *x, const double *y)
{
    KIN_EACH_LANE
    for (int k = 0; k < KIN_LANES; ++k) {
        const double u = re[k] + a, v = im[k] + b;
        re[k] = u * x[k] - v * y[k];
        im[k] = u * y[k] + v * x[k];
    }
}

/* The arguments and the squares of f at the points of half a circle. */
KIN_INLINE void kin_on_circle_of(
    const kin_about *f, double radius, kin_pack *arguments, kin_pack *squares)
{
    for (int half = 0; half < 2; ++half) {
        kin_pack x, y, ahead[2], back[2], p[2], q[2];
        for (int k = 0; k < KIN_LANES; ++k) {
            const int part = 3 * (2 * (half * KIN_LANES + k) + 1);
            x[k] = radius * kin_cosines[part];
            y[k] = radius * kin_sine_of_part(part);
        }
        /* exp(i x) = (1 + i t) / (1 - i t), and its inverse. */
        for (int k = 0; k < KIN_LANES; ++k) {
            const double above = 1.0 - y[k], below = 1.0 + y[k];
            const double across = above * below - x[k] * x[k];
            const double outer = 1.0 / (below * below + x[k] * x[k]);
            const double inner = 1.0 / (above * above + x[k] * x[k]);
            ahead[0][k] = across * outer;
            ahead[1][k] = (x[k] + x[k]) * outer;
            back[0][k] = across * inner;
            back[1][k] = -(x[k] + x[k]) * inner;
        }
        for (int i = 0; i < 2; ++i) {
            kin_fill(p[i], 0.0);
            kin_fill(q[i], 0.0);
        }
        for (int k = f->degree; k > 0; --k) {
            kin_add_and_multiply(p[0], p[1], f->re[k], f->im[k], ahead[0], ahead[1]);
            kin_add_and_multiply(q[0], q[1], f->re[k], -f->im[k], back[0], back[1]);
        }
        for (int k = 0; k < KIN_LANES; ++k) {
            p[0][k] += q[0][k] + (f->re[0] + f->re[0]);
            p[1][k] += q[1][k];
            squares[half][k] = p[0][k] * p[0][k] + p[1][k] * p[1][k];
        }
        kin_angles(arguments[half], p[1], p[0]);
    }
}
KIN_BY_PROCESSOR(kin_on_circle,
    (const kin_about *f, double radius, kin_pack *arguments, kin_pack *squares),
    (f, radius, arguments, squares))

/* The zeros within a circle; -1 where it passes next to one. */
static int kin_zeros_within(const kin_about *f, double radius)
{
    kin_pack arguments[2], squares[2];
    double turned = 0.0, ends[2], before = 0.0;
    int followed = 1;
    kin_on_circle(f, radius, arguments, squares);
    /* From the mirror image of the first point, and to that of the last one. */
    ends[0] = kin_wrap(2.0 * arguments[0][0]);
    ends[1] = kin_wrap(-2.0 * arguments[1][KIN_LANES - 1]);
    for (int i = 0; i < 2; ++i) {
        turned += ends[i];
        followed = followed && fabs(ends[i]) < KIN_FOLLOWED;
    }
    for (int i = 0; i < KIN_POINTS; ++i) {
        const double argument = arguments[i / KIN_LANES][i % KIN_LANES];
        const double step = kin_wrap(argument - before);
        if (i > 0) {
            turned += 2.0 * step;
            followed = followed && fabs(step) < KIN_FOLLOWED;
        }
        followed = followed && squares[i / KIN_LANES][i % KIN_LANES] > f->least * f->least;
        before = argument;
    }
    return followed && turned > -KIN_FOLLOWED ? (int)(turned / 6.283185307179586 + 0.5) : -1;
}

/* The zeros near an angle, if there are two circles about it with none between them. */
static void kin_find_zeros(const kin_harmonics *f, double angle, kin_zeros *zeros)
{
    kin_about about;
    int before = -1;
    kin_turn_harmonics(f, angle, &about);
    *zeros = kin_untold;
    for (int i = 0; i < KIN_RADII; ++i) {
        const int count = kin_zeros_within(&about, kin_radii[i]);
        if (count >= 0 && count == before) {
            zeros->count = count;
            zeros->angle = angle;
            zeros->within = 2.0 * kin_atan2(kin_radii[i], 1.0);
            return;
        }
        before = count;
    }
}

/* Where zeros have met, or all but met: f and its derivatives but for the last are nearly zero there, and
 * of the last but one it is a zero that is found to all digits. Whether there is such an angle. */
static int kin_find_meeting(const kin_harmonics *f, const kin_zeros *zeros, double *angle)
{
    kin_harmonics before = *f;
    for (int order = 2; order < zeros->count; ++order) {
        kin_differentiate(&before);
    }
    *angle = zeros->angle;
    for (int step = 0; step < 6; ++step) {
        double of[3];
        kin_derivatives(&before, *angle, of);
        if (fabs(of[0]) <= KIN_MET * fabs(of[2]) && fabs(of[1]) <= KIN_SETTLED_AT * fabs(of[2])) {
            return kin_are_near(zeros, *angle);
        }
        *angle -= of[1] / of[2];
    }
    return 0;
}
