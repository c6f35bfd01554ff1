/* One configuration that reaches a target. */
typedef struct kin_solution {
    /* Radians in (-pi, pi], metres of joints that slide. Limits are not applied. */
    double q[KIN_JOINTS];
    /* How far the forward kinematics of q is from the target, metres: the root of the squares
     * of the distance and of the angle at the distance of the arm's size, as far as these
     * count. */
    double residual;
    /* Which combination of the plan's roots this is, below KIN_BRANCHES; of the roots of a
     * polynomial in one joint its place, from KIN_BRANCHES on where these stand beside a plan. */
    int branch;
    /* Not 0 where the target is singular: q stands for a family of solutions, or for two that
     * have met. */
    int singular;
} kin_solution;

/* What a function returns that has found no solution, besides 0: the target is out of reach. */
/* An entry of the target that counts, or a parameter, is not finite; beyond 1e15 no digit of an angle
 * is left. */
#define KIN_NOT_FINITE (-1)
/* The rotation of the target is none, to within the tolerance of solutions. */
#define KIN_NOT_A_ROTATION (-2)
/* There are solutions, and none within the limits. */
#define KIN_BEYOND_LIMITS (-3)
