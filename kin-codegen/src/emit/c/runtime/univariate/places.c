/* Where the equations stand in the matrix whose determinant is the polynomial. A row may have
 * entries in twelve columns: the first four, of monomials that no row that is multiplied by the
 * last joint's half tangent has, or the next four, of those that no other row has, and the last
 * eight. */
typedef struct kin_places {
    int equation[16];
    /* The columns of a row's entries; their places among its twelve, and those where it has
     * none. */
    int entries[16][9], compact[16][9], empty[16][3];
    /* Bit i is set where row i is multiplied by the last joint's half tangent. */
    unsigned shifted;
} kin_places;

/* A row with a single entry. */
static void kin_place_alone(int column, int entries[9], int empty[3])
{
    const int first = column >= 4 && column < 8 ? 4 : 0;
    int count = 1;
    entries[0] = column;
    for (int i = 0; i < 12; ++i) {
        const int other = i < 4 ? first + i : i + 4;
        if (other != column) {
            *(count < 9 ? &entries[count] : &empty[count - 9]) = other;
            ++count;
        }
    }
}

static void kin_find_places(const kin_elimination *elimination, kin_places *out)
{
    out->shifted = 0;
    for (int row = 0; row < 16; ++row) {
        const int shift = elimination->rows[row][1], i0 = shift & 1, j0 = shift >> 1 & 1;
        const unsigned char *columns = elimination->columns;
        out->equation[row] = elimination->rows[row][0];
        if (out->equation[row] == 8) {
            const int column = columns[shift & 15];
            kin_place_alone(column, out->entries[row], out->empty[row]);
            out->shifted |= (unsigned)(column >= 4 && column < 8) << row;
        } else {
            out->shifted |= (unsigned)i0 << row;
            for (int i = 0; i < 3; ++i) {
                for (int j = 0; j < 3; ++j) {
                    out->entries[row][3 * i + j] = columns[i + i0 + 4 * (j + j0)];
                }
                out->empty[row][i] = columns[i + i0 + 4 * (3 * (1 - j0))];
            }
        }
        for (int i = 0; i < 9; ++i) {
            out->compact[row][i] = out->entries[row][i] - (out->entries[row][i] > 3 ? 4 : 0);
        }
        for (int i = 0; i < 3; ++i) {
            out->empty[row][i] -= out->empty[row][i] > 3 ? 4 : 0;
        }
    }
}
