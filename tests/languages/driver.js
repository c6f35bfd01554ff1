// Reads configurations and targets of one robot and writes all that its functions have for
// them, as driver.c does.

const reader = (input) => {
    const words = input.split(/\s+/).filter((word) => word !== "");
    let next = 0;
    const number = () => {
        const word = words[next++];
        // As Rust writes them.
        return { inf: Infinity, "-inf": -Infinity }[word] ?? Number(word);
    };
    const numbers = (count) => Array.from({ length: count }, number);
    return { number, numbers };
};

const reasons = { "not finite": -1, "not a rotation": -2, "out of reach": 0 };

function forward(robot, q, write) {
    write(robot.fk(q));
    robot.fk_links(q).forEach((pose) => write(pose));
    write(robot.spatial_jacobian(q));
    write(robot.body_jacobian(q));
    write(robot.geometric_jacobian(q));
    const { pose, jacobian } = robot.fk_jacobian(q);
    write(pose);
    write(jacobian);
    robot.frames.forEach((_, frame) => {
        write([0]);
        write(robot.fk_frame(q, frame));
    });
    if (robot.frames.length > 0) {
        write([-1, -1]);
    }
    const inside = robot.within_limits(q);
    write([inside ? 1 : 0]);
    write(inside ?? robot.joints.map((_, i) => robot.inside(i, q[i]) ?? q[i]));
}

function inverse(robot, { numbers }, write) {
    const { parameters } = robot.form;
    const pose = numbers(12);
    const seed = numbers(robot.joints.length);
    write(robot.redundancy(pose, seed));
    const given = numbers(parameters.length);
    const solutions = robot.ik_at(pose, given);
    write([solutions.length > 0 ? solutions.length : reasons[robot.why_none(pose, given)]]);
    for (const { q, residual, branch, singular } of solutions) {
        write([branch, singular ? 1 : 0, residual]);
        write(q);
    }
    const nearest =
        parameters.length === 0
            ? robot.ik_nearest(pose, seed)
            : robot.ik_nearest_at(pose, given, seed);
    const seeded = robot.ik_seeded_at(pose, given, seed);
    const none = seeded.length > 0 ? -3 : reasons[robot.why_none(pose, given)];
    write([nearest ? 1 : none]);
    if (nearest) {
        write(nearest.q);
    }
}

export function all_of(robot, input) {
    const read = reader(input);
    const out = [];
    const write = (numbers) => out.push(Array.from(numbers).join(" "));
    for (let count = read.number(); count > 0; --count) {
        forward(robot, read.numbers(robot.joints.length), write);
    }
    if (robot.form) {
        for (let count = read.number(); count > 0; --count) {
            inverse(robot, read, write);
        }
    }
    return out.join("\n");
}

export function name_of(robot) {
    const names = [robot.name, robot.base, robot.joints[0].name];
    return names.every((name) => name === names[0]) ? names[0] : names.join(" is not ");
}

// Of a mechanism: targets, and for each the poses and all solutions of all chains.
export function placed_of(mechanism, input) {
    const read = reader(input);
    const out = [];
    const write = (numbers) => out.push(Array.from(numbers).join(" "));
    for (let count = read.number(); count > 0; --count) {
        const placed = mechanism.ik(read.numbers(12));
        write([placed.length]);
        for (const { pose, solutions } of placed) {
            write(pose);
            for (const found of solutions) {
                write([found.length]);
                found.forEach(write);
            }
        }
    }
    return out.join("\n");
}

// Of a mechanism: closed configurations, each with its driven joints moved; how far the loops
// were from closed, and what they are closed to.
export function closed_of(mechanism, input) {
    const read = reader(input);
    const out = [];
    const write = (numbers) => out.push(Array.from(numbers).join(" "));
    const joints = mechanism.chains.reduce((sum, { arm }) => sum + arm.joints.length, 0);
    for (let count = read.number(); count > 0; --count) {
        const q = read.numbers(joints);
        write([mechanism.gap(q)]);
        mechanism.actuated.forEach((joint, i) => (q[joint] += 0.01 * (i % 3) - 0.01));
        const { q: closed, residual } = mechanism.close(q, mechanism.actuated, 40);
        write([residual]);
        write(closed);
    }
    return out.join("\n");
}

// Of a mechanism: how far the ends of its chains are apart.
export function gap_of(mechanism, input) {
    const joints = mechanism.chains.reduce((sum, { arm }) => sum + arm.joints.length, 0);
    return String(mechanism.gap(reader(input).numbers(joints)));
}

// What stands in place of a robot is asked.
export function ask_of(asked) {
    return asked.ask().join(" ");
}

// Of joint values: how many solutions the target that they make has.
export function count_of(robot, input) {
    const { numbers } = reader(input);
    return String(robot.ik(robot.fk(numbers(robot.joints.length))).length);
}

// The answer, or what it is refused with.
function said(ask) {
    try {
        return String(ask());
    } catch (error) {
        return String(error);
    }
}

// What is answered where arrays are longer or shorter than they should be: a line each.
export function with_lengths(robot, input) {
    const q = reader(input).numbers(robot.joints.length);
    const pose = robot.fk(q);
    const short = q.slice(1);
    return [
        said(() => robot.fk(short)),
        said(() => robot.fk()),
        said(() => robot.fk_jacobian(Float64Array.from([...q, 0]))),
        said(() => robot.fk_frame(0, 0)),
        said(() => robot.ik([...pose, 0, 0, 0, 1])),
        said(() => robot.ik_seeded(pose, short)),
        said(() => robot.ik_nearest(pose)),
        said(() => robot.within_limits(q, short)),
        said(() => robot.fk(q.map(String))),
        said(() => robot.fk_jacobian([null, ...short])),
        said(() => robot.ik(Array.from(pose).map(String))),
        said(() => robot.fk_frame(q, 99)),
        said(() => robot.within_limits(q).length),
        said(() => robot.within_limits(q, q.map(() => NaN)).length),
        said(() => robot.approach(pose, q.map((x) => x + 0.1)).residual < 1e-9),
        said(() => robot.ik_nearest(Float64Array.from(pose), q).q.length),
    ].join("\n");
}

// The same of a mechanism.
export function mechanism_with_lengths(mechanism, input) {
    const q = reader(input).numbers(3);
    const joints = mechanism.chains.flatMap(({ arm }) => arm.joints).length;
    return [
        said(() => mechanism.gap(q)),
        said(() => mechanism.platform([...q, 0])),
        said(() => mechanism.close(q, [0], 10)),
        said(() => mechanism.close(new Array(joints).fill(0.0), [0, joints], 10)),
        said(() => mechanism.close(new Array(joints).fill(0.0), null, 10)),
        said(() => mechanism.ik(q)),
    ].join("\n");
}

// What is answered where parameters are not as they should be: a line each.
export function with_parameters(robot, input) {
    const { numbers } = reader(input);
    const q = numbers(robot.joints.length);
    const pose = robot.fk(q);
    const [own] = robot.redundancy(pose, q);
    const far = q.map((x, i) => (i === 0 ? 1e160 : x));
    return [
        said(() => robot.ik_at(pose, own).length === robot.ik_at(pose, [own]).length),
        said(() => robot.ik_at(pose, [])),
        said(() => robot.ik_at(pose)),
        said(() => robot.why_none(pose, [own, own])),
        said(() => robot.ik_at(pose, "6")),
        said(() => robot.ik_at(pose, [1e16]).length),
        said(() => robot.why_none(pose, [1e16])),
        said(() => robot.ik_nearest_at(pose, own, far) !== null),
    ].join("\n");
}
