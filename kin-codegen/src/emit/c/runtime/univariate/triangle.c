/* M = Q R by Householder's reflections, without Q: at twice the cost of L U, and never worse than
 * rounding. The determinant of Q is -1. */
typedef struct kin_triangle {
    kin_pack rows[16][16];
    /* Of the diagonal. */
    kin_pack inverses[16];
} kin_triangle;

/* Of the matrices in the rows. */
KIN_INLINE void kin_triangulate(kin_triangle *t)
{
    kin_pack (*m)[16] = t->rows;
    for (int c = 0; c < 16; ++c) {
        kin_pack square, image, weight;
        kin_fill(square, 0.0);
        for (int i = c; i < 16; ++i) {
            kin_plus(square, m[i][c], m[i][c]);
        }
        for (int k = 0; k < KIN_LANES; ++k) {
            const double x = m[c][c][k], root = sqrt(square[k]);
            /* Without cancellation by the choice of sign. */
            image[k] = c == 15 ? x : kin_select(x, 0.0, root, -root);
            weight[k] = 1.0 / kin_max(square[k] - image[k] * x, 1e-30);
            m[c][c][k] = x - image[k];
        }
        for (int j = c + 1; j < 16; ++j) {
            kin_pack along;
            kin_fill(along, 0.0);
            for (int i = c; i < 16; ++i) {
                kin_plus(along, m[i][c], m[i][j]);
            }
            kin_times(along, weight);
            for (int i = c; i < 16; ++i) {
                kin_minus(m[i][j], along, m[i][c]);
            }
        }
        kin_copy(m[c][c], image);
        kin_reciprocals(t->inverses[c], image, 1e-30);
    }
}

/* One step of inverse iteration on the transpose of R times R. */
KIN_INLINE void kin_improve(kin_triangle *t, kin_pack x[16])
{
    for (int i = 0; i < 16; ++i) {
        for (int j = 0; j < i; ++j) {
            kin_minus(x[i], t->rows[j][i], x[j]);
        }
        kin_times(x[i], t->inverses[i]);
    }
    kin_normalize(x, 16);
    for (int i = 15; i >= 0; --i) {
        for (int j = i + 1; j < 16; ++j) {
            kin_minus(x[i], t->rows[i][j], x[j]);
        }
        kin_times(x[i], t->inverses[i]);
    }
}

/* Starts that no arm is square to: the fractional parts of multiples of the golden ratio, about 0. */
KIN_INLINE void kin_first_vector(int n, kin_pack x[16])
{
    for (int i = 0; i < 16; ++i) {
        const double part = ((n + 1) * i % 61 + 1) * 0.6180339887498948;
        kin_fill(x[i], part - (int)part - 0.48);
    }
}

/* About the norm of the inverse, and no more. */
KIN_INLINE void kin_inverse_norm(kin_triangle *t, kin_pack norm)
{
    kin_pack x[16];
    kin_first_vector(0, x);
    kin_improve(t, x);
    kin_dot(norm, x, x, 16);
    for (int k = 0; k < KIN_LANES; ++k) {
        norm[k] = sqrt(norm[k]);
    }
}

/* An orthonormal basis of what Q R nearly takes to zero: the least right singular vectors, by
 * subspace iteration; and about how long what they are taken to is. */
KIN_INLINE void kin_null_space(
    kin_triangle *t, int count, kin_pack space[][16], kin_pack lengths[])
{
    for (int n = 0; n < count; ++n) {
        kin_first_vector(n, space[n]);
    }
    for (int round = 0; round < 3; ++round) {
        for (int n = 0; n < count; ++n) {
            kin_improve(t, space[n]);
            for (int before = 0; before < n; ++before) {
                kin_pack along;
                kin_dot(along, space[before], space[n], 16);
                for (int i = 0; i < 16; ++i) {
                    kin_minus(space[n][i], along, space[before][i]);
                }
            }
            kin_dot(lengths[n], space[n], space[n], 16);
            for (int k = 0; k < KIN_LANES; ++k) {
                lengths[n][k] = 1.0 / sqrt(lengths[n][k]);
            }
            for (int i = 0; i < 16; ++i) {
                kin_times(space[n][i], lengths[n]);
            }
        }
    }
}
