/* M = L U, in the order in which rows and columns stand: that was chosen for the arm, and how far
 * it can be trusted at a target is seen in what comes out. L has ones on its diagonal and takes
 * the place below that of U. */
typedef struct kin_factors {
    kin_pack rows[16][12];
    /* Of the pivots. */
    kin_pack inverses[16];
    unsigned shifted;
} kin_factors;

/* x -= a b + c d + e f + g h, in this order. */
KIN_INLINE void kin_minus_four(
    double *x, const double *a, const double *b, const double *c, const double *d, const double *e,
    const double *f, const double *g, const double *h)
{
    KIN_EACH_LANE
    for (int k = 0; k < KIN_LANES; ++k) {
        x[k] = x[k] - a[k] * b[k] - c[k] * d[k] - e[k] * f[k] - g[k] * h[k];
    }
}

/* Pivots of four rows from the `first` on, in the columns from `column` on of those that they
 * have; bit i of `others` is set where row i has them too. */
KIN_INLINE void kin_factor_block(kin_factors *f, int first, int column, unsigned others)
{
    kin_pack *a = f->rows[first], *b = f->rows[first + 1];
    kin_pack *c = f->rows[first + 2], *d = f->rows[first + 3];
    for (int i = 0; i < 4; ++i) {
        kin_pack *row = f->rows[first + i];
        kin_reciprocals(f->inverses[first + i], row[column + i], 1e-30);
        for (int l = i + 1; l < 4; ++l) {
            kin_pack *other = f->rows[first + l];
            kin_times(other[column + i], f->inverses[first + i]);
            for (int j = column + i + 1; j < 12; ++j) {
                kin_minus(other[j], other[column + i], row[j]);
            }
        }
    }
    for (int i = first + 4; i < 16; ++i) {
        kin_pack *row = f->rows[i], *share = row + column;
        if (!(others >> i & 1)) {
            continue;
        }
        for (int l = 0; l < 4; ++l) {
            for (int m = 0; m < l; ++m) {
                kin_minus(share[l], share[m], f->rows[first + m][column + l]);
            }
            kin_times(share[l], f->inverses[first + l]);
        }
        for (int j = column + 4; j < 12; ++j) {
            kin_minus_four(row[j], share[0], a[j], share[1], b[j], share[2], c[j], share[3], d[j]);
        }
    }
}

/* Of the matrices at values of the kept joint. */
KIN_INLINE void kin_factorize(
    const kin_recovery *of, const double *cosine, const double *sine, kin_factors *f)
{
    kin_compact_matrices(of, cosine, sine, f->rows);
    f->shifted = of->places.shifted;
    kin_factor_block(f, 0, 0, ~f->shifted & 0xff00u);
    kin_factor_block(f, 4, 0, f->shifted & 0xff00u);
    kin_factor_block(f, 8, 4, 0xf000u);
    kin_factor_block(f, 12, 8, 0u);
}

/* The column of pivot i in its row. */
KIN_INLINE int kin_pivot_column(int i)
{
    return i < 8 ? i % 4 : i - 4;
}

/* x becomes the solution of L y = x. */
KIN_INLINE void kin_substitute_forward(kin_factors *f, kin_pack x[16])
{
    for (int i = 0; i < 16; ++i) {
        const int own = i < 8 ? i % 4 : 4, first = f->shifted >> i & 1 ? 4 : 0;
        for (int k = 0; k < own; ++k) {
            kin_minus(x[i], f->rows[i][k], x[first + k]);
        }
        for (int k = 8; k < i; ++k) {
            kin_minus(x[i], f->rows[i][k - 4], x[k]);
        }
    }
}

/* x becomes the solution of U y = x. */
KIN_INLINE void kin_substitute_back(kin_factors *f, kin_pack x[16])
{
    for (int i = 15; i >= 0; --i) {
        for (int j = i < 8 ? 8 : i + 1; j < 16; ++j) {
            kin_minus(x[i], f->rows[i][j - 4], x[j]);
        }
        for (int j = i % 4 + 1; i < 8 && j < 4; ++j) {
            kin_minus(x[i], f->rows[i][j], x[i / 4 * 4 + j]);
        }
        kin_times(x[i], f->inverses[i]);
    }
}

/* The vector that L U nearly takes to zero, of length 1: inverse iteration (Wilkinson, The
 * Algebraic Eigenvalue Problem, 1965, chapter 5) from L times a vector of ones. */
KIN_INLINE void kin_null_vector(kin_factors *f, kin_pack x[16])
{
    for (int i = 0; i < 16; ++i) {
        kin_fill(x[i], 1.0);
    }
    kin_substitute_back(f, x);
    kin_normalize(x, 16);
    kin_substitute_forward(f, x);
    kin_substitute_back(f, x);
    kin_normalize(x, 16);
}
