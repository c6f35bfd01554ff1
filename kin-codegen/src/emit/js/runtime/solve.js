/* How far the rotation of a target is from one, as far as it counts. */
const $rotation_error = (form, target) => {
    const [x, y, z] = [0, 1, 2].map((j) => [target[j], target[4 + j], target[8 + j]]);
    const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    if (form.counts_axis) {
        return Math.abs(Math.sqrt(dot(z, z)) - 1.0);
    }
    const missing = [0.5 * (dot(x, x) - 1.0), 0.5 * (dot(y, y) - 1.0), dot(x, y)];
    for (let i = 0; i < 3; ++i) {
        const a = (i + 1) % 3;
        const b = (i + 2) % 3;
        missing.push(z[i] - (x[a] * y[b] - x[b] * y[a]));
    }
    return form.counts_rotation ? $norm(missing) : 0.0;
};

/* Why a target has no solutions. */
const $why_none = (form, target) => {
    const counts = (i) => (i % 4 === 3 ? form.counts_translation : form.counts_rotation);
    if (!target.every((x, i) => !counts(i) || Number.isFinite(x))) {
        return "not finite";
    }
    const rotates = $rotation_error(form, target) * form.size <= form.tolerance;
    return rotates ? "out of reach" : "not a rotation";
};

/* The turn of a free angle, radians, that leaves the next root the most room, from the level
 * d of its equation a cos x + b sin x = d at turns of 0, pi/2 and pi. */
const $roomiest_turn = (here, quarter, half) => {
    const mean = 0.5 * (here + half);
    const cosine = 0.5 * (here - half);
    const sine = quarter - mean;
    const amplitude = Math.sqrt(cosine * cosine + sine * sine);
    /* mean + cosine cos x + sine sin x = 0, or what comes nearest to it. */
    const near = Math.max(amplitude + mean, 0.0);
    const far = Math.max(amplitude - mean, 0.0);
    return $wrap($atan2(sine, cosine) - 2.0 * $atan2(Math.sqrt(near), Math.sqrt(far)));
};

/* The lanes, with an angle that is free turned where its own value leaves the next root none. */
const $branches = (form, target, from, given) => {
    /* A joint without a seed takes no part in a choice, and what of it is free is at 0. */
    const seed = from.map((x) => (Math.abs(x) < Infinity ? x : 0.0));
    const lanes = form.lanes(target, seed, given, 1e-24);
    if (form.free_angle === null || !lanes.no_root.some((x) => x > 0.0)) {
        return lanes;
    }
    /* A free angle at the seed's value can leave a later step no root: it turns to where it
     * leaves the most room. */
    const turned = (turn) => {
        const other = seed.map((x, i) => (i === form.free_angle ? x + turn : x));
        return form.lanes(target, other, given, 2.5e-19);
    };
    const samples = [0.0, 1.5707963267948966, Math.PI].map(turned);
    for (let k = 0; k < form.branches; ++k) {
        if (lanes.no_root[k] > 0.0) {
            const best = turned($roomiest_turn(...samples.map((sample) => sample.level[k])));
            lanes.q.forEach((lane, i) => (lane[k] = best.q[i][k]));
            lanes.residual[k] = best.residual[k];
            lanes.invalid[k] = best.invalid[k];
            lanes.singular[k] = best.singular[k];
        }
    }
    return lanes;
};

/* The values of all joints, from those that are solved for and those that are given. */
const $whole = (arm, solved, given) => {
    const q = new Array(arm.joints.length);
    arm.form.solved.forEach((joint, i) => (q[joint] = solved[i]));
    arm.form.locked.forEach((joint, i) => {
        q[joint] = arm.joints[joint].repeats ? $wrap(given[i]) : given[i];
    });
    return q;
};

/* Adds a solution, unless it is one of those that are there; of two the better one stays. */
const $insert = (arm, found, solutions) => {
    const same = (known) => found.q.every((q, i) => {
        const off = q - known.q[i];
        return Math.abs(arm.joints[i].repeats ? $wrap(off) : off) < 1e-6;
    });
    const known = solutions.findIndex(same);
    if (known >= 0) {
        if (found.residual < solutions[known].residual) {
            solutions[known] = { ...found, branch: solutions[known].branch };
        }
    } else if (solutions.length < arm.form.most) {
        solutions.push(found);
    }
};

/* A branch that rounding keeps from its target, corrected; it may stay off. */
const $corrected = (arm, target, given, solved, branch, singular, evaluations = 12) => {
    const { form } = arm;
    const seen = (q) => $seen(arm, $whole(arm, q, given), form.solved);
    const found = $correct((q) => $linearize(form, target, seen, q), form.size, solved, evaluations);
    const q = found.q.map((x, i) => (arm.joints[form.solved[i]].repeats ? $wrap(x) : x));
    return {
        q: $whole(arm, q, given),
        residual: found.residual,
        branch,
        singular: found.singular || singular,
    };
};

/* The branches that reach their target, those that rounding keeps from it corrected. */
const $reaching = (arm, target, given, lanes) => {
    const { form } = arm;
    const solutions = [];
    const nearly = [];
    const correct = form.swivel ? $at_swivel : $corrected;
    const corrects = !form.projected
        && $rotation_error(form, target) * form.size <= form.tolerance;
    for (let k = 0; k < form.branches; ++k) {
        const residual = lanes.residual[k];
        if (!(lanes.invalid[k] <= 0.0)) {
            continue;
        }
        if (residual <= form.tolerance) {
            const q = $whole(arm, lanes.q.map((lane) => lane[k]), given);
            solutions.push({ q, residual, branch: k, singular: lanes.singular[k] > 0.0 });
        } else if (corrects && residual <= form.nearly) {
            nearly.push(k);
        }
    }
    for (const k of nearly) {
        const solved = lanes.q.map((lane) => lane[k]);
        const found = correct(arm, target, given, solved, k, lanes.singular[k] > 0.0);
        if (found && found.residual <= form.tolerance) {
            $insert(arm, found, solutions);
        }
    }
    return solutions;
};

/* The solutions of a target by the branches of a plan. */
const $solve = (arm, target, seed, given) =>
    $reaching(arm, target, given, $branches(arm.form, target, seed, given));
