/* The determinant as a polynomial in the joint that is kept: by reflections, or with the pivots
 * that were chosen for the arm. Its noise is no number where the target is none. */
KIN_INLINE void kin_sample(
    const kin_recovery *of, int reflected, kin_harmonics *f)
{
    const kin_elimination *elimination = of->elimination;
    const int degree = elimination->degree, count = degree <= 8 ? 24 : 32;
    double values[32];
    /* How fast the determinants change with the entries. */
    double slopes = 0.0;
    kin_pack largest[16], cosine, sine, inverse_norm;
    union {
        kin_factors factors;
        kin_triangle triangle;
    } matrices;
    for (int i = 0; i < 16; ++i) {
        kin_fill(largest[i], 0.0);
    }
    for (int first = 0; first < count; first += KIN_LANES) {
        double *determinants = values + first;
        for (int k = 0; k < KIN_LANES; ++k) {
            cosine[k] = kin_cosines[96 / count * (first + k)];
            sine[k] = kin_sine_of_part(96 / count * (first + k));
        }
        if (reflected) {
            kin_matrices(of, cosine, sine, matrices.triangle.rows);
            kin_triangulate(&matrices.triangle);
            kin_inverse_norm(&matrices.triangle, inverse_norm);
        } else {
            kin_factorize(of, cosine, sine, &matrices.factors);
            kin_fill(inverse_norm, 0.0);
        }
        /* Fifteen reflections have the determinant -1. */
        kin_fill(determinants, reflected ? -1.0 : 1.0);
        for (int i = 0; i < 16; ++i) {
            const double *pivot = reflected ? matrices.triangle.rows[i][i]
                : matrices.factors.rows[i][kin_pivot_column(i)];
            kin_times(determinants, pivot);
            kin_at_least(largest[i], pivot);
        }
        for (int k = 0; k < KIN_LANES; ++k) {
            slopes += fabs(determinants[k]) * inverse_norm[k];
        }
    }
    kin_transform(degree, values, count, f);
    f->shift = 2.220446049250313e-16 * slopes / f->size;
    /* What rounding leaves of a pivot that is zero for all angles may be the same for all, so that
     * the harmonics that have to vanish do. */
    for (int i = 0; i < 16; ++i) {
        double most = 0.0;
        for (int k = 0; k < KIN_LANES; ++k) {
            most = largest[i][k] > most ? largest[i][k] : most;
        }
        most = 2.220446049250313e-16 / most;
        f->noise = f->noise < most ? most : f->noise;
    }
    if (elimination->has_fold) {
        kin_divide_by_fold(elimination->fold, f);
    }
}

KIN_INLINE void kin_factored_polynomial_of(const kin_recovery *of, kin_harmonics *f)
{
    kin_sample(of, 0, f);
}
KIN_BY_PROCESSOR(kin_factored_polynomial, (const kin_recovery *of, kin_harmonics *f), (of, f))

KIN_INLINE void kin_reflected_polynomial_of(const kin_recovery *of, kin_harmonics *f)
{
    kin_sample(of, 1, f);
}
KIN_BY_PROCESSOR(kin_reflected_polynomial, (const kin_recovery *of, kin_harmonics *f), (of, f))

/* Above this noise no pivot can be trusted that was not chosen for the target. */
#define KIN_NOISY 3e-13

static void kin_polynomial(const kin_recovery *of, kin_harmonics *f)
{
    kin_factored_polynomial(of, f);
    if (!(f->noise < KIN_NOISY)) {
        kin_reflected_polynomial(of, f);
    }
}
