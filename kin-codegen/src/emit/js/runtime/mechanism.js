/* A chain's solutions of a pose: of the whole chain, or of its head, which carries a point, and
 * then of the tail, which turns about it. */
const $chain_solutions = (chain, target) => {
    const { head, tail, point } = chain;
    const joints = ({ q }) => Array.from(q);
    if (!head) {
        return chain.arm.ik(target).map(joints);
    }
    const [x, y, z] = [0, 4, 8].map((i) => target[i] * point[0] + target[i + 1] * point[1]
        + target[i + 2] * point[2] + target[i + 3]);
    return head.ik([1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z]).map(joints).flatMap((first) => {
        const rest = $product($inverse(head.fk(first)), target);
        return tail.ik(rest).map(joints).map((last) => [...first, ...last]);
    });
};

/* What the platform's poses by the chains miss each other by, and how the joints make it: of
 * all chains against the first. The angles count at the distance of the mechanism's length. */
const $gaps = (mechanism, q, free) => {
    const places = [];
    mechanism.chains.forEach(({ arm }, chain) =>
        arm.joints.forEach((_, joint) => places.push([chain, joint])));
    const parts = mechanism.split(q);
    const poses = mechanism.chains.map(({ arm }, i) => arm.fk(parts[i]));
    const jacobians = mechanism.chains.map(({ arm }, i) => arm.geometric_jacobian(parts[i]));
    const error = [];
    const rows = [];
    let [square, most] = [0.0, 0.0];
    for (let chain = 1; chain < poses.length; ++chain) {
        const [a, b] = [poses[0], poses[chain]];
        let trace = 0.0;
        let [shift, sine] = [0.0, 0.0];
        for (let row = 0; row < 6; ++row) {
            const scale = row < 3 ? 1.0 / mechanism.length : 1.0;
            let off = 0.0;
            if (row < 3) {
                off = a[4 * row + 3] - b[4 * row + 3];
            } else {
                const [i, j] = [(row - 2) % 3, (row - 1) % 3];
                for (let k = 0; k < 3; ++k) {
                    trace += a[4 * (row - 3) + k] * b[4 * (row - 3) + k];
                    off += 0.5 * (b[4 * i + k] * a[4 * j + k] - b[4 * j + k] * a[4 * i + k]);
                }
            }
            error.push(scale * off);
            if (row < 3) {
                shift = Math.hypot(shift, scale * off);
            } else {
                sine = Math.hypot(sine, off);
            }
            rows.push(Float64Array.from(free, (place) => {
                const [of, joint] = places[place];
                const n = mechanism.chains[of].arm.joints.length;
                const entry = scale * jacobians[of][row * n + joint];
                return of === chain ? entry : of === 0 ? -entry : 0.0;
            }));
        }
        /* Half a turn has no sine. */
        const angle = $atan2(sine, 0.5 * (trace - 1.0));
        square += shift * shift + angle * angle;
        most = Math.max(most, shift, angle);
    }
    const [residual, gap] = [Math.sqrt(square), most].map((it) => mechanism.length * it);
    return { error, rows, residual, gap };
};

/* A mechanism with the functions that its chains make. */
const $mechanism = (mechanism) => {
    const { chains } = mechanism;
    /* Joint values by chain. */
    mechanism.split = (q) => {
        let first = 0;
        return chains.map(({ arm }) => {
            const part = q.slice(first, first + arm.joints.length);
            first += arm.joints.length;
            return part;
        });
    };
    /* The platform's pose, by the first chain. */
    mechanism.platform = (q) => chains[0].arm.fk(mechanism.split(q)[0]);
    /* How far the loops are from closed, metres. */
    mechanism.gap = (q) => $gaps(mechanism, q, []).gap;
    /* A closed configuration next to one, with some joints at rest, by so many evaluations of
     * Levenberg's method at most. */
    mechanism.close = (q, resting = [], evaluations = 40) => {
        if (!Array.isArray(resting)) {
            throw new TypeError(`close: resting is an array of joints, and not ${resting}`);
        }
        const unknown = resting.find((i) => !(i in q));
        if (unknown !== undefined) {
            throw new TypeError(
                `close: resting is joints from 0 to ${q.length - 1}, and ${unknown} is none`);
        }
        const free = Array.from(q.keys()).filter((i) => !resting.includes(i));
        const all = (some) => {
            const whole = Array.from(q);
            free.forEach((place, i) => (whole[place] = some[i]));
            return whole;
        };
        const linearize = (some) => ({ q: some, ...$gaps(mechanism, all(some), free) });
        const found = $correct(linearize, mechanism.length, free.map((i) => q[i]), evaluations);
        const closed = all(found.q);
        return { q: closed, residual: mechanism.gap(closed) };
    };
    if (mechanism.aim !== null) {
        /* The poses that a target stands for, and by chain all solutions of each. */
        mechanism.ik = (target) => {
            let poses = [{ pose: target }];
            if (mechanism.aim === "translation") {
                const upright = Float64Array.from(mechanism.home);
                [3, 7, 11].forEach((i) => (upright[i] = target[i]));
                poses = [{ pose: upright }];
            } else if (mechanism.aim !== "pose") {
                const lead = chains[mechanism.aim];
                poses = $chain_solutions(lead, target).map((q) => ({ pose: lead.arm.fk(q), q }));
            }
            const placed = poses.map(({ pose, q }) => ({
                pose,
                solutions: chains.map((chain, i) =>
                    (i === mechanism.aim ? [q] : $chain_solutions(chain, pose))),
            }));
            return placed.filter(({ solutions }) => solutions.every((found) => found.length > 0));
        };
    }
    const joints = chains.reduce((count, { arm }) => count + arm.joints.length, 0);
    const of_q = Object.fromEntries(["split", "platform", "gap", "close"].map((name) => [name, ["q"]]));
    return $counted(mechanism, joints, { ...of_q, ik: ["pose"] });
};
