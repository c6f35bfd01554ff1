/* f = a2 cos 2x + b2 sin 2x + a1 cos x + b1 sin x + a0 at an angle. */
const $value = (f, s, c) =>
    f[0] * (c - s) * (c + s) + 2.0 * f[1] * s * c + f[2] * c + f[3] * s + f[4];

/* A unit vector turned by the Newton step rise / rate, at most a little. */
const $nudge = ([s, c], rise, rate) => {
    const square = rate * rate;
    const half = 0.5 * ((rise * rate) / (square > 1e-200 ? square : 1e-200));
    /* Half the step's tangent keeps the point on the circle, but for h^6. */
    const h = half < -0.025 ? -0.025 : half > 0.025 ? 0.025 : half;
    const hh = h * h;
    const scale = 1.0 - hh * (1.0 - hh);
    const ds = 2.0 * h * scale;
    const dc = (1.0 - hh) * scale;
    const turned_s = s * dc + c * ds;
    const turned_c = c * dc - s * ds;
    /* The root's reciprocal next to 1. */
    const norm = 1.5 - 0.5 * (turned_s * turned_s + turned_c * turned_c);
    return [turned_s * norm, turned_c * norm];
};

/* Newton steps towards a root of f, given its derivative. */
const $newton = (f, slope, steps, from) => {
    let at = from;
    for (let i = 0; i < steps; ++i) {
        at = $nudge(at, -$value(f, at[0], at[1]), $value(slope, at[0], at[1]));
    }
    return at;
};

/* The largest real root of m^3 + a m^2 + b m + c, which has one that is not negative. */
const $largest_root = (a, b, c) => {
    const shift = a / 3.0;
    const p = (b - a * shift) / 3.0;
    const q = 0.5 * (c + shift * (2.0 * shift * shift - b));
    const discriminant = q * q + p * p * p;
    let y;
    if (discriminant > 0.0) {
        const root = Math.sqrt(discriminant);
        const big = Math.cbrt(q < 0.0 ? -q + root : -q - root);
        y = big !== 0.0 ? big - p / big : 0.0;
    } else {
        const radius = Math.sqrt(-p > 0.0 ? -p : 0.0);
        const cosine = radius > 0.0 ? -q / (radius * radius * radius) : 1.0;
        const inside = cosine < -1.0 ? -1.0 : cosine > 1.0 ? 1.0 : cosine;
        y = 2.0 * radius * Math.cos(Math.acos(inside) / 3.0);
    }
    let m = y - shift;
    for (let i = 0; i < 3; ++i) {
        const value = ((m + a) * m + b) * m + c;
        const slope = (3.0 * m + 2.0 * a) * m + b;
        const step = value / slope;
        if (Math.abs(slope) > 1e-300 && Math.abs(step) < 0.1 * (1.0 + Math.abs(m))) {
            m -= step;
        }
    }
    return m > 0.0 ? m : 0.0;
};

/* Newton on (t^2 + alpha t + beta)(t^2 + gamma t + delta) = t^4 + a t^3 + b t^2 + c t + d.
 * The factors stay as they are where they share a root. */
const $refine_factors = (of, factors) => {
    for (let i = 0; i < 2; ++i) {
        const [[alpha, beta], [gamma, delta]] = factors;
        const e3 = alpha + gamma - of[0];
        const e2 = beta + delta + alpha * gamma - of[1];
        const e1 = alpha * delta + beta * gamma - of[2];
        const e0 = beta * delta - of[3];
        const apart = alpha - gamma;
        const over = delta - beta;
        const rest = alpha * e3 - e2;
        const f = beta * e3 - alpha * rest - e1;
        const g = -beta * rest - e0;
        const corner = over + alpha * apart;
        const resultant = corner * over + beta * apart * apart;
        const size = over * over + (alpha * alpha + Math.abs(beta)) * apart * apart;
        if (Math.abs(resultant) > 1e-9 * size && size > 1e-200) {
            const d_alpha = (f * over + g * apart) / resultant;
            const d_beta = (corner * g - beta * apart * f) / resultant;
            factors[0][0] += d_alpha;
            factors[0][1] += d_beta;
            factors[1][0] -= e3 + d_alpha;
            factors[1][1] += rest - d_beta + apart * d_alpha;
        }
    }
};

