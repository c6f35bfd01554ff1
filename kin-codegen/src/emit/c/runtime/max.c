/* The larger of two numbers, the second where either is NaN. */
KIN_INLINE double kin_max(double a, double b)
{
    return kin_select(b, a, a, b);
}
