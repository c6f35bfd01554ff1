/* A lane as another run of the plan has it. */
static void kin_set_lane(kin_lanes *lanes, const kin_lanes *other, int k)
{
    for (int i = 0; i < KIN_SOLVED; ++i) {
        lanes->q[i][k] = other->q[i][k];
    }
    lanes->residual[k] = other->residual[k];
    lanes->invalid[k] = other->invalid[k];
    lanes->singular[k] = other->singular[k];
}

/* Whether a joint that is free leaves a root none for which it makes room, but for the one that
 * is left out. */
static int kin_leaves_none(const kin_lanes *lanes, int joint, int left_out, int k)
{
    int leaves = 0;
    for (int j = 0; j < KIN_FREE; ++j) {
        const int is_asked = kin_free[j] == kin_free[joint] && j != left_out;
        leaves |= is_asked && lanes->no_root[j][k] > 0.0;
    }
    return leaves;
}

/* The lanes with a joint moved where it is free, and the seed that moves it. */
static void kin_move_by(
    const double target[12], const double seed[KIN_SOLVED], const double *given, int joint,
    double turn, double moved[KIN_SOLVED], kin_lanes *lanes)
{
    for (int i = 0; i < KIN_SOLVED; ++i) {
        moved[i] = seed[i];
    }
    moved[kin_free[joint]] += (kin_free_slides[joint] > 0.0 ? kin_free_slides[joint] : 1.0) * turn;
    kin_compute_lanes(target, moved, given, 1e-16, lanes);
}

/* Takes a turn with its level if that leaves a lane more room than the best one so far. */
static void kin_take_turn(
    const kin_lanes *lanes, int joint, double turn, int k, double *best, double *least, int *has_roots)
{
    const double level = fabs(lanes->level[joint][k]);
    const int has = !kin_leaves_none(lanes, joint, -1, k);
    if (has != *has_roots ? has : level < *least) {
        *best = turn;
        *least = level;
        *has_roots = has;
    }
}

/* One of 15 turns all round but the seed's own, radians: to both sides, as slides go. */
static double kin_turn_round(int i)
{
    const int step = i < 7 ? i - 7 : i - 6;
    return step * (6.283185307179586 / 16.0);
}

/* Of turns all round the one that leaves a lane the most room, or if none leaves it any the best next
 * to it. */
static double kin_turn_all_round(
    const double target[12], const double seed[KIN_SOLVED], const double *given, int joint,
    const kin_lanes all_round[15], int k)
{
    /* Beside the best turn, to those through which a parabola tells where the level is least. */
    static const double parabolas[4] = {1e-2, 1e-3, 1e-4, 2e-5};
    double step = 6.283185307179586 / 16.0, best = 0.0, least = HUGE_VAL, moved[KIN_SOLVED];
    int has_roots = 0;
    kin_lanes lanes;
    for (int i = 0; i < 15; ++i) {
        kin_take_turn(&all_round[i], joint, kin_turn_round(i), k, &best, &least, &has_roots);
    }
    for (int halving = 0; halving < 5 && !has_roots; ++halving) {
        const double from = best;
        step *= 0.5;
        for (int sign = -1; sign <= 1; sign += 2) {
            kin_move_by(target, seed, given, joint, from + sign * step, moved, &lanes);
            kin_take_turn(&lanes, joint, from + sign * step, k, &best, &least, &has_roots);
        }
    }
    for (int i = 0; i < 4 && !has_roots; ++i) {
        const double from = best, here = least;
        double beside[2], bend;
        for (int end = 0; end < 2; ++end) {
            const double turn = from + (end == 0 ? -parabolas[i] : parabolas[i]);
            kin_move_by(target, seed, given, joint, turn, moved, &lanes);
            beside[end] = fabs(lanes.level[joint][k]);
        }
        bend = beside[0] + beside[1] - 2.0 * here;
        if (bend > 0.0) {
            const double turn = from + parabolas[i] * 0.5 * (beside[0] - beside[1]) / bend;
            kin_move_by(target, seed, given, joint, turn, moved, &lanes);
            kin_take_turn(&lanes, joint, turn, k, &best, &least, &has_roots);
        }
    }
    return best;
}

/* The lanes, or the only one, with the joints from the first one moved that are free and leave a
 * later root none, as `said`: to the next value that leaves it one, or if that is far to where it has
 * the most room. Where more than one is free, each moves after those before it. */
static void kin_move_free_joints(
    const double target[12], const double seed[KIN_SOLVED], const double *given,
    const kin_lanes *said, int first, int only, kin_lanes *lanes)
{
    int open[KIN_BRANCHES];
    for (int k = 0; k < KIN_BRANCHES; ++k) {
        open[k] = only < 0 || k == only;
    }
    for (int joint = first; joint < KIN_FREE; ++joint) {
        double samples[4][KIN_BRANCHES], moved[KIN_SOLVED];
        kin_lanes best, all_round[15];
        int is_sampled = 0, is_round = 0;
        for (int k = 0; k < KIN_BRANCHES; ++k) {
            const int is_slide = kin_free_slides[joint] > 0.0;
            double levels[4], turn;
            int is_next;
            if (!open[k] || !(said->no_root[joint][k] > 0.0)) {
                continue;
            }
            open[k] = 0;
            for (int i = 0; i < 4 && !is_sampled; ++i) {
                kin_move_by(target, seed, given, joint, kin_level_turns[i], moved, &best);
                for (int other = 0; other < KIN_BRANCHES; ++other) {
                    samples[i][other] = best.level[joint][other];
                }
            }
            is_sampled = 1;
            for (int i = 0; i < 4; ++i) {
                levels[i] = samples[i][k];
            }
            /* To where the root is a double one, if that is next to the seed. */
            turn = kin_next_root(levels, is_slide);
            is_next = fabs(turn) <= 0.05;
            if (is_next) {
                kin_move_by(target, seed, given, joint, turn, moved, &best);
                is_next = !kin_leaves_none(&best, joint, -1, k);
            }
            if (!is_next) {
                int is_as_told;
                turn = kin_roomiest_turn(levels, is_slide);
                kin_move_by(target, seed, given, joint, turn, moved, &best);
                is_as_told = kin_levels_tell(levels, is_slide, turn, best.level[joint][k]);
                if (kin_leaves_none(&best, joint, is_as_told ? joint : -1, k)) {
                    for (int i = 0; i < 15 && !is_round; ++i) {
                        kin_move_by(target, seed, given, joint, kin_turn_round(i), moved, &all_round[i]);
                    }
                    is_round = 1;
                    turn = kin_turn_all_round(target, seed, given, joint, all_round, k);
                    kin_move_by(target, seed, given, joint, turn, moved, &best);
                }
            }
            kin_set_lane(lanes, &best, k);
            kin_move_free_joints(target, moved, given, &best, joint + 1, k, lanes);
        }
    }
}
