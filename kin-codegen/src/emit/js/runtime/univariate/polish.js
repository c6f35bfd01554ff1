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

/* x without what of it is along others of length 1, which are at right angles to each other. */
const $across = (x, others) =>
    others.reduce((x, other) => {
        const along = $dot(x, other);
        return x.map((x, i) => x - along * other[i]);
    }, x);

/* The motion of the joints that moves the tip least, of length 1, among those at right angles to
 * `others`: the least right singular vector, by inverse iteration on the transpose of J times J. */
const $weak_motion = (jacobian, others) => {
    /* A start that no arm is square to. */
    let x = $zeros(6).map((_, i) => 1.0 + 0.3 * i);
    for (let round = 0; round < 2; ++round) {
        x = $across(x, others);
        for (let j = 0; j < 6; ++j) {
            for (let i = 0; i < j; ++i) {
                x[j] -= jacobian.above[i][j] * x[i];
            }
        }
        for (let j = 0; j < 6; ++j) {
            x[j] *= jacobian.inverses[j];
        }
        $back_substitute(jacobian, x);
        x = $across(x, others);
        $normalize(x);
    }
    return x;
};

const $form_value = (form, [x, y]) =>
    x * x * (x * form[0] + y * form[1]) + y * y * (x * form[2] + y * form[3]);

/* How fast it grows from (x, y) in a direction. */
const $form_slope = (form, [x, y], along) =>
    along[0] * (3.0 * x * x * form[0] + 2.0 * x * y * form[1] + y * y * form[2]) +
    along[1] * (3.0 * y * y * form[3] + 2.0 * x * y * form[2] + x * x * form[1]);

/* The directions, of length 1, of a cubic form's zeros, the real parts of two that are complex. */
const $form_zeros = (form) => {
    /* By a direction d in which the form is no less than in others, a zero is r d and the one at a right
     * angle to it. */
    const size = (u) => Math.abs($form_value(form, u));
    const d = [
        [0.0, 1.0],
        [Math.SQRT1_2, Math.SQRT1_2],
        [Math.SQRT1_2, -Math.SQRT1_2],
    ].reduce((d, u) => (size(u) > size(d) ? u : d), [1.0, 0.0]);
    const beside = [-d[1], d[0]];
    const lead = $form_value(form, d);
    const third = $form_slope(form, d, beside) / lead / 3.0;
    const b = $form_slope(form, beside, d) / lead;
    /* y^3 + p y + q = 0 of y = r + third: the root of the other sign than q is alone, the others are on
     * both sides of half of it, if they are real. */
    const p = b - 3.0 * third * third;
    const q = 2.0 * third * third * third - third * b + $form_value(form, beside) / lead;
    let y = 1.0 + Math.abs(p) + Math.abs(q);
    /* Newton's method from above: each step is a third of the way at least. */
    for (let step = 0; step < 20; ++step) {
        y = (2.0 * y * y * y + Math.abs(q)) / (3.0 * y * y + p);
    }
    y = q < 0.0 ? y : -y;
    const gap = Math.sqrt($max(-p - 0.75 * y * y, 0.0));
    return [y, gap - 0.5 * y, -gap - 0.5 * y].map((y) => {
        const r = y - third;
        const share = 1.0 / Math.sqrt(1.0 + r * r);
        return beside.map((x, i) => (x + r * d[i]) * share);
    });
};

/* Near a nearly singular configuration, the three others at which the target may be reached, to second
 * order. Where J loses one or two ranks, what is missing is e = J d + H(d, d)/2 with d = a v + b w + ...
 * along the two directions that J takes nearest to zero; with u = (a, b) the parts of J^-1 of it along
 * both are u + Q(u, u)/2, two conics: the bifurcation equations of Lyapunov and Schmidt to second order
 * (Golubitsky and Schaeffer, Singularities and Groups in Bifurcation Theory I, 1985, chapter I). From a
 * solution, where nothing is missing, the others are in the directions of three u to which Q(u, u) is
 * parallel. So is nearly v where J loses one rank alone. Along each the farther root is taken, for
 * Newton's method leads to the nearer; where there is none, or two of the directions are complex, what
 * is between the two. H is a second difference. */
const $split = (search, target, q) => {
    /* How far the second derivative is taken, and the second order may tell anything, radians. */
    const bend_by = 1e-3;
    const farthest = 0.5;
    const here = $system(search, target, q);
    const jacobian = $orthogonal(here);
    const v = $weak_motion(jacobian, []);
    const w = $weak_motion(jacobian, [v]);
    const bend = (along) => {
        const bend = here.error.map((x) => x + x);
        for (const way of [-bend_by, bend_by]) {
            const beside = $system(search, target, along.map((x, i) => q[i] + x * way));
            beside.error.forEach((x, i) => (bend[i] -= x));
        }
        return bend.map((x) => x * (1.0 / (bend_by * bend_by)));
    };
    const [first, both, second] = [v, v.map((x, i) => x + w[i]), w].map(bend);
    const mixed = both.map((x, i) => 0.5 * (x - first[i] - second[i]));
    const step = $solve_jacobian(jacobian, here.error);
    const bends = [first, mixed, second].map((bend) => $solve_jacobian(jacobian, bend));
    /* By the two directions: what is missing and Q, and what of both is across. */
    const missing = [v, w].map((v) => $dot(v, step));
    const conics = [v, w].map((v) => bends.map((bent) => $dot(v, bent)));
    const step_across = $across(step, [v, w]);
    const across = bends.map((bent) => $across(bent, [v, w]));
    /* Zero where Q(u, u) is parallel to u, by falling powers of its first number. */
    const form = [
        conics[1][0],
        2.0 * conics[1][1] - conics[0][0],
        conics[1][2] - 2.0 * conics[0][1],
        -conics[0][2],
    ];
    return $form_zeros(form).map(([x, y]) => {
        const squares = [x * x, 2.0 * x * y, y * y];
        const a = squares.reduce((a, square, i) => a + square * (x * conics[0][i] + y * conics[1][i]), 0.0);
        const root = Math.sqrt($max(1.0 + 2.0 * a * (x * missing[0] + y * missing[1]), 0.0));
        const by = $max(-$max((1.0 + root) / a, -farthest), -farthest);
        return q.map((q, i) => {
            const bent = squares.reduce((bent, square, m) => bent + square * across[m][i], 0.0);
            return q + step_across[i] + by * (x * v[i] + y * w[i]) - 0.5 * by * by * bent;
        });
    });
};
