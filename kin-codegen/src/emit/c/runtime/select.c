/* x where a < b, else y, also where a or b is NaN. Both are computed; as a mask where that
 * makes loops over lanes vector instructions, which a condition keeps GCC from. */
KIN_INLINE double kin_select(double a, double b, double x, double y)
{
#if defined(__GNUC__) && (defined(__x86_64__) || defined(__aarch64__))
    const unsigned long long mask = 0ULL - (unsigned long long)(a < b);
    unsigned long long bits, others;
    __builtin_memcpy(&bits, &x, sizeof bits);
    __builtin_memcpy(&others, &y, sizeof others);
    bits = (bits & mask) | (others & ~mask);
    __builtin_memcpy(&x, &bits, sizeof x);
    return x;
#else
    return a < b ? x : y;
#endif
}
