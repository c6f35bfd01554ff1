/* Adds a solution of one chain, with the platform in the given of several places. */
static void kin_add(kin_postures *postures, int chain, int place, const double *q)
{
    const int first = kin_chains[chain], end = kin_chains[chain + 1];
    const int b = postures->counts[chain];
    if (b < KIN_MOST) {
        for (int joint = first; joint < end; ++joint) {
            postures->q[b][joint] = q[joint - first];
        }
        postures->places[chain][b] = place;
        postures->counts[chain] = b + 1;
    }
}

/* How many solutions of a chain are for a place. */
static int kin_in_place(const kin_postures *postures, int chain, int place)
{
    int count = 0;
    for (int b = 0; b < postures->counts[chain]; ++b) {
        count += postures->places[chain][b] == place;
    }
    return count;
}

/* How many postures are for a place; at most 2^31 - 1. */
static int kin_all_in_place(const kin_postures *postures, int place)
{
    int here = 1;
    for (int chain = 0; chain < KIN_CHAINS; ++chain) {
        const int count = kin_in_place(postures, chain, place);
        if (count == 0) {
            return 0;
        }
        here = here > 2147483647 / count ? 2147483647 : here * count;
    }
    return here;
}

/* Ends the solutions for a place, which are the last ones: where some chain has none there, those of
 * the others combine with nothing, and leave their room to those for other places. */
static inline void kin_end_place(kin_postures *postures, int place)
{
    if (kin_all_in_place(postures, place) > 0) {
        return;
    }
    for (int chain = 0; chain < KIN_CHAINS; ++chain) {
        int *count = &postures->counts[chain];
        while (*count > 0 && postures->places[chain][*count - 1] == place) {
            --*count;
        }
    }
}

int kin_count(const kin_postures *postures)
{
    int count = 0;
    for (int place = 0; place < KIN_MOST; ++place) {
        const int here = kin_all_in_place(postures, place);
        count = count > 2147483647 - here ? 2147483647 : count + here;
    }
    return count;
}

int kin_posture(const kin_postures *postures, int number, double q[KIN_JOINTS])
{
    for (int place = 0; place < KIN_MOST && number >= 0; ++place) {
        int rest = number;
        number -= kin_all_in_place(postures, place);
        if (number >= 0) {
            continue;
        }
        for (int chain = 0; chain < KIN_CHAINS; ++chain) {
            const int count = kin_in_place(postures, chain, place);
            int b = -1;
            for (int nth = rest % count; nth >= 0; --nth) {
                do {
                    ++b;
                } while (postures->places[chain][b] != place);
            }
            for (int joint = kin_chains[chain]; joint < kin_chains[chain + 1]; ++joint) {
                q[joint] = postures->q[b][joint];
            }
            rest /= count;
        }
        return 1;
    }
    return 0;
}

/* The posture that moves each chain least from a seed, within the limits or regardless of them. */
static int kin_choose_posture(
    const kin_postures *postures, const double seed[KIN_JOINTS], int limited, double q[KIN_JOINTS])
{
    double best = HUGE_VAL;
    for (int place = 0; place < KIN_MOST; ++place) {
        double chosen[KIN_JOINTS], total = 0.0;
        for (int chain = 0; chain < KIN_CHAINS; ++chain) {
            double least = HUGE_VAL;
            for (int b = 0; b < postures->counts[chain]; ++b) {
                double moved[KIN_JOINTS], distance = 0.0;
                if (postures->places[chain][b] != place) {
                    continue;
                }
                for (int joint = kin_chains[chain]; joint < kin_chains[chain + 1]; ++joint) {
                    const double own = postures->q[b][joint];
                    if (limited) {
                        const double lower = kin_lower_limits[joint], upper = kin_upper_limits[joint];
                        double beyond;
                        const double value = kin_next_inside(
                            kin_turns[joint], lower, upper, own, seed[joint], &beyond);
                        moved[joint] = kin_at_most_at_a_stop(lower, upper, value);
                        distance += beyond <= 1e-9 ? 0.0 : HUGE_VAL;
                    } else {
                        const double apart = own - seed[joint];
                        moved[joint] = kin_turns[joint] ? seed[joint] + kin_wrap(apart) : own;
                    }
                    distance += (moved[joint] - seed[joint]) * (moved[joint] - seed[joint]);
                }
                if (distance < least) {
                    least = distance;
                    for (int joint = kin_chains[chain]; joint < kin_chains[chain + 1]; ++joint) {
                        chosen[joint] = moved[joint];
                    }
                }
            }
            total += least;
        }
        if (total < best) {
            best = total;
            for (int joint = 0; joint < KIN_JOINTS; ++joint) {
                q[joint] = chosen[joint];
            }
        }
    }
    return best < HUGE_VAL;
}

int kin_ik(const double pose[12], kin_postures *postures)
{
    static const double seed[KIN_JOINTS] = {0.0};
    return kin_ik_seeded(pose, seed, postures);
}

int kin_ik_nearest(const double pose[12], const double seed[KIN_JOINTS], double q[KIN_JOINTS])
{
    kin_postures postures;
    return kin_ik_seeded(pose, seed, &postures) > 0 && kin_choose_posture(&postures, seed, 1, q);
}
