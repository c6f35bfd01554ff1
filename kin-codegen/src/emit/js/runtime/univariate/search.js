/* The solutions of a target, by the eliminations of an arm. */

/* Solutions at most, and configurations that wait at a time. */
const $MOST_FOUND = 16;
const $MOST_WAITING = 8;
/* Solutions reach the target to this, in units of the arm's size. */
const $REACHED = 1e-13;
/* Below this independence of the Jacobian's columns a configuration is singular. */
const $SINGULAR = 1e-5;
/* Solutions that are nearer to each other, radians or half the arm's size, are one. */
const $SAME = 1e-6;
/* Singular solutions that are nearer to each other, radians or half the arm's size, are one, or
 * members of a family; from so near, Newton's method leads to a regular solution. */
const $FAMILY = 1e-4;
/* What comes no nearer than this to a target, in units of the arm's size, is not next to a solution. */
const $NEXT_TO = 1e-6;
/* Of a slide that is farther, in the same units, rounding alone may miss the target. */
const $FARTHEST = 1e6;
/* Cosines and sines that are off by more are those of an extraneous root; by more than the second, they
 * are not of one of several that have almost met; where they are off by less than the third, a null
 * vector is of one solution, and no mixture. */
const $EXTRANEOUS = 0.05;
const $MIXED = 0.5;
const $PURE = 1e-3;
/* The same of a vector that eigenvalues tell from others: of no solution. */
const $OF_NONE = 0.2;
/* Where zeros have met is one place, radians, that others are farther from. */
const $SAME_PLACE = 1e-6;
/* What is taken to less may be of solutions next to a value of the kept joint. */
const $NULL = 1e-2;
/* Relative noise above which no answer is sure. */
const $UNCERTAIN = 1e-9;
/* Below this another solution may be so near that roots of the polynomial do not tell the two apart. */
const $MEETING = 3e-3;
/* Steps of Newton's method at most; twice as many where it converges slowly. */
const $NEWTON_STEPS = 6;

/* How far two values of a joint are apart. */
const $apart = ({ of }, joint, a, b) => Math.abs(of.slides[joint] ? a - b : $wrap(a - b));

/* Whether no joint is farther from where it is in the other configuration. */
const $are_within = (search, distance, a, b) =>
    a.every((x, i) => $apart(search, i, x, b[i]) <= distance);

/* The place of a regular solution, which is appended unless it is there: of two the better one is
 * kept. -1 if there is no place left. */
const $place_of = (search, solution) => {
    const { regular } = search;
    const is_same = (known) => known.q.every((x, i) => $apart(search, i, x, solution.q[i]) < $SAME);
    const known = regular.findIndex(is_same);
    if (known >= 0) {
        if (solution.residual < regular[known].residual) {
            regular[known] = { ...solution, branch: regular[known].branch };
        }
        return known;
    }
    return regular.length === $MOST_FOUND ? -1 : regular.push(solution) - 1;
};

/* Adds a configuration that has arrived, if it is a solution; whether it is one. */
const $insert_arrived = (search, arrived, branch) => {
    const { residual, independence } = arrived;
    const { of, gap, regular, singular } = search;
    if (!(residual <= $NEXT_TO) || arrived.q.some((x) => Math.abs(x) > $FARTHEST)) {
        return false;
    }
    const solution = {
        q: arrived.q.map((x, i) => (of.slides[i] ? x : $wrap(x))),
        residual: of.size * Math.sqrt(residual * residual + gap * gap),
        branch,
        singular: independence < $SINGULAR,
        independence,
    };
    if (!(residual <= $REACHED)) {
        search.nearest = residual < search.nearest_by ? solution : search.nearest;
        search.nearest_by = Math.min(residual, search.nearest_by);
        return false;
    }
    /* Next to the threshold one that is found twice is what it was the first time. */
    const is_same = ({ q }) => $are_within(search, $SAME, q, solution.q);
    if (singular.some(is_same)) {
        return true;
    }
    solution.singular = solution.singular && !regular.some(is_same);
    if (!solution.singular) {
        const place = $place_of(search, solution);
        if (place >= 0) {
            search.again |= 1 << place;
            regular[place].independence = independence;
        }
        return true;
    }
    const is_of_family = ({ q }) => $are_within(search, $FAMILY, q, solution.q);
    if (!singular.some(is_of_family) && singular.length < $MOST_FOUND) {
        singular.push(solution);
    }
    return true;
};

