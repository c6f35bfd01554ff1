/* Reads closed configurations of one mechanism and writes all that its functions have for them;
 * `kin_` stands for the mechanism. */
static void run_kin_robot(void)
{
    int count = 0;
    if (scanf("%d", &count) != 1) {
        exit(1);
    }
    for (int k = 0; k < count; ++k) {
        double q[KIN_JOINTS], poses[12 * KIN_CHAINS], jacobian[6 * KIN_JOINTS], moved[KIN_JOINTS];
        double forward[6 * KIN_ACTUATED], actuated[KIN_ACTUATED], rates[KIN_JOINTS];
        int is;
        read_numbers(q, KIN_JOINTS);
        kin_chain_poses(q, poses);
        write_numbers(poses, 12 * KIN_CHAINS);
        printf("%.17g\n", kin_gap(q));
        /* Gaps that are numbers, where a joint is none. */
        int numbers = 0;
        for (int i = 0; i < KIN_JOINTS; ++i) {
            const double kept = q[i];
            q[i] = NAN;
            numbers += kin_gap(q) == kin_gap(q);
            q[i] = kept;
        }
        printf("%d\n", numbers);
        kin_structure_jacobian(q, jacobian);
        write_numbers(jacobian, 6 * KIN_JOINTS);
        printf("%.17g %.17g\n", kin_actuator_singularity(q), kin_kinematic_singularity(q));
        is = kin_forward_jacobian(q, forward);
        printf("%d\n", is);
        write_numbers(forward, is ? 6 * KIN_ACTUATED : 0);
        is = kin_inverse_jacobian(q, forward);
        printf("%d\n", is);
        write_numbers(forward, is ? 6 * KIN_ACTUATED : 0);
        for (int a = 0; a < KIN_ACTUATED; ++a) {
            actuated[a] = 1.0 - 0.3 * a;
        }
        is = kin_joint_rates(q, actuated, rates);
        printf("%d\n", is);
        write_numbers(rates, is ? KIN_JOINTS : 0);
        for (int a = 0; a < KIN_ACTUATED; ++a) {
            actuated[a] = q[kin_actuated[a]] + 0.01 * (a % 3) - 0.01;
        }
        is = kin_fk_near(actuated, q, moved);
        printf("%d\n", is);
        write_numbers(moved, KIN_JOINTS);
        printf("%d\n", kin_within_limits(q, moved));
#ifdef KIN_MOST
        {
            kin_postures postures;
            double worst = 0.0, far[12];
            const int all = kin_ik(poses, &postures);
            printf("%d\n", all);
            for (int chain = 0; chain < KIN_CHAINS; ++chain) {
                printf("%d\n", postures.counts[chain]);
                for (int b = 0; b < postures.counts[chain]; ++b) {
                    printf("%d\n", postures.places[chain][b]);
                    write_numbers(
                        postures.q[b] + kin_chains[chain], kin_chains[chain + 1] - kin_chains[chain]);
                }
            }
            for (int number = 0; number < all; number += 1 + all / 50) {
                if (!kin_posture(&postures, number, moved)) {
                    exit(1);
                }
                worst = kin_gap(moved) > worst ? kin_gap(moved) : worst;
            }
            printf("%.17g %d\n", worst, kin_posture(&postures, all, moved));
            for (int number = 0; number < all && number < 16; ++number) {
                kin_posture(&postures, number, moved);
                write_numbers(moved, KIN_JOINTS);
            }
            for (int joint = 0; joint < KIN_JOINTS; ++joint) {
                rates[joint] = q[joint] + 0.02;
            }
            printf("%d\n", kin_ik_nearest(poses, rates, moved));
            write_numbers(moved, KIN_JOINTS);
            for (int i = 0; i < 12; ++i) {
                far[i] = poses[i] + (i == 3 ? 90.0 : 0.0);
            }
            printf("%d %d\n", kin_ik(far, &postures), kin_ik_nearest(far, q, moved));
        }
#endif
#ifdef KIN_ASSEMBLY_MODES
        {
            kin_assembly assemblies[KIN_ASSEMBLY_MODES];
            int found;
            for (int a = 0; a < KIN_ACTUATED; ++a) {
                actuated[a] = q[kin_actuated[a]];
            }
            found = kin_fk(actuated, assemblies);
            printf("%d\n", found);
            for (int i = 0; i < found; ++i) {
                printf("%d %.17g\n", assemblies[i].branch, assemblies[i].residual);
                write_numbers(assemblies[i].q, KIN_JOINTS);
            }
        }
#endif
    }
    puts("end");
}
