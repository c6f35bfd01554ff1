/* The cross product. */
static void kin_cross(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        out[i] = a[j] * b[k] - a[k] * b[j];
    }
}

/* The motion along a twist: the linear part, and behind it the angular. */
static void kin_exp(const double twist[6], double out[12])
{
    const double *v = twist, *w = twist + 3;
    const double angle = kin_norm(w, 3);
    double sine, cosine, half, unused, b, c, once[3], curved[3];
    kin_sin_cos(angle, &sine, &cosine);
    kin_sin_cos(0.5 * angle, &half, &unused);
    half = angle > 0.0 ? half / (0.5 * angle) : 1.0;
    b = 0.5 * half * half;
    c = angle > 0.0 ? (angle - sine) / (angle * angle * angle) : 1.0 / 6.0;
    sine = angle > 0.0 ? sine / angle : 1.0;
    kin_cross(w, v, once);
    kin_cross(w, once, curved);
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        out[4 * i + i] = 1.0 - b * (w[j] * w[j] + w[k] * w[k]);
        out[4 * i + j] = b * w[i] * w[j] - sine * w[k];
        out[4 * i + k] = b * w[i] * w[k] + sine * w[j];
        out[4 * i + 3] = v[i] + b * once[i] + c * curved[i];
    }
}

/* The twist whose motion this is, of an angle in [0, pi]. */
static void kin_log(const double pose[12], double out[6])
{
    const double squares[4] = {
        1.0 + pose[0] - pose[5] - pose[10], 1.0 - pose[0] + pose[5] - pose[10],
        1.0 - pose[0] - pose[5] + pose[10], 1.0 + pose[0] + pose[5] + pose[10],
    };
    double quaternion[4], p[3], once[3], curved[3], sine, half, cotangent, factor, k;
    int most = 3;
    for (int i = 0; i < 3; ++i) {
        most = squares[i] > squares[most] ? i : most;
    }
    factor = 0.5 / sqrt(squares[most]);
    for (int i = 0; i < 3; ++i) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        const double skew = pose[4 * b + a] - pose[4 * a + b];
        const double even = pose[4 * i + most % 3] + pose[4 * (most % 3) + i];
        quaternion[i] = most == 3 ? factor * skew : factor * (i == most ? squares[most] : even);
        p[i] = pose[4 * i + 3];
        if (i == most) {
            quaternion[3] = factor * skew;
        }
    }
    if (most == 3) {
        quaternion[3] = factor * squares[3];
    }
    if (quaternion[3] < 0.0) {
        for (int i = 0; i < 4; ++i) {
            quaternion[i] = -quaternion[i];
        }
    }
    sine = kin_norm(quaternion, 3);
    half = kin_atan2(sine, quaternion[3]);
    factor = sine > 0.0 ? 2.0 * half / sine : 2.0;
    for (int i = 0; i < 3; ++i) {
        out[3 + i] = factor * quaternion[i];
    }
    cotangent = sine > 0.0 ? half * quaternion[3] / sine : 1.0;
    k = half > 0.0 ? (1.0 - cotangent) / (4.0 * half * half) : 1.0 / 12.0;
    kin_cross(out + 3, p, once);
    kin_cross(out + 3, once, curved);
    for (int i = 0; i < 3; ++i) {
        out[i] = p[i] - 0.5 * once[i] + k * curved[i];
    }
}
