/* Solutions that share the value of the kept joint span what the matrix takes to zero; the vectors
 * of monomials in that space are the eigenvectors of multiplication in it (Auzinger and Stetter,
 * ISNM 86, 1988). So many may share it. */
#define KIN_SHARING 4
#define KIN_RATIOS 3
typedef kin_pack kin_square[KIN_SHARING][KIN_SHARING];
/* Rounds of Weierstrass' iteration: those eigenvalues that are apart part by then as far as a start of
 * Newton's method needs it; and by what share of how far two are apart the last one moves one at most. */
#define KIN_ROUNDS 12
#define KIN_SETTLED 1e-4
/* Where a family of solutions has one value of the kept joint, the vectors of all its members are in the
 * space, and no matrix multiplies all of them by their ratios: a pivot is zero. The same next to it. */
#define KIN_OF_FAMILY 1e-5

/* The eigenvalues that belong to vectors of a space: how far each is from the real axis, and the least
 * distance of two, zero where they are not known; in units of the largest entry of the matrix. */
typedef struct kin_eigenvalues {
    kin_pack imaginary[KIN_SHARING], apart;
} kin_eigenvalues;

/* Whether one is complex, of those that are known, and not one of two real ones that have nearly met. */
static int kin_is_complex(const kin_eigenvalues *values, int n, int lane)
{
    return values->imaginary[n][lane] > 0.01;
}

/* Where a monomial of the half tangents stands. */
KIN_INLINE int kin_column(const kin_elimination *elimination, int i, int j)
{
    return elimination->columns[(i + 4 * j) & 15];
}

