/* The pose that a pose of the tip stands for, as projected targets see it: home, turned about the
 * first axis to come nearest to it, where it is, of a planar arm at the height of home. */
static void kin_project(const double tip[12], double seen[12])
{
    double m[3][3], sine = 0.0, cosine = 0.0, length, rise = 0.0;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            m[i][j] = tip[4 * i] * kin_home[4 * j] + tip[4 * i + 1] * kin_home[4 * j + 1]
                + tip[4 * i + 2] * kin_home[4 * j + 2];
        }
    }
    for (int i = 0; i < 3; ++i) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        sine += kin_axis[i] * (m[b][a] - m[a][b]);
        cosine += m[i][i];
        for (int j = 0; j < 3; ++j) {
            cosine -= kin_axis[i] * m[i][j] * kin_axis[j];
        }
        rise += KIN_PLANAR ? kin_axis[i] * (kin_home[4 * i + 3] - tip[4 * i + 3]) : 0.0;
    }
    length = sqrt(sine * sine + cosine * cosine);
    if (length == 0.0) {
        cosine = length = 1.0;
    }
    sine /= length;
    cosine /= length;
    for (int j = 0; j < 3; ++j) {
        double along = 0.0;
        for (int i = 0; i < 3; ++i) {
            along += kin_axis[i] * kin_home[4 * i + j];
        }
        for (int i = 0; i < 3; ++i) {
            const int a = (i + 1) % 3, b = (i + 2) % 3;
            seen[4 * i + j] = cosine * kin_home[4 * i + j]
                + sine * (kin_axis[a] * kin_home[4 * b + j] - kin_axis[b] * kin_home[4 * a + j])
                + (1.0 - cosine) * along * kin_axis[i];
        }
    }
    for (int i = 0; i < 3; ++i) {
        seen[4 * i + 3] = tip[4 * i + 3] + rise * kin_axis[i];
    }
}

/* The same of a target: one that is no rotation by some error is none by as much. */
static void kin_project_target(const double target[12], double seen[12])
{
    /* A stretched rotation has the error sqrt(3) times the stretch. */
    const double stretch = 1.0 + kin_rotation_error(&kin_own_metric, target) / sqrt(3.0);
    kin_project(target, seen);
    for (int i = 0; i < 12; ++i) {
        seen[i] *= i % 4 == 3 ? 1.0 : stretch;
    }
}

/* As kin_see_joints, as projected targets see it: turns about the first axis, and of a planar arm
 * motions across it. */
static void kin_see_projected(
    const double *solved, const void *given, double pose[12], double jacobian[6][7])
{
    double tip[12];
    kin_see_joints(solved, given, tip, jacobian);
    kin_project(tip, pose);
    for (int k = 0; k < KIN_SOLVED; ++k) {
        double w[3], v[3], turn = 0.0, lift = 0.0;
        for (int i = 0; i < 3; ++i) {
            w[i] = jacobian[3 + i][k];
            turn += kin_axis[i] * w[i];
        }
        for (int i = 0; i < 3; ++i) {
            const int a = (i + 1) % 3, b = (i + 2) % 3;
            v[i] = jacobian[i][k] + (w[a] * tip[4 * b + 3] - w[b] * tip[4 * a + 3]);
            lift += KIN_PLANAR ? kin_axis[i] * v[i] : 0.0;
        }
        for (int i = 0; i < 3; ++i) {
            jacobian[3 + i][k] = turn * kin_axis[i];
            v[i] -= lift * kin_axis[i];
        }
        for (int i = 0; i < 3; ++i) {
            const int a = (i + 1) % 3, b = (i + 2) % 3;
            jacobian[i][k] = v[i]
                - (jacobian[3 + a][k] * pose[4 * b + 3] - jacobian[3 + b][k] * pose[4 * a + 3]);
        }
    }
}
