/* The trigonometric polynomial of the cosines and sines of multiples of an angle. */
typedef struct kin_harmonics {
    int degree;
    double cosines[KIN_DEGREE + 1], sines[KIN_DEGREE + 1];
    /* How far values are off by rounding, if the largest harmonic is 1: as large as the harmonics
     * are that have to vanish, or more. */
    double noise;
    /* How far rounding of the target moves values, where that may be more. */
    double shift;
    /* What all are shares of, times the number of samples. */
    double size;
} kin_harmonics;

/* The sine of a part of a turn, from 0 to 191 of 192. */
KIN_INLINE double kin_sine_of_part(int part)
{
    return kin_cosines[part < 48 ? part + 144 : part - 48];
}

/* From values at equal distances: so many that some harmonics have to vanish. */
static void kin_transform(int degree, const double *values, int count, kin_harmonics *f)
{
    const int half = count / 2;
    double cosines[17] = {0.0}, sines[17] = {0.0}, largest = 0.0, vanishing = 0.0;
    for (int j = 0; j <= half; ++j) {
        /* Values mirrored at 0 and half a turn: even and odd parts. */
        const double mirrored = j == 0 || j == half ? 0.0 : values[count - j];
        const double even = values[j] + mirrored, odd = values[j] - mirrored;
        const int step = 192 / count * j;
        for (int k = 0, part = 0; k <= half; ++k) {
            cosines[k] += even * kin_cosines[part];
            sines[k] += odd * kin_sine_of_part(part);
            part += step;
            part -= part < 192 ? 0 : 192;
        }
    }
    f->degree = degree;
    for (int k = 0; k <= half; ++k) {
        const double a = cosines[k], b = sines[k];
        if (k > degree) {
            vanishing += a * a + b * b;
            continue;
        }
        f->cosines[k] = k == 0 ? a : 2.0 * a;
        f->sines[k] = k == 0 ? b : 2.0 * b;
        largest = fabs(a) > largest ? fabs(a) : largest;
        largest = fabs(b) > largest ? fabs(b) : largest;
    }
    for (int k = 0; k <= degree; ++k) {
        f->cosines[k] /= largest;
        f->sines[k] /= largest;
    }
    f->noise = sqrt(vanishing) / largest + 2.220446049250313e-16;
    f->shift = 0.0;
    f->size = largest;
}

/* Divides by 1 - cos(angle - fold): from the highest harmonic down, each is told by the two above
 * it; by how much the last ones miss is noise. */
static void kin_divide_by_fold(double fold, kin_harmonics *f)
{
    double s, c, above[2] = {0.0, 0.0}, here[2] = {0.0, 0.0}, largest = 0.0, missed;
    const int degree = f->degree;
    /* What stands where the result is written. */
    double given[2] = {f->cosines[degree], f->sines[degree]};
    kin_sin_cos(fold, &s, &c);
    /* Of exp(i k angle): half of what is of cos - i sin. */
    for (int k = degree; k > 0; --k) {
        const double x = here[0] - 0.5 * given[0], y = here[1] + 0.5 * given[1];
        const double u = c * above[0] - s * above[1], v = s * above[0] + c * above[1];
        const double below[2] = {
            2.0 * (c * x - s * y) - (c * u - s * v), 2.0 * (s * x + c * y) - (s * u + c * v)};
        const double share = k == 1 ? 1.0 : 2.0;
        for (int i = 0; i < 2; ++i) {
            above[i] = here[i];
            here[i] = below[i];
            largest = kin_max(largest, fabs(below[i]));
        }
        given[0] = f->cosines[k - 1];
        given[1] = f->sines[k - 1];
        f->cosines[k - 1] = share * below[0];
        f->sines[k - 1] = -share * below[1];
    }
    missed = fabs(here[0] - (c * above[0] - s * above[1]) - given[0]) + fabs(here[1]);
    f->sines[0] = 0.0;
    f->degree = degree > 0 ? degree - 1 : 0;
    for (int k = 0; k <= f->degree; ++k) {
        f->cosines[k] /= largest;
        f->sines[k] /= largest;
    }
    f->noise = (f->noise + missed) / largest;
}

/* f, f' and f'' at an angle. */
static void kin_derivatives(const kin_harmonics *f, double angle, double out[3])
{
    double sine, cosine, c = 1.0, s = 0.0;
    kin_sin_cos(angle, &sine, &cosine);
    out[0] = f->cosines[0];
    out[1] = out[2] = 0.0;
    for (int k = 1; k <= f->degree; ++k) {
        const double turned = c * cosine - s * sine, a = f->cosines[k], b = f->sines[k];
        s = s * cosine + c * sine;
        c = turned;
        out[0] += a * c + b * s;
        out[1] += k * (b * c - a * s);
        out[2] -= k * k * (a * c + b * s);
    }
}

/* f becomes f', with the noise of f. */
static void kin_differentiate(kin_harmonics *f)
{
    for (int k = 0; k <= f->degree; ++k) {
        const double cosine = f->cosines[k];
        f->cosines[k] = k * f->sines[k];
        f->sines[k] = -k * cosine;
    }
}

/* f and f' at some angles: Horner's rule in exp(i angle). */
KIN_INLINE void kin_value_and_slope(
    const kin_harmonics *f, const double *angle, double *value, double *slope)
{
    kin_pack sine, cosine, x, y, u, v;
    kin_sines_and_cosines(angle, sine, cosine);
    kin_fill(x, 0.0);
    kin_fill(y, 0.0);
    kin_fill(u, 0.0);
    kin_fill(v, 0.0);
    for (int order = f->degree; order > 0; --order) {
        const double a = f->cosines[order], b = -f->sines[order];
        for (int k = 0; k < KIN_LANES; ++k) {
            const double c = cosine[k], s = sine[k];
            const double x1 = x[k] + a, y1 = y[k] + b;
            const double u1 = u[k] - order * b, v1 = v[k] + order * a;
            x[k] = x1 * c - y1 * s;
            y[k] = x1 * s + y1 * c;
            u[k] = u1 * c - v1 * s;
            v[k] = u1 * s + v1 * c;
        }
    }
    for (int k = 0; k < KIN_LANES; ++k) {
        value[k] = x[k] + f->cosines[0];
        slope[k] = u[k];
    }
}
