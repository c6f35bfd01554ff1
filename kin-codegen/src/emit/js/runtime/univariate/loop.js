/* A line in space as fifteen numbers on which rigid motions act linearly: of a line through p
 * along l these are l, p, m = p x l, n = l (p.p) - 2 p (p.l), p.p, p.l and 1. The line after a
 * rigid motion, in its place. */
const $move_line = (pose, line) => {
    const t = [pose[3], pose[7], pose[11]];
    const square = t[0] * t[0] + t[1] * t[1] + t[2] * t[2];
    const one = line[14];
    for (let v = 0; v < 12; v += 3) {
        const [x, y, z] = [line[v], line[v + 1], line[v + 2]];
        for (let i = 0; i < 3; ++i) {
            line[v + i] = pose[4 * i] * x + pose[4 * i + 1] * y + pose[4 * i + 2] * z;
        }
    }
    const [l, p, m, n] = [0, 3, 6, 9];
    const along_line = t[0] * line[l] + t[1] * line[l + 1] + t[2] * line[l + 2];
    const along_point = t[0] * line[p] + t[1] * line[p + 1] + t[2] * line[p + 2];
    for (let i = 0; i < 3; ++i) {
        const a = (i + 1) % 3;
        const b = (i + 2) % 3;
        const across = t[a] * line[m + b] - t[b] * line[m + a];
        line[n + i] += square * line[l + i] - 2.0 * (across + t[i] * (line[13] + along_line));
    }
    for (let i = 0; i < 3; ++i) {
        const a = (i + 1) % 3;
        const b = (i + 2) % 3;
        line[p + i] += t[i] * one;
        line[m + i] += t[a] * line[l + b] - t[b] * line[l + a];
    }
    line[12] += 2.0 * along_point + square * one;
    line[13] += along_line;
};

/* What a joint that goes back makes of a line: the coefficients of 1, the cosine and the sine, or
 * of 1, a slide and its square. */
const $go_back = (slides, line) => {
    const first = line.slice();
    const second = new Float64Array(15);
    const third = new Float64Array(15);
    if (slides) {
        second[5] = -line[14];
        second[6] = line[1];
        second[7] = -line[0];
        second[9] = -2.0 * line[7];
        second[10] = 2.0 * line[6];
        second[11] = 2.0 * line[13];
        second[12] = -2.0 * line[5];
        second[13] = -line[2];
        third[9] = line[0];
        third[10] = line[1];
        third[11] = -line[2];
        third[12] = line[14];
        return [first, second, third];
    }
    for (let v = 0; v < 12; v += 3) {
        second[v] = line[v];
        second[v + 1] = line[v + 1];
        third[v] = line[v + 1];
        third[v + 1] = -line[v];
        first[v] = 0.0;
        first[v + 1] = 0.0;
    }
    return [first, second, third];
};

/* Where a monomial of the half tangents stands: the i-th power of the last joint's times the j-th of
 * the last but one. */
const $column = ({ columns }, i, j) => columns[(i + 4 * j) & 15];

/* Where the equations stand in the matrix whose determinant is the polynomial. A row may have
 * entries in twelve columns: the first four, of monomials that no row that is multiplied by the last
 * joint's half tangent has, or the next four, of those that no other row has, and the last eight;
 * `compact` are the places among its twelve. */
const $places = (elimination) => elimination.rows.map(([equation, shift]) => {
    const i0 = shift & 1;
    const j0 = (shift >> 1) & 1;
    const columns = [];
    for (let i = 0; i < 3 && equation < 8; ++i) {
        for (let j = 0; j < 3; ++j) {
            columns.push($column(elimination, i + i0, j + j0));
        }
    }
    if (equation === 8) {
        /* A single monomial. */
        columns.push(elimination.columns[shift & 15]);
    }
    const is_shifted = equation < 8 ? i0 === 1 : columns[0] >= 4 && columns[0] < 8;
    const compact = columns.map((column) => (column > 3 ? column - 4 : column));
    return { equation, columns, compact, is_shifted };
});

/* The constant motions behind the joints in the order of the loop that a target closes. */
const $close_loop = ({ fixed }, { joints, backwards }, target) => {
    const closing = $product(fixed[6], $product($inverse(target), fixed[0]));
    return joints.map((joint) => {
        const at = backwards ? (joint + 5) % 6 : joint;
        const motion = at === 5 ? closing : fixed[at + 1];
        return backwards ? $inverse(motion) : motion;
    });
};

/* The line of the fourth joint in the frame of the kept one, along the other side of the loop: the
 * coefficients of (1, cos, sin) of the last joint times those of the last but one, which change
 * fastest. */
