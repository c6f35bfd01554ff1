/* What is given beside a target: values of joints. */
typedef double kin_given;
#define KIN_CORRECTED KIN_SOLVED

/* The pose of a configuration, and the spatial Jacobian of the joints that are solved for. */
static void kin_seen(
    const double solved[KIN_CORRECTED], const kin_given *given, double pose[12],
    double jacobian[6][KIN_CORRECTED])
{
    double q[KIN_JOINTS], all[6 * KIN_JOINTS];
    kin_whole(solved, given, q);
    kin_fk_jacobian(q, pose, all);
    for (int row = 0; row < 6; ++row) {
        for (int k = 0; k < KIN_CORRECTED; ++k) {
            jacobian[row][k] = all[row * KIN_JOINTS + kin_solved[k]];
        }
    }
}
