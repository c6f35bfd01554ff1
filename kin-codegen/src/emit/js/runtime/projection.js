/* The pose that a pose of the tip stands for, as projected targets see it: home, turned about the
 * first axis to come nearest to it, where it is, of a planar arm at the height of home. */
const $stands_for = ({ axis, home, planar }, tip) => {
    let sine = 0.0;
    let cosine = 0.0;
    let rise = 0.0;
    const m = (i, j) => tip[4 * i] * home[4 * j] + tip[4 * i + 1] * home[4 * j + 1]
        + tip[4 * i + 2] * home[4 * j + 2];
    for (let i = 0; i < 3; ++i) {
        const a = (i + 1) % 3;
        const b = (i + 2) % 3;
        sine += axis[i] * (m(b, a) - m(a, b));
        cosine += m(i, i);
        for (let j = 0; j < 3; ++j) {
            cosine -= axis[i] * m(i, j) * axis[j];
        }
        rise += planar ? axis[i] * (home[4 * i + 3] - tip[4 * i + 3]) : 0.0;
    }
    let length = Math.sqrt(sine * sine + cosine * cosine);
    if (length === 0.0) {
        cosine = length = 1.0;
    }
    sine /= length;
    cosine /= length;
    const seen = new Float64Array(12);
    for (let j = 0; j < 3; ++j) {
        let along = 0.0;
        for (let i = 0; i < 3; ++i) {
            along += axis[i] * home[4 * i + j];
        }
        for (let i = 0; i < 3; ++i) {
            const a = (i + 1) % 3;
            const b = (i + 2) % 3;
            seen[4 * i + j] = cosine * home[4 * i + j]
                + sine * (axis[a] * home[4 * b + j] - axis[b] * home[4 * a + j])
                + (1.0 - cosine) * along * axis[i];
        }
    }
    for (let i = 0; i < 3; ++i) {
        seen[4 * i + 3] = tip[4 * i + 3] + rise * axis[i];
    }
    return seen;
};

/* A pose of the tip and rows of the spatial Jacobian as projected targets see them: turns about the
 * first axis, and of a planar arm motions across it. */
const $see_projected = (projection, seen) => {
    const { axis, planar } = projection;
    const tip = seen.pose;
    const pose = $stands_for(projection, tip);
    const jacobian = seen.jacobian.map((row) => row.slice());
    for (let k = 0; k < jacobian[0].length; ++k) {
        const w = [3, 4, 5].map((i) => jacobian[i][k]);
        const turn = axis[0] * w[0] + axis[1] * w[1] + axis[2] * w[2];
        const v = [0, 1, 2].map((i) => {
            const a = (i + 1) % 3;
            const b = (i + 2) % 3;
            return jacobian[i][k] + (w[a] * tip[4 * b + 3] - w[b] * tip[4 * a + 3]);
        });
        const lift = planar ? axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2] : 0.0;
        const about = axis.map((x) => turn * x);
        for (let i = 0; i < 3; ++i) {
            const a = (i + 1) % 3;
            const b = (i + 2) % 3;
            jacobian[3 + i][k] = about[i];
            jacobian[i][k] = v[i] - lift * axis[i]
                - (about[a] * pose[4 * b + 3] - about[b] * pose[4 * a + 3]);
        }
    }
    return { pose, jacobian };
};

/* The same of a target: one that is no rotation by some error is none by as much. */
const $project_target = (projection, target) => {
    /* A stretched rotation has the error sqrt(3) times the stretch. */
    const stretch = 1.0 + $rotation_error({ counts_rotation: true }, target) / Math.sqrt(3.0);
    return $stands_for(projection, target).map((x, i) => (i % 4 === 3 ? x : stretch * x));
};

/* How projected targets see the tip: by the first axis, the tip at home, and whether the height along
 * that axis is not read. */
const $projection = (projection) => ({
    target: (target) => $project_target(projection, target),
    see: (seen) => $see_projected(projection, seen),
});
