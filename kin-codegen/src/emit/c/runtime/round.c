/* The integer nearest to x, of two the even one, for |x| < 2^51. */
KIN_INLINE double kin_round(double x)
{
    const double rounder = 6755399441055744.0; /* 1.5 * 2^52 */
    return (x + rounder) - rounder;
}
