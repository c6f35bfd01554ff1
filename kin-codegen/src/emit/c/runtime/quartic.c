/* A root of a trigonometric quartic. State: 0 for a root, 1 for a place that holds none, 2
 * for two or more roots that have met. */
typedef struct kin_root {
    double sine;
    double cosine;
    double state;
} kin_root;

/* f at an angle. */
static double kin_value(const double f[5], double s, double c)
{
    return f[0] * (c - s) * (c + s) + 2.0 * f[1] * s * c + f[2] * c + f[3] * s + f[4];
}

/* A unit vector turned by the Newton step rise / rate, at most a little. */
static void kin_nudge(double *s, double *c, double rise, double rate)
{
    const double square = rate * rate;
    const double half = 0.5 * (rise * rate / (square > 1e-200 ? square : 1e-200));
    /* Half the step's tangent keeps the point on the circle, but for h^6. */
    const double h = half < -0.025 ? -0.025 : half > 0.025 ? 0.025 : half;
    const double hh = h * h;
    const double scale = 1.0 - hh * (1.0 - hh);
    const double ds = 2.0 * h * scale, dc = (1.0 - hh) * scale;
    double turned_s, turned_c, norm;
    turned_s = *s * dc + *c * ds;
    turned_c = *c * dc - *s * ds;
    /* The root's reciprocal next to 1. */
    norm = 1.5 - 0.5 * (turned_s * turned_s + turned_c * turned_c);
    *s = turned_s * norm;
    *c = turned_c * norm;
}

/* Newton steps towards a root of f, given its derivative. */
static void kin_newton(const double f[5], const double slope[5], int steps, double *s, double *c)
{
    for (int i = 0; i < steps; ++i) {
        kin_nudge(s, c, -kin_value(f, *s, *c), kin_value(slope, *s, *c));
    }
}

/* The largest real root of m^3 + a m^2 + b m + c, which has one that is not negative. */
static double kin_largest_root(double a, double b, double c)
{
    const double shift = a / 3.0;
    const double p = (b - a * shift) / 3.0;
    const double q = 0.5 * (c + shift * (2.0 * shift * shift - b));
    const double discriminant = q * q + p * p * p;
    double y, m;
    if (discriminant > 0.0) {
        const double root = sqrt(discriminant);
        const double big = cbrt(q < 0.0 ? -q + root : -q - root);
        y = big != 0.0 ? big - p / big : 0.0;
    } else {
        const double radius = sqrt(-p > 0.0 ? -p : 0.0);
        double cosine = radius > 0.0 ? -q / (radius * radius * radius) : 1.0;
        cosine = cosine < -1.0 ? -1.0 : cosine > 1.0 ? 1.0 : cosine;
        y = 2.0 * radius * cos(acos(cosine) / 3.0);
    }
    m = y - shift;
    for (int i = 0; i < 3; ++i) {
        const double value = ((m + a) * m + b) * m + c;
        const double slope = (3.0 * m + 2.0 * a) * m + b;
        const double step = value / slope;
        if (fabs(slope) > 1e-300 && fabs(step) < 0.1 * (1.0 + fabs(m))) {
            m -= step;
        }
    }
    return m > 0.0 ? m : 0.0;
}

/* Newton on (t^2 + alpha t + beta)(t^2 + gamma t + delta) = t^4 + a t^3 + b t^2 + c t + d.
 * The factors stay as they are where they share a root. */
static void kin_refine_factors(const double of[4], double factors[2][2])
{
    for (int i = 0; i < 2; ++i) {
        const double alpha = factors[0][0], beta = factors[0][1];
        const double gamma = factors[1][0], delta = factors[1][1];
        const double e3 = alpha + gamma - of[0];
        const double e2 = beta + delta + alpha * gamma - of[1];
        const double e1 = alpha * delta + beta * gamma - of[2];
        const double e0 = beta * delta - of[3];
        const double apart = alpha - gamma, over = delta - beta;
        const double rest = alpha * e3 - e2;
        const double f = beta * e3 - alpha * rest - e1, g = -beta * rest - e0;
        const double corner = over + alpha * apart;
        const double resultant = corner * over + beta * apart * apart;
        const double size = over * over + (alpha * alpha + fabs(beta)) * apart * apart;
        if (fabs(resultant) > 1e-9 * size && size > 1e-200) {
            const double d_alpha = (f * over + g * apart) / resultant;
            const double d_beta = (corner * g - beta * apart * f) / resultant;
            factors[0][0] += d_alpha;
            factors[0][1] += d_beta;
            factors[1][0] -= e3 + d_alpha;
            factors[1][1] += rest - d_beta + apart * d_alpha;
        }
    }
}

