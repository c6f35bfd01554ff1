/* Of some solutions the one inside the limits that moves the joints least from a seed; of
 * equals the first. */
static int kin_choose(
    const kin_solution *solutions, int count, const double seed[KIN_JOINTS], kin_solution *chosen)
{
    double least = HUGE_VAL;
    for (int k = 0; k < count; ++k) {
        double motion = 0.0, excess = -HUGE_VAL;
        kin_solution moved = solutions[k];
        for (int i = 0; i < KIN_JOINTS; ++i) {
            const int known = fabs(seed[i]) < HUGE_VAL;
            const double from = known ? seed[i] : 0.0;
            const double lower = kin_lower_limits[i], upper = kin_upper_limits[i];
            double beyond;
            const double value = kin_next_inside(
                kin_turns[i], lower, upper, solutions[k].q[i], from, &beyond);
            motion += known ? (value - from) * (value - from) : 0.0;
            excess = kin_max(excess, beyond);
            moved.q[i] = kin_at_most_at_a_stop(lower, upper, value);
        }
        /* What is too much for a number is still a motion. */
        motion = -kin_max(-motion, -1.7976931348623157e308);
        if (excess <= 1e-9 && motion < least) {
            least = motion;
            *chosen = moved;
        }
    }
    return least < HUGE_VAL ? 1 : KIN_BEYOND_LIMITS;
}
