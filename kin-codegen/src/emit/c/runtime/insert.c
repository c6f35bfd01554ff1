/* How far two values of a joint are apart, full turns left out. */
static double kin_joint_distance(int joint, double a, double b)
{
    return fabs(kin_turns[joint] ? kin_wrap(a - b) : a - b);
}

/* The place of a configuration among some solutions, -1 if it is none of them. */
static int kin_known_place(const double q[KIN_JOINTS], const kin_solution *solutions, int count)
{
    for (int known = 0; known < count; ++known) {
        int same = 1;
        for (int i = 0; i < KIN_JOINTS; ++i) {
            same = same && kin_joint_distance(i, q[i], solutions[known].q[i]) < 1e-6;
        }
        if (same) {
            return known;
        }
    }
    return -1;
}

/* Adds a solution, unless it is one of those that are there; of two the better one stays. */
static int kin_insert(const kin_solution *found, kin_solution *solutions, int count)
{
    const int known = kin_known_place(found->q, solutions, count);
    if (known >= 0) {
        if (found->residual < solutions[known].residual) {
            const int branch = solutions[known].branch;
            solutions[known] = *found;
            solutions[known].branch = branch;
        }
    } else if (count < KIN_MAX_SOLUTIONS) {
        solutions[count] = *found;
        ++count;
    }
    return count;
}
