/* The motion back of a joint of value q: of its twist, linear and angular. */
static void kin_undo(const double twist[6], double q, double out[12])
{
    const double *v = twist, *w = twist + 3;
    const int turns = w[0] != 0.0 || w[1] != 0.0 || w[2] != 0.0;
    double sine = 0.0, cosine = 1.0, p[3];
    if (turns) {
        kin_sin_cos(-q, &sine, &cosine);
    }
    /* A point of the axis. */
    for (int i = 0; i < 3; ++i) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        p[i] = w[a] * v[b] - w[b] * v[a];
    }
    for (int i = 0; i < 3; ++i) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        for (int j = 0; j < 3; ++j) {
            out[4 * i + j] = (i == j ? cosine : 0.0) + (1.0 - cosine) * w[i] * w[j];
        }
        out[4 * i + b] += sine * w[a];
        out[4 * i + a] -= sine * w[b];
        out[4 * i + 3] = 0.0;
    }
    for (int i = 0; i < 3; ++i) {
        out[4 * i + 3] = turns
            ? p[i] - (out[4 * i] * p[0] + out[4 * i + 1] * p[1] + out[4 * i + 2] * p[2]) : -q * v[i];
    }
}
