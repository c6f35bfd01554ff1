/* Solutions that share the value of the kept joint span what the matrix takes to zero; the vectors
 * of monomials in that space are the eigenvectors of multiplication in it (Auzinger and Stetter,
 * ISNM 86, 1988). So many may share it. */
#define KIN_SHARING 4
#define KIN_RATIOS 3
typedef kin_pack kin_square[KIN_SHARING][KIN_SHARING];

/* Where a monomial of the half tangents stands. */
KIN_INLINE int kin_column(const kin_elimination *elimination, int i, int j)
{
    return elimination->columns[(i + 4 * j) & 15];
}

/* h becomes g^-1 h, for a positive definite g. */
static void kin_solve_square(kin_square g, kin_square h, int n)
{
    for (int c = 0; c < n; ++c) {
        kin_pack pivot;
        for (int k = 0; k < KIN_LANES; ++k) {
            pivot[k] = 1.0 / kin_max(g[c][c][k], 1e-30);
        }
        for (int i = 0; i < n; ++i) {
            kin_pack share;
            kin_copy(share, g[i][c]);
            kin_times(share, pivot);
            for (int j = 0; i != c && j < n; ++j) {
                kin_minus(g[i][j], share, g[c][j]);
                kin_minus(h[i][j], share, h[c][j]);
            }
        }
        for (int j = 0; j < n; ++j) {
            kin_times(g[c][j], pivot);
            kin_times(h[c][j], pivot);
        }
    }
}

/* Two functions of the half tangents whose ratio tells solutions apart, above and below: the
 * coefficients of 1, each of the two, and their product. What one hardly tells apart, of values that
 * are as large, others do. */
static const double kin_ratios[KIN_RATIOS][2][4] = {
    {{0.31, 0.83, -0.57, 0.44}, {0.92, -0.38, 0.29, 0.71}},
    {{-0.74, 0.35, 0.61, 0.27}, {0.42, 0.66, 0.53, -0.81}},
    {{0.58, -0.47, 0.22, 0.89}, {-0.33, 0.76, 0.85, 0.19}}};

/* What multiplication by a ratio does to a space's vectors, in the sense of least squares. */
static void kin_multiplication(
    const kin_elimination *elimination, kin_pack space[][16], int n, int ratio, kin_square image)
{
    const double *const of_above = kin_ratios[ratio][0], *const of_below = kin_ratios[ratio][1];
    kin_square gram;
    for (int a = 0; a < n; ++a) {
        for (int b = 0; b < n; ++b) {
            kin_fill(gram[a][b], 0.0);
            kin_fill(image[a][b], 0.0);
        }
    }
    for (int i = 0; i < elimination->powers[0]; ++i) {
        for (int j = 0; j < elimination->powers[1]; ++j) {
            kin_pack above[KIN_SHARING], below[KIN_SHARING];
            for (int a = 0; a < n; ++a) {
                kin_fill(above[a], 0.0);
                kin_fill(below[a], 0.0);
                for (int corner = 0; corner < 4; ++corner) {
                    const int column = kin_column(elimination, i + corner % 2, j + corner / 2);
                    kin_plus_scaled(above[a], space[a][column], of_above[corner]);
                    kin_plus_scaled(below[a], space[a][column], of_below[corner]);
                }
            }
            for (int a = 0; a < n; ++a) {
                for (int b = 0; b < n; ++b) {
                    kin_plus(gram[a][b], below[a], below[b]);
                    kin_plus(image[a][b], below[a], above[b]);
                }
            }
        }
    }
    kin_solve_square(gram, image, n);
}

/* The eigenvectors of two by two, from the quadratic. */
static void kin_eigenvectors_of_pair(kin_square t, kin_square out)
{
    for (int k = 0; k < KIN_LANES; ++k) {
        const double b = t[0][1][k], c = t[1][0][k], half = (t[0][0][k] - t[1][1][k]) * 0.5;
        const double length = sqrt(kin_max(half * half + b * c, 0.0));
        for (int i = 0; i < 2; ++i) {
            const double root = i == 0 ? length : -length;
            /* The one without cancellation, of the two rows that tell it. */
            out[i][0][k] = kin_select(root * half, 0.0, b, root + half);
            out[i][1][k] = kin_select(root * half, 0.0, root - half, c);
        }
    }
}

static void kin_product(kin_square a, kin_square b, kin_square out)
{
    for (int i = 0; i < KIN_SHARING; ++i) {
        for (int j = 0; j < KIN_SHARING; ++j) {
            kin_fill(out[i][j], 0.0);
            for (int m = 0; m < KIN_SHARING; ++m) {
                kin_plus(out[i][j], a[i][m], b[m][j]);
            }
        }
    }
}