/* t^2 + b t + c = 0, without cancellation. */
static void kin_quadratic(const double of[2], double t[2], int real[2])
{
    const double b = of[0], c = of[1];
    const double discriminant = 0.25 * b * b - c;
    const double root = sqrt(discriminant > 0.0 ? discriminant : 0.0);
    const double far_ = b < 0.0 ? -0.5 * b + root : -0.5 * b - root;
    const double near_ = fabs(far_) > 1e-150 ? c / far_ : 0.0;
    real[0] = real[1] = discriminant > -1e-7 * (1.0 + b * b + fabs(c));
    t[0] = far_;
    t[1] = discriminant > 0.0 ? near_ : far_;
}

/* t = tan(theta/2) for the roots of f, and whether they are real. */
static void kin_half_angles(const double f[5], double t[4], int real[4])
{
    /* (1 + t^2)^2 f(theta), highest power first. */
    const double lead = f[0] - f[2] + f[4];
    double of[4], factors[2][2];
    of[0] = (2.0 * f[3] - 4.0 * f[1]) / lead;
    of[1] = (2.0 * f[4] - 6.0 * f[0]) / lead;
    of[2] = (2.0 * f[3] + 4.0 * f[1]) / lead;
    of[3] = (f[0] + f[2] + f[4]) / lead;
    {
        /* Depressed: t = y - a/4, and split as (y^2 + s y + v)(y^2 - s y + u). */
        const double h = 0.25 * of[0];
        const double p = of[1] - 6.0 * h * h;
        const double q = of[2] - 2.0 * of[1] * h + 8.0 * h * h * h;
        const double r = of[3] - of[2] * h + of[1] * h * h - 3.0 * h * h * h * h;
        const double m = kin_largest_root(p, 0.25 * p * p - r, -0.125 * q * q);
        const double ss = 2.0 * m;
        const double s = sqrt(ss);
        const double sum = p + ss;
        const double square = sum * sum - 4.0 * r;
        const double width = sqrt(square > 0.0 ? square : 0.0);
        const double gap = q < 0.0 ? -width : width;
        const double v = 0.5 * (sum - gap), u = 0.5 * (sum + gap);
        factors[0][0] = s + 2.0 * h;
        factors[0][1] = v + h * (s + h);
        factors[1][0] = -s + 2.0 * h;
        factors[1][1] = u + h * (-s + h);
    }
    kin_refine_factors(of, factors);
    kin_quadratic(factors[0], t, real);
    kin_quadratic(factors[1], t + 2, real + 2);
}

/* The root of multiplicity 3 or 4 nearby, if there is one. */
static int kin_multiple(double d[5][5], double s, double c, int order, double *at_s, double *at_c)
{
    double height[5];
    int shallow;
    *at_s = s;
    *at_c = c;
    kin_newton(d[order - 1], d[order], 6, at_s, at_c);
    for (int i = 0; i < 5; ++i) {
        height[i] = fabs(kin_value(d[i], *at_s, *at_c));
    }
    if (order == 4) {
        shallow = height[1] * height[1] * height[1] * height[1] <= 1e-14 * 1e-14 * 1e-14 * height[4]
            && height[2] * height[2] <= 1e-14 * height[4];
    } else {
        shallow = height[1] * height[1] * height[1] <= 1e-14 * 1e-14 * height[3];
    }
    return fabs(*at_s - s) + fabs(*at_c - c) < 0.1 && height[0] < 1e-14 && shallow;
}

/* Newton on f as long as it brings f nearer to zero, and whether roots have met there. `d`
 * is f and its derivatives. */
static int kin_refine_root(double d[5][5], double *s, double *c)
{
    double y = kin_value(d[0], *s, *c);
    for (int i = 0; i < 6; ++i) {
        double trial_s = *s, trial_c = *c, trial_y;
        kin_nudge(&trial_s, &trial_c, -y, kin_value(d[1], *s, *c));
        trial_y = kin_value(d[0], trial_s, trial_c);
        if (fabs(trial_y) < fabs(y)) {
            *s = trial_s;
            *c = trial_c;
            y = trial_y;
        }
    }
    /* Elsewhere f is steeper or higher. */
    if (fabs(kin_value(d[1], *s, *c)) >= 1e-2 || fabs(y) >= 4e-3) {
        return 0;
    }
    for (int order = 4; order >= 3; --order) {
        double at_s, at_c;
        if (kin_multiple(d, *s, *c, order, &at_s, &at_c)) {
            *s = at_s;
            *c = at_c;
            return 1;
        }
    }
    {
        double at_s = *s, at_c = *c, height, bend;
        int missed, flat, met;
        kin_newton(d[1], d[2], 3, &at_s, &at_c);
        height = kin_value(d[0], at_s, at_c);
        bend = kin_value(d[2], at_s, at_c);
        missed = height * bend > 0.0 && fabs(height) < 1e-8;
        flat = fabs(kin_value(d[1], at_s, at_c)) < 2e-7
            && fabs(at_s - *s) + fabs(at_c - *c) < 1e-3;
        met = flat && (fabs(height) < 1e-14 || missed);
        if (met) {
            *s = at_s;
            *c = at_c;
        }
        return met;
    }
}

