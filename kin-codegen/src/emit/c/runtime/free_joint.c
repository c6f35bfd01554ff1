/* What a later root says of a free joint at some turns from the seed's value, radians: d of its
 * equation a cos x + b sin x = d. Three tell what it is as the function of a turn x,
 * constant + first cos x + second sin x for an angle and constant + first q + second q q for a slide,
 * q = x / (pi / 2), and the fourth whether d is that. */
static const double kin_level_turns[4] = {0.0, 1.5707963267948966, 3.141592653589793, 4.0};

/* What the first three tell. */
typedef struct kin_level_function {
    double constant, first, second;
} kin_level_function;

static kin_level_function kin_level_function_of(const double levels[4], int is_slide)
{
    const double mean = 0.5 * (levels[0] + levels[2]);
    kin_level_function of;
    if (is_slide) {
        of.constant = levels[0];
        of.second = mean - levels[1];
        of.first = 0.5 * (levels[2] - levels[0]) - 2.0 * of.second;
    } else {
        of.constant = mean;
        of.first = 0.5 * (levels[0] - levels[2]);
        of.second = levels[1] - mean;
    }
    return of;
}

/* Where c + b x + a x x is zero nearest to 0, or if it is nowhere where it is least. */
static double kin_nearest_zero(double c, double b, double a)
{
    const double discriminant = b * b - 4.0 * a * c;
    double over = -b, below = 2.0 * a;
    if (!(discriminant < 0.0)) {
        const double root = sqrt(discriminant);
        over = -2.0 * c;
        below = b + (b < 0.0 ? -root : root);
    }
    return below == 0.0 ? 0.0 : over / below;
}

/* The turn, radians, that leaves the root the most room; of two for a slide the nearer one. */
static double kin_roomiest_turn(const double levels[4], int is_slide)
{
    const kin_level_function of = kin_level_function_of(levels, is_slide);
    if (is_slide) {
        return 1.5707963267948966 * kin_nearest_zero(of.constant, of.first, of.second);
    } else {
        const double amplitude = sqrt(of.first * of.first + of.second * of.second);
        /* constant + first cos x + second sin x = 0, or what comes nearest to it. */
        const double near_ = kin_max(amplitude + of.constant, 0.0);
        const double far_ = kin_max(amplitude - of.constant, 0.0);
        return kin_wrap(kin_atan2(of.second, of.first) - 2.0 * kin_atan2(sqrt(near_), sqrt(far_)));
    }
}

/* The turn, radians, to where the root becomes a double one: d is 1 or -1. */
static double kin_next_root(const double levels[4], int is_slide)
{
    const kin_level_function of = kin_level_function_of(levels, is_slide);
    const double beyond = levels[0] - (levels[0] < 0.0 ? -1.0 : 1.0);
    if (is_slide) {
        return 1.5707963267948966 * kin_nearest_zero(beyond, of.first, of.second);
    }
    /* By the tangent of half of the angle. */
    return 2.0 * kin_atan2(kin_nearest_zero(beyond, 2.0 * of.second, beyond - 2.0 * of.first), 1.0);
}

/* Whether d is as the three turns tell it, at the fourth and where it is known too. */
static int kin_levels_tell(const double levels[4], int is_slide, double turn, double level)
{
    const kin_level_function of = kin_level_function_of(levels, is_slide);
    const double known[2][2] = {{kin_level_turns[3], levels[3]}, {turn, level}};
    int tell = 1;
    for (int i = 0; i < 2; ++i) {
        double first, second, scale;
        if (is_slide) {
            first = known[i][0] / 1.5707963267948966;
            second = first * first;
        } else {
            kin_sin_cos(known[i][0], &second, &first);
        }
        scale = fabs(of.constant) + fabs(of.first) * kin_max(fabs(first), 1.0)
            + fabs(of.second) * kin_max(fabs(second), 1.0);
        /* Also where it is no number. */
        tell &= fabs(of.constant + of.first * first + of.second * second - known[i][1]) <= 1e-9 * scale;
    }
    return tell;
}