/* Whether the solution next to a configuration is known: a regular one, with no other beside it, where
 * it is `meeting` from singular or more. */
const $is_known = (search, q) => {
    const known = search.regular.findIndex((it) =>
        it.independence > search.meeting && $are_within(search, $FAMILY, it.q, q));
    search.again |= known >= 0 ? 1 << known : 0;
    return known >= 0;
};

/* A target's rotation, made orthonormal by Newton's method. */
const $orthonormalize = (target) => {
    for (let step = 0; step < 5; ++step) {
        const dual = $square(3);
        for (let i = 0; i < 3; ++i) {
            const x = target.slice(4 * ((i + 1) % 3));
            const y = target.slice(4 * ((i + 2) % 3));
            for (let j = 0; j < 3; ++j) {
                const a = (j + 1) % 3;
                const b = (j + 2) % 3;
                dual[i][j] = x[a] * y[b] - x[b] * y[a];
            }
        }
        const volume = $dot(dual[0], target);
        for (let i = 0; i < 3; ++i) {
            for (let j = 0; j < 3; ++j) {
                target[4 * i + j] = 0.5 * (target[4 * i + j] + dual[i][j] / volume);
            }
        }
    }
};

/* A rotation whose third column is along that of a target (Duff et al., J. Computer Graphics
 * Techniques 6, 2017). */
const $complete_axis = (target) => {
    const axis = [target[2], target[6], target[10]];
    const length = Math.sqrt($dot(axis, axis));
    const [x, y, z] = axis.map((it) => it / length);
    const sign = $copysign(1.0, z);
    const a = -1.0 / (sign + z);
    const b = x * y * a;
    const rotation = [1.0 + sign * x * x * a, b, x, sign * b, sign + y * y * a, y, -sign * x, -y, z];
    rotation.forEach((it, i) => (target[4 * Math.floor(i / 3) + (i % 3)] = it));
};

/* What is known of a target, which is a rotation, lengths in units of half the arm's size: nothing
 * yet. Where solutions are less independent than `meeting`, another one may be near. */
const $search_of = (of, target) => ({
    of,
    target,
    /* How far the rotation asked for is from the one that is reached, radians. */
    gap: 0.0,
    regular: [],
    singular: [],
    /* What has come near without being a solution, and how near, in units of the arm's size. */
    nearest: null,
    nearest_by: Infinity,
    /* Bit i is set where regular solution i was found again since this was cleared. */
    again: 0,
    /* The branch of the next solution. */
    branch: 0,
    /* Near the target, where Newton's method led to, and no further. */
    stuck: [],
    meeting: $MEETING,
    /* Whether another target is the one that is meant. */
    is_beside: false,
    /* Of so many solutions the neighbours were looked for. */
    looked_at: { regular: 0, singular: 0 },
});

/* The same of a target as given, lengths in metres. */
const $begin = (form, given) => {
    const { size } = form.search;
    const target = Array.from(given, (x, i) => x * (i % 4 === 3 ? 2.0 / size : 1.0));
    const gap = $rotation_error(form, given);
    if (form.counts_axis) {
        $complete_axis(target);
    } else if (gap <= 0.1) {
        $orthonormalize(target);
    }
    return { ...$search_of(form.search, target), gap };
};

/* Whether a target is farther away than the arm is long. */
const $is_too_far = ({ fixed, slides }, target) => {
    const length = (pose) => Math.sqrt(pose[3] * pose[3] + pose[7] * pose[7] + pose[11] * pose[11]);
    const reach = fixed.reduce((sum, pose) => sum + length(pose), 1e-6);
    return !slides.some(Boolean) && length(target) > reach;
};

