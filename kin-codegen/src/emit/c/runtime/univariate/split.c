/* Takes away what of x is along others of length 1, which are at right angles to each other. */
KIN_INLINE void kin_across(kin_pack x[6], kin_pack others[][6], int count)
{
    for (int n = 0; n < count; ++n) {
        kin_pack along;
        kin_dot(along, x, others[n], 6);
        for (int i = 0; i < 6; ++i) {
            kin_minus(x[i], along, others[n][i]);
        }
    }
}

/* The motion of the joints that moves the tip least, of length 1, among those at right angles to the
 * `count` in front of it: the least right singular vector, by inverse iteration on the transpose of J
 * times J. */
KIN_INLINE void kin_weak_motion(kin_orthogonal *jacobian, kin_pack weakest[][6], int count)
{
    kin_pack *x = weakest[count];
    for (int i = 0; i < 6; ++i) {
        /* A start that no arm is square to. */
        kin_fill(x[i], 1.0 + 0.3 * i);
    }
    for (int round = 0; round < 2; ++round) {
        kin_across(x, weakest, count);
        for (int j = 0; j < 6; ++j) {
            for (int i = 0; i < j; ++i) {
                kin_minus(x[j], jacobian->above[i][j], x[i]);
            }
        }
        for (int j = 0; j < 6; ++j) {
            kin_times(x[j], jacobian->inverses[j]);
        }
        kin_back_substitute(jacobian, x);
        kin_across(x, weakest, count);
        kin_normalize(x, 6);
    }
}

/* H(v, v), by a second difference of what is missing. */
KIN_INLINE void kin_bend(
    const kin_problem *problem, kin_pack q[6], const kin_system *here, kin_pack v[6], kin_pack bend[6])
{
    /* How far the second derivative is taken, radians. */
    const double by = 1e-3;
    kin_pack moved[6];
    kin_system beside;
    for (int i = 0; i < 6; ++i) {
        for (int k = 0; k < KIN_LANES; ++k) {
            bend[i][k] = here->error[i][k] + here->error[i][k];
        }
    }
    for (int way = -1; way <= 1; way += 2) {
        for (int i = 0; i < 6; ++i) {
            kin_copy(moved[i], q[i]);
            kin_plus_scaled(moved[i], v[i], way * by);
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
            bend[i][k] *= 1.0 / (by * by);
        }
    }
}

KIN_INLINE double kin_form_value(const double form[4], const double u[2])
{
    return u[0] * u[0] * (u[0] * form[0] + u[1] * form[1])
        + u[1] * u[1] * (u[0] * form[2] + u[1] * form[3]);
}

/* How fast it grows from u in a direction. */
KIN_INLINE double kin_form_slope(const double form[4], const double u[2], const double along[2])
{
    const double xx = u[0] * u[0], xy = 2.0 * u[0] * u[1], yy = u[1] * u[1];
    return along[0] * (3.0 * xx * form[0] + xy * form[1] + yy * form[2])
        + along[1] * (3.0 * yy * form[3] + xy * form[2] + xx * form[1]);
}

/* The directions, of length 1, of a cubic form's zeros, the real parts of two that are complex. */
static void kin_form_zeros(const double form[4], double out[3][2])
{
    /* By a direction d in which the form is no less than in others, a zero is r d and the one at a right
     * angle to it. */
    static const double tried[4][2] = {{1.0, 0.0}, {0.0, 1.0}, {0.7071067811865476, 0.7071067811865476},
        {0.7071067811865476, -0.7071067811865476}};
    const double *d = tried[0];
    for (int i = 1; i < 4; ++i) {
        if (fabs(kin_form_value(form, tried[i])) > fabs(kin_form_value(form, d))) {
            d = tried[i];
        }
    }
    const double beside[2] = {-d[1], d[0]}, lead = kin_form_value(form, d);
    const double third = kin_form_slope(form, d, beside) / lead / 3.0;
    const double b = kin_form_slope(form, beside, d) / lead;
    /* y^3 + p y + q = 0 of y = r + third: the root of the other sign than q is alone, the others are on
     * both sides of half of it, if they are real. */
    const double p = b - 3.0 * third * third;
    const double q = 2.0 * third * third * third - third * b + kin_form_value(form, beside) / lead;
    double y = 1.0 + fabs(p) + fabs(q);
    /* Newton's method from above: each step is a third of the way at least. */
    for (int step = 0; step < 20; ++step) {
        y = (2.0 * y * y * y + fabs(q)) / (3.0 * y * y + p);
    }
    y = copysign(y, -q);
    const double gap = sqrt(kin_max(-p - 0.75 * y * y, 0.0));
    const double roots[3] = {y, gap - 0.5 * y, -gap - 0.5 * y};
    for (int n = 0; n < 3; ++n) {
        const double r = roots[n] - third, share = 1.0 / sqrt(1.0 + r * r);
        for (int i = 0; i < 2; ++i) {
            out[n][i] = (beside[i] + r * d[i]) * share;
        }
    }
}

