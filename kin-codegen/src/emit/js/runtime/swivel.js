/* The swivel angle, by elbow and wrist in base coordinates: how far the elbow is turned about
 * the line from the shoulder to the wrist, from where the reference direction points; and how
 * the angle changes with the elbow while the wrist rests. */
const $swivel_angle = ({ shoulder, reference }, elbow, wrist) => {
    const axes = [0, 1, 2];
    const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    const cross = (a, b) => axes.map((i) => {
        const [j, k] = [(i + 1) % 3, (i + 2) % 3];
        return a[j] * b[k] - a[k] * b[j];
    });
    const line = axes.map((i) => wrist[i] - shoulder[i]);
    const from = axes.map((i) => elbow[i] - shoulder[i]);
    const scale = 1.0 / Math.sqrt(dot(line, line));
    const way = line.map((x) => x * scale);
    const along = dot(from, way);
    const slope = dot(reference, way);
    const aside = axes.map((i) => from[i] - along * way[i]);
    const beside = axes.map((i) => reference[i] - slope * way[i]);
    const square = dot(aside, aside);
    return {
        angle: $atan2(dot(cross(way, beside), from), dot(beside, from)),
        gradient: cross(way, aside).map((x) => x / square),
    };
};

/* The swivel angle of a configuration. */
const $swivel_of = (arm, q) => {
    const { swivel } = arm.form;
    const elbow = $point(arm.fk_links(q)[swivel.link], swivel.elbow);
    return $swivel_angle(swivel, elbow, $point(arm.fk(q), swivel.wrist)).angle;
};

/* How the swivel angle changes with the joints while the wrist rests, and how far it is off. */
const $swivel_slopes = (arm, q, wanted, wrist) => {
    const { swivel } = arm.form;
    const n = arm.joints.length;
    const { jacobian } = arm.fk_jacobian(q);
    const elbow = $point(arm.fk_links(q)[swivel.link], swivel.elbow);
    const { angle, gradient } = $swivel_angle(swivel, elbow, wrist);
    const slopes = new Array(n).fill(0.0);
    for (let k = 0; k < n && k <= swivel.link; ++k) {
        for (let i = 0; i < 3; ++i) {
            const a = (i + 1) % 3;
            const b = (i + 2) % 3;
            slopes[k] += gradient[i] * (jacobian[i * n + k]
                + (jacobian[(3 + a) * n + k] * elbow[b] - jacobian[(3 + b) * n + k] * elbow[a]));
        }
    }
    return { slopes, off: $wrap(wanted - angle) };
};

/* A branch at a swivel angle that misses its target, corrected: the angle tells one
 * of the joints that turn the elbow from the others. Null if it stays off. */
const $at_swivel = (arm, target, given, whole, branch, singular) => {
    const wrist = $point(target, arm.form.swivel.wrist);
    const slopes_at = (q) => $swivel_slopes(arm, q, given[0], wrist);
    const first = slopes_at(whole).slopes;
    const told = Math.abs(first[1]) > Math.abs(first[0]) ? 1 : 0;
    const others = arm.form.solved.filter((joint) => joint !== told);
    /* All joint values, from those of the others than the one that the angle tells. */
    const all = (some) => {
        const q = whole.slice();
        others.forEach((joint, i) => (q[joint] = some[i]));
        for (let step = 0; step < 8; ++step) {
            const { slopes, off } = slopes_at(q);
            const by = off / slopes[told];
            if (Number.isNaN(by)) {
                break;
            }
            q[told] += by > 0.5 ? 0.5 : by < -0.5 ? -0.5 : by;
            if (Math.abs(by) < 1e-15) {
                break;
            }
        }
        return q;
    };
    const seen = (some) => {
        const q = all(some);
        const { pose, jacobian } = $seen(arm, q, arm.form.solved);
        const { slopes } = slopes_at(q);
        const row = (entries) =>
            others.map((i) => entries[i] + entries[told] * (-slopes[i] / slopes[told]));
        return { pose, jacobian: jacobian.map(row) };
    };
    const linearize = (some) => $linearize(arm.form, target, seen, some);
    const start = others.map((joint) => whole[joint]);
    const found = $correct(linearize, arm.form.size, start, $steps(arm.form));
    if (!(found.residual <= arm.form.tolerance)) {
        return null;
    }
    const q = all(found.q.map($wrap)).map($wrap);
    /* Where the angle hardly tells its joint, nothing was solved. */
    if (!(Math.abs(slopes_at(q).off) <= 1e-9)) {
        return null;
    }
    const residual = $distance(arm.form, arm.fk(q), target);
    return { q, residual, branch, singular: found.singular || singular };
};
