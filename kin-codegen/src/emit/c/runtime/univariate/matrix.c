/* The equations of one row of the matrices, at values of the kept joint by the cosine and sine of its
 * half: where its entry i belongs, `place`[i] says. */
KIN_INLINE void kin_write_row(
    const kin_recovery *of, int row, const double *cosine, const double *sine, const int *place,
    kin_pack *out)
{
    const int equation = of->places.equation[row];
    const int is_half = equation < of->elimination->half;
    kin_pack c, s;
    KIN_EACH_LANE
    for (int k = 0; k < KIN_LANES; ++k) {
        const double whole = cosine[k] * cosine[k] - sine[k] * sine[k];
        const double twice = (cosine[k] + cosine[k]) * sine[k];
        c[k] = is_half ? cosine[k] : whole;
        s[k] = is_half ? sine[k] : twice;
    }
    for (int i = 0; i < 9; ++i) {
        const double *f = of->functionals[equation][i];
        const double one = f[0], a = f[1], b = f[2];
        double *entry = out[place[i]];
        KIN_EACH_LANE
        for (int k = 0; k < KIN_LANES; ++k) {
            entry[k] = one + a * c[k] + b * s[k];
        }
    }
}

/* The matrices. */
KIN_INLINE void kin_matrices(
    const kin_recovery *of, const double *cosine, const double *sine, kin_pack out[16][16])
{
    for (int row = 0; row < 16; ++row) {
        for (int column = 0; column < 16; ++column) {
            kin_fill(out[row][column], 0.0);
        }
        kin_write_row(of, row, cosine, sine, of->places.entries[row], out[row]);
    }
}

/* The same, of each row the twelve columns in which it may have entries. */
KIN_INLINE void kin_compact_matrices(
    const kin_recovery *of, const double *cosine, const double *sine, kin_pack out[16][12])
{
    for (int row = 0; row < 16; ++row) {
        for (int i = 0; i < 3; ++i) {
            kin_fill(out[row][of->places.empty[row][i]], 0.0);
        }
        kin_write_row(of, row, cosine, sine, of->places.compact[row], out[row]);
    }
}

/* The largest entry of the matrices times vectors, without its sign. */
KIN_INLINE void kin_misses(
    const kin_recovery *of, const double *cosine, const double *sine, kin_pack x[16], double *out)
{
    kin_fill(out, 0.0);
    for (int row = 0; row < 16; ++row) {
        static const int in_order[9] = {0, 1, 2, 3, 4, 5, 6, 7, 8};
        kin_pack entries[9], sum;
        kin_write_row(of, row, cosine, sine, in_order, entries);
        kin_fill(sum, 0.0);
        for (int i = 0; i < 9; ++i) {
            kin_plus(sum, entries[i], x[of->places.entries[row][i]]);
        }
        kin_at_least(out, sum);
    }
}
