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

/* What a later root says of a free joint at some turns from the seed's value, radians: d of its
 * equation a cos x + b sin x = d. Three tell what it is as the function of a turn x,
 * constant + first cos x + second sin x for an angle and constant + first q + second q q for a slide,
 * q = x / (pi / 2), and the fourth whether d is that. */
const $level_turns = [0.0, 1.5707963267948966, Math.PI, 4.0];

/* What the first three tell. */
const $told_by = ([here, quarter, half], is_slide) => {
    const mean = 0.5 * (here + half);
    const bend = mean - quarter;
    return is_slide
        ? [here, 0.5 * (half - here) - 2.0 * bend, bend]
        : [mean, 0.5 * (here - half), -bend];
};

/* Where c + b x + a x x is zero nearest to 0, or if it is nowhere where it is least. */
const $nearest_zero = ([c, b, a]) => {
    const discriminant = b * b - 4.0 * a * c;
    let [over, below] = [-b, 2.0 * a];
    if (!(discriminant < 0.0)) {
        const root = Math.sqrt(discriminant);
        [over, below] = [-2.0 * c, b + (b < 0.0 ? -root : root)];
    }
    return below === 0.0 ? 0.0 : over / below;
};

/* The turn, radians, that leaves the root the most room; of two for a slide the nearer one. */
const $roomiest_turn = (levels, is_slide) => {
    const told = $told_by(levels, is_slide);
    if (is_slide) {
        return 1.5707963267948966 * $nearest_zero(told);
    }
    const [constant, cosine, sine] = told;
    const amplitude = Math.sqrt(cosine * cosine + sine * sine);
    /* constant + cosine cos x + sine sin x = 0, or what comes nearest to it. */
    const near = Math.max(amplitude + constant, 0.0);
    const far = Math.max(amplitude - constant, 0.0);
    return $wrap($atan2(sine, cosine) - 2.0 * $atan2(Math.sqrt(near), Math.sqrt(far)));
};

/* The turn, radians, to where the root becomes a double one: d is 1 or -1. */
const $next_root = (levels, is_slide) => {
    const [, first, second] = $told_by(levels, is_slide);
    const beyond = levels[0] - (levels[0] < 0.0 ? -1.0 : 1.0);
    return is_slide
        ? 1.5707963267948966 * $nearest_zero([beyond, first, second])
        /* By the tangent of half of the angle. */
        : 2.0 * $atan2($nearest_zero([beyond, 2.0 * second, beyond - 2.0 * first]), 1.0);
};

/* Whether d is as the three turns tell it, at the fourth and where it is known too. */
const $levels_tell = (levels, is_slide, turn, level) => {
    const [constant, x, y] = $told_by(levels, is_slide);
    const functions_at = (turn) => {
        if (is_slide) {
            const quarters = turn / 1.5707963267948966;
            return [quarters, quarters * quarters];
        }
        const { sine, cosine } = $sin_cos(turn);
        return [cosine, sine];
    };
    const is_told = ([turn, level]) => {
        const [first, second] = functions_at(turn);
        const scale = Math.abs(constant) + Math.abs(x) * Math.max(Math.abs(first), 1.0) +
            Math.abs(y) * Math.max(Math.abs(second), 1.0);
        /* Also where it is no number. */
        return Math.abs(constant + x * first + y * second - level) <= 1e-9 * scale;
    };
    return [[$level_turns[3], levels[3]], [turn, level]].every(is_told);
};

/* Whether a joint that is free leaves a root none for which it makes room, but for the one that
 * is left out. */
const $leaves_none = (form, lanes, joint, left_out, k) =>
    form.free_joints.some(({ coordinate }, j) =>
        coordinate === form.free_joints[joint].coordinate && j !== left_out && lanes.no_root[j][k] > 0.0);

/* The lanes with the joints from the first one moved that are free and leave a later root none, as
 * `said`: to the next value that leaves it one, or if that is far to where it has the most room. Where
 * more than one is free, each moves after those before it. */
