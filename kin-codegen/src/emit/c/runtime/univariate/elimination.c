/* What is left of the arm when all joints but one are eliminated. From the kept joint on, the
 * joints round the loop are kept, two of the constant side, one that leaves its own axis in
 * place, and the two that are eliminated in half tangents. The line of the fourth, as the two
 * before it move it, lies in a space of nine dimensions out of fifteen, or fewer: six linear
 * functionals or more vanish on it, and so along the other side of the loop (Raghavan and Roth,
 * J. Mechanical Design 115, 1993). */
typedef struct kin_elimination {
    /* In the order of the loop, the kept one first; whether that runs from tip to base. */
    int joints[6], backwards;
    /* Of the polynomial in the kept joint. */
    int degree;
    /* Whether a joint that is given stands between the kept one and the next. */
    int moved;
    /* The functionals in the frame of the kept joint: how many there are, and how many of them
     * are, in turn, real and imaginary parts of those that do not see what turns with
     * exp(-i angle). */
    int count, half;
    double functionals[8][15];
    /* Functionals that give the cosine and sine of the third joint, or its slide and the square
     * of that. */
    double third[2][15];
    /* Whether the axes of the joints beside the kept one coincide at a value of it, a double root
     * whatever the target; the value. */
    int has_fold;
    double fold;
    /* Up to these powers of the last joint's half tangent and the last but one's all monomials
     * are there. */
    int powers[2];
    /* Rows of the matrix: which functional, and by which half tangents it is multiplied: bit 0 of
     * the last joint, bit 1 of the last but one; functional 8 stands for a monomial. */
    unsigned char rows[16][2];
    /* In which column the monomial i + 4 j stands: the i-th power of the last joint's half
     * tangent times the j-th of the last but one. */
    unsigned char columns[16];
} kin_elimination;

/* What is solved: the constant motions between the six joints, lengths in units of half the arm's
 * size, and the target, orthonormal. */
typedef struct kin_problem {
    double fixed[7][12], target[12];
} kin_problem;
