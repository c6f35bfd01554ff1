/* The motion of the joints that moves the tip least, of length 1: the least right singular vector,
 * by inverse iteration on the transpose of J times J. */
KIN_INLINE void kin_weak_motion(kin_orthogonal *jacobian, kin_pack x[6])
{
    for (int i = 0; i < 6; ++i) {
        /* A start that no arm is square to. */
        kin_fill(x[i], 1.0 + 0.3 * i);
    }
    for (int round = 0; round < 2; ++round) {
        for (int j = 0; j < 6; ++j) {
            for (int i = 0; i < j; ++i) {
                kin_minus(x[j], jacobian->above[i][j], x[i]);
            }
        }
        for (int j = 0; j < 6; ++j) {
            kin_times(x[j], jacobian->inverses[j]);
        }
        kin_back_substitute(jacobian, x);
        kin_normalize(x, 6);
    }
}

/* Near nearly singular configurations, the two others at which the target may be reached, to second
 * order. Where J v is small, what is missing is e = J d + H(d, d)/2 with d = a v + ..., and along v
 * the roots of v.J^-1 e = a + a^2 v.J^-1 H(v, v)/2 tell a; where there are none, both are where the
 * tip comes nearest: the bifurcation equation of Lyapunov and Schmidt to second order (Golubitsky
 * and Schaeffer, Singularities and Groups in Bifurcation Theory I, 1985, chapter I). H(v, v) is a
 * second difference. */
KIN_INLINE void kin_split_of(const kin_problem *problem, kin_pack q[6], kin_pack out[2][6])
{
    /* How far the second derivative is taken, and the second order may tell anything, radians. */
    const double bend_by = 1e-3, farthest = 0.5;
    kin_system here, beside;
    kin_orthogonal jacobian;
    kin_pack v[6], bend[6], step[6], bent[6], moved[6], e, a, alpha[2];
    kin_linearize_all(problem, q, &here);
    kin_orthogonalize_jacobian(&here, &jacobian);
    kin_weak_motion(&jacobian, v);
    for (int i = 0; i < 6; ++i) {
        for (int k = 0; k < KIN_LANES; ++k) {
            bend[i][k] = here.error[i][k] + here.error[i][k];
        }
    }
    for (int way = -1; way <= 1; way += 2) {
        for (int i = 0; i < 6; ++i) {
            kin_copy(moved[i], q[i]);
            kin_plus_scaled(moved[i], v[i], way * bend_by);
        }
        kin_linearize_all(problem, moved, &beside);
        for (int i = 0; i < 6; ++i) {
            for (int k = 0; k < KIN_LANES; ++k) {
                bend[i][k] -= beside.error[i][k];
            }
        }
    }
    for (int i = 0; i < 6; ++i) {
        for (int k = 0; k < KIN_LANES; ++k) {
            bend[i][k] *= 1.0 / (bend_by * bend_by);
        }
    }
    kin_solve_all(&jacobian, here.error, step);
    kin_solve_all(&jacobian, bend, bent);
    kin_dot(e, v, step, 6);
    kin_dot(a, v, bent, 6);
    for (int k = 0; k < KIN_LANES; ++k) {
        /* (-1 +- root) / a, without cancellation. */
        const double beyond = 1.0 + sqrt(kin_max(1.0 + 2.0 * a[k] * e[k], 0.0));
        alpha[0][k] = 2.0 * e[k] / beyond;
        alpha[1][k] = -beyond / a[k];
    }
    for (int way = 0; way < 2; ++way) {
        for (int k = 0; k < KIN_LANES; ++k) {
            const double less = -kin_max(-alpha[way][k], -farthest);
            const double by = kin_max(less, -farthest), half_square = by * by * 0.5;
            for (int i = 0; i < 6; ++i) {
                const double across = step[i][k] - e[k] * v[i][k];
                const double bent_across = bent[i][k] - a[k] * v[i][k];
                out[way][i][k] = q[i][k] + across + by * v[i][k] - half_square * bent_across;
            }
        }
    }
}
KIN_BY_PROCESSOR(kin_split,
    (const kin_problem *problem, kin_pack q[6], kin_pack out[2][6]), (problem, q, out))
