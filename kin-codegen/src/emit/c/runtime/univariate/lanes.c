/* Configurations, or values of a joint, are worked on eight at once, one in each place of a
 * pack, in loops that become vector instructions. */
#define KIN_LANES 8
typedef double kin_pack[KIN_LANES];

/* In front of a loop over the places, which do not depend on each other. `restrict` would say too much:
 * where a function is inlined in a loop, GCC holds it of the packs of all rounds. */
#if defined(__clang__)
#define KIN_EACH_LANE _Pragma("clang loop vectorize(assume_safety)")
#elif defined(__GNUC__)
#define KIN_EACH_LANE _Pragma("GCC unroll 1") _Pragma("GCC ivdep")
#else
#define KIN_EACH_LANE
#endif

/* Defines a function by its inline body, `name`_of; in optimized code by wider vector instructions
 * where the processor has them and the compiler was not told to take them for granted, with the
 * same results. */
#if defined(__GNUC__) && defined(__OPTIMIZE__) && defined(__x86_64__) && !defined(__AVX2__)
#define KIN_BY_PROCESSOR(name, parameters, arguments) \
    static __attribute__((target("avx2"), noinline)) void name##_by_avx2 parameters \
    { \
        name##_of arguments; \
    } \
    static void name parameters \
    { \
        if (__builtin_cpu_supports("avx2")) { \
            name##_by_avx2 arguments; \
        } else { \
            name##_of arguments; \
        } \
    }
#else
#define KIN_BY_PROCESSOR(name, parameters, arguments) \
    static void name parameters \
    { \
        name##_of arguments; \
    }
#endif

KIN_INLINE void kin_fill(double *x, double value)
{
    for (int k = 0; k < KIN_LANES; ++k) {
        x[k] = value;
    }
}

KIN_INLINE void kin_copy(double *x, const double *a)
{
    KIN_EACH_LANE
    for (int k = 0; k < KIN_LANES; ++k) {
        x[k] = a[k];
    }
}

/* x += a b. */
KIN_INLINE void kin_plus(double *x, const double *a, const double *b)
{
    KIN_EACH_LANE
    for (int k = 0; k < KIN_LANES; ++k) {
        x[k] += a[k] * b[k];
    }
}

/* x -= a b. */
KIN_INLINE void kin_minus(double *x, const double *a, const double *b)
{
    KIN_EACH_LANE
    for (int k = 0; k < KIN_LANES; ++k) {
        x[k] -= a[k] * b[k];
    }
}

/* x += a b for the same b in all places. */
KIN_INLINE void kin_plus_scaled(double *x, const double *a, double b)
{
    KIN_EACH_LANE
    for (int k = 0; k < KIN_LANES; ++k) {
        x[k] += a[k] * b;
    }
}

/* x *= a. */
KIN_INLINE void kin_times(double *x, const double *a)
{
    KIN_EACH_LANE
    for (int k = 0; k < KIN_LANES; ++k) {
        x[k] *= a[k];
    }
}

/* x = max(x, |a|). */
KIN_INLINE void kin_at_least(double *x, const double *a)
{
    KIN_EACH_LANE
    for (int k = 0; k < KIN_LANES; ++k) {
        x[k] = kin_max(x[k], fabs(a[k]));
    }
}

/* 1/x, of an x that is nearer to 0 than `least` as if it were that far from it. */
KIN_INLINE void kin_reciprocals(double *out, const double *x, double least)
{
    KIN_EACH_LANE
    for (int k = 0; k < KIN_LANES; ++k) {
        out[k] = 1.0 / copysign(kin_max(fabs(x[k]), least), x[k]);
    }
}

/* The sum of n products. */
KIN_INLINE void kin_dot(double *out, kin_pack *a, kin_pack *b, int n)
{
    kin_fill(out, 0.0);
    for (int i = 0; i < n; ++i) {
        kin_plus(out, a[i], b[i]);
    }
}

/* Vectors by their lengths. */
KIN_INLINE void kin_normalize(kin_pack *x, int n)
{
    kin_pack share;
    kin_dot(share, x, x, n);
    for (int k = 0; k < KIN_LANES; ++k) {
        share[k] = 1.0 / sqrt(share[k]);
    }
    for (int i = 0; i < n; ++i) {
        kin_times(x[i], share);
    }
}

KIN_INLINE void kin_sines_and_cosines(const double *x, double *sine, double *cosine)
{
    KIN_EACH_LANE
    for (int k = 0; k < KIN_LANES; ++k) {
        kin_sin_cos(x[k], &sine[k], &cosine[k]);
    }
}

/* The angles of (cosine, sine) times any length. */
KIN_INLINE void kin_angles(double *out, const double *sine, const double *cosine)
{
    KIN_EACH_LANE
    for (int k = 0; k < KIN_LANES; ++k) {
        out[k] = kin_angle(sine[k], cosine[k]);
    }
}
