/* The other joints from values of the kept one. */
typedef struct kin_starts {
    /* By joint of the arm. */
    kin_pack q[6];
    /* How far two cosines and sines are from being of an angle, or powers of a slide: what an
     * extraneous root shows itself by. */
    kin_pack inconsistency;
} kin_starts;

/* The last joint, or the last but one, from a vector of monomials: tan of its half is the share of
 * two neighbouring powers, and sine and cosine are had without dividing; of a slide the first power
 * by the power before. */
KIN_INLINE void kin_eliminated(
    const kin_recovery *of, int before, kin_pack null[16], double *out)
{
    const kin_elimination *elimination = of->elimination;
    const int slides = of->slides[before ? 4 : 5];
    const int rows = slides ? 1 : 3, most = elimination->powers[before ? 0 : 1];
    const int others = slides ? (most < 3 ? most : 3) + 1 : 4;
    kin_pack x, y;
    kin_fill(x, 0.0);
    kin_fill(y, 0.0);
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < others; ++j) {
            const double *low = null[kin_column(elimination, before ? j : i, before ? i : j)];
            const double *high =
                null[kin_column(elimination, before ? j : i + 1, before ? i + 1 : j)];
            for (int k = 0; k < KIN_LANES; ++k) {
                const double a = low[k], b = high[k];
                y[k] += slides ? a * b : (a + a) * b;
                x[k] += slides ? a * a : (a - b) * (a + b);
            }
        }
    }
    if (slides) {
        for (int k = 0; k < KIN_LANES; ++k) {
            out[k] = y[k] / x[k];
        }
    } else {
        kin_angles(out, y, x);
    }
}

/* By what a joint, by its place in the loop, moves a line: its sine and cosine, or the square of
 * its slide and the slide. */
KIN_INLINE void kin_functions(
    const kin_recovery *of, int place, const double *value, double *sine, double *cosine)
{
    if (of->slides[place]) {
        for (int k = 0; k < KIN_LANES; ++k) {
            sine[k] = value[k] * value[k];
            cosine[k] = value[k];
        }
    } else {
        kin_sines_and_cosines(value, sine, cosine);
    }
}

/* The transpose of a rotation times vectors. */
KIN_INLINE void kin_rotate_back(const double pose[12], kin_pack x[3])
{
    for (int k = 0; k < KIN_LANES; ++k) {
        const double a = x[0][k], b = x[1][k], c = x[2][k];
        x[0][k] = a * pose[0] + b * pose[4] + c * pose[8];
        x[1][k] = a * pose[1] + b * pose[5] + c * pose[9];
        x[2][k] = a * pose[2] + b * pose[6] + c * pose[10];
    }
}

/* A rotation times vectors, and the translation of points. */
KIN_INLINE void kin_place_vectors(const double pose[12], int points, kin_pack x[3])
{
    for (int k = 0; k < KIN_LANES; ++k) {
        const double a = x[0][k], b = x[1][k], c = x[2][k];
        x[0][k] = a * pose[0] + b * pose[1] + c * pose[2] + (points ? pose[3] : 0.0);
        x[1][k] = a * pose[4] + b * pose[5] + c * pose[6] + (points ? pose[7] : 0.0);
        x[2][k] = a * pose[8] + b * pose[9] + c * pose[10] + (points ? pose[11] : 0.0);
    }
}

/* Vectors turned about z. */
KIN_INLINE void kin_turn(
    const double *sine, const double *cosine, double *x, double *y)
{
    KIN_EACH_LANE
    for (int k = 0; k < KIN_LANES; ++k) {
        const double a = x[k], b = y[k];
        x[k] = cosine[k] * a - sine[k] * b;
        y[k] = sine[k] * a + cosine[k] * b;
    }
}

/* The same backwards. */
KIN_INLINE void kin_turn_back(
    const double *sine, const double *cosine, double *x, double *y)
{
    KIN_EACH_LANE
    for (int k = 0; k < KIN_LANES; ++k) {
        const double a = x[k], b = y[k];
        x[k] = a * cosine[k] + b * sine[k];
        y[k] = b * cosine[k] - a * sine[k];
    }
}

/* Directions and points as a joint moves them, by its place in the loop. */
KIN_INLINE void kin_move(
    const kin_recovery *of, int place, const double *sine, const double *cosine, kin_pack l[3],
    kin_pack p[3])
{
    if (of->slides[place]) {
        for (int k = 0; k < KIN_LANES; ++k) {
            p[2][k] += cosine[k];
        }
    } else {
        kin_turn(sine, cosine, l[0], l[1]);
        kin_turn(sine, cosine, p[0], p[1]);
    }
}

