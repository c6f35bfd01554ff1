int kin_within_limits(const double q[KIN_JOINTS], double moved[KIN_JOINTS])
{
    int inside = 1;
    for (int i = 0; i < KIN_JOINTS; ++i) {
        const double lower = kin_lower_limits[i], upper = kin_upper_limits[i];
        double beyond;
        const double value = kin_next_inside(kin_turns[i], lower, upper, q[i], q[i], &beyond);
        const int is_inside = beyond <= 1e-9;
        moved[i] = is_inside ? kin_at_most_at_a_stop(lower, upper, value) : q[i];
        inside = inside && is_inside;
    }
    return inside;
}
