/* All real roots of a trigonometric polynomial. Descartes' rule of signs in Bernstein's basis bounds
 * the number of roots on an interval and has its parity (Collins and Akritas, SYMSAC 1976; Lane and
 * Riesenfeld, BIT 21, 1981): no change of sign means none, one means one. Halving does the rest, with
 * a bound on its steps; where there may be two on an interval with one extremum, the sign at that
 * tells; intervals on which the signs are those of rounding end at a width. */

/* Arcs of the circle, on each of which (1 + t^2)^degree times f is a polynomial in t: the angles
 * middle + 2 atan t, |t| up to this, tan of a quarter of an arc. */
const $ARCS = 16;
const $REACH = 0.09849140335716425;
/* Candidates at most: more than a polynomial of the highest degree has roots. */
const $MOST_ROOTS = 32;
/* Halvings at most, in all, and intervals that wait at a time. */
const $HALVINGS = 192;
const $WAITING = 16;
/* In multiples of the noise, what a coefficient may be without having a sign. */
const $UNSIGNED = 256.0;
/* Below this an interval, radians, on which there may be several roots is one candidate. */
const $NARROW = 4e-4;
/* Where all is noise, candidates are this far apart at most, radians. */
const $BLIND = 0.05;
/* Clusters that are nearer to each other are one, radians. */
const $CLUSTER = 5e-3;
/* Steps towards a root at most. */
const $ROOT_STEPS = 60;

/* Where an arc has its middle: none ends at an angle that robots are sent to. */
const $middle = (arc) => 0.0371 + 0.39269908169872414 * arc;

/* The coefficients on an arc in Bernstein's basis; the least of them, without its sign; how often
 * their sign changes, and where it does last, as a share of the arc. */
const $on_arc = (f, arc) => {
    const last = f.degree <= 8 ? 8 : 12;
    const basis = $bernstein[last];
    const even = new Float64Array(f.degree + 1);
    const odd = new Float64Array(f.degree + 1);
    /* The cosine and sine of k times the middle of the first arc. */
    let x = 1.0;
    let y = 0.0;
    for (let k = 0; k <= f.degree; ++k) {
        const part = 12 * ((k * arc) % $ARCS);
        const c = $cosines[part];
        const s = $sine_of_part(part);
        const cosine = c * x - s * y;
        const sine = s * x + c * y;
        even[k] = cosine * f.cosines[k] + sine * f.sines[k];
        odd[k] = cosine * f.sines[k] - sine * f.cosines[k];
        const before = x;
        x = x * 0.9993118739340654 - y * 0.03709148978386511;
        y = before * 0.03709148978386511 + y * 0.9993118739340654;
    }
    /* Linear in the turned harmonics: those of cosines the same from both ends, those of sines the
     * opposite. */
    const coefficients = new Float64Array(2 * last + 1);
    for (let i = 0; i <= last; ++i) {
        let of_cosines = 0.0;
        let of_sines = 0.0;
        for (let k = 0; k <= f.degree; ++k) {
            of_cosines += even[k] * basis[i][k][0];
            of_sines += odd[k] * basis[i][k][1];
        }
        coefficients[i] = of_cosines + of_sines;
        coefficients[2 * last - i] = of_cosines - of_sines;
    }
    let least = Math.abs(coefficients[0]);
    let changes = 0;
    let share = 0.0;
    for (let i = 1; i < coefficients.length; ++i) {
        const a = coefficients[i - 1];
        const b = coefficients[i];
        least = -$max(-least, -Math.abs(b));
        if (a * b < 0.0) {
            changes += 1;
            share = (i - 1 + a / (a - b)) / (coefficients.length - 1);
        }
    }
    return { coefficients, least, changes, share };
};

/* Whether another root is near a candidate, complex ones included. */
const $has_neighbour = ({ candidates }, candidate) => candidate.is_flat || candidates.some((other) =>
    other !== candidate && Math.abs($wrap(other.angle - candidate.angle)) < $CLUSTER);

/* Adds a candidate, which may be two roots; none or any number; or one where the polynomial hardly
 * changes. */
const $push_root = (found, angle, kind) => {
    if (found.candidates.length === $MOST_ROOTS) {
        found.is_incomplete = true;
        return;
    }
    found.candidates.push({ angle, is_twice: false, is_several: false, is_flat: false, ...kind });
};