/* The fourth joint's line in the frame of the kept one. */
KIN_INLINE void kin_see_line(
    const kin_recovery *of, kin_pack sine[6], kin_pack cosine[6], kin_pack line[15])
{
    for (int i = 0; i < 15; ++i) {
        for (int k = 0; k < KIN_LANES; ++k) {
            const double c = cosine[4][k], s = sine[4][k];
            const double one = of->far_side[0][i] + c * of->far_side[1][i] + s * of->far_side[2][i];
            const double two = of->far_side[3][i] + c * of->far_side[4][i] + s * of->far_side[5][i];
            const double six = of->far_side[6][i] + c * of->far_side[7][i] + s * of->far_side[8][i];
            line[i][k] = one + two * cosine[5][k] + six * sine[5][k];
        }
    }
    for (int v = 0; v < 12; v += 3) {
        kin_turn_back(sine[0], cosine[0], line[v], line[v + 1]);
    }
}

/* The third joint, and how far its functions are from being of one value. */
KIN_INLINE void kin_third(
    const kin_recovery *of, kin_pack line[15], double *value, double *off)
{
    kin_pack f[2];
    for (int i = 0; i < 2; ++i) {
        kin_fill(f[i], 0.0);
        for (int j = 0; j < 15; ++j) {
            kin_plus_scaled(f[i], line[j], of->third[i][j]);
        }
    }
    if (of->slides[2]) {
        for (int k = 0; k < KIN_LANES; ++k) {
            const double square = f[0][k] * f[0][k];
            value[k] = f[0][k];
            off[k] = (square - f[1][k]) / (1.0 + square);
        }
        return;
    }
    kin_angles(value, f[1], f[0]);
    for (int k = 0; k < KIN_LANES; ++k) {
        off[k] = f[0][k] * f[0][k] + f[1][k] * f[1][k] - 1.0;
    }
}

/* The second joint, which takes the fourth's axis and the point on it from where the third leaves
 * them to where they are seen in the frame of the kept one; and how far it misses. */
KIN_INLINE void kin_second(
    const kin_recovery *of, kin_pack line[15], kin_pack sine[6], kin_pack cosine[6],
    double *value, double *off)
{
    const double *on = of->behind[2];
    kin_pack l[3], p[3], far_l[3], far_p[3];
    for (int i = 0; i < 3; ++i) {
        kin_fill(l[i], on[4 * i + 2]);
        kin_fill(p[i], on[4 * i + 3]);
        for (int k = 0; k < KIN_LANES; ++k) {
            far_l[i][k] = line[i][k];
            far_p[i][k] = line[3 + i][k] - of->behind[0][4 * i + 3];
        }
    }
    kin_move(of, 2, sine[2], cosine[2], l, p);
    kin_place_vectors(of->behind[1], 0, l);
    kin_place_vectors(of->behind[1], 1, p);
    kin_rotate_back(of->behind[0], far_l);
    kin_rotate_back(of->behind[0], far_p);
    if (of->slides[1]) {
        for (int k = 0; k < KIN_LANES; ++k) {
            value[k] = far_p[2][k] - p[2][k];
        }
    } else {
        kin_pack s, c;
        for (int k = 0; k < KIN_LANES; ++k) {
            s[k] = l[0][k] * far_l[1][k] - l[1][k] * far_l[0][k]
                + (p[0][k] * far_p[1][k] - p[1][k] * far_p[0][k]);
            c[k] = l[0][k] * far_l[0][k] + l[1][k] * far_l[1][k]
                + (p[0][k] * far_p[0][k] + p[1][k] * far_p[1][k]);
        }
        kin_angles(value, s, c);
    }
    kin_functions(of, 1, value, sine[1], cosine[1]);
    kin_move(of, 1, sine[1], cosine[1], l, p);
    kin_fill(off, 0.0);
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < KIN_LANES; ++k) {
            off[k] = kin_max(off[k], fabs(l[i][k] - far_l[i][k]));
            off[k] = kin_max(off[k], fabs(p[i][k] - far_p[i][k]));
        }
    }
}

/* The joint whose axis was followed: where its x axis goes the other way round; slides do not turn
 * it. */
KIN_INLINE void kin_fourth(
    const kin_recovery *of, kin_pack sine[6], kin_pack cosine[6], double *value)
{
    kin_pack x[3];
    kin_fill(x[0], 1.0);
    kin_fill(x[1], 0.0);
    kin_fill(x[2], 0.0);
    for (int i = 3; i < 9; ++i) {
        const int next = (i + 1) % 6;
        kin_rotate_back(of->behind[i % 6], x);
        if (i < 8 && !of->slides[next]) {
            kin_turn_back(sine[next], cosine[next], x[0], x[1]);
        }
    }
    kin_angles(value, x[1], x[0]);
}