/* The roots of t^2 + b t + c = 0, without cancellation, and whether they are real. */
const $quadratic = ([b, c]) => {
    const discriminant = 0.25 * b * b - c;
    const root = Math.sqrt(discriminant > 0.0 ? discriminant : 0.0);
    const far = b < 0.0 ? -0.5 * b + root : -0.5 * b - root;
    const near = Math.abs(far) > 1e-150 ? c / far : 0.0;
    const real = discriminant > -1e-7 * (1.0 + b * b + Math.abs(c));
    return [{ t: far, real }, { t: discriminant > 0.0 ? near : far, real }];
};

/* t = tan(theta/2) for the roots of f, and whether they are real. */
const $half_angles = (f) => {
    /* (1 + t^2)^2 f(theta), highest power first. */
    const lead = f[0] - f[2] + f[4];
    const of = [
        (2.0 * f[3] - 4.0 * f[1]) / lead,
        (2.0 * f[4] - 6.0 * f[0]) / lead,
        (2.0 * f[3] + 4.0 * f[1]) / lead,
        (f[0] + f[2] + f[4]) / lead,
    ];
    /* Depressed: t = y - a/4, and split as (y^2 + s y + v)(y^2 - s y + u). */
    const h = 0.25 * of[0];
    const p = of[1] - 6.0 * h * h;
    const q = of[2] - 2.0 * of[1] * h + 8.0 * h * h * h;
    const r = of[3] - of[2] * h + of[1] * h * h - 3.0 * h * h * h * h;
    const m = $largest_root(p, 0.25 * p * p - r, -0.125 * q * q);
    const ss = 2.0 * m;
    const s = Math.sqrt(ss);
    const sum = p + ss;
    const square = sum * sum - 4.0 * r;
    const width = Math.sqrt(square > 0.0 ? square : 0.0);
    const gap = q < 0.0 ? -width : width;
    const v = 0.5 * (sum - gap);
    const u = 0.5 * (sum + gap);
    const factors = [[s + 2.0 * h, v + h * (s + h)], [-s + 2.0 * h, u + h * (-s + h)]];
    $refine_factors(of, factors);
    return [...$quadratic(factors[0]), ...$quadratic(factors[1])];
};

/* The root of multiplicity 3 or 4 next to a point, if there is one. `d` is f and its
 * derivatives. */
const $multiple = (d, from, order) => {
    const at = $newton(d[order - 1], d[order], 6, from);
    const height = d.map((f) => Math.abs($value(f, at[0], at[1])));
    const shallow = order === 4
        ? height[1] * height[1] * height[1] * height[1] <= 1e-14 * 1e-14 * 1e-14 * height[4]
            && height[2] * height[2] <= 1e-14 * height[4]
        : height[1] * height[1] * height[1] <= 1e-14 * 1e-14 * height[3];
    const apart = Math.abs(at[0] - from[0]) + Math.abs(at[1] - from[1]);
    return apart < 0.1 && height[0] < 1e-14 && shallow ? at : null;
};