/* h becomes g^-1 h, for a positive definite g, whose least pivot is told. */
static void kin_solve_square(kin_square g, kin_square h, int n, double *least)
{
    kin_fill(least, HUGE_VAL);
    for (int c = 0; c < n; ++c) {
        kin_pack pivot;
        for (int k = 0; k < KIN_LANES; ++k) {
            least[k] = g[c][c][k] < least[k] ? g[c][c][k] : least[k];
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

/* What multiplication by a ratio does to a space's vectors, in the sense of least squares, and the least
 * pivot. */
static void kin_multiplication(const kin_elimination *elimination, kin_pack space[][16], int n,
    int ratio, kin_square image, double *least)
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
    kin_solve_square(gram, image, n, least);
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

static void kin_copy_square(kin_square to, kin_square from)
{
    for (int i = 0; i < KIN_SHARING; ++i) {
        for (int j = 0; j < KIN_SHARING; ++j) {
            kin_copy(to[i][j], from[i][j]);
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

/* r of t = q r, by Gram and Schmidt; q takes the place of t. */
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
    kin_copy_square(shifted, given);
    for (int i = 0; i < KIN_SHARING; ++i) {
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

/* The two of two by two. */
static void kin_values_of_pair(kin_square t, kin_pack values[][2])
{
    for (int k = 0; k < KIN_LANES; ++k) {
        const double mean = (t[0][0][k] + t[1][1][k]) * 0.5, half = (t[0][0][k] - t[1][1][k]) * 0.5;
        const double square = half * half + t[0][1][k] * t[1][0][k], root = sqrt(fabs(square));
        const double real = kin_select(square, 0.0, 0.0, root);
        values[0][0][k] = mean + real;
        values[1][0][k] = mean - real;
        values[0][1][k] = root - real;
        values[1][1][k] = real - root;
    }
}

/* The coefficients of the characteristic polynomial, from the second power's on down but for the first,
 * which is one (Faddeev and Faddeeva, Computational Methods of Linear Algebra, 1963). */
static void kin_characteristic(kin_square t, kin_pack out[KIN_SHARING])
{
    kin_square power, next;
    kin_copy_square(power, t);
    for (int n = 0; n < KIN_SHARING; ++n) {
        kin_fill(out[n], 0.0);
        for (int i = 0; i < KIN_SHARING; ++i) {
            for (int k = 0; k < KIN_LANES; ++k) {
                out[n][k] -= power[i][i][k] * (1.0 / (n + 1));
            }
        }
        for (int i = 0; i < KIN_SHARING; ++i) {
            for (int k = 0; k < KIN_LANES; ++k) {
                power[i][i][k] += out[n][k];
            }
        }
        kin_product(t, power, next);
        kin_copy_square(power, next);
    }
}

/* A round of Weierstrass' iteration for the roots of a polynomial, all at once (Weierstrass, Neuer Beweis
 * des Satzes, dass jede ganze rationale Function einer Veraenderlichen dargestellt werden kann als ein
 * Product aus linearen Functionen derselben Veraenderlichen, 1891), and by how much it moves one at most. */
KIN_INLINE void kin_part_roots_of(kin_pack *polynomial, kin_pack values[][2], double *moved)
{
    kin_fill(moved, 0.0);
    for (int i = 0; i < KIN_SHARING; ++i) {
        kin_pack above[2], below[2];
        for (int part = 0; part < 2; ++part) {
            kin_fill(above[part], part == 0 ? 1.0 : 0.0);
            kin_fill(below[part], part == 0 ? 1.0 : 0.0);
        }
        for (int n = 0; n < KIN_SHARING; ++n) {
            kin_add_and_multiply(above[0], above[1], 0.0, 0.0, values[i][0], values[i][1]);
            for (int k = 0; k < KIN_LANES; ++k) {
                above[0][k] += polynomial[n][k];
            }
        }
        for (int j = 0; j < KIN_SHARING; ++j) {
            kin_pack apart[2];
            for (int k = 0; k < KIN_LANES; ++k) {
                apart[0][k] = values[i][0][k] - values[j][0][k];
                apart[1][k] = values[i][1][k] - values[j][1][k];
            }
            if (j != i) {
                kin_add_and_multiply(below[0], below[1], 0.0, 0.0, apart[0], apart[1]);
            }
        }
        KIN_EACH_LANE
        for (int k = 0; k < KIN_LANES; ++k) {
            const double x = below[0][k], y = below[1][k];
            const double share = 1.0 / kin_max(x * x + y * y, 1e-200);
            const double u = (above[0][k] * x + above[1][k] * y) * share;
            const double v = (above[1][k] * x - above[0][k] * y) * share;
            values[i][0][k] -= u;
            values[i][1][k] -= v;
            moved[k] = kin_max(kin_max(moved[k], fabs(u)), fabs(v));
        }
    }
}
KIN_BY_PROCESSOR(kin_part_roots, (kin_pack *polynomial, kin_pack values[][2], double *moved),
    (polynomial, values, moved))

/* The eigenvalues as roots of the characteristic polynomial, and by how much the last round moved one at
 * most. */
static void kin_values_of(kin_square given, kin_pack values[][2], double *moved)
{
    /* Points about the mean of the eigenvalues, none of which is another one's mirror image. */
    static const double points[KIN_SHARING][2] = {
        {0.921, 0.389}, {-0.416, 0.909}, {-0.936, -0.351}, {0.378, -0.926}};
    kin_square t;
    kin_pack mean, polynomial[KIN_SHARING];
    kin_copy_square(t, given);
    kin_fill(mean, 0.0);
    for (int i = 0; i < KIN_SHARING; ++i) {
        kin_plus_scaled(mean, given[i][i], 1.0 / KIN_SHARING);
    }
    for (int k = 0; k < KIN_LANES; ++k) {
        double square = 0.0, radius;
        for (int i = 0; i < KIN_SHARING; ++i) {
            t[i][i][k] -= mean[k];
            for (int j = 0; j < KIN_SHARING; ++j) {
                square += t[i][j][k] * t[i][j][k];
            }
        }
        radius = sqrt(square * (1.0 / KIN_SHARING));
        for (int i = 0; i < KIN_SHARING; ++i) {
            values[i][0][k] = radius * points[i][0];
            values[i][1][k] = radius * points[i][1];
        }
    }
    kin_characteristic(t, polynomial);
    for (int round = 0; round < KIN_ROUNDS; ++round) {
        kin_part_roots(polynomial, values, moved);
    }
    for (int i = 0; i < KIN_SHARING; ++i) {
        kin_plus_scaled(values[i][0], mean, 1.0);
    }
}

/* What is told of so many eigenvalues that are known but for an error, if the least pivot says that they
 * are told. */
static void kin_tell(kin_square of, int n, kin_pack values[][2], const double *error,
    const double *least, kin_eigenvalues *out)
{
    for (int k = 0; k < KIN_LANES; ++k) {
        double largest = 0.0, apart = HUGE_VAL, share;
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j < n; ++j) {
                const double x = values[i][0][k] - values[j][0][k];
                const double y = values[i][1][k] - values[j][1][k];
                const double distance = sqrt(x * x + y * y);
                largest = kin_max(largest, fabs(of[i][j][k]));
                /* Not a number takes its place. */
                apart = i == j || apart < distance ? apart : distance;
            }
        }
        share = error[k] < KIN_SETTLED * apart && !(least[k] < KIN_OF_FAMILY) ? 1.0 / largest : 0.0;
        for (int i = 0; i < n; ++i) {
            out->imaginary[i][k] = fabs(values[i][1][k]) * share;
        }
        out->apart[k] = apart * share;
    }
}

/* The vectors of monomials in a space of two or four, and what they are multiplied by; where two are
 * complex, one of a pair their real part, of more something else. */
static void kin_monomial_vectors(const kin_elimination *elimination, kin_pack space[][16], int n,
    int ratio, kin_pack out[][16], kin_eigenvalues *told)
{
    kin_square image, weights;
    kin_pack values[KIN_SHARING][2], error = {0.0}, least;
    kin_multiplication(elimination, space, n, ratio, image, least);
    if (n == 2) {
        kin_values_of_pair(image, values);
        kin_eigenvectors_of_pair(image, weights);
    } else {
        kin_values_of(image, values, error);
        for (int i = 0; i < n; ++i) {
            kin_eigenvector(image, values[i][0], weights[i]);
        }
    }
    kin_tell(image, n, values, error, least, told);
    for (int a = 0; a < n; ++a) {
        for (int i = 0; i < 16; ++i) {
            kin_fill(out[a][i], 0.0);
            for (int b = 0; b < n; ++b) {
                kin_plus(out[a][i], space[b][i], weights[a][b]);
            }
        }
    }
}
