/* A line in space as fifteen numbers on which rigid motions act linearly: of a line through p
 * along l these are l, p, m = p x l, n = l (p.p) - 2 p (p.l), p.p, p.l and 1. */

/* The line after a rigid motion. */
static void kin_move_line(const double pose[12], double line[15])
{
    const double t[3] = {pose[3], pose[7], pose[11]};
    const double square = t[0] * t[0] + t[1] * t[1] + t[2] * t[2], one = line[14];
    double *l = line, *p = line + 3, *m = line + 6, *n = line + 9, along_line, along_point;
    for (int v = 0; v < 12; v += 3) {
        const double x = line[v], y = line[v + 1], z = line[v + 2];
        for (int i = 0; i < 3; ++i) {
            line[v + i] = pose[4 * i] * x + pose[4 * i + 1] * y + pose[4 * i + 2] * z;
        }
    }
    along_line = t[0] * l[0] + t[1] * l[1] + t[2] * l[2];
    along_point = t[0] * p[0] + t[1] * p[1] + t[2] * p[2];
    for (int i = 0; i < 3; ++i) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        const double across = t[a] * m[b] - t[b] * m[a];
        n[i] += square * l[i] - 2.0 * (across + t[i] * (line[13] + along_line));
    }
    for (int i = 0; i < 3; ++i) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        p[i] += t[i] * one;
        m[i] += t[a] * l[b] - t[b] * l[a];
    }
    line[12] += 2.0 * along_point + square * one;
    line[13] += along_line;
}

/* What a joint that goes back makes of some lines: behind the coefficients of 1 those of the
 * cosine and of the sine, or of a slide and its square. */
static void kin_go_back(int slides, double lines[9][15], int count)
{
    for (int k = 0; k < count; ++k) {
        double *at = lines[k], *second = lines[k + count], *third = lines[k + 2 * count];
        for (int i = 0; i < 15; ++i) {
            second[i] = third[i] = 0.0;
        }
        if (slides) {
            second[5] = -at[14];
            second[6] = at[1];
            second[7] = -at[0];
            second[9] = -2.0 * at[7];
            second[10] = 2.0 * at[6];
            second[11] = 2.0 * at[13];
            second[12] = -2.0 * at[5];
            second[13] = -at[2];
            third[9] = at[0];
            third[10] = at[1];
            third[11] = -at[2];
            third[12] = at[14];
            continue;
        }
        for (int v = 0; v < 12; v += 3) {
            second[v] = third[v + 1] = at[v];
            second[v + 1] = third[v] = at[v + 1];
            third[v + 1] = -third[v + 1];
            at[v] = at[v + 1] = 0.0;
        }
    }
}
