/* What a later root says of a free angle at some turns of the seed's, radians: d of its equation
 * a cos x + b sin x = d. Three tell mean + cosine cos x + sine sin x, and the fourth whether d is
 * that. */
static const double kin_level_turns[4] = {0.0, 1.5707963267948966, 3.141592653589793, 4.0};

/* What the first three tell. */
typedef struct kin_first_harmonic {
    double mean, cosine, sine;
} kin_first_harmonic;

static kin_first_harmonic kin_first_harmonic_of(const double levels[4])
{
    kin_first_harmonic of;
    of.mean = 0.5 * (levels[0] + levels[2]);
    of.cosine = 0.5 * (levels[0] - levels[2]);
    of.sine = levels[1] - of.mean;
    return of;
}

/* The turn, radians, that leaves the root the most room. */
static double kin_roomiest_turn(const double levels[4])
{
    const kin_first_harmonic of = kin_first_harmonic_of(levels);
    const double amplitude = sqrt(of.cosine * of.cosine + of.sine * of.sine);
    /* mean + cosine cos x + sine sin x = 0, or what comes nearest to it. */
    const double near_ = kin_max(amplitude + of.mean, 0.0);
    const double far_ = kin_max(amplitude - of.mean, 0.0);
    return kin_wrap(kin_atan2(of.sine, of.cosine) - 2.0 * kin_atan2(sqrt(near_), sqrt(far_)));
}

/* Whether d is as the three turns tell it, at the fourth and where it is known too. */
static int kin_levels_tell(const double levels[4], double turn, double level)
{
    const kin_first_harmonic of = kin_first_harmonic_of(levels);
    const double scale = fabs(of.mean) + fabs(of.cosine) + fabs(of.sine);
    const double known[2][2] = {{kin_level_turns[3], levels[3]}, {turn, level}};
    int tell = 1;
    for (int i = 0; i < 2; ++i) {
        double sine, cosine;
        kin_sin_cos(known[i][0], &sine, &cosine);
        /* Also where it is no number. */
        tell &= fabs(of.mean + of.cosine * cosine + of.sine * sine - known[i][1]) <= 1e-9 * scale;
    }
    return tell;
}
