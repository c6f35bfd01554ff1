/* What some vectors span: they are, in another order, upper triangular in an orthonormal basis,
 * the product of reflections, whose further vectors are at right angles to all of them. */
typedef struct kin_span {
    /* How many are independent, and which. */
    int rank;
    int taken[6];
    double lower[6][6];
    double reflections[6][6];
} kin_span;

static void kin_mirror(const double normal[6], double x[6])
{
    double twice = 0.0;
    for (int i = 0; i < 6; ++i) {
        twice += 2.0 * normal[i] * x[i];
    }
    for (int i = 0; i < 6; ++i) {
        x[i] -= twice * normal[i];
    }
}

/* A vector in the basis. */
static void kin_into(const kin_span *span, double x[6])
{
    for (int k = 0; k < span->rank; ++k) {
        kin_mirror(span->reflections[k], x);
    }
}

/* A vector of the basis. */
static void kin_out_of(const kin_span *span, double x[6])
{
    for (int k = span->rank - 1; k >= 0; --k) {
        kin_mirror(span->reflections[k], x);
    }
}

/* The span of columns, those of the joints from first to end that are passive, or of all but
 * `without`: the longest remainder first, and none that is rounding of the longest. */
static void kin_span_of(
    const double *columns, int first, int end, int passive, int without, kin_span *span)
{
    double longest = 0.0;
    span->rank = 0;
    for (int k = 0; k < 6; ++k) {
        double inside[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0}, most = -1.0, length, target, size;
        int chosen = first;
        for (int joint = first; joint < end; ++joint) {
            double x[6], square = 0.0;
            if (joint == without || (passive && kin_is_actuated(joint))) {
                continue;
            }
            for (int i = 0; i < 6; ++i) {
                x[i] = columns[6 * joint + i];
            }
            kin_into(span, x);
            for (int i = k; i < 6; ++i) {
                square += x[i] * x[i];
            }
            if (square > most) {
                most = square;
                chosen = joint;
                for (int i = 0; i < 6; ++i) {
                    inside[i] = x[i];
                }
            }
        }
        length = sqrt(most > 0.0 ? most : 0.0);
        longest = k == 0 ? length : longest;
        if (!(length > 1e-10 * longest)) {
            return;
        }
        target = inside[k] < 0.0 ? length : -length;
        size = sqrt(2.0 * target * (target - inside[k]));
        for (int i = 0; i < 6; ++i) {
            span->reflections[k][i] = i < k ? 0.0 : (inside[i] - (i == k ? target : 0.0)) / size;
            span->lower[k][i] = i < k ? inside[i] : (i == k ? target : 0.0);
        }
        span->taken[k] = chosen;
        span->rank = k + 1;
    }
}

/* The combination of the columns that comes nearest to a vector, added to `out` a part of it: the
 * coefficient of each joint that was taken. The largest of them, angles, or metres by the
 * mechanism's length. */
static double kin_coordinates(const kin_span *span, const double vector[6], double part, double *out)
{
    double x[6], largest = 0.0;
    for (int i = 0; i < 6; ++i) {
        x[i] = vector[i];
    }
    kin_into(span, x);
    for (int k = span->rank - 1; k >= 0; --k) {
        const int joint = span->taken[k];
        for (int j = k + 1; j < span->rank; ++j) {
            x[k] -= span->lower[j][k] * x[j];
        }
        x[k] /= span->lower[k][k];
        out[joint] += part * x[k];
        largest = kin_max(largest, fabs(x[k]) / (kin_turns[joint] ? 1.0 : KIN_LENGTH));
    }
    return largest;
}
