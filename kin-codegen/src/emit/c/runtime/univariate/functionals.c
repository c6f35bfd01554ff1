/* The same in the frame of the kept joint, behind which no joint is given. */
static int kin_find_functionals(
    const kin_elimination *elimination, const double behind[12], double functionals[8][15],
    double third[2][15])
{
    (void)behind;
    return kin_own_functionals(elimination, functionals, third);
}