/* The joints that go with values of the kept one, from vectors of monomials. */
KIN_INLINE void kin_joints_of_vectors_of(
    const kin_recovery *of, const double *kept, kin_pack null[16], kin_starts *out)
{
    const kin_elimination *elimination = of->elimination;
    const double sign = elimination->backwards ? -1.0 : 1.0;
    kin_pack values[6], sine[6], cosine[6], line[15], second_off, third_off;
    kin_copy(values[0], kept);
    kin_eliminated(of, 0, null, values[5]);
    kin_eliminated(of, 1, null, values[4]);
    kin_sines_and_cosines(kept, sine[0], cosine[0]);
    kin_functions(of, 4, values[4], sine[4], cosine[4]);
    kin_functions(of, 5, values[5], sine[5], cosine[5]);
    kin_see_line(of, sine, cosine, line);
    kin_third(of, line, values[2], third_off);
    kin_functions(of, 2, values[2], sine[2], cosine[2]);
    kin_second(of, line, sine, cosine, values[1], second_off);
    kin_fourth(of, sine, cosine, values[3]);
    for (int i = 0; i < 6; ++i) {
        for (int k = 0; k < KIN_LANES; ++k) {
            out->q[elimination->joints[i]][k] = sign * values[i][k];
        }
    }
    for (int k = 0; k < KIN_LANES; ++k) {
        out->inconsistency[k] = kin_max(second_off[k], fabs(third_off[k]));
    }
}
KIN_BY_PROCESSOR(kin_joints_of_vectors,
    (const kin_recovery *of, const double *kept, kin_pack null[16], kin_starts *out),
    (of, kept, null, out))

/* The cosine and sine of halves of values. */
KIN_INLINE void kin_halves(const double *kept, double *cosine, double *sine)
{
    kin_pack half;
    for (int k = 0; k < KIN_LANES; ++k) {
        half[k] = 0.5 * kept[k];
    }
    kin_sines_and_cosines(half, sine, cosine);
}

/* What is taken to zero at values of the kept joint, by the pivots that were chosen for the arm; by
 * how much it misses zero. */
KIN_INLINE void kin_find_null_vector_of(
    const kin_recovery *of, const double *kept, kin_pack null[16], double *miss)
{
    kin_pack cosine, sine;
    kin_factors factors;
    kin_halves(kept, cosine, sine);
    kin_factorize(of, cosine, sine, &factors);
    kin_null_vector(&factors, null);
    kin_misses(of, cosine, sine, null, miss);
}
KIN_BY_PROCESSOR(kin_find_null_vector,
    (const kin_recovery *of, const double *kept, kin_pack null[16], double *miss),
    (of, kept, null, miss))

/* What is nearly taken to zero at values of the kept joint: so many vectors of a basis, of which
 * the first are those of fewer, and about how long what they are taken to is. */
KIN_INLINE void kin_find_null_space_of(const kin_recovery *of, const double *kept, int count,
    kin_pack space[][16], kin_pack lengths[])
{
    kin_pack cosine, sine;
    kin_triangle triangle;
    kin_halves(kept, cosine, sine);
    kin_matrices(of, cosine, sine, triangle.rows);
    kin_triangulate(&triangle);
    kin_null_space(&triangle, count, space, lengths);
}
KIN_BY_PROCESSOR(kin_find_null_space,
    (const kin_recovery *of, const double *kept, int count, kin_pack space[][16],
        kin_pack lengths[]),
    (of, kept, count, space, lengths))

/* The joints that go with values of the kept one. */
static void kin_recover(const kin_recovery *of, const double *kept, kin_starts *out)
{
    kin_pack null[1][16], miss, length[1];
    int is_good = 1;
    kin_find_null_vector(of, kept, null[0], miss);
    for (int k = 0; k < KIN_LANES; ++k) {
        /* Not a number is not less. */
        is_good = is_good && miss[k] < 1e-9;
    }
    if (!is_good) {
        kin_find_null_space(of, kept, 1, null, length);
    }
    kin_joints_of_vectors(of, kept, null[0], out);
}

/* The configurations that share values of the kept joint or have nearly met there: those of the
 * vectors in so many dimensions of what is nearly taken to zero that are monomials. */
static void kin_recover_sharing(const kin_recovery *of, const double *kept, kin_pack space[][16],
    int count, int ratio, kin_starts *out, kin_eigenvalues *values)
{
    kin_pack vectors[KIN_SHARING][16];
    kin_monomial_vectors(of->elimination, space, count, ratio, vectors, values);
    for (int i = 0; i < count; ++i) {
        kin_joints_of_vectors(of, kept, vectors[i], &out[i]);
    }
}

/* How many of so many vectors in a lane are of no solution, complex or off by more than a solution may be;
 * none where an eigenvalue, or what is taken to zero, is not known as well as the eigenvalues are apart. */
static int kin_extraneous(const kin_starts *starts, int count, kin_pack *lengths,
    const kin_eigenvalues *values, int lane, double off)
{
    int extraneous = 0;
    /* Not a number is not less. */
    if (!(lengths[count - 1][lane] < 1e-4 * values->apart[lane])) {
        return 0;
    }
    for (int n = 0; n < count; ++n) {
        extraneous += kin_is_complex(values, n, lane) || starts[n].inconsistency[lane] > off;
    }
    return extraneous;
}