/* t = q r by Gram and Schmidt; q takes its place. */
static void kin_orthogonalize(kin_square t, kin_square r)
{
    for (int j = 0; j < KIN_SHARING; ++j) {
        kin_pack share;
        for (int i = 0; i < KIN_SHARING; ++i) {
            kin_fill(r[i][j], 0.0);
        }
        for (int before = 0; before < j; ++before) {
            for (int i = 0; i < KIN_SHARING; ++i) {
                kin_plus(r[before][j], t[i][before], t[i][j]);
            }
            for (int i = 0; i < KIN_SHARING; ++i) {
                kin_minus(t[i][j], r[before][j], t[i][before]);
            }
        }
        for (int i = 0; i < KIN_SHARING; ++i) {
            kin_plus(r[j][j], t[i][j], t[i][j]);
        }
        for (int k = 0; k < KIN_LANES; ++k) {
            r[j][j][k] = kin_max(sqrt(r[j][j][k]), 1e-150);
            share[k] = 1.0 / r[j][j][k];
        }
        for (int i = 0; i < KIN_SHARING; ++i) {
            kin_times(t[i][j], share);
        }
    }
}

/* The vector that belongs to the eigenvalue nearest to a value, by inverse iteration, in which two
 * that are complex do no harm. */
static void kin_eigenvector(kin_square given, const kin_pack value, kin_pack out[KIN_SHARING])
{
    kin_square shifted, r;
    for (int i = 0; i < KIN_SHARING; ++i) {
        for (int j = 0; j < KIN_SHARING; ++j) {
            kin_copy(shifted[i][j], given[i][j]);
        }
        for (int k = 0; k < KIN_LANES; ++k) {
            shifted[i][i][k] -= value[k];
        }
    }
    kin_orthogonalize(shifted, r);
    /* The inverse of r takes the last column to where the shifted matrix has nearly nothing left. */
    kin_fill(out[KIN_SHARING - 1], 1.0);
    for (int i = KIN_SHARING - 2; i >= 0; --i) {
        kin_pack above;
        kin_fill(above, 0.0);
        for (int j = i + 1; j < KIN_SHARING; ++j) {
            kin_plus(above, r[i][j], out[j]);
        }
        for (int k = 0; k < KIN_LANES; ++k) {
            out[i][k] = -above[k] / r[i][i][k];
        }
    }
}

/* Eigenvalues by the QR algorithm without shifts, on the fourth power, which has the same vectors
 * and needs a quarter of the rounds: those that are real and apart part by then as far as a start
 * of Newton's method needs it. Where two are complex, two of the vectors are none. */
static void kin_eigenvectors(kin_square given, kin_square out)
{
    kin_square t, r, basis, other;
    kin_product(given, given, r);
    kin_product(r, r, t);
    for (int i = 0; i < KIN_SHARING; ++i) {
        for (int j = 0; j < KIN_SHARING; ++j) {
            kin_fill(basis[i][j], i == j ? 1.0 : 0.0);
        }
    }
    for (int round = 0; round < 10; ++round) {
        kin_orthogonalize(t, r);
        kin_product(basis, t, other);
        for (int i = 0; i < KIN_SHARING; ++i) {
            for (int j = 0; j < KIN_SHARING; ++j) {
                kin_copy(basis[i][j], other[i][j]);
            }
        }
        kin_product(r, t, other);
        for (int i = 0; i < KIN_SHARING; ++i) {
            for (int j = 0; j < KIN_SHARING; ++j) {
                kin_copy(t[i][j], other[i][j]);
            }
        }
    }
    kin_product(given, basis, t);
    for (int c = 0; c < KIN_SHARING; ++c) {
        kin_pack value;
        kin_fill(value, 0.0);
        for (int i = 0; i < KIN_SHARING; ++i) {
            kin_plus(value, basis[i][c], t[i][c]);
        }
        kin_eigenvector(given, value, out[c]);
    }
}

/* The vectors of monomials in a space of two or four; where two are complex, one of a pair their
 * real part, of more something else. */
static void kin_monomial_vectors(
    const kin_elimination *elimination, kin_pack space[][16], int n, int ratio, kin_pack out[][16])
{
    kin_square image, weights;
    kin_multiplication(elimination, space, n, ratio, image);
    if (n == 2) {
        kin_eigenvectors_of_pair(image, weights);
    } else {
        kin_eigenvectors(image, weights);
    }
    for (int a = 0; a < n; ++a) {
        for (int i = 0; i < 16; ++i) {
            kin_fill(out[a][i], 0.0);
            for (int b = 0; b < n; ++b) {
                kin_plus(out[a][i], space[b][i], weights[a][b]);
            }
        }
    }
}
