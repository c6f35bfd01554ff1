/* The swivel angle, by elbow and wrist in base coordinates: how far the elbow is turned about
 * the line from the shoulder to the wrist, from where the reference direction points. */
static double kin_swivel(const double elbow[3], const double wrist[3])
{
    double way[3], from[3], beside[3], ahead[3], sine = 0.0, cosine = 0.0;
    double length = 0.0, slope = 0.0;
    for (int i = 0; i < 3; ++i) {
        way[i] = wrist[i] - kin_shoulder[i];
        from[i] = elbow[i] - kin_shoulder[i];
        length += way[i] * way[i];
    }
    for (int i = 0; i < 3; ++i) {
        way[i] *= 1.0 / sqrt(length);
        slope += kin_reference[i] * way[i];
    }
    for (int i = 0; i < 3; ++i) {
        beside[i] = kin_reference[i] - slope * way[i];
    }
    for (int i = 0; i < 3; ++i) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        ahead[i] = way[a] * beside[b] - way[b] * beside[a];
        sine += ahead[i] * from[i];
        cosine += beside[i] * from[i];
    }
    return kin_atan2(sine, cosine);
}

/* A point of a body in base coordinates. */
static void kin_point(const double pose[12], const double point[3], double out[3])
{
    for (int i = 0; i < 3; ++i) {
        out[i] = pose[4 * i] * point[0] + pose[4 * i + 1] * point[1] + pose[4 * i + 2] * point[2]
            + pose[4 * i + 3];
    }
}
