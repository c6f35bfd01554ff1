/* Some functionals on lines as seen behind a motion, on those in front of it. */
static void kin_see_in_front(
    const double motion[12], const double behind[][15], int count, double front[][15])
{
    double back[12];
    kin_invert(motion, back);
    for (int k = 0; k < 15; ++k) {
        double line[15] = {0.0};
        line[k] = 1.0;
        kin_move_line(back, line);
        for (int n = 0; n < count; ++n) {
            front[n][k] = 0.0;
            for (int i = 0; i < 15; ++i) {
                front[n][k] += behind[n][i] * line[i];
            }
        }
    }
}

/* From a complex number, the product of two others. */
static void kin_take_product(double from[2], const double x[2], const double y[2])
{
    const double re = x[0] * y[0] - x[1] * y[1], im = x[0] * y[1] + x[1] * y[0];
    from[0] -= re;
    from[1] -= im;
}

static void kin_to_unit(double vector[6][2])
{
    double square = 0.0;
    for (int j = 0; j < 6; ++j) {
        square += vector[j][0] * vector[j][0] + vector[j][1] * vector[j][1];
    }
    for (int j = 0; j < 6; ++j) {
        vector[j][0] /= sqrt(square);
        vector[j][1] /= sqrt(square);
    }
}

/* Brings the largest entry of the rows from k on to row k and divides this by it, and takes its
 * multiples from the other rows; the column, which no other pivot has. */
static int kin_eliminate_row(double rows[4][6][2], int k, const int is_pivot[6])
{
    double largest = -1.0, inverse[2];
    int row = k, column = 0;
    for (int i = k; i < 4; ++i) {
        for (int j = 0; j < 6; ++j) {
            const double *x = rows[i][j];
            const double square = x[0] * x[0] + x[1] * x[1];
            if (square > largest && !is_pivot[j]) {
                row = i;
                column = j;
                largest = square;
            }
        }
    }
    inverse[0] = rows[row][column][0] / kin_max(largest, 1e-60);
    inverse[1] = -rows[row][column][1] / kin_max(largest, 1e-60);
    for (int j = 0; j < 6; ++j) {
        const double x[2] = {rows[row][j][0], rows[row][j][1]};
        rows[row][j][0] = rows[k][j][0];
        rows[row][j][1] = rows[k][j][1];
        rows[k][j][0] = inverse[0] * x[0] - inverse[1] * x[1];
        rows[k][j][1] = inverse[0] * x[1] + inverse[1] * x[0];
    }
    for (int i = 0; i < 4; ++i) {
        const double by[2] = {rows[i][column][0], rows[i][column][1]};
        for (int j = 0; j < 6 && i != k; ++j) {
            kin_take_product(rows[i][j], by, rows[k][j]);
        }
    }
    return column;
}

/* The complex weights of the combinations of six functionals that do not see what turns with
 * exp(-i angle), at right angles to each other and of length 1. */
static void kin_find_unseen(double functionals[6][15], double weights[2][6][2])
{
    double seen[4][6][2], along[2] = {0.0, 0.0};
    int pivots[4], is_pivot[6] = {0};
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 6; ++j) {
            seen[i][j][0] = functionals[j][3 * i];
            seen[i][j][1] = -functionals[j][3 * i + 1];
        }
    }
    for (int k = 0; k < 4; ++k) {
        pivots[k] = kin_eliminate_row(seen, k, is_pivot);
        is_pivot[pivots[k]] = 1;
    }
    for (int n = 0, free = 0; n < 2; ++n, ++free) {
        while (free < 5 && is_pivot[free]) {
            ++free;
        }
        for (int j = 0; j < 6; ++j) {
            weights[n][j][0] = j == free ? 1.0 : 0.0;
            weights[n][j][1] = 0.0;
        }
        for (int k = 0; k < 4; ++k) {
            weights[n][pivots[k]][0] = -seen[k][free][0];
            weights[n][pivots[k]][1] = -seen[k][free][1];
        }
    }
    kin_to_unit(weights[0]);
    for (int j = 0; j < 6; ++j) {
        const double *x = weights[0][j], *y = weights[1][j];
        along[0] += x[0] * y[0] + x[1] * y[1];
        along[1] += x[0] * y[1] - x[1] * y[0];
    }
    for (int j = 0; j < 6; ++j) {
        kin_take_product(weights[1][j], along, weights[0][j]);
    }
    kin_to_unit(weights[1]);
}

/* The functionals in the frame of the kept joint, how many there are, and what gives the third
 * joint, where a joint that is given may stand behind the kept one: those that half the angle is
 * enough for depend on its value. */
static int kin_find_functionals(
    const kin_elimination *elimination, const double behind[12], double functionals[8][15],
    double third[2][15])
{
    double six[6][15], weights[2][6][2];
    if (!elimination->moved) {
        return kin_own_functionals(elimination, functionals, third);
    }
    kin_see_in_front(behind, elimination->third, 2, third);
    kin_see_in_front(behind, elimination->functionals, 6, six);
    kin_find_unseen(six, weights);
    for (int i = 0; i < 4; ++i) {
        for (int k = 0; k < 15; ++k) {
            functionals[i][k] = 0.0;
            for (int j = 0; j < 6; ++j) {
                functionals[i][k] += weights[i / 2][j][i % 2] * six[j][k];
            }
        }
    }
    return 4;
}
