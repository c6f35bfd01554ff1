/* What is missing between where the platform is meant to be and where a chain has it, scaled. */
static void kin_missing(const kin_seen *seen, const double platform[12], int chain, double out[6])
{
    double back[12], between[12], twist[6];
    kin_invert(seen->poses + 12 * chain, back);
    kin_compose(platform, back, between);
    kin_log(between, twist);
    kin_scaled(seen->poses, twist, out);
}

/* Moves every chain's passive joints by a part of what takes its end along with the platform. The
 * longest of the whole motions, angles, or metres by the mechanism's length. */
static double kin_follow(
    const kin_seen *seen, const double motion[6], const double missing[6 * KIN_CHAINS], double part,
    double q[KIN_JOINTS])
{
    double longest = 0.0;
    for (int i = 0; i < 6; ++i) {
        longest = kin_max(longest, fabs(motion[i]) / KIN_LENGTH);
    }
    for (int chain = 0; chain < KIN_CHAINS; ++chain) {
        double wanted[6];
        kin_span span;
        kin_span_of(seen->columns, kin_chains[chain], kin_chains[chain + 1], 1, -1, &span);
        for (int i = 0; i < 6; ++i) {
            wanted[i] = motion[i] + missing[6 * chain + i];
        }
        longest = kin_max(longest, kin_coordinates(&span, wanted, part, q));
    }
    return longest;
}

/* One step: of the platform, such that no chain needs an impossible motion to follow, and then of
 * every chain. The nearer the loops are to being closed, the less is the platform's motion damped
 * (Levenberg and Marquardt). */
static void kin_step(const kin_seen *seen, double platform[12], double gap, double q[KIN_JOINTS])
{
    double missing[6 * KIN_CHAINS], beside[6 * KIN_CHAINS], r[36], tails[6], motion[6], limit, longest;
    double twist[6], moved[12], old[12];
    const double damping = gap / KIN_LENGTH < 0.1 ? gap / KIN_LENGTH : 0.1;
    for (int chain = 0; chain < KIN_CHAINS; ++chain) {
        kin_missing(seen, platform, chain, missing + 6 * chain);
        for (int i = 0; i < 6; ++i) {
            beside[6 * chain + i] = -missing[6 * chain + i];
        }
    }
    kin_wrenches(seen, beside, 1, r, tails);
    for (int i = 0; i < 6; ++i) {
        double row[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0}, tail = 0.0;
        row[i] = damping;
        kin_take_row(r, tails, row, &tail, 6, 1);
    }
    kin_back_substitute(r, tails, 1, 0, motion);
    /* Most steps are short enough; those that are not are drawn back. */
    longest = kin_follow(seen, motion, missing, 1.0, q);
    limit = longest > 0.6 ? 0.6 / longest : 1.0;
    if (limit < 1.0) {
        kin_follow(seen, motion, missing, limit - 1.0, q);
    }
    kin_spatial(seen->poses, motion, twist);
    for (int i = 0; i < 6; ++i) {
        twist[i] *= limit;
    }
    kin_exp(twist, moved);
    for (int i = 0; i < 12; ++i) {
        old[i] = platform[i];
    }
    kin_compose(moved, old, platform);
}

int kin_fk_near(
    const double actuated[KIN_ACTUATED], const double seed[KIN_JOINTS], double q[KIN_JOINTS])
{
    double here[KIN_JOINTS], platform[12], least = HUGE_VAL;
    int idle = 0;
    for (int i = 0; i < KIN_JOINTS; ++i) {
        here[i] = seed[i];
    }
    for (int a = 0; a < KIN_ACTUATED; ++a) {
        here[kin_actuated[a]] = actuated[a];
    }
    for (int step = 0; step < 60; ++step) {
        kin_seen seen;
        double gap;
        kin_see(here, &seen);
        gap = kin_apart(seen.poses);
        idle = gap < 0.5 * least ? 0 : idle + 1;
        if (gap < least) {
            least = gap;
            for (int i = 0; i < KIN_JOINTS; ++i) {
                q[i] = here[i];
            }
        }
        if (!(gap > 1e-14 * KIN_LENGTH) || (idle > 0 && least < 1e-12 * KIN_LENGTH)) {
            break;
        }
        for (int i = 0; i < 12 && step == 0; ++i) {
            platform[i] = seen.poses[i];
        }
        kin_step(&seen, platform, gap, here);
    }
    return least <= 1e-12 * KIN_LENGTH;
}
