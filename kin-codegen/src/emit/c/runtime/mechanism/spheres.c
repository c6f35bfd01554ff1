/* The points at some distances from three centres: two, mirror images in the plane of these; the
 * first is on the side that (c2 - c1) x (c3 - c1) points to. One where the spheres touch. How many
 * there are. */
static int kin_three_spheres(
    const double centres[9], const double radii[3], double points[6])
{
    double u[3], v[3], normal[3], x[3], beside_v[3], beside_u[3], size, square, a, b, height, up;
    for (int i = 0; i < 3; ++i) {
        u[i] = centres[3 + i] - centres[i];
        v[i] = centres[6 + i] - centres[i];
    }
    kin_cross(u, v, normal);
    square = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
    size = kin_max(kin_norm(u, 3), kin_norm(v, 3));
    size = kin_max(kin_max(size, radii[0]), kin_max(radii[1], radii[2]));
    if (!(sqrt(square) > 1e-12 * kin_norm(u, 3) * kin_norm(v, 3))) {
        return 0;
    }
    a = 0.5 * (kin_norm(u, 3) * kin_norm(u, 3) + (radii[0] - radii[1]) * (radii[0] + radii[1]));
    b = 0.5 * (kin_norm(v, 3) * kin_norm(v, 3) + (radii[0] - radii[2]) * (radii[0] + radii[2]));
    kin_cross(v, normal, beside_v);
    kin_cross(normal, u, beside_u);
    for (int i = 0; i < 3; ++i) {
        x[i] = (a * beside_v[i] + b * beside_u[i]) / square;
    }
    height = (radii[0] - kin_norm(x, 3)) * (radii[0] + kin_norm(x, 3));
    if (height < -1e-13 * size * size) {
        return 0;
    }
    up = height <= 1e-13 * size * size ? 0.0 : sqrt(height / square);
    for (int i = 0; i < 3; ++i) {
        points[i] = centres[i] + x[i] + up * normal[i];
        points[3 + i] = centres[i] + x[i] - up * normal[i];
    }
    return up > 0.0 ? 2 : 1;
}