/* The direction, of eight, opposite to which |f| is largest. */
static void kin_best_reference(const double f[5], double *s, double *c)
{
    static const double h = 0.7071067811865476;
    const double directions[8][2] = {
        {0.0, 1.0}, {1.0, 0.0}, {0.0, -1.0}, {-1.0, 0.0}, {h, h}, {h, -h}, {-h, -h}, {-h, h}
    };
    double best = 0.0;
    *s = 0.0;
    *c = 1.0;
    for (int i = 0; i < 8; ++i) {
        const double size = fabs(kin_value(f, -directions[i][0], -directions[i][1]));
        if (size > best) {
            best = size;
            *s = directions[i][0];
            *c = directions[i][1];
        }
    }
}

/* The real roots of f = a2 cos 2x + b2 sin 2x + a1 cos x + b1 sin x + a0, given as
 * {a2, b2, a1, b1, a0}: up to four, each once, in four places (Ferrari, by the half-angle
 * substitution from where |f| is largest; each root refined on f itself). */
static void kin_trig_roots(const double of[5], kin_root roots[4])
{
    double scale = 0.0, d[5][5], turned[5], t[4], sin_, cos_, s2, c2;
    int real[4];
    for (int i = 0; i < 5; ++i) {
        scale = fabs(of[i]) > scale ? fabs(of[i]) : scale;
    }
    if (!(scale >= 2.2250738585072014e-308 && scale < 1e300)) {
        for (int i = 0; i < 4; ++i) {
            roots[i].sine = 0.0;
            roots[i].cosine = 1.0;
            roots[i].state = 1.0;
        }
        return;
    }
    for (int i = 0; i < 5; ++i) {
        d[0][i] = of[i] / scale;
    }
    for (int i = 1; i < 5; ++i) {
        d[i][0] = 2.0 * d[i - 1][1];
        d[i][1] = -2.0 * d[i - 1][0];
        d[i][2] = d[i - 1][3];
        d[i][3] = -d[i - 1][2];
        d[i][4] = 0.0;
    }
    kin_best_reference(d[0], &sin_, &cos_);
    s2 = 2.0 * sin_ * cos_;
    c2 = (cos_ - sin_) * (cos_ + sin_);
    turned[0] = d[0][0] * c2 + d[0][1] * s2;
    turned[1] = d[0][1] * c2 - d[0][0] * s2;
    turned[2] = d[0][2] * cos_ + d[0][3] * sin_;
    turned[3] = d[0][3] * cos_ - d[0][2] * sin_;
    turned[4] = d[0][4];
    kin_half_angles(turned, t, real);
    for (int i = 0; i < 4; ++i) {
        /* tan(theta/2) = t, turned back by the reference. */
        const double s = 2.0 * t[i] / (1.0 + t[i] * t[i]);
        const double c = (1.0 - t[i] * t[i]) / (1.0 + t[i] * t[i]);
        double height;
        int met;
        roots[i].sine = s * cos_ + c * sin_;
        roots[i].cosine = c * cos_ - s * sin_;
        met = kin_refine_root(d, &roots[i].sine, &roots[i].cosine);
        height = fabs(kin_value(d[0], roots[i].sine, roots[i].cosine));
        roots[i].state = met && height < 1e-8 ? 2.0 : !met && real[i] && height < 1e-12 ? 0.0 : 1.0;
    }
    /* Of roots that coincide the first is double and the others are none. */
    for (int i = 0; i < 4; ++i) {
        for (int j = i + 1; j < 4; ++j) {
            const double sine = fabs(roots[i].sine - roots[j].sine);
            const double cosine = fabs(roots[i].cosine - roots[j].cosine);
            if (roots[i].state != 1.0 && roots[j].state != 1.0
                && (sine > cosine ? sine : cosine) < 2e-7) {
                roots[i].state = 2.0;
                roots[j].state = 1.0;
            }
        }
    }
}
