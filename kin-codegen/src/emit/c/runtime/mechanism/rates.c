/* A configuration as its chains see it. Twists are compared at the platform's origin, angles
 * counted at the distance of the mechanism's length, so that all six coordinates are metres. */
typedef struct kin_seen {
    double poses[12 * KIN_CHAINS];
    /* Of each joint, displaced by those before it. */
    double columns[6 * KIN_JOINTS];
} kin_seen;

/* A spatial twist at the platform's origin, metres. */
static void kin_scaled(const double origin[12], const double twist[6], double out[6])
{
    const double at[3] = {origin[3], origin[7], origin[11]};
    kin_cross(twist + 3, at, out);
    for (int i = 0; i < 3; ++i) {
        out[i] += twist[i];
        out[3 + i] = KIN_LENGTH * twist[3 + i];
    }
}

/* The twist that is so scaled. */
static void kin_spatial(const double origin[12], const double scaled[6], double out[6])
{
    const double at[3] = {origin[3], origin[7], origin[11]};
    double w[3], moment[3];
    for (int i = 0; i < 3; ++i) {
        w[i] = scaled[3 + i] / KIN_LENGTH;
    }
    kin_cross(w, at, moment);
    for (int i = 0; i < 3; ++i) {
        out[i] = scaled[i] - moment[i];
        out[3 + i] = w[i];
    }
}

static void kin_see(const double q[KIN_JOINTS], kin_seen *seen)
{
    double twists[6 * KIN_JOINTS];
    kin_chain_twists(q, seen->poses, twists);
    for (int joint = 0; joint < KIN_JOINTS; ++joint) {
        kin_scaled(seen->poses, twists + 6 * joint, seen->columns + 6 * joint);
    }
}

/* How far the chains' ends are apart. */
static double kin_apart(const double *poses)
{
    double gap = 0.0;
    for (int chain = 1; chain < KIN_CHAINS; ++chain) {
        const double *const a = poses, *const b = poses + 12 * chain;
        double between[3][3], trace, apart[2];
        const double off[3] = {a[3] - b[3], a[7] - b[7], a[11] - b[11]};
        double skew[3];
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                between[i][j] = b[i] * a[j] + b[4 + i] * a[4 + j] + b[8 + i] * a[8 + j];
            }
        }
        trace = between[0][0] + between[1][1] + between[2][2];
        for (int i = 0; i < 3; ++i) {
            skew[i] = between[(i + 2) % 3][(i + 1) % 3] - between[(i + 1) % 3][(i + 2) % 3];
        }
        apart[0] = kin_norm(off, 3);
        apart[1] = KIN_LENGTH * kin_atan2(kin_norm(skew, 3), trace - 1.0);
        for (int i = 0; i < 2; ++i) {
            /* What is no number is no closed loop. */
            if (apart[i] != apart[i]) {
                return apart[i];
            }
            gap = apart[i] > gap ? apart[i] : gap;
        }
    }
    return gap;
}

/* All the wrenches that locked actuators bear, as a triangle, and beside it their products with
 * some vectors of each chain. Tells by how much more than six of them contradict each other. */
static double kin_wrenches(
    const kin_seen *seen, const double *beside, int count, double r[36], double *tails)
{
    double left = 0.0;
    for (int i = 0; i < 36; ++i) {
        r[i] = 0.0;
    }
    for (int i = 0; i < 6 * count; ++i) {
        tails[i] = 0.0;
    }
    for (int chain = 0; chain < KIN_CHAINS; ++chain) {
        kin_span span;
        kin_span_of(seen->columns, kin_chains[chain], kin_chains[chain + 1], 1, -1, &span);
        for (int i = span.rank; i < 6; ++i) {
            double row[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0}, tail[KIN_ACTUATED];
            row[i] = 1.0;
            kin_out_of(&span, row);
            for (int t = 0; t < count; ++t) {
                const double *const vector = beside + 6 * (count * chain + t);
                tail[t] = 0.0;
                for (int j = 0; j < 6; ++j) {
                    tail[t] += row[j] * vector[j];
                }
            }
            kin_take_row(r, tails, row, tail, 6, count);
            for (int t = 0; t < count; ++t) {
                left = kin_max(left, fabs(tail[t]));
            }
        }
    }
    return left;
}

