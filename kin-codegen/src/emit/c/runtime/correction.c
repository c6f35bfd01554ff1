/* A configuration as the target sees it: what is missing, and how the joints make it;
 * lengths in units of the arm's size, zero where the target does not count. */
typedef struct kin_linearization {
    double q[7];
    double residual;
    double error[7];
    double rows[7][7];
} kin_linearization;

/* The joints that are solved for: how many, and the function that has their pose and spatial
 * Jacobian, with what is given beside a target; and, unless it is 0, one that tells what is missing
 * of one more coordinate, metres, and how the joints make it. */
typedef struct kin_solved_for {
    int count;
    void (*see)(const double *q, const void *given, double pose[12], double jacobian[6][7]);
    const void *given;
    double (*beside)(const double *q, const void *given, double row[7]);
} kin_solved_for;

/* How far a pose is from a target, as far as the target counts, metres. */
static double kin_distance(const kin_metric *by, const double pose[12], const double target[12])
{
    double shift = 0.0, turn = 0.0;
    for (int i = 0; i < 12; ++i) {
        const double off = pose[i] - target[i];
        if (i % 4 == 3) {
            shift += off * off;
        } else if (i % 4 == 2 || !by->axis) {
            turn += (by->axis ? 1.0 : 0.5) * off * off;
        }
    }
    shift = by->translation ? shift : 0.0;
    return sqrt(shift + (by->rotation ? by->size * by->size * turn : 0.0));
}

/* Fills in all but the configuration. */
static void kin_linearize(
    const kin_metric *by, const kin_solved_for *joints, const double target[12], kin_linearization *here)
{
    double pose[12], jacobian[6][7];
    joints->see(here->q, joints->given, pose, jacobian);
    for (int i = 0; i < 3; ++i) {
        const double off = pose[4 * i + 3] - target[4 * i + 3];
        here->error[i] = by->translation ? -off / by->size : 0.0;
        here->error[3 + i] = 0.0;
    }
    for (int j = by->axis ? 2 : 0; by->rotation && j < 3; ++j) {
        for (int i = 0; i < 3; ++i) {
            const int a = (i + 1) % 3, b = (i + 2) % 3;
            here->error[3 + i] += (by->axis ? 1.0 : 0.5)
                * (pose[4 * a + j] * target[4 * b + j] - pose[4 * b + j] * target[4 * a + j]);
        }
    }
    here->residual = kin_distance(by, pose, target);
    for (int k = 0; k < joints->count; ++k) {
        double v[3], w[3], along = 0.0;
        for (int i = 0; i < 3; ++i) {
            v[i] = jacobian[i][k];
            w[i] = jacobian[3 + i][k];
            along += w[i] * pose[4 * i + 2];
        }
        for (int i = 0; i < 3; ++i) {
            const int a = (i + 1) % 3, b = (i + 2) % 3;
            const double linear = v[i] + (w[a] * pose[4 * b + 3] - w[b] * pose[4 * a + 3]);
            const double angular = by->axis ? w[i] - along * pose[4 * i + 2] : w[i];
            here->rows[i][k] = by->translation ? linear / by->size : 0.0;
            here->rows[3 + i][k] = by->rotation ? angular : 0.0;
        }
    }
    if (joints->beside) {
        const double off = joints->beside(here->q, joints->given, here->rows[6]);
        here->error[6] = off / by->size;
        for (int k = 0; k < joints->count; ++k) {
            here->rows[6][k] /= by->size;
        }
        here->residual = sqrt(here->residual * here->residual + off * off);
    }
}

/* The Cholesky factor of JtJ + damping, with the reciprocals of its diagonal on the
 * diagonal. */
static void kin_factor(
    double rows[7][7], int height, int count, double damping, double lower[7][7])
{
    for (int i = 0; i < count; ++i) {
        for (int j = 0; j <= i; ++j) {
            lower[i][j] = i == j ? damping : 0.0;
            for (int row = 0; row < height; ++row) {
                lower[i][j] += rows[row][i] * rows[row][j];
            }
        }
    }
    for (int i = 0; i < count; ++i) {
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

/* Levenberg's method from a configuration that nearly reaches the target, damped by the
 * square of what is missing (Yamashita and Fukushima, Computing Supplement 15, 2001), for at
 * most twelve evaluations. Whether the Jacobian loses rank where it has arrived. */
static int kin_correct(
    const kin_metric *by, const kin_solved_for *joints, const double target[12], int evaluations,
    kin_linearization *here)
{
    const int height = joints->beside ? 7 : 6;
    double lower[7][7], weight = 1.0, miss, least, most;
    kin_linearize(by, joints, target, here);
    miss = kin_norm(here->error, height);
    for (int step = 0; step < evaluations && here->residual >= 1e-14 * by->size && weight <= 1e12;
         ++step) {
        kin_linearization there;
        double x[7], next;
        kin_factor(here->rows, height, joints->count, weight * miss * miss, lower);
        for (int i = 0; i < joints->count; ++i) {
            x[i] = 0.0;
            for (int row = 0; row < height; ++row) {
                x[i] += here->rows[row][i] * here->error[row];
            }
            for (int k = 0; k < i; ++k) {
                x[i] -= lower[i][k] * x[k];
            }
            x[i] *= lower[i][i];
        }
        for (int i = joints->count - 1; i >= 0; --i) {
            for (int k = i + 1; k < joints->count; ++k) {
                x[i] -= lower[k][i] * x[k];
            }
            x[i] *= lower[i][i];
            there.q[i] = here->q[i] + x[i];
        }
        kin_linearize(by, joints, target, &there);
        next = kin_norm(there.error, height);
        if (next < miss) {
            weight *= next < 0.5 * miss ? 0.1 : 1.0;
            *here = there;
            miss = next;
        } else {
            weight *= 8.0;
        }
    }
    kin_factor(here->rows, height, joints->count, 0.0, lower);
    least = most = lower[0][0];
    for (int i = 1; i < joints->count; ++i) {
        most = lower[i][i] > most ? lower[i][i] : most;
        least = lower[i][i] < least ? lower[i][i] : least;
    }
    return least / most < 1e-5;
}
