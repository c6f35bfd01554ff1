/* What is given beside a target: the swivel angle, which tells one of the joints that turn the
 * elbow from the others; where the target has the wrist; and of the values of that joint with
 * the same angle, the one next to which is meant. */
typedef struct kin_given {
    double angle;
    double wrist[3];
    int joint;
    double value;
} kin_given;
#define KIN_CORRECTED (KIN_JOINTS - 1)

/* How the swivel angle changes with the joints, and how far it is off. */
static double kin_slopes(
    const double q[KIN_JOINTS], const kin_given *given, double slopes[KIN_JOINTS])
{
    double links[12 * KIN_JOINTS], pose[12], jacobian[6 * KIN_JOINTS], elbow[3], gradient[3], own;
    kin_fk_links(q, links);
    kin_fk_jacobian(q, pose, jacobian);
    kin_point(links + 12 * KIN_ELBOW_LINK, kin_elbow, elbow);
    own = kin_swivel(elbow, given->wrist, gradient);
    for (int k = 0; k < KIN_JOINTS; ++k) {
        slopes[k] = 0.0;
        for (int i = 0; i < 3 && k <= KIN_ELBOW_LINK; ++i) {
            const int a = (i + 1) % 3, b = (i + 2) % 3;
            slopes[k] += gradient[i] * (jacobian[i * KIN_JOINTS + k]
                + (jacobian[(3 + a) * KIN_JOINTS + k] * elbow[b]
                - jacobian[(3 + b) * KIN_JOINTS + k] * elbow[a]));
        }
    }
    return kin_wrap(given->angle - own);
}

/* All joint values, from those of the others than the one that the angle tells. */
static void kin_told(
    const double others[KIN_CORRECTED], const kin_given *given, double q[KIN_JOINTS])
{
    for (int i = 0; i < KIN_JOINTS; ++i) {
        q[i] = i == given->joint ? given->value : others[i - (i > given->joint)];
    }
    for (int step = 0; step < 8; ++step) {
        double slopes[KIN_JOINTS];
        const double off = kin_slopes(q, given, slopes);
        const double by = off / slopes[given->joint];
        if (by != by) {
            return;
        }
        q[given->joint] += by > 0.5 ? 0.5 : by < -0.5 ? -0.5 : by;
        if (fabs(by) < 1e-15) {
            return;
        }
    }
}

/* The pose of a configuration, and the spatial Jacobian of the others, which take the joint that
 * is told along. */
static void kin_see_joints(
    const double *others, const void *beside, double pose[12], double jacobian[6][6])
{
    const kin_given *const given = (const kin_given *)beside;
    double q[KIN_JOINTS], all[6 * KIN_JOINTS], slopes[KIN_JOINTS];
    kin_told(others, given, q);
    kin_fk_jacobian(q, pose, all);
    kin_slopes(q, given, slopes);
    for (int row = 0; row < 6; ++row) {
        for (int k = 0; k < KIN_CORRECTED; ++k) {
            const int i = k + (k >= given->joint);
            jacobian[row][k] = all[row * KIN_JOINTS + i]
                + all[row * KIN_JOINTS + given->joint] * (-slopes[i] / slopes[given->joint]);
        }
    }
}
