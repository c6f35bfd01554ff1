/* Newton's method on the six joints of an arm. */

/* What is missing and the geometric Jacobian that makes it, by columns; lengths in units of the arm's
 * size. */
const $system = ({ fixed, slides }, target, q) => {
    const r = [0, 1, 2].map((i) => fixed[0].slice(4 * i, 4 * i + 3));
    const p = [0, 1, 2].map((i) => fixed[0][4 * i + 3]);
    const axes = [];
    const origins = [];
    for (let joint = 0; joint < 6; ++joint) {
        const next = fixed[joint + 1];
        const { sine, cosine } = slides[joint] ? { sine: 0.0, cosine: 1.0 } : $sin_cos(q[joint]);
        axes.push([r[0][2], r[1][2], r[2][2]]);
        origins.push([p[0], p[1], p[2]]);
        for (let i = 0; i < 3; ++i) {
            const [a, b, z] = r[i];
            const x = a * cosine + b * sine;
            const y = b * cosine - a * sine;
            p[i] += slides[joint] ? z * q[joint] : 0.0;
            r[i][0] = x * next[0] + y * next[4] + z * next[8];
            r[i][1] = x * next[1] + y * next[5] + z * next[9];
            r[i][2] = x * next[2] + y * next[6] + z * next[10];
            p[i] = p[i] + x * next[3] + y * next[7] + z * next[11];
        }
    }
    const columns = [];
    for (let joint = 0; joint < 6; ++joint) {
        const z = axes[joint];
        const o = origins[joint];
        const column = $zeros(6);
        for (let i = 0; i < 3; ++i) {
            const a = (i + 1) % 3;
            const b = (i + 2) % 3;
            const along = z[a] * (p[b] - o[b]) - z[b] * (p[a] - o[a]);
            column[i] = 0.5 * (slides[joint] ? z[i] : along);
            column[3 + i] = slides[joint] ? 0.0 : z[i];
        }
        columns.push(column);
    }
    const error = $zeros(6);
    let square = 0.0;
    for (let i = 0; i < 3; ++i) {
        const a = (i + 1) % 3;
        const b = (i + 2) % 3;
        error[i] = (target[4 * i + 3] - p[i]) * 0.5;
        square += error[i] * error[i];
        for (let j = 0; j < 3; ++j) {
            const apart = r[i][j] - target[4 * i + j];
            error[3 + i] += r[a][j] * (0.5 * target[4 * b + j]) - r[b][j] * (0.5 * target[4 * a + j]);
            square += apart * (0.5 * apart);
        }
    }
    return { columns, error, residual: Math.sqrt(square) };
};

/* J = Q R by the modified method of Gram and Schmidt, without roots: the columns of Q are at right
 * angles and have the lengths of the pivots; R has ones on its diagonal. What is solved with both in
 * turn is as good as by reflections (Bjorck, BIT 7, 1967). Also the squares of the pivots, and their
 * inverses. */
const $orthogonal = (system) => {
    const columns = system.columns.map((column) => column.slice());
    const above = $square(6);
    const squares = $zeros(6);
    const inverses = $zeros(6);
    for (let j = 0; j < 6; ++j) {
        squares[j] = $max($dot(columns[j], columns[j]), 1e-24);
        inverses[j] = 1.0 / squares[j];
        for (let l = j + 1; l < 6; ++l) {
            above[j][l] = $dot(columns[j], columns[l]) * inverses[j];
            for (let i = 0; i < 6; ++i) {
                columns[l][i] -= above[j][l] * columns[j][i];
            }
        }
    }
    return { columns, above, squares, inverses };
};

/* x becomes the solution of R y = x. */
const $back_substitute = ({ above }, x) => {
    for (let j = 5; j >= 0; --j) {
        for (let l = j + 1; l < 6; ++l) {
            x[j] -= above[j][l] * x[l];
        }
    }
};

/* x of J x = e. */
const $solve_jacobian = (jacobian, error) => {
    const e = error.slice();
    const x = $zeros(6);
    for (let j = 0; j < 6; ++j) {
        x[j] = $dot(jacobian.columns[j], e) * jacobian.inverses[j];
        for (let i = 0; i < 6; ++i) {
            e[i] -= x[j] * jacobian.columns[j][i];
        }
    }
    $back_substitute(jacobian, x);
    return x;
};

/* The squares of the least and of the largest pivot. */
const $extremes = ({ squares }) => squares.reduce(
    ([least, largest], square) => [-$max(-least, -square), $max(largest, square)],
    [squares[0], squares[0]],
);

/* How far from singular: 1 / (|J^-1| * the largest pivot). By the norm of all entries 1 / |J^-1| is
 * the least singular value but for a factor of the root of 6; a pivot may be far above that. */
