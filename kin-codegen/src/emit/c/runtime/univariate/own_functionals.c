/* The functionals that an elimination has, how many there are, and what gives the third joint. */
static int kin_own_functionals(
    const kin_elimination *elimination, double functionals[8][15], double third[2][15])
{
    for (int k = 0; k < 15; ++k) {
        for (int i = 0; i < elimination->count; ++i) {
            functionals[i][k] = elimination->functionals[i][k];
        }
        third[0][k] = elimination->third[0][k];
        third[1][k] = elimination->third[1][k];
    }
    return elimination->count;
}