const $see_far_side = (behind, slides) => {
    const line = new Float64Array(15);
    line[2] = 1.0;
    line[14] = 1.0;
    let lines = [line];
    for (let joint = 3; joint < 6; ++joint) {
        const back = $inverse(behind[joint]);
        lines.forEach((it) => $move_line(back, it));
        if (joint < 5) {
            const parts = lines.map((it) => $go_back(slides[joint + 1], it));
            lines = [0, 1, 2].flatMap((part) => parts.map((it) => it[part]));
        }
    }
    return lines;
};

/* A functional on lines that turn back with the kept joint: what does not turn, and the
 * coefficients of its cosine and sine. */
const $parts = (functional, lines) => {
    const parts = [0, 1, 2].map(() => new Float64Array(9));
    lines.forEach((line, k) => {
        for (let v = 0; v < 12; v += 3) {
            parts[1][k] += functional[v] * line[v] + functional[v + 1] * line[v + 1];
            parts[2][k] += functional[v] * line[v + 1] - functional[v + 1] * line[v];
            parts[0][k] += functional[v + 2] * line[v + 2];
        }
        for (let i = 12; i < 15; ++i) {
            parts[0][k] += functional[i] * line[i];
        }
    });
    return parts;
};

/* From (1, cos, sin) of the last joint and the last but one to the powers of their half tangents,
 * those of the last but one changing fastest, times the squares of the halves' cosines; a slide's
 * powers are monomials already. */
const $to_monomials = (slides, x) => {
    const to_powers = (first, step) => {
        const [one, cosine, sine] = [x[first], x[first + step], x[first + 2 * step]];
        x[first] = one + cosine;
        x[first + step] = 2.0 * sine;
        x[first + 2 * step] = one - cosine;
    };
    for (let i = 0; i < 3 && !slides[4]; ++i) {
        to_powers(3 * i, 1);
    }
    for (let j = 0; j < 3 && !slides[5]; ++j) {
        to_powers(j, 3);
    }
};

/* One elimination at one target: the motions of its loop, which joints slide, the far side, and by
 * functional and monomial the coefficients of 1, the cosine and the sine of the kept joint; of the
 * first ones, of its half. The last is that a monomial is 0. */
const $loop = (search, elimination, target) => {
    const behind = $close_loop(search, elimination, target);
    const slides = elimination.joints.map((joint) => search.slides[joint]);
    const far_side = $see_far_side(behind, slides);
    const vanishing = elimination.moved ? $moved(elimination, behind[0]) : elimination;
    const { third } = vanishing;
    const parts = vanishing.functionals.map((functional) => $parts(functional, far_side));
    /* Of a real and an imaginary part that do not see what turns with exp(-i angle), that the
     * product with exp(-i angle/2) vanishes. */
    for (let i = 0; i < elimination.half; i += 2) {
        const [re, im] = [parts[i], parts[i + 1]];
        for (let k = 0; k < 9; ++k) {
            re[2][k] = im[0][k] - im[1][k];
            im[2][k] = re[1][k] - re[0][k];
            re[1][k] += re[0][k];
            im[1][k] += im[0][k];
            re[0][k] = 0.0;
            im[0][k] = 0.0;
        }
    }
    parts.forEach((of) => of.forEach((part) => $to_monomials(slides, part)));
    const functionals = [...parts];
    functionals[8] = [[1.0], [0.0], [0.0]];
    const places = $places(elimination);
    return { elimination, behind, slides, third, far_side, functionals, places };
};

/* The equations at a value of the kept joint, by the cosine and sine of its half: all sixteen columns,
 * or of each row the twelve that it has. */
const $matrix = ({ elimination, functionals, places }, half, is_compact) => {
    const { sine, cosine } = half;
    const whole = cosine * cosine - sine * sine;
    const twice = (cosine + cosine) * sine;
    return places.map(({ equation, columns, compact }) => {
        const is_half = equation < elimination.half;
        const c = is_half ? cosine : whole;
        const s = is_half ? sine : twice;
        const [one, a, b] = functionals[equation];
        const at = is_compact ? compact : columns;
        const row = new Float64Array(is_compact ? 12 : 16);
        for (let i = 0; i < at.length; ++i) {
            row[at[i]] = one[i] + a[i] * c + b[i] * s;
        }
        return row;
    });
};

/* The largest entry of the matrix times a vector, without its sign. */
const $miss = (loop, half, x) => $matrix(loop, half, false)
    .reduce((most, row) => $max(most, Math.abs($dot(row, x))), 0.0);
