/* Reads configurations and targets of one robot and writes all that its functions have for
 * them; `kin_` stands for the robot. */
static void run_kin_robot(void)
{
    int count = 0;
    if (scanf("%d", &count) != 1) {
        exit(1);
    }
    for (int k = 0; k < count; ++k) {
        double q[KIN_JOINTS], pose[12], links[12 * KIN_JOINTS], jacobian[6 * KIN_JOINTS];
        double moved[KIN_JOINTS];
        read_numbers(q, KIN_JOINTS);
        kin_fk(q, pose);
        write_numbers(pose, 12);
        kin_fk_links(q, links);
        write_numbers(links, 12 * KIN_JOINTS);
        kin_spatial_jacobian(q, jacobian);
        write_numbers(jacobian, 6 * KIN_JOINTS);
        kin_body_jacobian(q, jacobian);
        write_numbers(jacobian, 6 * KIN_JOINTS);
        kin_geometric_jacobian(q, jacobian);
        write_numbers(jacobian, 6 * KIN_JOINTS);
        kin_fk_jacobian(q, pose, jacobian);
        write_numbers(pose, 12);
        write_numbers(jacobian, 6 * KIN_JOINTS);
#ifdef KIN_FRAMES
        for (int frame = 0; frame < KIN_FRAMES; ++frame) {
            printf("%d\n", kin_fk_frame(q, frame, pose));
            write_numbers(pose, 12);
        }
        printf("%d %d\n", kin_fk_frame(q, -1, pose), kin_fk_frame(q, KIN_FRAMES, pose));
#endif
        printf("%d\n", kin_within_limits(q, moved));
        write_numbers(moved, KIN_JOINTS);
    }
#ifdef KIN_BRANCHES
    if (scanf("%d", &count) != 1) {
        exit(1);
    }
    for (int k = 0; k < count; ++k) {
        double q[KIN_JOINTS], pose[12];
        kin_solution solutions[KIN_MAX_SOLUTIONS];
        int found;
        read_numbers(pose, 12);
        read_numbers(q, KIN_JOINTS);
#ifdef KIN_PARAMETERS
        double parameters[KIN_PARAMETERS];
        kin_redundancy(pose, q, parameters);
        write_numbers(parameters, KIN_PARAMETERS);
        read_numbers(parameters, KIN_PARAMETERS);
        found = kin_ik_at(pose, parameters, solutions);
#else
        found = kin_ik(pose, solutions);
#endif
        printf("%d\n", found);
        for (int i = 0; i < found; ++i) {
            printf("%d %d %.17g\n", solutions[i].branch, solutions[i].singular, solutions[i].residual);
            write_numbers(solutions[i].q, KIN_JOINTS);
        }
#ifdef KIN_PARAMETERS
        found = kin_ik_nearest_at(pose, parameters, q, solutions);
#else
        found = kin_ik_nearest(pose, q, solutions);
#endif
        printf("%d\n", found);
        if (found == 1) {
            write_numbers(solutions[0].q, KIN_JOINTS);
        }
    }
#endif
    puts("end");
}
