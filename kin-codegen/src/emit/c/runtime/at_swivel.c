/* The half plane in which the swivel angle has the elbow: its direction across the line of shoulder and
 * wrist, and its normal, to which the angle grows; zeros where it is not defined. */
typedef struct kin_half_plane {
    double direction[3];
    double normal[3];
} kin_half_plane;

static void kin_unit(double v[3])
{
    const double length = kin_norm(v, 3);
    for (int i = 0; i < 3; ++i) {
        v[i] *= 1.0 / (length > 2.2250738585072014e-308 ? length : 2.2250738585072014e-308);
    }
}

static void kin_half_plane_of(const double target[12], double angle, kin_half_plane *plane)
{
    double way[3], aside[3], slope = 0.0, sine, cosine;
    kin_point(target, kin_wrist, way);
    for (int i = 0; i < 3; ++i) {
        way[i] -= kin_shoulder[i];
    }
    kin_unit(way);
    for (int i = 0; i < 3; ++i) {
        slope += kin_reference[i] * way[i];
    }
    for (int i = 0; i < 3; ++i) {
        aside[i] = kin_reference[i] - slope * way[i];
    }
    kin_unit(aside);
    kin_sin_cos(angle, &sine, &cosine);
    for (int i = 0; i < 3; ++i) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        const double beside = way[a] * aside[b] - way[b] * aside[a];
        plane->direction[i] = cosine * aside[i] + sine * beside;
        plane->normal[i] = cosine * beside - sine * aside[i];
    }
}

/* The elbow, and how far it is from the shoulder along a direction, metres. */
static double kin_elbow_along(
    const double q[KIN_JOINTS], const double direction[3], double elbow[3])
{
    double links[12 * KIN_JOINTS], along = 0.0;
    kin_fk_links(q, links);
    kin_point(links + 12 * KIN_ELBOW_LINK, kin_elbow, elbow);
    for (int i = 0; i < 3; ++i) {
        along += direction[i] * (elbow[i] - kin_shoulder[i]);
    }
    return along;
}

/* How far the elbow is from the plane, which is missing of it, and how the joints move it there. */
static double kin_beside_plane(const double *q, const void *given, double row[7])
{
    const double *const normal = ((const kin_half_plane *)given)->normal;
    double pose[12], jacobian[6 * KIN_JOINTS], elbow[3];
    const double off = kin_elbow_along(q, normal, elbow);
    kin_fk_jacobian(q, pose, jacobian);
    for (int k = 0; k < KIN_JOINTS; ++k) {
        row[k] = 0.0;
        for (int i = 0; i < 3 && k <= KIN_ELBOW_LINK; ++i) {
            const int a = (i + 1) % 3, b = (i + 2) % 3;
            row[k] += normal[i] * (jacobian[i * KIN_JOINTS + k]
                + (jacobian[(3 + a) * KIN_JOINTS + k] * elbow[b]
                - jacobian[(3 + b) * KIN_JOINTS + k] * elbow[a]));
        }
    }
    return -off;
}
