/* Takes one more row into an upper triangle, by Givens rotations, and what stands beside the row
 * into what stands beside the triangle. */
static void kin_take_row(double *r, double *tails, double *row, double *tail, int n, int m)
{
    for (int i = 0; i < n; ++i) {
        const double a = r[n * i + i], b = row[i], length = sqrt(a * a + b * b);
        if (b == 0.0 || length == 0.0) {
            continue;
        }
        for (int j = i; j < n; ++j) {
            const double x = r[n * i + j], y = row[j];
            r[n * i + j] = a / length * x + b / length * y;
            row[j] = a / length * y - b / length * x;
        }
        for (int j = 0; j < m; ++j) {
            const double x = tails[m * i + j], y = tail[j];
            tails[m * i + j] = a / length * x + b / length * y;
            tail[j] = a / length * y - b / length * x;
        }
    }
}

/* The singular values of a square of n rows, which is used up, by one-sided Jacobi rotations (M. R.
 * Hestenes, J. SIAM 6, 1958): how long the rows are when all are orthogonal, the largest first. */
static void kin_singular_values(double *square, double *values, int n)
{
    double zero = 0.0;
    int turned = 1;
    for (int i = 0; i < n * n; ++i) {
        zero += square[i] * square[i];
    }
    zero *= 7.888609052210118e-31;
    for (int sweep = 0; sweep < 30 && turned; ++sweep) {
        turned = 0;
        for (int i = 0; i < n; ++i) {
            for (int j = i + 1; j < n; ++j) {
                double *const a = square + n * i, *const b = square + n * j;
                double aa = 0.0, bb = 0.0, ab = 0.0, zeta, tangent, cosine;
                for (int k = 0; k < n; ++k) {
                    aa += a[k] * a[k];
                    bb += b[k] * b[k];
                    ab += a[k] * b[k];
                }
                if (fabs(ab) <= 1.7763568394002505e-15 * sqrt(aa * bb) || aa <= zero || bb <= zero) {
                    continue;
                }
                zeta = (bb - aa) / (2.0 * ab);
                tangent = copysign(1.0, zeta) / (fabs(zeta) + sqrt(1.0 + zeta * zeta));
                cosine = 1.0 / sqrt(1.0 + tangent * tangent);
                for (int k = 0; k < n; ++k) {
                    const double x = a[k], y = b[k];
                    a[k] = cosine * x - cosine * tangent * y;
                    b[k] = cosine * tangent * x + cosine * y;
                }
                turned = 1;
            }
        }
    }
    for (int i = 0; i < n; ++i) {
        double sum = 0.0;
        int place = i;
        for (int k = 0; k < n; ++k) {
            sum += square[n * i + k] * square[n * i + k];
        }
        sum = sqrt(sum);
        for (; place > 0 && values[place - 1] < sum; --place) {
            values[place] = values[place - 1];
        }
        values[place] = sum;
    }
}
