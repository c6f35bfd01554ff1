/* Of the values of joint i that are q but for full turns the one inside its limits and
 * nearest to a seed, and how far it is beyond a stop. */
static double kin_next_inside(int i, double q, double seed, double *beyond)
{
    const double pi = 3.141592653589793, turn = kin_turns[i] ? 6.283185307179586 : 0.0;
    const double lower = kin_lower_limits[i], upper = kin_upper_limits[i];
    const double middle = 0.5 * (lower + upper);
    double first = lower - 1e-9 + pi, last = upper + 1e-9 - pi, value;
    /* Without stops the middle is no number and not taken. */
    first = middle < first ? middle : first;
    last = middle > last ? middle : last;
    seed = seed < first ? first : seed;
    seed = seed > last ? last : seed;
    value = q + turn * kin_round((seed - q) * (turn * 0.025330295910584444));
    *beyond = kin_max(value - upper, lower - value);
    return value;
}

/* A value, not beyond a stop. */
static double kin_at_most_at_a_stop(int i, double value)
{
    value = value > kin_upper_limits[i] ? kin_upper_limits[i] : value;
    return value < kin_lower_limits[i] ? kin_lower_limits[i] : value;
}

int kin_within_limits(const double q[KIN_JOINTS], double moved[KIN_JOINTS])
{
    int inside = 1;
    for (int i = 0; i < KIN_JOINTS; ++i) {
        double beyond;
        const double value = kin_next_inside(i, q[i], q[i], &beyond);
        const int is_inside = beyond <= 1e-9;
        moved[i] = is_inside ? kin_at_most_at_a_stop(i, value) : q[i];
        inside = inside && is_inside;
    }
    return inside;
}
