/* The turn of a free angle, radians, that leaves the next root the most room, from the level
 * d of its equation a cos x + b sin x = d at turns of 0, pi/2 and pi. */
static double kin_roomiest_turn(double here, double quarter, double half)
{
    const double mean = 0.5 * (here + half);
    const double cosine = 0.5 * (here - half), sine = quarter - mean;
    const double amplitude = sqrt(cosine * cosine + sine * sine);
    /* mean + cosine cos x + sine sin x = 0, or what comes nearest to it. */
    const double near_ = kin_max(amplitude + mean, 0.0), far_ = kin_max(amplitude - mean, 0.0);
    return kin_wrap(kin_atan2(sine, cosine) - 2.0 * kin_atan2(sqrt(near_), sqrt(far_)));
}
