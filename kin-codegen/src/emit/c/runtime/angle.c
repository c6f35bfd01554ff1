/* The angle of the vector (x, y) in (-pi, pi] radians, 0 for (0, 0), within 3.5e-16
 * relative: kin_atan2 for loops over lanes. */
KIN_INLINE double kin_angle(double y, double x)
{
    const double pi = 3.141592653589793;
    const double smallest = 4.9406564584124654e-324;
    const double ax = fabs(x);
    const double ay = fabs(y);
    const double large = kin_select(ax, ay, ay, ax);
    const double small_ = kin_select(ax, ay, ax, ay);
    const double diagonal = kin_select(0.4142135623730951 * large, small_, 1.0, 0.0);
    const double steep = kin_select(ax, ay, -1.0, 1.0);
    const double left = kin_select(x, 0.0, -1.0, 1.0);
    const double along = large + diagonal * small_;
    const double across = small_ - diagonal * large;
    const double t = across / kin_select(along, smallest, smallest, along);
    const double z = t * t;
    const double z2 = z * z;
    const double z4 = z2 * z2;
    const double low = (-0.33333333333330145 + z * 0.19999999999087453)
        + z2 * (-0.14285714195131147 + z * 0.11111106648068127);
    const double middle = (-0.09090782280478897 + z * 0.0769006640103143)
        + z2 * (-0.06641104411324127 + z * 0.05692449982584821);
    const double high = -0.04358835218285214 + z * 0.0212566297845034;
    const double octant = t + t * (z * (low + z4 * (middle + z4 * high)));
    const double flat = kin_select(steep, 0.0, 1.5707963267948966, 0.0);
    const double upright = kin_select(0.5, diagonal, 0.7853981633974483, flat);
    const double axis = fabs(upright - kin_select(left, 0.0, pi, 0.0));
    const double angle = copysign(axis + steep * left * octant, y);
    return kin_select(-pi, angle, angle, pi);
}
