/* The solutions of a target, as they are found, of six joints in the units of the arm's frames. */
#define KIN_MOST_FOUND 16
/* Solutions reach the target to this, in units of the arm's size. */
#define KIN_REACHED 1e-13

typedef struct kin_six {
    double q[6], residual;
    int branch, singular;
} kin_six;

typedef struct kin_found {
    /* How far the target's rotation is from the one that is reached, radians. */
    double gap;
    kin_six regular[KIN_MOST_FOUND];
    int regular_count;
    /* Of each regular solution, how far from singular it is. */
    double independence[KIN_MOST_FOUND];
    /* Where the Jacobian loses rank: these may be members of families, and must not take the place
     * of others. */
    kin_six singular[KIN_MOST_FOUND];
    int singular_count;
    /* What has come near without being a solution, and how near, in units of the arm's size. */
    kin_six nearest;
    double nearest_by;
    /* Bit i is set where regular solution i was found again since this was cleared. */
    unsigned again;
} kin_found;

/* How far two values of a joint are apart. */
static double kin_apart(int joint, double a, double b)
{
    return fabs(kin_slides[joint] ? a - b : kin_wrap(a - b));
}

/* Whether no joint is farther from where it is in the other configuration. */
static int kin_are_within(double distance, const double a[6], const double b[6])
{
    int are = 1;
    for (int i = 0; i < 6; ++i) {
        are = are && kin_apart(i, a[i], b[i]) <= distance;
    }
    return are;
}

/* Solutions that are nearer to each other, radians or half the arm's size, are one. */
#define KIN_SAME 1e-6

/* The place of a regular solution, which is appended unless it is there: of two the better one is
 * kept. -1 if there is no place left. */
static int kin_place_of(kin_found *found, const kin_six *solution)
{
    for (int known = 0; known < found->regular_count; ++known) {
        int same = 1;
        for (int i = 0; i < 6; ++i) {
            same = same && kin_apart(i, found->regular[known].q[i], solution->q[i]) < KIN_SAME;
        }
        if (same) {
            if (solution->residual < found->regular[known].residual) {
                const int branch = found->regular[known].branch;
                found->regular[known] = *solution;
                found->regular[known].branch = branch;
            }
            return known;
        }
    }
    if (found->regular_count == KIN_MOST_FOUND) {
        return -1;
    }
    found->regular[found->regular_count] = *solution;
    return found->regular_count++;
}

/* Below this independence of the Jacobian's columns a configuration is singular. */
#define KIN_SINGULAR 1e-5
/* Singular solutions that are nearer to each other, radians or half the arm's size, are one, or
 * members of a family; from so near, Newton's method leads to a regular solution. */
#define KIN_FAMILY 1e-4
/* What comes no nearer than this to a target, in units of the arm's size, is not next to a solution. */
#define KIN_NEXT_TO 1e-6
/* Of a slide that is farther, in the same units, rounding alone may miss the target. */
#define KIN_FARTHEST 1e6

/* Adds one of the configurations that have arrived, if it is a solution; whether it is one. */
static int kin_insert_arrived(kin_found *found, const kin_arrived *arrived, int lane, int branch)
{
    const double residual = arrived->residual[lane], gap = found->gap;
    kin_six solution;
    if (!(residual <= KIN_NEXT_TO)) {
        return 0;
    }
    for (int i = 0; i < 6; ++i) {
        if (fabs(arrived->q[i][lane]) > KIN_FARTHEST) {
            return 0;
        }
        solution.q[i] = kin_slides[i] ? arrived->q[i][lane] : kin_wrap(arrived->q[i][lane]);
    }
    solution.residual = KIN_ARM_SIZE * sqrt(residual * residual + gap * gap);
    solution.branch = branch;
    solution.singular = arrived->independence[lane] < KIN_SINGULAR;
    if (!(residual <= KIN_REACHED)) {
        if (residual < found->nearest_by) {
            found->nearest = solution;
            found->nearest_by = residual;
        }
        return 0;
    }
    /* Next to the threshold one that is found twice is what it was the first time. */
    for (int i = 0; i < found->singular_count; ++i) {
        if (kin_are_within(KIN_SAME, found->singular[i].q, solution.q)) {
            return 1;
        }
    }
    for (int i = 0; i < found->regular_count; ++i) {
        if (kin_are_within(KIN_SAME, found->regular[i].q, solution.q)) {
            solution.singular = 0;
        }
    }
    if (!solution.singular) {
        const int place = kin_place_of(found, &solution);
        if (place >= 0) {
            found->again |= 1u << place;
            found->independence[place] = arrived->independence[lane];
        }
        return 1;
    }
    for (int i = 0; i < found->singular_count; ++i) {
        if (kin_are_within(KIN_FAMILY, found->singular[i].q, solution.q)) {
            return 1;
        }
    }
    if (found->singular_count < KIN_MOST_FOUND) {
        found->singular[found->singular_count++] = solution;
    }
    return 1;
}

/* Whether the solution next to a configuration is known: a regular one, with no other beside it,
 * where it is `meeting` from singular or more. */
static int kin_is_known(kin_found *found, const double q[6], double meeting)
{
    for (int i = 0; i < found->regular_count; ++i) {
        if (found->independence[i] > meeting && kin_are_within(KIN_FAMILY, found->regular[i].q, q)) {
            found->again |= 1u << i;
            return 1;
        }
    }
    return 0;
}

/* Sorts solutions by what they are ordered by. */
static void kin_sort(kin_six *solutions, int count, double (*by)(const kin_six *))
{
    for (int i = 1; i < count; ++i) {
        const kin_six moved = solutions[i];
        int place = i;
        for (; place > 0 && by(&solutions[place - 1]) > by(&moved); --place) {
            solutions[place] = solutions[place - 1];
        }
        solutions[place] = moved;
    }
}

/* Configurations, as many as are worked on at once. */
typedef struct kin_queue {
    double q[KIN_LANES][6];
    int count;
} kin_queue;

/* Takes one in if there is room. */
static void kin_enqueue(kin_queue *queue, const double q[6])
{
    if (queue->count < KIN_LANES) {
        for (int i = 0; i < 6; ++i) {
            queue->q[queue->count][i] = q[i];
        }
        ++queue->count;
    }
}

/* Empties it: by joint, the last one again in the places that are left, and how many they were. */
static int kin_dequeue(kin_queue *queue, kin_pack q[6])
{
    const int count = queue->count;
    for (int k = 0; k < KIN_LANES; ++k) {
        for (int i = 0; i < 6; ++i) {
            q[i][k] = queue->q[k < count ? k : count > 0 ? count - 1 : 0][i];
        }
    }
    queue->count = 0;
    return count;
}

/* The configuration in one place. */
static void kin_in_lane(kin_pack q[6], int lane, double out[6])
{
    for (int i = 0; i < 6; ++i) {
        out[i] = q[i][lane];
    }
}