/* Where there are several, nobody knows how many, unless a neighbour tells of them. */
const $push_cluster = (found, angle) => {
    const is_near = (other) => other.is_several && Math.abs(other.angle - angle) < $CLUSTER;
    if (!found.candidates.some(is_near)) {
        $push_root(found, angle, { is_several: true });
    }
};

/* What the signs of some coefficients say of the number of roots: 0, 1, 2, or Infinity where that is
 * not known; and the share of the interval at which one root is, about. */
const $count_signs = (coefficients, count, noise) => {
    const unknown = { roots: Infinity, share: 0.0 };
    if (!(Math.abs(coefficients[0]) > noise && Math.abs(coefficients[count - 1]) > noise)) {
        return unknown;
    }
    let before = 0;
    let roots = 0;
    let share = 0.0;
    for (let i = 1; i < count; ++i) {
        const a = coefficients[before];
        const b = coefficients[i];
        if (!(Math.abs(b) > noise)) {
            continue;
        }
        /* One without a sign between two of different signs changes nothing; more may hide two
         * roots. */
        if (a * b < 0.0 && i <= before + 2) {
            roots += 1;
            share = (before + (a / (a - b)) * (i - before)) / (count - 1);
        } else if (i > before + 1) {
            return unknown;
        }
        before = i;
    }
    return { roots: roots > 2 ? Infinity : roots, share };
};

const $arc_angle = (isolation, t) => isolation.middle + 2.0 * $atan2(t, 1.0);

const $between = ({ low, high }, share) => low + share * (high - low);

/* An interval with one root, and where it may be; the polynomial rises there or falls. */
const $bracket = (isolation, low, high, guess, rises) => {
    if (isolation.brackets.length === $MOST_ROOTS) {
        isolation.found.is_incomplete = true;
        return;
    }
    const [from, to, start] = [low, high, guess].map((t) => $arc_angle(isolation, t));
    isolation.brackets.push({ from, to, start, rises: rises ? 1.0 : -1.0 });
};

/* Where g = (1 + t^2)^degree f has its only extremum on an interval, with f and f'' there: Newton's
 * method on g', halving where it leaves the bracket. `opens` tells the sign of g''. */
const $steady = (isolation, interval, start, opens) => {
    const degree = (interval.coefficients.length - 1) / 2;
    let { low, high } = interval;
    let t = start;
    let value = 0.0;
    let curvature = 0.0;
    for (let step = 0; step < $ROOT_STEPS; ++step) {
        const f = $derivatives(isolation.f, $arc_angle(isolation, t));
        [value, , curvature] = f;
        /* But for powers of 1 + t^2. */
        const g = f[1] + degree * t * f[0];
        const change = ((f[2] + degree * t * f[1]) * 2.0) / (1.0 + t * t) + degree * f[0];
        if (g < 0.0 === opens) {
            low = t;
        } else {
            high = t;
        }
        let next = t - g / change;
        if (!(next > low && next < high)) {
            next = 0.5 * (low + high);
        }
        const moved = Math.abs(next - t);
        t = next;
        /* As a share of a radian: values there to its square. */
        if (moved < 1e-7) {
            break;
        }
    }
    return { t, value, curvature };
};

/* The roots on an interval with two or none, if g has one extremum there: the sign at that tells
 * which. False if it may have more. */
const $at_extremum = (isolation, interval) => {
    const { coefficients, low, high } = interval;
    const { found, noise } = isolation;
    const rise = coefficients.slice(1).map((x, i) => x - coefficients[i]);
    const { roots, share } = $count_signs(rise, rise.length, noise);
    if (roots !== 1) {
        return false;
    }
    const opens = rise[0] < 0.0;
    const { t, value, curvature } = $steady(isolation, interval, $between(interval, share), opens);
    /* Two roots that are nearer to each other than twice the root of 1e-12 are one candidate. */
    if (!(Math.abs(value) > 2.0 * noise + 0.5e-12 * Math.abs(curvature))) {
        const angle = $arc_angle(isolation, t);
        /* Of three roots or more, the curvature would be what rounding leaves. */
        if (Math.abs(curvature) > 1e-4) {
            $push_root(found, angle, { is_twice: true });
        } else {
            $push_cluster(found, angle);
        }
    } else if (value * coefficients[0] < 0.0) {
        /* Where a parabola has them. */
        const apart = 0.5 * Math.sqrt(Math.abs((2.0 * value) / curvature));
        $bracket(isolation, low, t, $max(t - apart, low), !opens);
        $bracket(isolation, t, high, -$max(-(t + apart), -high), opens);
    } else if (Math.abs(value) <= 2.0 * $UNSIGNED * isolation.f.shift) {
        /* Next to a family of solutions what the target is rounded by parts two that meet. */
        $push_root(found, $arc_angle(isolation, t), { is_twice: true });
    }
    return true;
};

