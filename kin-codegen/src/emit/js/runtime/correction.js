/* How far a pose is from a target, as far as the target counts, metres. */
const $distance = (form, pose, target) => {
    let shift = 0.0;
    let turn = 0.0;
    for (let i = 0; i < 12; ++i) {
        const off = pose[i] - target[i];
        if (i % 4 === 3) {
            shift += off * off;
        } else if (i % 4 === 2 || !form.counts_axis) {
            turn += (form.counts_axis ? 1.0 : 0.5) * off * off;
        }
    }
    shift = form.counts_translation ? shift : 0.0;
    return Math.sqrt(shift + (form.counts_rotation ? form.size * form.size * turn : 0.0));
};

/* A configuration as the target sees it: what is missing, and how the joints make it; lengths
 * in units of the arm's size, zero where the target does not count. `seen` has the pose and the
 * rows of the spatial Jacobian. */
const $linearize = (form, target, seen, q) => {
    const { pose, jacobian } = seen(q);
    const n = q.length;
    const error = new Float64Array(6);
    for (let i = 0; i < 3; ++i) {
        const off = pose[4 * i + 3] - target[4 * i + 3];
        error[i] = form.counts_translation ? -off / form.size : 0.0;
    }
    for (let j = form.counts_axis ? 2 : 0; form.counts_rotation && j < 3; ++j) {
        for (let i = 0; i < 3; ++i) {
            const a = (i + 1) % 3;
            const b = (i + 2) % 3;
            error[3 + i] += (form.counts_axis ? 1.0 : 0.5)
                * (pose[4 * a + j] * target[4 * b + j] - pose[4 * b + j] * target[4 * a + j]);
        }
    }
    const rows = Array.from({ length: 6 }, () => new Float64Array(n));
    for (let k = 0; k < n; ++k) {
        const v = [jacobian[0][k], jacobian[1][k], jacobian[2][k]];
        const w = [jacobian[3][k], jacobian[4][k], jacobian[5][k]];
        let along = 0.0;
        for (let i = 0; i < 3; ++i) {
            along += w[i] * pose[4 * i + 2];
        }
        for (let i = 0; i < 3; ++i) {
            const a = (i + 1) % 3;
            const b = (i + 2) % 3;
            const linear = v[i] + (w[a] * pose[4 * b + 3] - w[b] * pose[4 * a + 3]);
            const angular = form.counts_axis ? w[i] - along * pose[4 * i + 2] : w[i];
            rows[i][k] = form.counts_translation ? linear / form.size : 0.0;
            rows[3 + i][k] = form.counts_rotation ? angular : 0.0;
        }
    }
    return { q, residual: $distance(form, pose, target), error, rows };
};

/* The pose of a configuration, and rows of the spatial Jacobian for some joints. */
const $seen = (arm, q, joints) => {
    const { pose, jacobian } = arm.fk_jacobian(q);
    const n = arm.joints.length;
    const row = (i) => joints.map((joint) => jacobian[i * n + joint]);
    return { pose, jacobian: [0, 1, 2, 3, 4, 5].map(row) };
};

/* The Cholesky factor of JtJ + damping, with the reciprocals of its diagonal on the
 * diagonal. */
const $factor = (rows, damping) => {
    const n = rows.length === 0 ? 0 : rows[0].length;
    const lower = Array.from({ length: n }, () => new Float64Array(n));
    for (let i = 0; i < n; ++i) {
        for (let j = 0; j <= i; ++j) {
            lower[i][j] = i === j ? damping : 0.0;
            for (const row of rows) {
                lower[i][j] += row[i] * row[j];
            }
        }
    }
    for (let i = 0; i < n; ++i) {
        for (let j = 0; j < i; ++j) {
            for (let k = 0; k < j; ++k) {
                lower[i][j] -= lower[i][k] * lower[j][k];
            }
            lower[i][j] *= lower[j][j];
            lower[i][i] -= lower[i][j] * lower[i][j];
        }
        /* Rounding may leave the square of a singular pivot below zero. */
        lower[i][i] = 1.0 / Math.sqrt(lower[i][i] > 1e-20 ? lower[i][i] : 1e-20);
    }
    return lower;
};

const $norm = (error) => Math.sqrt(error.reduce((square, x) => square + x * x, 0.0));

/* One damped step from a configuration. */
const $step = (here, lower) => {
    const n = here.q.length;
    const x = new Float64Array(n);
    for (let i = 0; i < n; ++i) {
        for (let row = 0; row < here.rows.length; ++row) {
            x[i] += here.rows[row][i] * here.error[row];
        }
        for (let k = 0; k < i; ++k) {
            x[i] -= lower[i][k] * x[k];
        }
        x[i] *= lower[i][i];
    }
    for (let i = n - 1; i >= 0; --i) {
        for (let k = i + 1; k < n; ++k) {
            x[i] -= lower[k][i] * x[k];
        }
        x[i] *= lower[i][i];
    }
    return here.q.map((q, i) => q + x[i]);
};

/* Levenberg's method from a configuration that nearly reaches its target, damped by the square of
 * what is missing (Yamashita and Fukushima, Computing Supplement 15, 2001), for at most so many
 * evaluations; and whether the Jacobian loses rank where it has arrived. `linearize` says of a
 * configuration what is missing and how the joints make it. */
const $correct = (linearize, size, q, evaluations) => {
    let here = linearize(q);
    let weight = 1.0;
    let miss = $norm(here.error);
    for (let step = 0; step < evaluations; ++step) {
        if (!(here.residual >= 1e-14 * size && weight <= 1e12)) {
            break;
        }
        const lower = $factor(here.rows, weight * miss * miss);
        const there = linearize($step(here, lower));
        const next = $norm(there.error);
        if (next < miss) {
            weight *= next < 0.5 * miss ? 0.1 : 1.0;
            here = there;
            miss = next;
        } else {
            weight *= 8.0;
        }
    }
    const diagonal = $factor(here.rows, 0.0).map((row, i) => row[i]);
    const singular = Math.min(...diagonal) / Math.max(...diagonal) < 1e-5;
    return { q: here.q, residual: here.residual, singular };
};