/* Near nearly singular configurations, the three others at which the target may be reached, to second
 * order. Where J loses one or two ranks, what is missing is e = J d + H(d, d)/2 with d = a v + b w + ...
 * along the two directions that J takes nearest to zero; with u = (a, b) the parts of J^-1 of it along
 * both are u + Q(u, u)/2, two conics: the bifurcation equations of Lyapunov and Schmidt to second order
 * (Golubitsky and Schaeffer, Singularities and Groups in Bifurcation Theory I, 1985, chapter I). From a
 * solution, where nothing is missing, the others are in the directions of three u to which Q(u, u) is
 * parallel. So is nearly v where J loses one rank alone. Along each the farther root is taken, for
 * Newton's method leads to the nearer; where there is none, or two of the directions are complex, what
 * is between the two. H is a second difference. */
KIN_INLINE void kin_split_of(const kin_problem *problem, kin_pack q[6], kin_pack out[3][6])
{
    /* So far the second order may tell anything, radians. */
    const double farthest = 0.5;
    kin_system here;
    kin_orthogonal jacobian;
    kin_pack weakest[2][6], both[6], bends[3][6], bent[3][6], step[6], e[2], conics[2][3];
    kin_linearize_all(problem, q, &here);
    kin_orthogonalize_jacobian(&here, &jacobian);
    kin_weak_motion(&jacobian, weakest, 0);
    kin_weak_motion(&jacobian, weakest, 1);
    for (int i = 0; i < 6; ++i) {
        kin_copy(both[i], weakest[0][i]);
        kin_plus_scaled(both[i], weakest[1][i], 1.0);
    }
    kin_bend(problem, q, &here, weakest[0], bends[0]);
    kin_bend(problem, q, &here, both, bends[1]);
    kin_bend(problem, q, &here, weakest[1], bends[2]);
    for (int i = 0; i < 6; ++i) {
        for (int k = 0; k < KIN_LANES; ++k) {
            bends[1][i][k] = 0.5 * (bends[1][i][k] - bends[0][i][k] - bends[2][i][k]);
        }
    }
    /* By the two directions: what is missing and Q, and what of both is across. */
    kin_solve_all(&jacobian, here.error, step);
    for (int n = 0; n < 2; ++n) {
        kin_dot(e[n], weakest[n], step, 6);
    }
    kin_across(step, weakest, 2);
    for (int m = 0; m < 3; ++m) {
        kin_solve_all(&jacobian, bends[m], bent[m]);
        for (int n = 0; n < 2; ++n) {
            kin_dot(conics[n][m], weakest[n], bent[m], 6);
        }
        kin_across(bent[m], weakest, 2);
    }
    for (int k = 0; k < KIN_LANES; ++k) {
        /* Zero where Q(u, u) is parallel to u, by falling powers of its first number. */
        const double form[4] = {conics[1][0][k], 2.0 * conics[1][1][k] - conics[0][0][k],
            conics[1][2][k] - 2.0 * conics[0][1][k], -conics[0][2][k]};
        double directions[3][2];
        kin_form_zeros(form, directions);
        for (int n = 0; n < 3; ++n) {
            const double x = directions[n][0], y = directions[n][1];
            const double squares[3] = {x * x, 2.0 * x * y, y * y};
            double a = 0.0;
            for (int m = 0; m < 3; ++m) {
                a += squares[m] * (x * conics[0][m][k] + y * conics[1][m][k]);
            }
            const double missing = x * e[0][k] + y * e[1][k];
            const double root = sqrt(kin_max(1.0 + 2.0 * a * missing, 0.0));
            const double by = kin_max(-kin_max((1.0 + root) / a, -farthest), -farthest);
            for (int i = 0; i < 6; ++i) {
                double there = q[i][k] + step[i][k];
                there += by * (x * weakest[0][i][k] + y * weakest[1][i][k]);
                for (int m = 0; m < 3; ++m) {
                    there -= 0.5 * by * by * squares[m] * bent[m][i][k];
                }
                out[n][i][k] = there;
            }
        }
    }
}
KIN_BY_PROCESSOR(kin_split,
    (const kin_problem *problem, kin_pack q[6], kin_pack out[3][6]), (problem, q, out))
