/* The angle x, radians, moved by a multiple of 2 pi into (-pi, pi]. */
KIN_INLINE double kin_wrap(double x)
{
    const double pi = 3.141592653589793;
    const double turns = kin_round(x * 0.15915494309189535);
    double r = (x - turns * 6.2831853069365025) - turns * 2.430840202602477e-10;
    r = r > pi ? pi : r;
    return r <= -pi ? pi : r;
}
