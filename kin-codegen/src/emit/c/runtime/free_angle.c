/* The turn of a free angle, radians, that leaves the next root the most room, from the level
 * d of its equation a cos x + b sin x = d at turns of 0, pi/2 and pi. */
static double kin_roomiest_turn(double here, double quarter, double half)
{
    const double pi = 3.141592653589793;
    const double mean = 0.5 * (here + half);
    const double cosine = 0.5 * (here - half), sine = quarter - mean;
    const double amplitude = sqrt(cosine * cosine + sine * sine);
    const double phase = kin_wrap(kin_atan2(sine, cosine));
    const double near_ = amplitude + mean, far_ = amplitude - mean;
    if (amplitude <= 0.0) {
        return 0.0;
    }
    if ((near_ < far_ ? near_ : far_) <= 1e-13 * (amplitude + fabs(mean))) {
        return near_ < far_ ? phase : kin_wrap(phase + pi);
    }
    return kin_wrap(phase - 2.0 * kin_atan2(sqrt(near_), sqrt(far_)));
}
