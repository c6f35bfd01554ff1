/* Of the values of a joint that are q but for full turns, if it turns, the one inside its limits
 * and nearest to a seed, and how far it is beyond a stop. */
static double kin_next_inside(
    int turns, double lower, double upper, double q, double seed, double *beyond)
{
    const double pi = 3.141592653589793, turn = turns ? 6.283185307179586 : 0.0;
    const double middle = 0.5 * (lower + upper);
    double first = lower - 5e-10 + pi, last = upper + 5e-10 - pi, value;
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
static double kin_at_most_at_a_stop(double lower, double upper, double value)
{
    value = value > upper ? upper : value;
    return value < lower ? lower : value;
}
