/* A configuration as the target sees it: what is missing, and how the joints make it;
 * lengths in units of the arm's size, zero where the target does not count. */
typedef struct kin_linearization {
    double q[KIN_CORRECTED];
    double residual;
    double error[6];
    double rows[6][KIN_CORRECTED];
} kin_linearization;

/* How far a pose is from a target, as far as the target counts, metres. */
static double kin_distance(const double pose[12], const double target[12])
{
    double shift = 0.0, turn = 0.0;
    for (int i = 0; i < 12; ++i) {
        const double off = pose[i] - target[i];
        if (i % 4 == 3) {
            shift += off * off;
        } else if (i % 4 == 2 || !KIN_COUNTS_AXIS) {
            turn += (KIN_COUNTS_AXIS ? 1.0 : 0.5) * off * off;
        }
    }
    shift = KIN_COUNTS_TRANSLATION ? shift : 0.0;
    return sqrt(shift + (KIN_COUNTS_ROTATION ? KIN_SIZE * KIN_SIZE * turn : 0.0));
}

/* Fills in all but the configuration. */
static void kin_linearize(const double target[12], const kin_given *given, kin_linearization *here)
{
    double pose[12], jacobian[6][KIN_CORRECTED];
    kin_seen(here->q, given, pose, jacobian);
    for (int i = 0; i < 3; ++i) {
        const double off = pose[4 * i + 3] - target[4 * i + 3];
        here->error[i] = KIN_COUNTS_TRANSLATION ? -off / KIN_SIZE : 0.0;
        here->error[3 + i] = 0.0;
    }
    for (int j = KIN_COUNTS_AXIS ? 2 : 0; KIN_COUNTS_ROTATION && j < 3; ++j) {
        for (int i = 0; i < 3; ++i) {
            const int a = (i + 1) % 3, b = (i + 2) % 3;
            here->error[3 + i] += (KIN_COUNTS_AXIS ? 1.0 : 0.5)
                * (pose[4 * a + j] * target[4 * b + j] - pose[4 * b + j] * target[4 * a + j]);
        }
    }
    here->residual = kin_distance(pose, target);
    for (int k = 0; k < KIN_CORRECTED; ++k) {
        double v[3], w[3], along = 0.0;
        for (int i = 0; i < 3; ++i) {
            v[i] = jacobian[i][k];
            w[i] = jacobian[3 + i][k];
            along += w[i] * pose[4 * i + 2];
        }
        for (int i = 0; i < 3; ++i) {
            const int a = (i + 1) % 3, b = (i + 2) % 3;
            const double linear = v[i] + (w[a] * pose[4 * b + 3] - w[b] * pose[4 * a + 3]);
            const double angular = KIN_COUNTS_AXIS ? w[i] - along * pose[4 * i + 2] : w[i];
            here->rows[i][k] = KIN_COUNTS_TRANSLATION ? linear / KIN_SIZE : 0.0;
            here->rows[3 + i][k] = KIN_COUNTS_ROTATION ? angular : 0.0;
        }
    }
}

/* The Cholesky factor of JtJ + damping, with the reciprocals of its diagonal on the
 * diagonal. */
static void kin_factor(double rows[6][KIN_CORRECTED], double damping, double lower[KIN_CORRECTED][KIN_CORRECTED])
{
    for (int i = 0; i < KIN_CORRECTED; ++i) {
        for (int j = 0; j <= i; ++j) {
            lower[i][j] = i == j ? damping : 0.0;
            for (int row = 0; row < 6; ++row) {
                lower[i][j] += rows[row][i] * rows[row][j];
            }
        }
    }
    for (int i = 0; i < KIN_CORRECTED; ++i) {
        for (int j = 0; j < i; ++j) {
            for (int k = 0; k < j; ++k) {
                lower[i][j] -= lower[i][k] * lower[j][k];
            }
            lower[i][j] *= lower[j][j];
            lower[i][i] -= lower[i][j] * lower[i][j];
        }
        /* Rounding may leave the square of a singular pivot below zero. */
        lower[i][i] = 1.0 / sqrt(lower[i][i] > 1e-20 ? lower[i][i] : 1e-20);
    }
}

static double kin_norm(const double error[6])
{
    double square = 0.0;
    for (int i = 0; i < 6; ++i) {
        square += error[i] * error[i];
    }
    return sqrt(square);
}

/* Levenberg's method from a configuration that nearly reaches the target, damped by the
 * square of what is missing (Yamashita and Fukushima, Computing Supplement 15, 2001), for at
 * most twelve evaluations. Whether the Jacobian loses rank where it has arrived. */
static int kin_correct(
    const double target[12], const kin_given *given, int evaluations, kin_linearization *here)
{
    double lower[KIN_CORRECTED][KIN_CORRECTED], weight = 1.0, miss, least, most;
    kin_linearize(target, given, here);
    miss = kin_norm(here->error);
    for (int step = 0; step < evaluations && here->residual >= 1e-14 * KIN_SIZE && weight <= 1e12;
         ++step) {
        kin_linearization there;
        double x[KIN_CORRECTED], next;
        kin_factor(here->rows, weight * miss * miss, lower);
        for (int i = 0; i < KIN_CORRECTED; ++i) {
            x[i] = 0.0;
            for (int row = 0; row < 6; ++row) {
                x[i] += here->rows[row][i] * here->error[row];
            }
            for (int k = 0; k < i; ++k) {
                x[i] -= lower[i][k] * x[k];
            }
            x[i] *= lower[i][i];
        }
        for (int i = KIN_CORRECTED - 1; i >= 0; --i) {
            for (int k = i + 1; k < KIN_CORRECTED; ++k) {
                x[i] -= lower[k][i] * x[k];
            }
            x[i] *= lower[i][i];
            there.q[i] = here->q[i] + x[i];
        }
        kin_linearize(target, given, &there);
        next = kin_norm(there.error);
        if (next < miss) {
            weight *= next < 0.5 * miss ? 0.1 : 1.0;
            *here = there;
            miss = next;
        } else {
            weight *= 8.0;
        }
    }
    kin_factor(here->rows, 0.0, lower);
    least = most = lower[0][0];
    for (int i = 1; i < KIN_CORRECTED; ++i) {
        most = lower[i][i] > most ? lower[i][i] : most;
        least = lower[i][i] < least ? lower[i][i] : least;
    }
    return least / most < 1e-5;
}

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
