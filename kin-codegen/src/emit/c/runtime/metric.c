/* How far a pose is from a target. */
typedef struct kin_metric {
    /* The distance at which angles count as lengths, and by how much solutions may miss, metres. */
    double size;
    double tolerance;
    /* What of a target counts: of the rotation the direction of the axis. */
    int translation;
    int rotation;
    int axis;
} kin_metric;

/* How far the rotation of a target is from one, as far as it counts. */
static double kin_rotation_error(const kin_metric *by, const double target[12])
{
    double x[3], y[3], z[3], missing[6], square = 0.0;
    for (int i = 0; i < 3; ++i) {
        x[i] = target[4 * i];
        y[i] = target[4 * i + 1];
        z[i] = target[4 * i + 2];
    }
    if (by->axis) {
        return fabs(sqrt(z[0] * z[0] + z[1] * z[1] + z[2] * z[2]) - 1.0);
    }
    missing[0] = 0.5 * (x[0] * x[0] + x[1] * x[1] + x[2] * x[2] - 1.0);
    missing[1] = 0.5 * (y[0] * y[0] + y[1] * y[1] + y[2] * y[2] - 1.0);
    missing[2] = x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
    for (int i = 0; i < 3; ++i) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        missing[3 + i] = z[i] - (x[a] * y[b] - x[b] * y[a]);
    }
    for (int i = 0; i < 6; ++i) {
        square += missing[i] * missing[i];
    }
    return by->rotation ? sqrt(square) : 0.0;
}

/* Why a target has no solutions, by the codes of the header. */
static int kin_why_none(const kin_metric *by, const double target[12])
{
    for (int i = 0; i < 12; ++i) {
        const int counts = i % 4 == 3 ? by->translation : by->rotation;
        if (counts && !(fabs(target[i]) <= 1.7976931348623157e308)) {
            return -1;
        }
    }
    return kin_rotation_error(by, target) * by->size <= by->tolerance ? 0 : -2;
}
