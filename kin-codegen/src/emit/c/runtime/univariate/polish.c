/* What is missing and the geometric Jacobian that makes it, lengths in units of the arm's size. */
typedef struct kin_system {
    kin_pack columns[6][6], error[6], residual;
} kin_system;

KIN_INLINE void kin_linearize_all(const kin_problem *problem, kin_pack q[6], kin_system *out)
{
    const double (*fixed)[12] = problem->fixed, *target = problem->target;
    kin_pack r[3][3], p[3], axes[6][3], origins[6][3], square;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            kin_fill(r[i][j], fixed[0][4 * i + j]);
        }
        kin_fill(p[i], fixed[0][4 * i + 3]);
    }
    for (int joint = 0; joint < 6; ++joint) {
        const double *next = fixed[joint + 1];
        kin_pack sine, cosine;
        kin_fill(sine, 0.0);
        kin_fill(cosine, 1.0);
        if (!kin_slides[joint]) {
            kin_sines_and_cosines(q[joint], sine, cosine);
        }
        for (int i = 0; i < 3; ++i) {
            kin_copy(axes[joint][i], r[i][2]);
            kin_copy(origins[joint][i], p[i]);
            if (kin_slides[joint]) {
                kin_plus(p[i], r[i][2], q[joint]);
            }
            for (int k = 0; k < KIN_LANES; ++k) {
                const double a = r[i][0][k], b = r[i][1][k], z = r[i][2][k];
                const double x = a * cosine[k] + b * sine[k], y = b * cosine[k] - a * sine[k];
                r[i][0][k] = x * next[0] + y * next[4] + z * next[8];
                r[i][1][k] = x * next[1] + y * next[5] + z * next[9];
                r[i][2][k] = x * next[2] + y * next[6] + z * next[10];
                p[i][k] = p[i][k] + x * next[3] + y * next[7] + z * next[11];
            }
        }
    }
    for (int joint = 0; joint < 6; ++joint) {
        kin_pack *column = out->columns[joint], *z = axes[joint], *o = origins[joint];
        const double turns = kin_slides[joint] ? 0.0 : 1.0;
        for (int i = 0; i < 3; ++i) {
            const int a = (i + 1) % 3, b = (i + 2) % 3;
            for (int k = 0; k < KIN_LANES; ++k) {
                const double along = z[a][k] * (p[b][k] - o[b][k]) - z[b][k] * (p[a][k] - o[a][k]);
                column[i][k] = 0.5 * (kin_slides[joint] ? z[i][k] : along);
                column[3 + i][k] = turns * z[i][k];
            }
        }
    }
    kin_fill(square, 0.0);
    for (int i = 0; i < 3; ++i) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        for (int k = 0; k < KIN_LANES; ++k) {
            out->error[i][k] = (target[4 * i + 3] - p[i][k]) * 0.5;
            square[k] += out->error[i][k] * out->error[i][k];
        }
        kin_fill(out->error[3 + i], 0.0);
        for (int j = 0; j < 3; ++j) {
            for (int k = 0; k < KIN_LANES; ++k) {
                const double apart = r[i][j][k] - target[4 * i + j];
                out->error[3 + i][k] += r[a][j][k] * (0.5 * target[4 * b + j])
                    - r[b][j][k] * (0.5 * target[4 * a + j]);
                square[k] += apart * (0.5 * apart);
            }
        }
    }
    for (int k = 0; k < KIN_LANES; ++k) {
        out->residual[k] = sqrt(square[k]);
    }
}

/* J = Q R by the modified method of Gram and Schmidt, without roots: the columns of Q are at right
 * angles and have the lengths of the pivots; R has ones on its diagonal. What is solved with both
 * in turn is as good as by reflections (Bjorck, BIT 7, 1967). */
typedef struct kin_orthogonal {
    kin_pack columns[6][6], above[6][6];
    /* Of the pivots, and their inverses. */
    kin_pack squares[6], inverses[6];
} kin_orthogonal;

KIN_INLINE void kin_orthogonalize_jacobian(const kin_system *system, kin_orthogonal *out)
{
    for (int j = 0; j < 6; ++j) {
        for (int i = 0; i < 6; ++i) {
            kin_copy(out->columns[j][i], system->columns[j][i]);
        }
    }
    for (int j = 0; j < 6; ++j) {
        kin_dot(out->squares[j], out->columns[j], out->columns[j], 6);
        for (int k = 0; k < KIN_LANES; ++k) {
            out->squares[j][k] = kin_max(out->squares[j][k], 1e-24);
            out->inverses[j][k] = 1.0 / out->squares[j][k];
        }
        for (int l = j + 1; l < 6; ++l) {
            kin_dot(out->above[j][l], out->columns[j], out->columns[l], 6);
            kin_times(out->above[j][l], out->inverses[j]);
            for (int i = 0; i < 6; ++i) {
                kin_minus(out->columns[l][i], out->above[j][l], out->columns[j][i]);
            }
        }
    }
}

/* x becomes the solution of R y = x. */
KIN_INLINE void kin_back_substitute(kin_orthogonal *jacobian, kin_pack x[6])
{
    for (int j = 5; j >= 0; --j) {
        for (int l = j + 1; l < 6; ++l) {
            kin_minus(x[j], jacobian->above[j][l], x[l]);
        }
    }
}