const $move_free_joints = (form, run, seed, said, first, open, lanes) => {
    for (let joint = first; joint < form.free_joints.length; ++joint) {
        const { coordinate, slide } = form.free_joints[joint];
        const asked = open.filter((k) => said.no_root[joint][k] > 0.0);
        if (asked.length === 0) {
            continue;
        }
        open = open.filter((k) => !asked.includes(k));
        const moved = (turn) => {
            const by = (slide ?? 1.0) * turn;
            const other = seed.map((x, i) => (i === coordinate ? x + by : x));
            return { turn, seed: other, lanes: run(other) };
        };
        const samples = $level_turns.map(moved);
        let all_round = null;
        for (const k of asked) {
            const level = (at) => at.lanes.level[joint][k];
            const levels = samples.map(level);
            /* To where the root is a double one, if that is next to the seed. */
            const next = $next_root(levels, slide !== null);
            let best = Math.abs(next) <= 0.05 ? moved(next) : null;
            const is_next = best !== null && !$leaves_none(form, best.lanes, joint, -1, k);
            best = is_next ? best : moved($roomiest_turn(levels, slide !== null));
            const is_as_told = is_next || $levels_tell(levels, slide !== null, best.turn, level(best));
            if ($leaves_none(form, best.lanes, joint, is_as_told ? joint : -1, k)) {
                let step = 2.0 * Math.PI / 16.0;
                /* All but the seed's own, to both sides, as slides go. */
                all_round ??= Array.from({ length: 15 }, (_, i) => moved((i < 7 ? i - 7 : i - 6) * step));
                const has_roots = (at) => !$leaves_none(form, at.lanes, joint, -1, k);
                const is_more = (at, than) => (has_roots(at) === has_roots(than)
                    ? Math.abs(level(at)) < Math.abs(level(than))
                    : has_roots(at));
                const better = (one, other) => (is_more(other, one) ? other : one);
                best = all_round.reduce(better);
                for (let halving = 0; halving < 5 && !has_roots(best); ++halving) {
                    step *= 0.5;
                    best = [moved(best.turn - step), moved(best.turn + step)].reduce(better, best);
                }
                /* To where a parabola through the turns beside it tells that the level is least. */
                for (const beside of [1e-2, 1e-3, 1e-4, 2e-5]) {
                    if (has_roots(best)) {
                        break;
                    }
                    const [below, here, above] = [-beside, 0.0, beside].map((by) =>
                        Math.abs(level(by === 0.0 ? best : moved(best.turn + by))));
                    const bend = below + above - 2.0 * here;
                    if (bend > 0.0) {
                        const ahead = (0.5 * (below - above)) / bend;
                        best = better(best, moved(best.turn + beside * ahead));
                    }
                }
            }
            lanes.q.forEach((lane, i) => (lane[k] = best.lanes.q[i][k]));
            lanes.residual[k] = best.lanes.residual[k];
            lanes.invalid[k] = best.lanes.invalid[k];
            lanes.singular[k] = best.lanes.singular[k];
            $move_free_joints(form, run, best.seed, best.lanes, joint + 1, [k], lanes);
        }
    }
};

/* The seed with its joints turned. One without a seed takes no part in a choice, and what of it is free is
 * at 0. */
const $seed_turned = (from, turn) => from.map((x) => (Math.abs(x) < Infinity ? x : 0.0) + turn);

/* The lanes with joints that are free where the seed is. */
const $as_told = (form, target, from, given) => form.lanes(target, $seed_turned(from, 0.0), given, 1e-22);

