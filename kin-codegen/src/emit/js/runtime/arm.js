/* A target with the tool turned about the tip's z axis. */
const $turned = (pose, angle) => {
    const { sine, cosine } = $sin_cos(angle);
    const out = Float64Array.from(pose);
    for (let i = 0; i < 12; i += 4) {
        out[i] = pose[i] * cosine + pose[i + 1] * sine;
        out[i + 1] = pose[i + 1] * cosine - pose[i] * sine;
    }
    return out;
};

/* How far the tool is turned about the tip's z axis from where a target has it. */
const $turn_of = (reached, pose) => {
    let sine = 0.0;
    let cosine = 0.0;
    for (let i = 0; i < 12; i += 4) {
        sine += pose[i + 1] * reached[i] - pose[i] * reached[i + 1];
        cosine += pose[i] * reached[i] + pose[i + 1] * reached[i + 1];
    }
    return $atan2(sine, cosine);
};

/* An arm with the functions that its own ones and its closed form make. */
const $arm = (arm) => {
    const { form } = arm;
    arm.link_poses = (q) => {
        const poses = arm.poses(q);
        return arm.moves.map((_, i) => poses.subarray(12 * i, 12 * i + 12));
    };
    arm.fk_links = (q) => {
        const poses = arm.link_poses(q);
        return arm.joints.map(({ link }) => poses[link]);
    };
    arm.fk_frame = (q, frame) => {
        if (!Number.isInteger(frame) || !(frame in arm.frames)) {
            throw new TypeError(
                `fk_frame: frame is the number of one of ${arm.frames.length} frames, and not ${frame}`);
        }
        const { carrier, pose } = arm.frames[frame];
        return carrier === null ? Float64Array.from(pose) : $product(arm.link_poses(q)[carrier], pose);
    };
    arm.inside = (joint, value, seed = value) => $inside(arm, joint, value, seed);
    /* The same configuration within limits, moved by full turns as near to a seed as they allow, to 0
     * where that is no finite number; null if it is not within. */
    arm.within_limits = (q, seed = q) => {
        const from = (i) => (Math.abs(seed[i]) < Infinity ? seed[i] : 0.0);
        const inside = arm.joints.map((_, i) => arm.inside(i, q[i], from(i)));
        return inside.includes(null) ? null : inside;
    };
    /* One configuration that nearly reaches a target, by Levenberg's method from another one;
     * it may arrive elsewhere than it was sent. */
    arm.approach = (target, q, evaluations = 100) => {
        const all = arm.joints.map((_, i) => i);
        const aim = form ?? arm.aim;
        const { projection } = aim;
        const tip = (x) => $seen(arm, x, all);
        const seen = (x) => projection ? projection.see(tip(x)) : tip(x);
        const projected = projection ? projection.target(target) : target;
        const linearize = (x) => $linearize(aim, projected, seen, x);
        const found = $correct(linearize, aim.size, q, evaluations);
        return { q: Array.from(found.q), residual: found.residual };
    };
    if (form) {
        /* The parameters beside a target as an array: of one its value will do. */
        const given = (parameters) => {
            const values = typeof parameters === "number" ? [parameters] : parameters;
            const { length } = form.parameters;
            if (!values || values.length !== length || $no_number(values) !== null) {
                const names = form.parameters.map(({ name }) => name).join(", ");
                throw new TypeError(`a target takes ${length} parameters here, numbers: ${names}`);
            }
            return values;
        };
        /* Beyond, no digit of an angle is left. */
        const are_finite = (parameters) => parameters.every((x) => Math.abs(x) <= 1e15);
        const solve = (pose, parameters, seed) => {
            if (!are_finite(parameters)) {
                return [];
            }
            const turn = form.turns_tool ? parameters[parameters.length - 1] : 0.0;
            const target = form.turns_tool ? $turned(pose, turn) : pose;
            return form.solve(arm, target, seed, parameters);
        };
        /* Of a polynomial all roots are found without a seed. */
        const zeros = form.lanes ? form.solved.map(() => 0.0) : null;
        arm.ik_at = (pose, parameters) => solve(pose, given(parameters), zeros);
        arm.ik_seeded_at = (pose, parameters, seed) => {
            return solve(pose, given(parameters), form.solved.map((joint) => seed[joint]));
        };
        arm.ik_nearest_at = (pose, parameters, seed) => {
            return $nearest(arm, arm.ik_seeded_at(pose, parameters, seed), seed);
        };
        arm.redundancy = (pose, q) => {
            const parameters = form.locked.map((joint) => q[joint]);
            if (form.swivel) {
                parameters.push($swivel_of(arm, q));
            }
            if (form.turns_tool) {
                parameters.push($turn_of(arm.fk(q), pose));
            }
            return parameters;
        };
        arm.why_none = (pose, parameters) => {
            const are_numbers = parameters === undefined || are_finite(given(parameters));
            return are_numbers ? $why_none(form, pose) : "not finite";
        };
    }
    if (form && form.parameters.length === 0) {
        arm.ik = (pose) => arm.ik_at(pose, []);
        arm.ik_seeded = (pose, seed) => arm.ik_seeded_at(pose, [], seed);
        arm.ik_nearest = (pose, seed) => arm.ik_nearest_at(pose, [], seed);
    }
    const of_q = ["fk", "fk_links", "fk_frame", "fk_jacobian",
        "spatial_jacobian", "body_jacobian", "geometric_jacobian"];
    return $counted(arm, arm.joints.length, {
        ...Object.fromEntries(of_q.map((name) => [name, ["q"]])),
        within_limits: ["q", "seed"],
        approach: ["pose", "q"],
        redundancy: ["pose", "q"],
        why_none: ["pose"],
        ik: ["pose"],
        ik_seeded: ["pose", "seed"],
        ik_nearest: ["pose", "seed"],
        ik_at: ["pose"],
        ik_seeded_at: ["pose", "parameters", "seed"],
        ik_nearest_at: ["pose", "parameters", "seed"],
    });
};
