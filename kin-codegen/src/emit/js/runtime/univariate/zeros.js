/* How many zeros a trigonometric polynomial has near an angle, complex ones included: along a circle the
 * argument of f makes as many turns as there are zeros within, and so does that of a function that differs
 * from f by less than |f| there. In t = tan((x - angle) / 2) a circle about zero is its own mirror image,
 * as f is: half of it tells all. */

/* Points on half a circle. */
const $POINTS = 16;
/* Between two of them the argument is followed where it turns by less, radians. */
const $FOLLOWED = 2.0;
/* In multiples of its noise, the least of |f| on a circle that tells: more than f may be at an extremum that
 * is taken for roots, so that beyond the circle, where it is farther from it, there are none of these. */
const $TELLING = 2.5 * $UNSIGNED;
/* So far from the roots that it stands for a candidate may be, radians. */
const $STANDS_FOR = $CLUSTER + $NARROW;
/* Where zeros have met: the derivative before the last one that is zero there, as a multiple of the next, so
 * that their angles are 3e-5 apart at most, radians; and so near to it that is known. */
const $MET = 1e-10;
const $SETTLED_AT = 1e-9;
/* Radii of circles, tangents of half an angle. */
const $RADII = [1.5e-3, 3e-3, 6e-3, 1.2e-2, 2.4e-2, 4.8e-2];

/* f as a function of the angle that is left: a sum of exp(i k x) times these numbers and of their mirror
 * images. */
const $turned_harmonics = (f, angle) => {
    const { sine, cosine } = $sin_cos(angle);
    let [c, s] = [1.0, 0.0];
    return Array.from({ length: f.degree + 1 }, (_, k) => {
        const a = 0.5 * f.cosines[k];
        const b = -0.5 * f.sines[k];
        const turned = [a * c - b * s, a * s + b * c];
        [c, s] = [c * cosine - s * sine, c * sine + s * cosine];
        return turned;
    });
};

/* The value of f at a point of a circle. */
const $at_point = (harmonics, radius, i) => {
    const part = 3 * (2 * i + 1);
    const x = radius * $cosines[part];
    const y = radius * $sine_of_part(part);
    /* exp(i x) = (1 + i t) / (1 - i t), and its inverse. */
    const [above, below] = [1.0 - y, 1.0 + y];
    const across = above * below - x * x;
    const outer = 1.0 / (below * below + x * x);
    const inner = 1.0 / (above * above + x * x);
    const ahead = [across * outer, (x + x) * outer];
    const back = [across * inner, -(x + x) * inner];
    let p = [0.0, 0.0];
    let q = [0.0, 0.0];
    for (let k = harmonics.length - 1; k > 0; --k) {
        const [a, b] = harmonics[k];
        p = $complex_product([p[0] + a, p[1] + b], ahead);
        q = $complex_product([q[0] + a, q[1] - b], back);
    }
    const [constant] = harmonics[0];
    return [p[0] + (q[0] + (constant + constant)), p[1] + q[1]];
};

/* The zeros within a circle; null where it passes next to one. */
const $zeros_within = (harmonics, radius, least) => {
    const values = Array.from({ length: $POINTS }, (_, i) => $at_point(harmonics, radius, i));
    const of = values.map(([re, im]) => $angle(im, re));
    /* From the mirror image of the first point, and to that of the last one. */
    const ends = [$wrap(2.0 * of[0]), $wrap(-2.0 * of[$POINTS - 1])];
    const steps = of.slice(1).map((argument, i) => $wrap(argument - of[i]));
    const turned = steps.reduce((sum, step) => sum + 2.0 * step, ends[0] + ends[1]);
    const is_followed = [...ends, ...steps].every((step) => Math.abs(step) < $FOLLOWED);
    const is_above = values.every(([re, im]) => re * re + im * im > least * least);
    const tells = is_followed && is_above && turned > -$FOLLOWED;
    return tells ? Math.floor(turned / 6.283185307179586 + 0.5) : null;
};

/* The zeros near an angle, with their multiplicities, and where no others are; null unless there are two
 * circles about it with none between them. */
const $zeros_near = (f, angle) => {
    const harmonics = $turned_harmonics(f, angle);
    let before = null;
    for (const radius of $RADII) {
        const count = $zeros_within(harmonics, radius, $TELLING * f.noise);
        if (count !== null && count === before) {
            return { count, angle, within: 2.0 * $atan2(radius, 1.0) };
        }
        before = count;
    }
    return null;
};

/* Whether an angle is one of these zeros if it is a zero. */
const $are_near = (zeros, angle) =>
    zeros !== null && Math.abs($wrap(angle - zeros.angle)) < zeros.within;

/* Whether all that a candidate at an angle stands for are among them. */
const $cover = (zeros, angle) =>
    zeros !== null && Math.abs($wrap(angle - zeros.angle)) + $STANDS_FOR < zeros.within;

/* Where zeros have met, or all but met: f and its derivatives but for the last are nearly zero there, and of
 * the last but one it is a zero that is found to all digits; null if there is no such angle. */
const $meeting = (f, zeros) => {
    let before = f;
    for (let order = 2; order < zeros.count; ++order) {
        before = $derivative(before);
    }
    let { angle } = zeros;
    for (let step = 0; step < 6; ++step) {
        const [height, slope, curvature] = $derivatives(before, angle);
        const least = Math.abs(curvature);
        if (Math.abs(height) <= $MET * least && Math.abs(slope) <= $SETTLED_AT * least) {
            return $are_near(zeros, angle) ? angle : null;
        }
        angle -= slope / curvature;
    }
    return null;
};