/* Solves R x = b, of some b side by side; an x that R does not determine is 0. */
static void kin_back_substitute(const double r[36], const double *b, int count, int of, double x[6])
{
    for (int i = 5; i >= 0; --i) {
        double rest = b[count * i + of];
        for (int j = i + 1; j < 6; ++j) {
            rest -= r[6 * i + j] * x[j];
        }
        x[i] = fabs(r[6 * i + i]) > 1e-12 ? rest / r[6 * i + i] : 0.0;
    }
}

/* How well the chains hold the platform while the actuated joints are locked. */
static double kin_held(const kin_seen *seen)
{
    double r[36], values[6];
    kin_wrenches(seen, 0, 0, r, 0);
    kin_singular_values(r, values, 6);
    return values[5];
}

/* What unit rate of each actuated joint gives the platform, scaled. */
static int kin_moved(const kin_seen *seen, double motions[6 * KIN_ACTUATED])
{
    double beside[6 * KIN_CHAINS * KIN_ACTUATED], r[36], tails[6 * KIN_ACTUATED];
    if (!(kin_held(seen) >= 1e-9)) {
        return 0;
    }
    for (int chain = 0; chain < KIN_CHAINS; ++chain) {
        for (int a = 0; a < KIN_ACTUATED; ++a) {
            const int joint = kin_actuated[a];
            const int own = kin_chains[chain] <= joint && joint < kin_chains[chain + 1];
            for (int i = 0; i < 6; ++i) {
                beside[6 * (KIN_ACTUATED * chain + a) + i] = own ? seen->columns[6 * joint + i] : 0.0;
            }
        }
    }
    /* Where rates cannot be chosen freely, wrenches contradict each other. */
    if (!(kin_wrenches(seen, beside, KIN_ACTUATED, r, tails) <= 1e-4 * KIN_LENGTH)) {
        return 0;
    }
    for (int a = 0; a < KIN_ACTUATED; ++a) {
        kin_back_substitute(r, tails, KIN_ACTUATED, a, motions + 6 * a);
    }
    return 1;
}

void kin_chain_poses(const double q[KIN_JOINTS], double poses[12 * KIN_CHAINS])
{
    double twists[6 * KIN_JOINTS];
    kin_chain_twists(q, poses, twists);
}

void kin_structure_jacobian(const double q[KIN_JOINTS], double jacobian[6 * KIN_JOINTS])
{
    double poses[12 * KIN_CHAINS], twists[6 * KIN_JOINTS];
    kin_chain_twists(q, poses, twists);
    for (int joint = 0; joint < KIN_JOINTS; ++joint) {
        for (int i = 0; i < 6; ++i) {
            jacobian[KIN_JOINTS * i + joint] = twists[6 * joint + i];
        }
    }
}

double kin_gap(const double q[KIN_JOINTS])
{
    double poses[12 * KIN_CHAINS];
    kin_chain_poses(q, poses);
    return kin_apart(poses);
}

int kin_forward_jacobian(const double q[KIN_JOINTS], double jacobian[6 * KIN_ACTUATED])
{
    kin_seen seen;
    double motions[6 * KIN_ACTUATED];
    kin_see(q, &seen);
    if (!kin_moved(&seen, motions)) {
        return 0;
    }
    for (int a = 0; a < KIN_ACTUATED; ++a) {
        double twist[6];
        kin_spatial(seen.poses, motions + 6 * a, twist);
        for (int i = 0; i < 6; ++i) {
            jacobian[KIN_ACTUATED * i + a] = twist[i];
        }
    }
    return 1;
}

