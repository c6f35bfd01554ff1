/* Adds a solution, unless it is one of those that are there; of two the better one stays. */
static int kin_insert(const kin_solution *found, kin_solution *solutions, int count)
{
    for (int known = 0; known < count; ++known) {
        int same = 1;
        for (int i = 0; i < KIN_JOINTS; ++i) {
            const double off = found->q[i] - solutions[known].q[i];
            const double apart = kin_turns[i] ? fabs(kin_wrap(off)) : fabs(off);
            same = same && apart < 1e-6;
        }
        if (same) {
            if (found->residual < solutions[known].residual) {
                const int branch = solutions[known].branch;
                solutions[known] = *found;
                solutions[known].branch = branch;
            }
            return count;
        }
    }
    if (count < KIN_MAX_SOLUTIONS) {
        solutions[count] = *found;
        ++count;
    }
    return count;
}
