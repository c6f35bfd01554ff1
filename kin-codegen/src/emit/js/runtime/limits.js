/* Of the values of joint i that are q but for full turns the one inside its limits and nearest
 * to a seed, and how far it is beyond a stop. */
const $next_inside = (arm, i, q, seed) => {
    const { lower, upper, repeats } = arm.joints[i];
    const turn = repeats ? 6.283185307179586 : 0.0;
    const middle = 0.5 * (lower + upper);
    /* Without stops the middle is no number and not taken. */
    let first = lower - 5e-10 + Math.PI;
    let last = upper + 5e-10 - Math.PI;
    first = middle < first ? middle : first;
    last = middle > last ? middle : last;
    let from = seed < first ? first : seed;
    from = from > last ? last : from;
    const value = q + turn * $round((from - q) * (turn * 0.025330295910584444));
    return { value, beyond: $max(value - upper, lower - value) };
};

/* A value, not beyond a stop. */
const $at_most_at_a_stop = ({ lower, upper }, value) => {
    const below = value > upper ? upper : value;
    return below < lower ? lower : below;
};

/* A joint's value inside its limits, moved by full turns as near to a seed as they allow; null if
 * it is not inside. */
const $inside = (arm, i, q, seed) => {
    const { value, beyond } = $next_inside(arm, i, q, seed);
    return beyond <= 1e-9 ? $at_most_at_a_stop(arm.joints[i], value) : null;
};

/* Of some solutions the one inside the limits that moves the joints least from a seed; of
 * equals the first; null if none is inside. */
const $nearest = (arm, solutions, seed) => {
    let least = Infinity;
    let chosen = null;
    for (const solution of solutions) {
        let motion = 0.0;
        let excess = -Infinity;
        const q = solution.q.map((own, i) => {
            const known = Math.abs(seed[i]) < Infinity;
            const from = known ? seed[i] : 0.0;
            const { value, beyond } = $next_inside(arm, i, own, from);
            motion += known ? (value - from) * (value - from) : 0.0;
            excess = $max(excess, beyond);
            return $at_most_at_a_stop(arm.joints[i], value);
        });
        /* What is too much for a number is still a motion. */
        motion = -$max(-motion, -Number.MAX_VALUE);
        if (excess <= 1e-9 && motion < least) {
            least = motion;
            chosen = { ...solution, q };
        }
    }
    return chosen;
};
