/* The functionals in the frame of the kept joint, how many there are, and what gives the third
 * joint. */
static int kin_find_functionals(
    const kin_elimination *elimination, const double behind[12], double functionals[8][15],
    double third[2][15])
{
    (void)behind;
    for (int k = 0; k < 15; ++k) {
        for (int i = 0; i < elimination->count; ++i) {
            functionals[i][k] = elimination->functionals[i][k];
        }
        third[0][k] = elimination->third[0][k];
        third[1][k] = elimination->third[1][k];
    }
    return elimination->count;
}
