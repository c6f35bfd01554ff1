/* Sine and cosine of x radians, within 1.5e-16 for |x| up to 1.6e6, without meaning beyond
 * 3e15: reduction by pi/2 in two parts (Cody and Waite), minimax polynomials. Without jumps, for
 * loops that become vector instructions. */
KIN_INLINE void kin_sin_cos(double x, double *sine, double *cosine)
{
    const double quarters = kin_round(x * 0.6366197723675814);
    const double halves = kin_round(0.5 * quarters);
    /* Of x = pi halves + pi/2 odd + r: whether halves is odd, 1 or -1; odd itself. */
    const double flips = halves - 2.0 * kin_round(0.5 * halves);
    const double odd = quarters - 2.0 * halves;
    const double sign = 1.0 - 2.0 * (flips * flips);
    const double even = 1.0 - odd * odd;
    const double r = (x - quarters * 1.5707963267341256) - quarters * 6.077100506506192e-11;
    {
        const double z = r * r;
        const double zz = z * z;
        const double s = (-0.1666666666666663 + z * 0.008333333333322118)
            + zz * ((-0.000198412698295886 + z * 2.7557313621048824e-6)
            + zz * (-2.5050747708379155e-8 + z * 1.589622690454601e-10));
        const double c = (0.0416666666666666 + z * -0.0013888888888874138)
            + zz * ((2.480158728949087e-5 + z * -2.7557314354952887e-7)
            + zz * (2.0875723643570178e-9 + z * -1.1359667673654324e-11));
        const double of_sine = r + r * (z * s);
        const double of_cosine = 1.0 - (0.5 * z - zz * c);
        *sine = sign * (even * of_sine + odd * of_cosine);
        *cosine = sign * (even * of_cosine - odd * of_sine);
    }
}