/* The lanes, with joints that are free moved where their own values leave a later root none. */
const $branches = (form, target, from, given) => {
    const seed = $seed_turned(from, 0.0);
    const lanes = $as_told(form, target, from, given);
    const run = (seed) => form.lanes(target, seed, given, 1e-16);
    const open = Array.from({ length: form.branches }, (_, k) => k);
    $move_free_joints(form, run, seed, lanes, 0, open, lanes);
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

/* How far the joints of two configurations are apart, full turns left out. */
const $joint_distances = (arm, a, b) =>
    arm.joints.map(({ repeats }, i) => Math.abs(repeats ? $wrap(a[i] - b[i]) : a[i] - b[i]));

/* The place of a configuration among some solutions, -1 if it is none of them. */
const $known_place = (arm, q, solutions) =>
    solutions.findIndex((known) => $joint_distances(arm, q, known.q).every((apart) => apart < 1e-6));

/* Adds a solution, unless it is one of those that are there; of two the better one stays. */
const $insert = (arm, found, solutions) => {
    const known = $known_place(arm, found.q, solutions);
    if (known >= 0) {
        if (found.residual < solutions[known].residual) {
            solutions[known] = { ...found, branch: solutions[known].branch };
        }
    } else if (solutions.length < arm.form.most) {
        solutions.push(found);
    }
};

/* Evaluations for a correction: the branches of an arm's design are farther from the solutions. */
const $steps = ({ taken }) => (taken < 0.0 ? 60 : 12);

/* Where Levenberg's method leads from a configuration, and how far that is from the target. */
const $corrected = (arm, target, given, solved, evaluations) => {
    const { form } = arm;
    const tip = (q) => $seen(arm, $whole(arm, q, given), form.solved);
    const seen = (q) => form.projection ? form.projection.see(tip(q)) : tip(q);
    const linearize = (q) => $linearize(form, target, seen, q);
    const { q, residual, singular } = $correct(linearize, form.size, solved, evaluations);
    const wrapped = q.map((x, i) => (arm.joints[form.solved[i]].repeats ? $wrap(x) : x));
    return { missed: residual, found: { q: $whole(arm, wrapped, given), residual, singular } };
};

/* A singular solution stands for its neighbours as well, which rounding does not tell apart. Where none is
 * next to a seed that all but reaches the target, the one to which Levenberg's method leads from there takes
 * the place of the nearest; `from` is all of the seed. */
const $stay_at_seed = (arm, lead, from, solutions) => {
    const singular = solutions.filter(({ singular }) => singular);
    if (singular.length === 0) {
        return;
    }
    const missed = lead(0).missed / arm.form.size;
    const far = 1e-6 + 100.0 * missed;
    const is_next = ({ q }) =>
        q.reduce((square, x, i) => square + (x - from[i]) * (x - from[i]), 0.0) <= far * far;
    if (!(missed <= 2e-2) || singular.some(is_next)) {
        return;
    }
    /* Most take four; beside a fold each may halve what is left. */
    const there = lead(40);
    const { found } = there;
    const apart = (a, b) =>
        $joint_distances(arm, a, b).reduce((square, x) => square + x * x, 0.0);
    /* Of two that mirror each other, as near as rounding tells, the first. */
    const nearest = singular.reduce((one, other) =>
        apart(other.q, found.q) < 0.9 * apart(one.q, found.q) ? other : one);
    const known = solutions[$known_place(arm, found.q, solutions)] ?? nearest;
    /* One that is known may be a whole turn away, which limits may leave no other answer than. */
    if (there.missed <= 1e-13 * arm.form.size && found.singular && known === nearest
        && apart(found.q, from) <= apart(nearest.q, from)) {
        Object.assign(nearest, found);
    }
};

/* The branches that reach their target, the others corrected; of singular ones those that are next to
 * the seed. */
const $reaching = (arm, target, given, seed, lanes) => {
    const { form } = arm;
    const solutions = [];
    const nearly = [];
    const aim = form.projection ? form.projection.target(target) : target;
    const lead = form.swivel ? $at_swivel : $corrected;
    const correct = (q, evaluations) => lead(arm, aim, given, q, evaluations);
    const corrects = form.corrects
        && $rotation_error(form, aim) * form.size <= form.tolerance;
    for (let k = 0; k < form.branches; ++k) {
        const residual = lanes.residual[k];
        if (!(lanes.invalid[k] <= 0.0)) {
            continue;
        }
        if (residual <= form.taken) {
            const q = $whole(arm, lanes.q.map((lane) => lane[k]), given);
            solutions.push({ q, residual, branch: k, singular: lanes.singular[k] > 0.0 });
        } else if (corrects && residual <= form.nearly) {
            nearly.push(k);
        }
    }
    for (const k of nearly) {
        const solved = lanes.q.map((lane) => lane[k]);
        const { missed, found } = correct(solved, $steps(form));
        if (missed <= form.tolerance) {
            const { q, residual } = found;
            /* Branches of a design say where the arm may be singular. */
            const singular = found.singular || (form.taken >= 0.0 && lanes.singular[k] > 0.0);
            $insert(arm, { q, residual, branch: k, singular }, solutions);
        }
    }
    if (corrects) {
        const lead = (evaluations) => correct(seed, evaluations);
        $stay_at_seed(arm, lead, $whole(arm, seed, given), solutions);
    }
    return solutions;
};

/* The solutions of a target by the branches of a plan. The angle of a vector that is nearly nothing may be
 * given up for one that leaves later steps a root, or be the one that the target asks for. And where a free
 * joint is at right angles to what the target is off, no step of Newton's method tells that it has to turn:
 * neither one of the turns, nor two or three of them together, is nearly a multiple of a quarter turn. */
const $solve = (arm, target, seed, given) => {
    const { form } = arm;
    const as_told = $as_told(form, target, seed, given);
    const moves = form.free_joints.some((_, i) => as_told.no_root[i].some((none) => none > 0.0));
    const branches = moves ? $branches(form, target, seed, given) : as_told;
    const solutions = $reaching(arm, target, given, seed, branches);
    if (form.taken < 0.0) {
        return solutions;
    }
    const each = Array.from({ length: form.branches }, (_, k) => k);
    const begins = (k) => as_told.invalid[k] <= 0.0 && as_told.residual[k] <= form.nearly;
    const begin = each.filter(begins).length;
    /* Of those that have led to none yet. */
    const add = (lanes) => {
        for (const { branch } of solutions) {
            lanes.invalid[branch] = 1.0;
        }
        for (const found of $reaching(arm, target, given, seed, lanes)) {
            if ($known_place(arm, found.q, solutions) < 0) {
                $insert(arm, found, solutions);
            }
        }
    };
    if (moves) {
        add(as_told);
    }
    for (const turn of [0.65, 1.9]) {
        if (solutions.length < begin) {
            add(form.lanes(target, $seed_turned(seed, turn), given, 1e-16));
        }
    }
    return solutions;
};
