/* The pose a b. */
static void kin_compose(const double a[12], const double b[12], double out[12])
{
    for (int i = 0; i < 12; i += 4) {
        for (int j = 0; j < 4; ++j) {
            out[i + j] = a[i] * b[j] + a[i + 1] * b[4 + j] + a[i + 2] * b[8 + j];
        }
        out[i + 3] += a[i + 3];
    }
}

/* The pose that a leads back from. */
static void kin_invert(const double a[12], double out[12])
{
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            out[4 * i + j] = a[4 * j + i];
        }
        out[4 * i + 3] = -(a[i] * a[3] + a[4 + i] * a[7] + a[8 + i] * a[11]);
    }
}
