/* A trigonometric polynomial on arcs of the circle: (1 + t^2)^degree times it is a polynomial in
 * t on each arc, here in Bernstein's basis. */
#define KIN_ARCS 16
#define KIN_COEFFICIENTS (2 * KIN_DEGREE + 1)
/* An arc is the angles middle + 2 atan t, |t| up to this: tan of a quarter of it. */
#define KIN_REACH 0.09849140335716425

typedef struct kin_arcs {
    double coefficients[KIN_COEFFICIENTS][KIN_ARCS];
    /* How many coefficients there are. */
    int count;
    /* The least of them, without its sign; how often their sign changes, and where it does last, as
     * a share of the arc. */
    double least[KIN_ARCS], changes[KIN_ARCS], share[KIN_ARCS];
} kin_arcs;

/* Where an arc has its middle: none ends at an angle that robots are sent to. */
static double kin_middle(int arc)
{
    return 0.0371 + 0.39269908169872414 * arc;
}

/* The harmonics turned to the middle of each arc. */
KIN_INLINE void kin_turn_to_arcs(
    const kin_harmonics *f, double even[KIN_DEGREE + 1][KIN_ARCS],
    double odd[KIN_DEGREE + 1][KIN_ARCS])
{
    /* The cosine and sine of k times the middle of the first arc. */
    double x = 1.0, y = 0.0;
    for (int k = 0; k <= f->degree; ++k) {
        const double a = f->cosines[k], b = f->sines[k], before = x;
        for (int arc = 0; arc < KIN_ARCS; ++arc) {
            const int part = 12 * (k * arc % KIN_ARCS);
            const double c = kin_cosines[part], s = kin_sine_of_part(part);
            const double cosine = c * x - s * y, sine = s * x + c * y;
            even[k][arc] = cosine * a + sine * b;
            odd[k][arc] = cosine * b - sine * a;
        }
        x = x * 0.9993118739340654 - y * 0.03709148978386511;
        y = before * 0.03709148978386511 + y * 0.9993118739340654;
    }
    for (int k = f->degree + 1; k <= KIN_DEGREE; ++k) {
        for (int arc = 0; arc < KIN_ARCS; ++arc) {
            even[k][arc] = odd[k][arc] = 0.0;
        }
    }
}

KIN_INLINE void kin_find_arcs_of(const kin_harmonics *f, kin_arcs *out)
{
    double even[KIN_DEGREE + 1][KIN_ARCS], odd[KIN_DEGREE + 1][KIN_ARCS];
    double before[KIN_ARCS], behind[KIN_ARCS], at[KIN_ARCS];
    /* The coefficients are linear in the turned harmonics: those of cosines the same from both
     * ends, those of sines the opposite. */
    const int last = f->degree <= 8 ? 8 : KIN_DEGREE;
    const double *basis = f->degree <= 8 ? kin_low_basis : kin_high_basis;
    kin_turn_to_arcs(f, even, odd);
    out->count = 2 * last + 1;
    for (int i = 0; i <= last; ++i) {
        double of_cosines[KIN_ARCS] = {0.0}, of_sines[KIN_ARCS] = {0.0};
        for (int k = 0; k <= last; ++k, basis += 2) {
            const double c = basis[0], s = basis[1];
            for (int arc = 0; arc < KIN_ARCS; ++arc) {
                of_cosines[arc] += even[k][arc] * c;
                of_sines[arc] += odd[k][arc] * s;
            }
        }
        for (int arc = 0; arc < KIN_ARCS; ++arc) {
            out->coefficients[i][arc] = of_cosines[arc] + of_sines[arc];
            out->coefficients[2 * last - i][arc] = of_cosines[arc] - of_sines[arc];
        }
    }
    for (int arc = 0; arc < KIN_ARCS; ++arc) {
        out->least[arc] = fabs(out->coefficients[0][arc]);
        out->changes[arc] = 0.0;
        before[arc] = 1.0;
        behind[arc] = at[arc] = 0.0;
    }
    for (int i = 1; i < out->count; ++i) {
        for (int arc = 0; arc < KIN_ARCS; ++arc) {
            const double a = out->coefficients[i - 1][arc], b = out->coefficients[i][arc];
            const double product = a * b;
            out->least[arc] = -kin_max(-out->least[arc], -fabs(b));
            out->changes[arc] += kin_select(product, 0.0, 1.0, 0.0);
            before[arc] = kin_select(product, 0.0, a, before[arc]);
            behind[arc] = kin_select(product, 0.0, b, behind[arc]);
            at[arc] = kin_select(product, 0.0, i - 1.0, at[arc]);
        }
    }
    for (int arc = 0; arc < KIN_ARCS; ++arc) {
        const double change = before[arc] / (before[arc] - behind[arc]);
        out->share[arc] = (at[arc] + change) / (out->count - 1.0);
    }
}
KIN_BY_PROCESSOR(kin_find_arcs, (const kin_harmonics *f, kin_arcs *out), (f, out))