/* Keeps where Newton's method has come near to a target that it converges to slowly, or that is out of
 * reach by little. */
const $stick = (search, { q, residual }) => {
    const is_there = (other) => $are_within(search, $FAMILY, other, q);
    if (residual < 1e-3 && search.stuck.length < $MOST_WAITING && !search.stuck.some(is_there)) {
        search.stuck.push(q);
    }
};

/* Adds where Newton's method has arrived, as a branch of its own if it is new; whether it is a
 * solution. */
const $insert_new = (search, arrived) => {
    const count = () => search.regular.length + search.singular.length;
    const before = count();
    const is_reached = $insert_arrived(search, arrived, search.branch);
    search.branch += count() > before ? 1 : 0;
    return is_reached;
};

/* Starts Newton's method from a configuration. */
const $start = (search, q) => {
    const arrived = $polish(search.of, search.target, q, 2 * $NEWTON_STEPS);
    if (!$insert_new(search, arrived)) {
        $stick(search, arrived);
    }
};

/* The same, if it may be near a solution that is not known: if it is off by no more. */
const $start_unknown = (search, { q, inconsistency }, off) => {
    if (inconsistency < off && !$is_known(search, q)) {
        $start(search, q);
    }
};

/* The kept joint's values at regular solutions. */
const $kept = (search, { elimination: { joints, backwards } }) =>
    search.regular.map(({ q }) => (backwards ? -q[joints[0]] : q[joints[0]]));

/* Adds the solution at every root that is one, if it has one; those that may have more. */
const $one_each = (search, loop, roots) => {
    const is_one = ({ is_twice, is_several }) => !is_twice && !is_several;
    const unclear = roots.candidates.filter((candidate) => !is_one(candidate));
    for (const candidate of roots.candidates.filter(is_one)) {
        const { q, inconsistency: off } = $recover(loop, candidate.angle);
        const before = search.again;
        const is_known = $is_known(search, q);
        /* Next to another one a root is known to half of its digits. */
        const is_mixed = off >= $EXTRANEOUS && $has_neighbour(roots, candidate);
        if ((is_known && (search.again === before || off > $PURE)) || is_mixed) {
            unclear.push(candidate);
        } else if (!is_known && off < $EXTRANEOUS) {
            $insert_new(search, $polish(search.of, search.target, q, $NEWTON_STEPS));
            /* It may have led to the solution at another root. */
            const is_its_own = (kept, place) =>
                ((search.again & ~before) >> place) & 1 && Math.abs($wrap(kept - candidate.angle)) < $CLUSTER;
            if (!$kept(search, loop).some(is_its_own)) {
                unclear.push(candidate);
            }
        } else if (!is_known && $null_space_at(loop, candidate.angle, 2).lengths.every((it) => it < $NULL)) {
            /* Where more is taken to zero than what is of a solution, a vector need not be. */
            unclear.push(candidate);
        }
    }
    return unclear.map((candidate) => ({ ...candidate, zeros: null, is_met: false }));
};

/* Whether two of them are one. */
const $is_same = (a, b) => Math.abs($wrap(a - b)) < 1e-9;

/* A root of several is known to a quarter of its digits, and what is nearly taken to zero there mixes
 * the solutions that share it. Those that are found have all digits of it, and there what is taken to zero
 * tells whether some are missing, which other ratios may tell apart. */
