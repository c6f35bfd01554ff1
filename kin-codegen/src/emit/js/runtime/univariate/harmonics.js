/* Trigonometric polynomials, as the cosines and sines of multiples of an angle, up to a degree;
 * `noise` is how far values are off by rounding, if the largest harmonic is 1: as large as the
 * harmonics are that have to vanish, or more. */

/* The sine of a part of a turn, from 0 to 191 of 192. */
const $sine_of_part = (part) => $cosines[part < 48 ? part + 144 : part - 48];

/* By the largest harmonic. */
const $by_largest = (degree, cosines, sines, largest, noise) => ({
    degree,
    cosines: cosines.slice(0, degree + 1).map((x) => x / largest),
    sines: sines.slice(0, degree + 1).map((x) => x / largest),
    noise,
    size: largest,
});

/* From values at equal distances: so many that some harmonics have to vanish. */
const $transform = (degree, values) => {
    const count = values.length;
    const half = count / 2;
    const cosines = new Float64Array(half + 1);
    const sines = new Float64Array(half + 1);
    for (let j = 0; j <= half; ++j) {
        /* Values mirrored at 0 and half a turn: even and odd parts. */
        const mirrored = j === 0 || j === half ? 0.0 : values[count - j];
        const even = values[j] + mirrored;
        const odd = values[j] - mirrored;
        const step = (192 / count) * j;
        for (let k = 0; k <= half; ++k) {
            const part = (step * k) % 192;
            cosines[k] += even * $cosines[part];
            sines[k] += odd * $sine_of_part(part);
        }
    }
    let largest = 0.0;
    let vanishing = 0.0;
    for (let k = 0; k <= half; ++k) {
        const a = cosines[k];
        const b = sines[k];
        if (k > degree) {
            vanishing += a * a + b * b;
            continue;
        }
        cosines[k] *= k === 0 ? 1.0 : 2.0;
        sines[k] *= k === 0 ? 1.0 : 2.0;
        largest = Math.abs(a) > largest ? Math.abs(a) : largest;
        largest = Math.abs(b) > largest ? Math.abs(b) : largest;
    }
    const noise = Math.sqrt(vanishing) / largest + 2.220446049250313e-16;
    return $by_largest(degree, cosines, sines, largest, noise);
};

/* Divided by 1 - cos(angle - fold): from the highest harmonic down, each is told by the two above it;
 * by how much the last ones miss is noise. */
const $divided_by_fold = (fold, f) => {
    const { sine: s, cosine: c } = $sin_cos(fold);
    const cosines = new Float64Array(f.degree + 1);
    const sines = new Float64Array(f.degree + 1);
    let above = [0.0, 0.0];
    let here = [0.0, 0.0];
    let largest = 0.0;
    /* Of exp(i k angle): half of what is of cos - i sin. */
    for (let k = f.degree; k > 0; --k) {
        const x = here[0] - 0.5 * f.cosines[k];
        const y = here[1] + 0.5 * f.sines[k];
        const u = c * above[0] - s * above[1];
        const v = s * above[0] + c * above[1];
        const below = [2.0 * (c * x - s * y) - (c * u - s * v), 2.0 * (s * x + c * y) - (s * u + c * v)];
        const share = k === 1 ? 1.0 : 2.0;
        largest = $max($max(largest, Math.abs(below[0])), Math.abs(below[1]));
        above = here;
        here = below;
        cosines[k - 1] = share * below[0];
        sines[k - 1] = -share * below[1];
    }
    const missed = Math.abs(here[0] - (c * above[0] - s * above[1]) - f.cosines[0]) + Math.abs(here[1]);
    sines[0] = 0.0;
    const degree = f.degree > 0 ? f.degree - 1 : 0;
    return $by_largest(degree, cosines, sines, largest, (f.noise + missed) / largest);
};

/* f, f' and f'' at an angle. */
const $derivatives = (f, angle) => {
    const { sine, cosine } = $sin_cos(angle);
    let c = 1.0;
    let s = 0.0;
    const out = [f.cosines[0], 0.0, 0.0];
    for (let k = 1; k <= f.degree; ++k) {
        const turned = c * cosine - s * sine;
        s = s * cosine + c * sine;
        c = turned;
        const a = f.cosines[k];
        const b = f.sines[k];
        out[0] += a * c + b * s;
        out[1] += k * (b * c - a * s);
        out[2] -= k * k * (a * c + b * s);
    }
    return out;
};

/* f', with the noise of f. */
const $derivative = (f) => ({
    ...f,
    cosines: f.sines.map((sine, k) => k * sine),
    sines: f.cosines.map((cosine, k) => -k * cosine),
});

/* f and f' at an angle: Horner's rule in exp(i angle). */
const $value_and_slope = (f, angle) => {
    const { sine: s, cosine: c } = $sin_cos(angle);
    let [x, y, u, v] = [0.0, 0.0, 0.0, 0.0];
    for (let order = f.degree; order > 0; --order) {
        const a = f.cosines[order];
        const b = -f.sines[order];
        const x1 = x + a;
        const y1 = y + b;
        const u1 = u - order * b;
        const v1 = v + order * a;
        x = x1 * c - y1 * s;
        y = x1 * s + y1 * c;
        u = u1 * c - v1 * s;
        v = u1 * s + v1 * c;
    }
    return { value: x + f.cosines[0], slope: u };
};