const $independence = (jacobian) => {
    let sum = 0.0;
    for (let j = 0; j < 6; ++j) {
        /* Column j of R^-1, and J^-1 = R^-1 D^-1 Q^T. */
        const column = $zeros(6);
        column[j] = 1.0;
        let square = 1.0;
        for (let i = j - 1; i >= 0; --i) {
            for (let l = i + 1; l <= j; ++l) {
                column[i] -= jacobian.above[i][l] * column[l];
            }
            square += column[i] * column[i];
        }
        sum += square * jacobian.inverses[j];
    }
    const [, largest] = $extremes(jacobian);
    return Math.sqrt(1.0 / (sum * largest));
};

/* Whether the Jacobian of the step before is as good. */
const $is_steady = (jacobian, { residual }) => {
    const [least, largest] = $extremes(jacobian);
    return residual < 1e-10 && least > largest * 1e-6;
};

/* Moves a configuration towards the target until it is there, or for so many steps: next to a singular
 * one it may go away for some steps before it comes nearer. Where it arrived, how far the tip is from
 * the target in units of the arm's size, and how far from singular the Jacobian is. */
const $polish = (search, target, start, steps) => {
    const q = start.slice();
    let system = $system(search, target, q);
    let jacobian = $orthogonal(system);
    /* Below, the residual is rounding. */
    for (let step = 0; step < steps && system.residual > 1e-14; ++step) {
        const change = $solve_jacobian(jacobian, system.error);
        /* No joint moves by more in one step, radians or half the arm's size. */
        const longest = change.reduce((most, x) => $max(most, Math.abs(x)), 0.3);
        for (let i = 0; i < 6; ++i) {
            q[i] += (0.3 / longest) * change[i];
        }
        system = $system(search, target, q);
        if (!$is_steady(jacobian, system)) {
            jacobian = $orthogonal(system);
        }
    }
    return { q, residual: system.residual, independence: $independence(jacobian) };
};

/* The motion of the joints that moves the tip least, of length 1: the least right singular vector, by
 * inverse iteration on the transpose of J times J. */
const $weak_motion = (jacobian) => {
    /* A start that no arm is square to. */
    const x = $zeros(6).map((_, i) => 1.0 + 0.3 * i);
    for (let round = 0; round < 2; ++round) {
        for (let j = 0; j < 6; ++j) {
            for (let i = 0; i < j; ++i) {
                x[j] -= jacobian.above[i][j] * x[i];
            }
        }
        for (let j = 0; j < 6; ++j) {
            x[j] *= jacobian.inverses[j];
        }
        $back_substitute(jacobian, x);
        $normalize(x);
    }
    return x;
};

/* Near a nearly singular configuration, the two others at which the target may be reached, to second
 * order. Where J v is small, what is missing is e = J d + H(d, d)/2 with d = a v + ..., and along v the
 * roots of v.J^-1 e = a + a^2 v.J^-1 H(v, v)/2 tell a; where there are none, both are where the tip
 * comes nearest: the bifurcation equation of Lyapunov and Schmidt to second order (Golubitsky and
 * Schaeffer, Singularities and Groups in Bifurcation Theory I, 1985, chapter I). H(v, v) is a second
 * difference. */
const $split = (search, target, q) => {
    /* How far the second derivative is taken, and the second order may tell anything, radians. */
    const bend_by = 1e-3;
    const farthest = 0.5;
    const here = $system(search, target, q);
    const jacobian = $orthogonal(here);
    const v = $weak_motion(jacobian);
    const bend = here.error.map((x) => x + x);
    for (const way of [-bend_by, bend_by]) {
        const beside = $system(search, target, v.map((x, i) => q[i] + x * way));
        beside.error.forEach((x, i) => (bend[i] -= x));
    }
    const step = $solve_jacobian(jacobian, here.error);
    const bent = $solve_jacobian(jacobian, bend.map((x) => x * (1.0 / (bend_by * bend_by))));
    const e = $dot(v, step);
    const a = $dot(v, bent);
    /* (-1 +- root) / a, without cancellation. */
    const beyond = 1.0 + Math.sqrt($max(1.0 + 2.0 * a * e, 0.0));
    return [(2.0 * e) / beyond, -beyond / a].map((alpha) => {
        const less = -$max(-alpha, -farthest);
        const by = $max(less, -farthest);
        const half_square = by * by * 0.5;
        return v.map((x, i) => {
            const across = step[i] - e * x;
            const bent_across = bent[i] - a * x;
            return q[i] + across + by * x - half_square * bent_across;
        });
    });
};