const $share_exactly = (search, loop, unclear) => {
    const several = unclear.filter(({ is_several }) => is_several).map(({ angle }) => angle);
    const sharing = (kept) => $kept(search, loop).filter((it) => $is_same(it, kept)).length;
    const is_near = (kept) => several.some((angle) => Math.abs($wrap(kept - angle)) < $CLUSTER);
    const known = [];
    for (const kept of $kept(search, loop).filter(is_near)) {
        if (known.length < $MOST_WAITING && !known.some((it) => $is_same(it, kept)) && sharing(kept) < $SHARING) {
            known.push(kept);
        }
    }
    const spaces = known.map((kept) => ({ kept, ...$null_space_at(loop, kept, $SHARING) }));
    $RATIOS.forEach((ratio, i) => {
        const are_missing = ({ kept, lengths }) =>
            i === 0 || lengths.filter((it) => it < $NULL).length > sharing(kept);
        spaces.filter(are_missing)
            .flatMap(({ kept, space }) => $recover_sharing(loop, kept, space, ratio).starts)
            .forEach((start) => $start_unknown(search, start, $MIXED));
    });
};

/* The candidates with the zeros near them; not where a root of all targets was taken from the polynomial.
 * Where a few zeros have met one is left, at the angle where they have. */
const $with_zeros = ({ fold }, f, candidates) => {
    candidates.forEach((candidate, i) => {
        const { angle } = candidate;
        const known = candidates.slice(0, i).find(({ zeros }) => $cover(zeros, angle));
        const zeros = known ? known.zeros : $zeros_near(f, angle);
        candidate.zeros = fold !== null && $are_near(zeros, fold) ? null : zeros;
    });
    /* Next to a target with a family of solutions what is nearly taken to zero is more than theirs. */
    if (!(f.noise < $NOISY)) {
        return candidates;
    }
    const left = [];
    for (const candidate of candidates) {
        const { zeros, is_twice, is_several } = candidate;
        const are_few = zeros !== null && zeros.count >= 2 && zeros.count <= $SHARING;
        const angle = are_few && (is_twice || is_several) ? $meeting(f, zeros) : null;
        const is_there = (it) => it.is_met && Math.abs($wrap(it.angle - angle)) < $SAME_PLACE;
        if (angle === null) {
            left.push(candidate);
        } else if (!left.some(is_there)) {
            left.push({ ...candidate, angle, is_met: true });
        }
    }
    return left;
};

/* Whether near a candidate as many solutions are known as there are zeros: no two have one. */
const $is_settled = (search, loop, { zeros }) => {
    if (zeros === null) {
        return false;
    }
    let count = 0;
    let places = 0;
    $kept(search, loop).forEach((kept, place) => {
        if ($are_near(zeros, kept)) {
            count += 1;
            places |= 1 << place;
        }
    });
    const is_settled = count === zeros.count;
    search.again |= is_settled ? places : 0;
    return is_settled;
};

/* The candidates that other solutions than those that are known may be near. */
const $unsettled = (search, loop, candidates) =>
    candidates.filter((candidate) => !$is_settled(search, loop, candidate));

/* Adds the solutions of so many that share a value of the kept joint at the candidates that are wanted;
 * those that may have more. */
const $share = (search, loop, unclear, is_wanted, sharing, off) => {
    for (const candidate of unclear.filter(is_wanted)) {
        const { angle, zeros, is_met } = candidate;
        const { space, lengths } = $null_space_at(loop, angle, sharing);
        const shared = $recover_sharing(loop, angle, space, $RATIOS[0]);
        if (is_met && zeros.count === sharing) {
            const count = sharing - $extraneous(shared, lengths, $OF_NONE);
            candidate.zeros = { ...zeros, count };
        }
        shared.starts.filter((_, n) => !shared.told.are_complex[n])
            .forEach((start) => $start_unknown(search, start, off));
    }
    return $unsettled(search, loop, unclear);
};

/* Adds the solutions that share a value of the kept joint; the candidates that may have more. Where a
 * pivot is nearly zero at all its values, as next to a target with a family of solutions, so is what it
 * leaves alone, and the space of two solutions has more dimensions. */
