/* The angle of the vector (x, y) in [-pi, pi] radians, within 3.3e-16 relative. */
KIN_INLINE double kin_atan2(double y, double x)
{
    const double smallest = 4.9406564584124654e-324;
    const double ax = fabs(x);
    const double ay = fabs(y);
    const double large = ay > ax ? ay : ax;
    const double small_ = ay > ax ? ax : ay;
    const int past_quarter = 0.25 * large < small_;
    const int past_three_quarters = 0.75 * large < small_;
    const double center = (past_quarter ? 0.5 : 0.0) + (past_three_quarters ? 0.5 : 0.0);
    const double head = (past_quarter ? 0.4636476090008061 : 0.0)
        + (past_three_quarters ? 0.7853981633974483 - 0.4636476090008061 : 0.0);
    const double tail = (past_quarter ? 2.2698777452961687e-17 : 0.0)
        + (past_three_quarters ? 3.061616997868383e-17 - 2.2698777452961687e-17 : 0.0);
    const double below = large + center * small_;
    const double t = (small_ - center * large) / (below > smallest ? below : smallest);
    const double z = t * t;
    const double zz = z * z;
    const double low = (-0.33333333333332543 + z * 0.19999999999588905)
        + zz * (-0.14285714212326123 + z * 0.11111104766168227);
    const double high = (-0.09090604830403615 + z * 0.07683764998433239)
        + zz * (-0.0652617146549674 + z * 0.046093150867149844);
    const double octant = tail + (t + t * (z * (low + zz * zz * high)));
    /* angle = axis +- (head + octant), with the sign and the axis of the sector. */
    const int steep = ax < ay;
    const int left = x < 0.0;
    const double axis = (steep ? 1.5707963267948966 : 0.0)
        + (left && !steep ? 3.141592653589793 : 0.0);
    const double way = steep != left ? -1.0 : 1.0;
    const double offset = head + (octant + way * (axis * 3.898171832295186e-17));
    return copysign(axis + way * offset, y);
}
