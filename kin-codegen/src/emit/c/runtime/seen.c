/* The pose of a configuration, and the spatial Jacobian of the joints that are solved for, with the
 * values of joints that are given. */
static void kin_see_joints(
    const double *solved, const void *given, double pose[12], double jacobian[6][7])
{
    double q[KIN_JOINTS], all[6 * KIN_JOINTS];
    kin_whole(solved, (const double *)given, q);
    kin_fk_jacobian(q, pose, all);
    for (int row = 0; row < 6; ++row) {
        for (int k = 0; k < KIN_SOLVED; ++k) {
            jacobian[row][k] = all[row * KIN_JOINTS + kin_solved[k]];
        }
    }
}