const $several_each = (search, loop, is_noisy, candidates) => {
    const may_be_more = ({ is_several, zeros }) => is_several && zeros !== null && zeros.count > 2;
    const stages = [
        [(it) => !may_be_more(it), 2, $EXTRANEOUS],
        [({ is_several }) => is_noisy || is_several, $SHARING, $MIXED],
        [may_be_more, 2, $EXTRANEOUS],
    ];
    let unclear = $unsettled(search, loop, candidates);
    for (const [is_wanted, sharing, off] of stages) {
        unclear = $share(search, loop, unclear, is_wanted, sharing, off);
    }
    $share_exactly(search, loop, unclear);
    unclear = $unsettled(search, loop, unclear);
    /* What else is nearly taken to zero mixes with the two. */
    return $share(search, loop, unclear, ({ is_twice }) => is_twice, $SHARING, $EXTRANEOUS);
};

/* Adds the solutions that nearly singular ones have nearly met, and those between which Newton's method
 * got stuck; where several meet, each shows the next. */
const $meet = (search) => {
    const { of, target, regular, singular, looked_at } = search;
    let points = search.stuck;
    search.stuck = [];
    for (let round = 0; round < 4; ++round) {
        for (; points.length < $MOST_WAITING && looked_at.regular < regular.length; ++looked_at.regular) {
            const { q, independence } = regular[looked_at.regular];
            if (independence < search.meeting) {
                points.push(q);
            }
        }
        for (; points.length < $MOST_WAITING && looked_at.singular < singular.length; ++looked_at.singular) {
            points.push(singular[looked_at.singular].q);
        }
        if (points.length === 0) {
            break;
        }
        points.flatMap((q) => $split(of, target, q)).forEach((q) => $start(search, q));
        points = [];
    }
    if (!search.is_beside) {
        search.stuck = [];
    }
};

/* Where a family of solutions makes a polynomial of zeros, those of targets beside this one are none,
 * and the regular solutions there are beside those here. */
const $ask_beside = (search, elimination) => {
    if (search.is_beside) {
        return;
    }
    /* A turn by 1e-4 about (0.36, 0.48, 0.8), and lengths in units of half the arm's size. */
    const [x, y, z, w] = [0.36 * 0.5e-4, 0.48 * 0.5e-4, 0.8 * 0.5e-4, 1.0];
    const s = 2.0 / (x * x + y * y + z * z + w * w);
    const there = [
        1.0 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w), 3e-5,
        s * (x * y + z * w), 1.0 - s * (x * x + z * z), s * (y * z - x * w), -5e-5,
        s * (x * z - y * w), s * (y * z + x * w), 1.0 - s * (x * x + y * y), 8e-5,
    ];
    /* Where solutions have met, one of the two is out of reach. */
    for (const by of [there, $inverse(there)]) {
        const beside = { ...$search_of(search.of, $product(search.target, by)), is_beside: true };
        $ask(beside, elimination);
        [...beside.regular, ...beside.singular].forEach(({ q }) => $start(search, q));
        /* Of a family that leads nowhere else these are next to its members. */
        beside.stuck.forEach((q) => $start(search, q));
    }
    $meet(search);
};

/* Where a family of solutions makes a polynomial of zeros, every value that the kept joint has in the
 * family is a root: adds the members at some, which are alone there or two. */
const $take_members = (search, loop) => {
    const before = search.singular.length;
    const two_at = (kept) =>
        $recover_sharing(loop, kept, $null_space_at(loop, kept, 2).space, $RATIOS[0]).starts;
    for (const offset of [0.0, 0.5]) {
        const kept = Array.from({ length: 8 }, (_, k) => (k + offset) * (6.283185307179586 / 8));
        for (const starts_at of [(at) => [$recover(loop, at)], two_at]) {
            kept.flatMap(starts_at).forEach((start) => $start_unknown(search, start, $EXTRANEOUS));
            if (search.singular.length > before) {
                return;
            }
        }
    }
};

/* Whether there is nothing left to look for, and what was known before was found again. */
const $has_all = (search, unclear) =>
    unclear.length === 0 && search.again === (1 << search.regular.length) - 1;

