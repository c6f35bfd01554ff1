const $dot3 = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const $cross3 = (a, b) => [0, 1, 2].map((i) => {
    const [j, k] = [(i + 1) % 3, (i + 2) % 3];
    return a[j] * b[k] - a[k] * b[j];
});

/* The swivel angle, by elbow and wrist in base coordinates: how far the elbow is turned about
 * the line from the shoulder to the wrist, from where the reference direction points. */
const $swivel_angle = ({ shoulder, reference }, elbow, wrist) => {
    const line = wrist.map((x, i) => x - shoulder[i]);
    const from = elbow.map((x, i) => x - shoulder[i]);
    const scale = 1.0 / Math.sqrt($dot3(line, line));
    const way = line.map((x) => x * scale);
    const slope = $dot3(reference, way);
    const beside = reference.map((x, i) => x - slope * way[i]);
    return $atan2($dot3($cross3(way, beside), from), $dot3(beside, from));
};

/* The swivel angle of a configuration. */
const $swivel_of = (arm, q) => {
    const { swivel } = arm.form;
    const elbow = $point(arm.fk_links(q)[swivel.link], swivel.elbow);
    return $swivel_angle(swivel, elbow, $point(arm.fk(q), swivel.wrist));
};

/* The half plane in which a swivel angle has the elbow: its direction across the line of shoulder and
 * wrist, and its normal, to which the angle grows; zeros where it is not defined. */
const $half_plane = ({ shoulder, reference }, angle, wrist) => {
    const unit = (v) => {
        const scale = 1.0 / Math.max(Math.sqrt($dot3(v, v)), 2.2250738585072014e-308);
        return v.map((x) => x * scale);
    };
    const way = unit(wrist.map((x, i) => x - shoulder[i]));
    const slope = $dot3(reference, way);
    const aside = unit(reference.map((x, i) => x - slope * way[i]));
    const beside = $cross3(way, aside);
    const { sine, cosine } = $sin_cos(angle);
    return {
        direction: aside.map((x, i) => cosine * x + sine * beside[i]),
        normal: beside.map((x, i) => cosine * x - sine * aside[i]),
    };
};

/* Where Levenberg's method leads from a configuration at a swivel angle: how far the elbow is from its
 * half plane is one more coordinate of the target; infinitely far on the other side. */
const $at_swivel = (arm, target, given, whole, evaluations) => {
    const { form } = arm;
    const { swivel } = form;
    const { direction, normal } = $half_plane(swivel, given[0], $point(target, swivel.wrist));
    const elbow_of = (q) => $point(arm.fk_links(q)[swivel.link], swivel.elbow);
    const along = (elbow, way) => $dot3(way, elbow.map((x, i) => x - swivel.shoulder[i]));
    const linearize = (q) => {
        const seen = (all) => $seen(arm, all, form.solved);
        const { residual, error, rows } = $linearize(form, target, seen, q);
        const { jacobian } = seen(q);
        const elbow = elbow_of(q);
        const off = along(elbow, normal);
        const row = q.map((_, k) => {
            const [v, w] = [0, 3].map((from) => [0, 1, 2].map((i) => jacobian[from + i][k]));
            const moved = $cross3(w, elbow).map((x, i) => v[i] + x);
            return k <= swivel.link ? $dot3(normal, moved) / form.size : 0.0;
        });
        return {
            q,
            residual: Math.sqrt(residual * residual + off * off),
            error: [...error, -off / form.size],
            rows: [...rows, row],
        };
    };
    const { q, residual: missed, singular } = $correct(linearize, form.size, [...whole], evaluations);
    const all = q.map($wrap);
    return {
        missed: along(elbow_of(all), direction) >= -form.tolerance ? missed : Infinity,
        found: { q: all, residual: $distance(form, arm.fk(all), target), singular },
    };
};
