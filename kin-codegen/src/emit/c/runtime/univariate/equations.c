/* One elimination at one target. */
typedef struct kin_recovery {
    const kin_elimination *elimination;
    /* The constant motions behind the joints in the order of the loop, and which slide. */
    double behind[6][12];
    int slides[6];
    /* The line of the fourth joint in the frame of the kept one, along the other side of the
     * loop: the coefficients of (1, cos, sin) of the last joint times those of the last but one,
     * which change fastest. */
    double far_side[9][15];
    /* What gives the third joint, in the frame of the kept one. */
    double third[2][15];
    /* By functional and monomial of the half tangents, the coefficients of 1, the cosine and the
     * sine of the kept joint; of the first ones, of its half. The last is that a monomial is 0. */
    double functionals[9][9][3];
    kin_places places;
} kin_recovery;

/* A functional on lines that turn back with the kept joint: what does not turn, and the
 * coefficients of its cosine and sine. */
static void kin_parts(const double functional[15], double lines[9][15], double parts[3][9])
{
    for (int k = 0; k < 9; ++k) {
        const double *line = lines[k];
        double fixed = 0.0, turning = 0.0, ahead = 0.0;
        for (int v = 0; v < 12; v += 3) {
            turning += functional[v] * line[v] + functional[v + 1] * line[v + 1];
            ahead += functional[v] * line[v + 1] - functional[v + 1] * line[v];
            fixed += functional[v + 2] * line[v + 2];
        }
        for (int i = 12; i < 15; ++i) {
            fixed += functional[i] * line[i];
        }
        parts[0][k] = fixed;
        parts[1][k] = turning;
        parts[2][k] = ahead;
    }
}

/* From (1, cos, sin) of a joint to the powers of its half tangent, times cos^2 of the half; a
 * slide's powers are monomials already. */
static void kin_to_powers(int slides, double *one, double *second, double *third)
{
    const double x = *one, cosine = *second, sine = *third;
    if (!slides) {
        *one = x + cosine;
        *second = 2.0 * sine;
        *third = x - cosine;
    }
}

/* The same of the last joint and the last but one; the powers of this change fastest then. */
static void kin_to_monomials(const int slides[6], double x[9])
{
    for (int i = 0; i < 3; ++i) {
        kin_to_powers(slides[4], &x[3 * i], &x[3 * i + 1], &x[3 * i + 2]);
    }
    for (int j = 0; j < 3; ++j) {
        kin_to_powers(slides[5], &x[j], &x[3 + j], &x[6 + j]);
    }
}

static void kin_close_loop(
    const kin_elimination *elimination, const kin_problem *problem, kin_recovery *loop)
{
    double back[12], rest[12], closing[12];
    kin_invert(problem->target, back);
    kin_compose(back, problem->fixed[0], rest);
    kin_compose(problem->fixed[6], rest, closing);
    for (int i = 0; i < 6; ++i) {
        const int joint = elimination->joints[i];
        const int at = elimination->backwards ? (joint + 5) % 6 : joint;
        const double *motion = at == 5 ? closing : problem->fixed[at + 1];
        if (elimination->backwards) {
            kin_invert(motion, loop->behind[i]);
        } else {
            for (int k = 0; k < 12; ++k) {
                loop->behind[i][k] = motion[k];
            }
        }
        loop->slides[i] = kin_slides[joint];
    }
}

static void kin_see_far_side(kin_recovery *loop)
{
    double back[12];
    for (int i = 0; i < 15; ++i) {
        loop->far_side[0][i] = i == 2 || i == 14 ? 1.0 : 0.0;
    }
    for (int joint = 3, count = 1; joint < 6; ++joint, count *= 3) {
        kin_invert(loop->behind[joint], back);
        for (int k = 0; k < count; ++k) {
            kin_move_line(back, loop->far_side[k]);
        }
        if (joint < 5) {
            kin_go_back(loop->slides[joint + 1], loop->far_side, count);
        }
    }
}

static void kin_begin_recovery(
    const kin_elimination *elimination, const kin_problem *problem, kin_recovery *out)
{
    double vanishing[8][15], parts[8][3][9];
    int count;
    out->elimination = elimination;
    kin_find_places(elimination, &out->places);
    kin_close_loop(elimination, problem, out);
    kin_see_far_side(out);
    count = kin_find_functionals(elimination, out->behind[0], vanishing, out->third);
    for (int i = 0; i < count; ++i) {
        kin_parts(vanishing[i], out->far_side, parts[i]);
    }
    /* Of a real and an imaginary part that do not see what turns with exp(-i angle), that the
     * product with exp(-i angle/2) vanishes. */
    for (int i = 0; i < elimination->half; i += 2) {
        double (*re)[9] = parts[i], (*im)[9] = parts[i + 1];
        for (int k = 0; k < 9; ++k) {
            re[2][k] = im[0][k] - im[1][k];
            im[2][k] = re[1][k] - re[0][k];
            re[1][k] += re[0][k];
            im[1][k] += im[0][k];
            re[0][k] = im[0][k] = 0.0;
        }
    }
    for (int i = 0; i < count; ++i) {
        for (int part = 0; part < 3; ++part) {
            kin_to_monomials(out->slides, parts[i][part]);
            for (int k = 0; k < 9; ++k) {
                out->functionals[i][k][part] = parts[i][part][k];
            }
        }
    }
    for (int k = 0; k < 9; ++k) {
        for (int part = 0; part < 3; ++part) {
            out->functionals[8][k][part] = k == 0 && part == 0 ? 1.0 : 0.0;
        }
    }
}
