/* The length of a vector. */
static double kin_norm(const double *x, int count)
{
    double square = 0.0;
    for (int i = 0; i < count; ++i) {
        square += x[i] * x[i];
    }
    return sqrt(square);
}