/* Newton on f as long as it brings f nearer to zero, and whether roots have met there. */
const $refine_root = (d, from) => {
    let at = from;
    let y = $value(d[0], at[0], at[1]);
    for (let i = 0; i < 6; ++i) {
        const trial = $nudge(at, -y, $value(d[1], at[0], at[1]));
        const trial_y = $value(d[0], trial[0], trial[1]);
        if (Math.abs(trial_y) < Math.abs(y)) {
            at = trial;
            y = trial_y;
        }
    }
    /* Elsewhere f is steeper or higher. */
    if (Math.abs($value(d[1], at[0], at[1])) >= 1e-2 || Math.abs(y) >= 4e-3) {
        return { at, met: false };
    }
    for (let order = 4; order >= 3; --order) {
        const found = $multiple(d, at, order);
        if (found) {
            return { at: found, met: true };
        }
    }
    const top = $newton(d[1], d[2], 3, at);
    const height = $value(d[0], top[0], top[1]);
    const bend = $value(d[2], top[0], top[1]);
    const missed = height * bend > 0.0 && Math.abs(height) < 1e-8;
    const flat = Math.abs($value(d[1], top[0], top[1])) < 2e-7
        && Math.abs(top[0] - at[0]) + Math.abs(top[1] - at[1]) < 1e-3;
    const met = flat && (Math.abs(height) < 1e-14 || missed);
    return { at: met ? top : at, met };
};

/* The direction, of eight, opposite to which |f| is largest. */
const $best_reference = (f) => {
    const h = 0.7071067811865476;
    const directions = [
        [0.0, 1.0], [1.0, 0.0], [0.0, -1.0], [-1.0, 0.0], [h, h], [h, -h], [-h, -h], [-h, h],
    ];
    let best = 0.0;
    let found = directions[0];
    for (const direction of directions) {
        const size = Math.abs($value(f, -direction[0], -direction[1]));
        if (size > best) {
            best = size;
            found = direction;
        }
    }
    return found;
};

/* The real roots of f = a2 cos 2x + b2 sin 2x + a1 cos x + b1 sin x + a0, given as
 * [a2, b2, a1, b1, a0]: up to four, each once, in four places (Ferrari, by the half-angle
 * substitution from where |f| is largest; each root refined on f itself). State: 0 for a root,
 * 1 for a place that holds none, 2 for two or more roots that have met. */
const $trig_roots = (of) => {
    let scale = 0.0;
    for (const x of of) {
        scale = Math.abs(x) > scale ? Math.abs(x) : scale;
    }
    if (!(scale >= 2.2250738585072014e-308 && scale < 1e300)) {
        return of.slice(1).map(() => ({ sine: 0.0, cosine: 1.0, state: 1.0 }));
    }
    const d = [of.map((x) => x / scale)];
    for (let i = 1; i < 5; ++i) {
        const f = d[i - 1];
        d.push([2.0 * f[1], -2.0 * f[0], f[3], -f[2], 0.0]);
    }
    const f = d[0];
    const [sine, cosine] = $best_reference(f);
    const s2 = 2.0 * sine * cosine;
    const c2 = (cosine - sine) * (cosine + sine);
    const turned = [
        f[0] * c2 + f[1] * s2,
        f[1] * c2 - f[0] * s2,
        f[2] * cosine + f[3] * sine,
        f[3] * cosine - f[2] * sine,
        f[4],
    ];
    const roots = $half_angles(turned).map(({ t, real }) => {
        /* tan(theta/2) = t, turned back by the reference. */
        const s = (2.0 * t) / (1.0 + t * t);
        const c = (1.0 - t * t) / (1.0 + t * t);
        const { at, met } = $refine_root(d, [s * cosine + c * sine, c * cosine - s * sine]);
        const height = Math.abs($value(f, at[0], at[1]));
        const state = met && height < 1e-8 ? 2.0 : !met && real && height < 1e-12 ? 0.0 : 1.0;
        return { sine: at[0], cosine: at[1], state };
    });
    /* Of roots that coincide the first is double and the others are none. */
    for (let i = 0; i < 4; ++i) {
        for (let j = i + 1; j < 4; ++j) {
            const off_sine = Math.abs(roots[i].sine - roots[j].sine);
            const off_cosine = Math.abs(roots[i].cosine - roots[j].cosine);
            if (roots[i].state !== 1.0 && roots[j].state !== 1.0
                && (off_sine > off_cosine ? off_sine : off_cosine) < 2e-7) {
                roots[i].state = 2.0;
                roots[j].state = 1.0;
            }
        }
    }
    return roots;
};