/* x of J x = e. */
KIN_INLINE void kin_solve_all(kin_orthogonal *jacobian, kin_pack error[6], kin_pack x[6])
{
    kin_pack e[6];
    for (int i = 0; i < 6; ++i) {
        kin_copy(e[i], error[i]);
    }
    for (int j = 0; j < 6; ++j) {
        kin_dot(x[j], jacobian->columns[j], e, 6);
        kin_times(x[j], jacobian->inverses[j]);
        for (int i = 0; i < 6; ++i) {
            kin_minus(e[i], x[j], jacobian->columns[j][i]);
        }
    }
    kin_back_substitute(jacobian, x);
}

/* The squares of the least and of the largest pivot. */
KIN_INLINE void kin_extremes(const kin_orthogonal *jacobian, double *least, double *largest)
{
    for (int k = 0; k < KIN_LANES; ++k) {
        least[k] = largest[k] = jacobian->squares[0][k];
    }
    for (int j = 1; j < 6; ++j) {
        for (int k = 0; k < KIN_LANES; ++k) {
            least[k] = -kin_max(-least[k], -jacobian->squares[j][k]);
            largest[k] = kin_max(largest[k], jacobian->squares[j][k]);
        }
    }
}

/* How far from singular: 1 / (|J^-1| * the largest pivot). By the norm of all entries 1 / |J^-1| is
 * the least singular value but for a factor of the root of 6; a pivot may be far above that. */
KIN_INLINE void kin_independence(const kin_orthogonal *jacobian, double *out)
{
    kin_pack least, largest, sum;
    kin_fill(sum, 0.0);
    for (int j = 0; j < 6; ++j) {
        /* Column j of R^-1, and J^-1 = R^-1 D^-1 Q^T. */
        kin_pack column[6], square;
        kin_fill(column[j], 1.0);
        kin_fill(square, 1.0);
        for (int i = j - 1; i >= 0; --i) {
            kin_fill(column[i], 0.0);
            for (int l = i + 1; l <= j; ++l) {
                kin_minus(column[i], jacobian->above[i][l], column[l]);
            }
            kin_plus(square, column[i], column[i]);
        }
        kin_plus(sum, square, jacobian->inverses[j]);
    }
    kin_extremes(jacobian, least, largest);
    for (int k = 0; k < KIN_LANES; ++k) {
        out[k] = sqrt(1.0 / (sum[k] * largest[k]));
    }
}

/* Where configurations arrived. */
typedef struct kin_arrived {
    kin_pack q[6];
    /* How far the tip is from the target, in units of the arm's size. */
    kin_pack residual;
    /* Of the Jacobian's columns. */
    kin_pack independence;
} kin_arrived;

/* Whether Newton's method goes on: from the fourth step on, a configuration that does not come
 * nearer by a factor of 0.6 in a step is not waited for, since at a double root it gains 4. */
KIN_INLINE int kin_is_open(const double *residual, const double *before, int step)
{
    int is = 0;
    for (int k = 0; k < KIN_LANES; ++k) {
        const int nearer = residual[k] < 0.6 * before[k];
        /* Below, the residual is rounding. */
        is |= (residual[k] > 1e-14) & (nearer | (step < 4));
    }
    return is;
}

/* Whether the Jacobian of the step before is as good. */
KIN_INLINE int kin_is_steady(const kin_orthogonal *jacobian, const kin_system *system)
{
    kin_pack least, largest;
    int is = 1;
    kin_extremes(jacobian, least, largest);
    for (int k = 0; k < KIN_LANES; ++k) {
        is &= (system->residual[k] < 1e-10) & (least[k] > largest[k] * 1e-6);
    }
    return is;
}

/* Moves configurations towards the target until they are there, or for so many steps. */
KIN_INLINE void kin_polish_of(
    const kin_problem *problem, kin_pack start[6], int steps, kin_arrived *out)
{
    kin_system system;
    kin_orthogonal jacobian;
    kin_pack before, longest, change[6];
    for (int i = 0; i < 6; ++i) {
        kin_copy(out->q[i], start[i]);
    }
    kin_fill(before, HUGE_VAL);
    kin_linearize_all(problem, out->q, &system);
    kin_orthogonalize_jacobian(&system, &jacobian);
    for (int step = 0; step < steps && kin_is_open(system.residual, before, step); ++step) {
        kin_copy(before, system.residual);
        kin_solve_all(&jacobian, system.error, change);
        /* No joint moves by more in one step, radians or half the arm's size. */
        kin_fill(longest, 0.3);
        for (int i = 0; i < 6; ++i) {
            kin_at_least(longest, change[i]);
        }
        for (int k = 0; k < KIN_LANES; ++k) {
            longest[k] = kin_select(1e-14, system.residual[k], 0.3 / longest[k], 0.0);
        }
        for (int i = 0; i < 6; ++i) {
            kin_plus(out->q[i], longest, change[i]);
        }
        kin_linearize_all(problem, out->q, &system);
        if (!kin_is_steady(&jacobian, &system)) {
            kin_orthogonalize_jacobian(&system, &jacobian);
        }
    }
    kin_copy(out->residual, system.residual);
    kin_independence(&jacobian, out->independence);
}
KIN_BY_PROCESSOR(kin_polish,
    (const kin_problem *problem, kin_pack start[6], int steps, kin_arrived *out),
    (problem, start, steps, out))