/* The upper and the lower part of an interval, by de Casteljau's algorithm; not quite halves, since
 * roots like to be in the middle. */
const $halved = (interval) => {
    const share = 0.4871;
    const cut = $between(interval, share);
    const upper = interval.coefficients.slice();
    const lower = new Float64Array(upper.length);
    for (let i = 0; i < upper.length; ++i) {
        lower[i] = upper[0];
        for (let j = 0; j < upper.length - 1 - i; ++j) {
            upper[j] += share * (upper[j + 1] - upper[j]);
        }
    }
    return [
        { coefficients: upper, low: cut, high: interval.high },
        { coefficients: lower, low: interval.low, high: cut },
    ];
};

/* What is on an arc on which there may be more roots than one. */
const $halve_arc = (isolation, arc) => {
    const { found, noise } = isolation;
    const waiting = [arc];
    while (waiting.length > 0) {
        const interval = waiting.pop();
        const { coefficients, low, high } = interval;
        const width = 2.0 * (high - low);
        const middle = $arc_angle(isolation, 0.5 * (low + high));
        const { roots, share } = $count_signs(coefficients, coefficients.length, noise);
        if (roots === 0) {
            continue;
        }
        if (roots === 1) {
            $bracket(isolation, low, high, $between(interval, share), coefficients[0] < 0.0);
        } else if (roots === 2 && $at_extremum(isolation, interval)) {
            continue;
        } else if (width < $NARROW) {
            $push_cluster(found, middle);
        } else if (roots > 2 && coefficients.every((x) => Math.abs(x) <= noise)) {
            /* All that is known of the polynomial here is noise. */
            const parts = Math.ceil(width / $BLIND);
            for (let part = 0; part < parts; ++part) {
                $push_cluster(found, $arc_angle(isolation, $between(interval, (part + 0.5) / parts)));
            }
        } else if (isolation.halvings === $HALVINGS || waiting.length + 2 > $WAITING) {
            $push_cluster(found, middle);
            found.is_incomplete = true;
        } else {
            isolation.halvings += 1;
            waiting.push(...$halved(interval));
        }
    }
};

/* The root in a bracket, by Newton's method, halving where that leaves it. */
const $leave_bracket = (f, { from, to, start, rises }, found) => {
    let [low, high, x, slope] = [from, to, start, 0.0];
    for (let step = 0; step < $ROOT_STEPS; ++step) {
        const here = $value_and_slope(f, x);
        slope = here.slope;
        const newton = x - here.value / slope;
        if (here.value * rises > 0.0) {
            high = x;
        } else {
            low = x;
        }
        const next = newton >= low && newton <= high ? newton : 0.5 * (low + high);
        const moved = Math.abs(next - x);
        x = next;
        /* Newton's method on the arm does the rest. */
        if (moved < 1e-9) {
            break;
        }
    }
    /* Roots that are complex may be so near that their solutions mix with this one. */
    $push_root(found, x, { is_flat: Math.abs(slope) < 1e-3 });
};

/* The roots, in no order, in (-pi, 2 pi]; a few that are none may be with them. */
const $find_roots = (f) => {
    const found = { candidates: [], is_incomplete: false };
    const isolation = { f, found, noise: $UNSIGNED * f.noise, middle: 0.0, brackets: [], halvings: 0 };
    for (let arc = 0; arc < $ARCS; ++arc) {
        const { coefficients, least, changes, share } = $on_arc(f, arc);
        const is_signed = least > isolation.noise;
        if (is_signed && changes === 0) {
            continue;
        }
        const whole = { coefficients, low: -$REACH, high: $REACH };
        isolation.middle = $middle(arc);
        if (is_signed && changes === 1) {
            $bracket(isolation, whole.low, whole.high, $between(whole, share), coefficients[0] < 0.0);
        } else {
            $halve_arc(isolation, whole);
        }
    }
    isolation.brackets.forEach((it) => $leave_bracket(f, it, found));
    return found;
};