/* Adds what one elimination finds; whether all solutions are sure to be among those found. */
const $ask = (search, elimination) => {
    const loop = $loop(search.of, elimination, search.target);
    const f = $polynomial(loop);
    if (!(f.noise < 1e-3)) {
        $take_members(search, loop);
        $ask_beside(search, elimination);
        return false;
    }
    const roots = $find_roots(f);
    search.again = 0;
    let unclear = $one_each(search, loop, roots);
    const may_be_certain = !roots.is_incomplete && f.noise < $UNCERTAIN;
    if (may_be_certain) {
        unclear = $with_zeros(elimination, f, unclear);
    }
    unclear = $several_each(search, loop, f.noise >= $NOISY, unclear);
    if (!may_be_certain || !$has_all(search, unclear)) {
        if (roots.is_incomplete || f.noise > 1e-7) {
            $ask_beside(search, elimination);
        }
        $meet(search);
        unclear = $unsettled(search, loop, unclear);
    }
    return may_be_certain && $has_all(search, unclear);
};

/* Asks the eliminations in turn until one is sure of its answer. */
const $ask_in_turn = (search) =>
    search.of.eliminations.some((elimination) => $ask(search, elimination));

/* Joint values in the units of an elimination, of six joints: those behind an arm's tip are at zero. */
const $in_units = ({ size, slides }, q) =>
    slides.map((slide, i) => (i < q.length ? q[i] : 0.0) * (slide ? 2.0 / size : 1.0));

/* Where Levenberg's method leads. */
const $lead = (of, target, from) => {
    const linearize = (q) => {
        const { columns, ...system } = $system(of, target, q);
        const rows = system.error.map((_, i) => columns.map((column) => column[i]));
        return { q, rows, ...system };
    };
    return $correct(linearize, 1.0, from, 40).q;
};

/* Takes the seed in if it is a singular solution, in front of the others and in place of one that is
 * next to it. Where the Jacobian loses two ranks at once Newton's steps, which divide rounding by both
 * pivots, lead away from one. */
const $keep = (form, search, seed) => {
    const from = $in_units(form.search, seed);
    const polish = (from, steps) => $polish(form.search, search.target, from, steps);
    let arrived = polish(from, $NEWTON_STEPS);
    if (arrived.residual > $REACHED && polish(from, 0).residual < 1e-2) {
        arrived = polish($lead(form.search, search.target, from), 0);
    }
    if (!(arrived.independence < $SINGULAR)) {
        return;
    }
    const others = search.singular.splice(0);
    $insert_arrived(search, arrived, search.branch);
    const [kept] = search.singular;
    const is_other = ({ q }) => !kept || !$are_within(search, $FAMILY, kept.q, q);
    search.singular.push(...others.filter(is_other));
};

/* The solutions of a target as the joints that are solved for see it: the regular ones, then the
 * singular ones that were found first, as far as there is room. If the seed is a singular solution, it
 * is among them. */
const $search_target = (form, target, seed) => {
    const search = $begin(form, target);
    if (seed) {
        $keep(form, search, seed);
    }
    if (search.gap <= 1e-9 && !$is_too_far(form.search, search.target)) {
        $ask_in_turn(search);
    }
    const [kept] = form.search.eliminations[0].joints;
    const by_kept = (a, b) => a.q[kept] - b.q[kept];
    const singular = search.singular.slice(0, $MOST_FOUND - search.regular.length);
    const solutions = [...search.regular.sort(by_kept), ...singular.sort(by_kept)];
    return { solutions, nearest: search.nearest };
};

/* Whether the joints behind the tip are at zero. A turn about the tip's axis, where it is free, is one
 * that need not be. */
const $is_at_zero = (form, q, within) => {
    const moving = form.solved.length + (form.counts_axis ? 1 : 0);
    return q.slice(moving).every((x) => Math.abs(x) < within);
};

/* The solutions among those that were found, with what is given: of an arm of fewer than six joints
 * those that have the ones behind its tip at zero. Where there are none, what comes nearest is led on:
 * where the Jacobian has lost two ranks, or one next to a family of solutions, Newton's steps are at a
 * loss. */