int kin_inverse_jacobian(const double q[KIN_JOINTS], double jacobian[6 * KIN_ACTUATED])
{
    kin_seen seen;
    double at[3];
    kin_see(q, &seen);
    for (int i = 0; i < 3; ++i) {
        at[i] = seen.poses[4 * i + 3];
    }
    for (int a = 0; a < KIN_ACTUATED; ++a) {
        const int joint = kin_actuated[a];
        const double *const own = seen.columns + 6 * joint;
        double rest[6], moment[3], square = 0.0, all = 0.0;
        kin_span span;
        int chain = 0;
        while (joint >= kin_chains[chain + 1]) {
            ++chain;
        }
        kin_span_of(seen.columns, kin_chains[chain], kin_chains[chain + 1], 0, joint, &span);
        for (int i = 0; i < 6; ++i) {
            rest[i] = own[i];
        }
        kin_into(&span, rest);
        for (int i = 0; i < span.rank; ++i) {
            rest[i] = 0.0;
        }
        kin_out_of(&span, rest);
        for (int i = 0; i < 6; ++i) {
            square += rest[i] * own[i];
            all += own[i] * own[i];
        }
        if (!(square > 1e-18 * all)) {
            return 0;
        }
        /* r . (v + w x p, l w) in terms of (v, w). */
        kin_cross(at, rest, moment);
        for (int i = 0; i < 3; ++i) {
            jacobian[6 * a + i] = rest[i] / square;
            jacobian[6 * a + 3 + i] = (moment[i] + KIN_LENGTH * rest[3 + i]) / square;
        }
    }
    return 1;
}

int kin_joint_rates(
    const double q[KIN_JOINTS], const double actuated[KIN_ACTUATED], double rates[KIN_JOINTS])
{
    kin_seen seen;
    double motions[6 * KIN_ACTUATED], velocity[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    kin_see(q, &seen);
    if (!kin_moved(&seen, motions)) {
        return 0;
    }
    for (int a = 0; a < KIN_ACTUATED; ++a) {
        for (int i = 0; i < 6; ++i) {
            velocity[i] += actuated[a] * motions[6 * a + i];
        }
    }
    for (int joint = 0; joint < KIN_JOINTS; ++joint) {
        rates[joint] = 0.0;
    }
    for (int a = 0; a < KIN_ACTUATED; ++a) {
        rates[kin_actuated[a]] = actuated[a];
    }
    for (int chain = 0; chain < KIN_CHAINS; ++chain) {
        kin_span span;
        double left[6];
        for (int i = 0; i < 6; ++i) {
            left[i] = velocity[i];
            for (int joint = kin_chains[chain]; joint < kin_chains[chain + 1]; ++joint) {
                left[i] -= rates[joint] * seen.columns[6 * joint + i];
            }
        }
        kin_span_of(seen.columns, kin_chains[chain], kin_chains[chain + 1], 1, -1, &span);
        kin_coordinates(&span, left, 1.0, rates);
    }
    return 1;
}

double kin_actuator_singularity(const double q[KIN_JOINTS])
{
    kin_seen seen;
    kin_see(q, &seen);
    return kin_held(&seen);
}

double kin_kinematic_singularity(const double q[KIN_JOINTS])
{
    kin_seen seen;
    double square[KIN_JOINTS * KIN_JOINTS], row[KIN_JOINTS], values[KIN_JOINTS];
    const int least = KIN_JOINTS - KIN_MOBILITY - 1;
    kin_see(q, &seen);
    for (int i = 0; i < KIN_JOINTS * KIN_JOINTS; ++i) {
        square[i] = 0.0;
    }
    for (int chain = 1; chain < KIN_CHAINS; ++chain) {
        for (int i = 0; i < 6; ++i) {
            for (int joint = 0; joint < KIN_JOINTS; ++joint) {
                const int own = kin_chains[chain] <= joint && joint < kin_chains[chain + 1];
                const double sign = joint < kin_chains[1] ? 1.0 : (own ? -1.0 : 0.0);
                row[joint] = sign * seen.columns[6 * joint + i];
            }
            kin_take_row(square, 0, row, 0, KIN_JOINTS, 0);
        }
    }
    kin_singular_values(square, values, KIN_JOINTS);
    return least >= 0 && values[0] > 0.0 ? values[least] / values[0] : 0.0;
}
