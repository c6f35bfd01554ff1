// Poses are twelve numbers, three rows of [R | p]; metres.

const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];

const product = (a, b) => {
    const out = new Array(12);
    for (let i = 0; i < 12; i += 4) {
        for (let j = 0; j < 4; ++j) {
            out[i + j] = a[i] * b[j] + a[i + 1] * b[4 + j] + a[i + 2] * b[8 + j] + (j === 3 ? a[i + 3] : 0);
        }
    }
    return out;
};

const transform = (pose, [x, y, z]) =>
    [0, 4, 8].map((i) => pose[i] * x + pose[i + 1] * y + pose[i + 2] * z + pose[i + 3]);

const rotate = (pose, [x, y, z]) => [0, 4, 8].map((i) => pose[i] * x + pose[i + 1] * y + pose[i + 2] * z);

const origin = (pose) => [pose[3], pose[7], pose[11]];

const column = (pose, j) => [pose[j], pose[4 + j], pose[8 + j]];

const add = (a, b, s = 1) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** The rotation by an angle about a unit axis, about the origin. */
const turn = ([x, y, z], angle) => {
    const [s, c] = [Math.sin(angle), Math.cos(angle)];
    const v = 1 - c;
    return [
        x * x * v + c, x * y * v - z * s, x * z * v + y * s, 0,
        x * y * v + z * s, y * y * v + c, y * z * v - x * s, 0,
        x * z * v - y * s, y * z * v + x * s, z * z * v + c, 0,
    ];
};

/** Roll, pitch and yaw: R = Rz(yaw) Ry(pitch) Rx(roll), as in URDF; radians. */
const rollPitchYaw = (pose) => {
    const pitch = Math.atan2(-pose[8], Math.hypot(pose[0], pose[4]));
    return Math.hypot(pose[0], pose[4]) > 1e-9
        ? [Math.atan2(pose[9], pose[10]), pitch, Math.atan2(pose[4], pose[0])]
        : [Math.atan2(-pose[6], pose[5]), pitch, 0];
};

const poseOf = ([x, y, z], [roll, pitch, yaw]) => {
    const pose = product(turn([0, 0, 1], yaw), product(turn([0, 1, 0], pitch), turn([1, 0, 0], roll)));
    [pose[3], pose[7], pose[11]] = [x, y, z];
    return pose;
};

/** The same pose with exactly orthonormal columns. */
const orthonormal = (pose) => {
    const unit = (v) => v.map((x) => x / Math.hypot(...v));
    const x = unit(column(pose, 0));
    const z = unit(cross(x, column(pose, 1)));
    const y = cross(z, x);
    return [0, 1, 2].flatMap((i) => [x[i], y[i], z[i], pose[4 * i + 3]]);
};

/**
 * The singular values of a matrix given by its rows, largest first: rotations of pairs of rows
 * until all are orthogonal (Hestenes, 1958).
 */
const singularValues = (matrix) => {
    const wide = matrix.length <= matrix[0].length;
    const rows = wide
        ? matrix.map((row) => Array.from(row))
        : matrix[0].map((_, j) => matrix.map((row) => row[j]));
    const inner = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
    for (let sweep = 0; sweep < 12; ++sweep) {
        let off = 0;
        for (let i = 0; i < rows.length; ++i) {
            for (let j = i + 1; j < rows.length; ++j) {
                const [a, b, c] = [inner(rows[i], rows[i]), inner(rows[j], rows[j]), inner(rows[i], rows[j])];
                if (Math.abs(c) <= 1e-15 * Math.sqrt(a * b)) {
                    continue;
                }
                off += 1;
                const zeta = (b - a) / (2 * c);
                const t = (zeta < 0 ? -1 : 1) / (Math.abs(zeta) + Math.hypot(1, zeta));
                const cosine = 1 / Math.hypot(1, t);
                const sine = t * cosine;
                for (let k = 0; k < rows[i].length; ++k) {
                    const [x, y] = [rows[i][k], rows[j][k]];
                    rows[i][k] = cosine * x - sine * y;
                    rows[j][k] = sine * x + cosine * y;
                }
            }
        }
        if (off === 0) {
            break;
        }
    }
    return rows.map((row) => Math.hypot(...row)).sort((a, b) => b - a);
};

/** Six rows that project on what is perpendicular to some vectors of six numbers. */
const perpendicular = (vectors) => {
    const inner = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
    const without = (vector, unit) => {
        const along = inner(vector, unit);
        return vector.map((x, i) => x - along * unit[i]);
    };
    const most = Math.max(0, ...vectors.map((vector) => Math.hypot(...vector)));
    let rest = vectors;
    let rows = [0, 1, 2, 3, 4, 5].map((i) => [0, 1, 2, 3, 4, 5].map((j) => (i === j ? 1 : 0)));
    while (rest.length > 0) {
        const longest = rest.reduce((best, it) => (Math.hypot(...it) > Math.hypot(...best) ? it : best));
        const length = Math.hypot(...longest);
        // What the rounding of a long chain leaves of a vector that depends on others.
        if (!(length > 1e-10 * most)) {
            break;
        }
        const unit = longest.map((x) => x / length);
        rows = rows.map((row) => without(row, unit));
        rest = rest.filter((it) => it !== longest).map((it) => without(it, unit));
    }
    return rows;
};