const $to_solutions = (arm, target, given, { solutions: found, nearest }) => {
    const { form } = arm;
    const { size, slides } = form.search;
    const solved = ({ q }) =>
        q.slice(0, form.solved.length).map((x, i) => (slides[i] ? 0.5 * size * x : x));
    /* Where six joints are nearly singular, a target that is off by rounding is reached with the joints
     * behind the tip this far from zero. */
    const may_be = ({ q }) => $is_at_zero(form, q, 1e-2);
    const solutions = [];
    const arrive_from = (it, evaluations) => {
        const { missed, found } = $corrected(arm, target, given, solved(it), evaluations);
        if (missed <= 1e-9 * size) {
            const { q, residual, singular } = found;
            $insert(arm, { q, residual, branch: it.branch, singular }, solutions);
        }
    };
    for (const it of found.slice(0, $MOST_FOUND).filter(may_be)) {
        if (form.search.is_whole) {
            const { residual, branch, singular } = it;
            solutions.push({ q: $whole(arm, solved(it), given), residual, branch, singular });
        } else {
            /* A regular solution takes two evaluations. */
            arrive_from(it, 24);
        }
    }
    if (solutions.length === 0 && nearest && may_be(nearest)) {
        arrive_from(nearest, 96);
    }
    return solutions;
};

/* The motion back of a joint of value q: of its twist, linear and angular. */
const $undo = (twist, q) => {
    const v = twist.slice(0, 3);
    const w = twist.slice(3);
    const turns = w.some((x) => x !== 0.0);
    const { sine, cosine } = turns ? $sin_cos(-q) : { sine: 0.0, cosine: 1.0 };
    const out = new Float64Array(12);
    for (let i = 0; i < 3; ++i) {
        for (let j = 0; j < 3; ++j) {
            out[4 * i + j] += (i === j ? cosine : 0.0) + (1.0 - cosine) * w[i] * w[j];
        }
        const a = (i + 1) % 3;
        const b = (i + 2) % 3;
        out[4 * i + b] += sine * w[a];
        out[4 * i + a] -= sine * w[b];
    }
    /* A point of the axis. */
    const p = [0, 1, 2].map((i) => {
        const a = (i + 1) % 3;
        const b = (i + 2) % 3;
        return w[a] * v[b] - w[b] * v[a];
    });
    for (let i = 0; i < 3; ++i) {
        out[4 * i + 3] = turns
            ? p[i] - (out[4 * i] * p[0] + out[4 * i + 1] * p[1] + out[4 * i + 2] * p[2]) : -q * v[i];
    }
    return out;
};

/* The target of the joints that are solved for: those that are given stand at the ends, and their
 * motions are known, the first ones seen from the base, the others from the tip. */
const $carried = ({ front, between, behind }, target, given) => {
    const from_base = front.reduce((pose, twist, i) => $product($undo(twist, given[i]), pose), target);
    const at_the_tip = given.slice(front.length + between.length);
    return behind.reduceRight(
        (pose, twist, i) => $product(pose, $undo(twist, at_the_tip[i])), from_base);
};

/* The form with the joints that are given between those that are solved for at their values. */
const $at_given = (form, given) => {
    const { front, between } = form.search;
    const fixed = [...form.search.fixed];
    for (let i = between.length - 1; i >= 0; --i) {
        const { behind, twist } = between[i];
        fixed[behind] = $product($undo(twist, -given[front.length + i]), fixed[behind]);
    }
    return { ...form, search: { ...form.search, fixed } };
};

/* The solutions of a target by eliminations alone. Of a polynomial's roots the branch is the place. */
const $solve_by_roots = (arm, target, seed, given) => {
    const form = $at_given(arm.form, given);
    const found = $search_target(form, $carried(form.search, target, given), seed);
    const solutions = $to_solutions(arm, target, given, found);
    return solutions.map((solution, branch) => ({ ...solution, branch }));
};
