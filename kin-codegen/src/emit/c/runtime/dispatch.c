/* The lanes, in optimized code by wider vector instructions where the processor has them and the
 * compiler was not told to take them for granted; the results are the same. */
#if defined(__GNUC__) && defined(__OPTIMIZE__) && defined(__x86_64__) && !defined(__AVX2__)
static __attribute__((target("avx2"))) void kin_lanes_by_avx2(
    const double target[12], const double seed[KIN_SOLVED], const double *given, double free_below,
    kin_lanes *lanes)
{
    kin_lanes_of(target, seed, given, free_below, lanes);
}
#endif

static void kin_compute_lanes(
    const double target[12], const double seed[KIN_SOLVED], const double *given, double free_below,
    kin_lanes *lanes)
{
#if defined(__GNUC__) && defined(__OPTIMIZE__) && defined(__x86_64__) && !defined(__AVX2__)
    if (__builtin_cpu_supports("avx2")) {
        kin_lanes_by_avx2(target, seed, given, free_below, lanes);
        return;
    }
#endif
    kin_lanes_of(target, seed, given, free_below, lanes);
}
