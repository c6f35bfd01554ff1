/* The product of two poses. */
const $product = (a, b) => {
    const out = new Float64Array(12);
    for (let i = 0; i < 12; i += 4) {
        for (let j = 0; j < 4; ++j) {
            out[i + j] = a[i] * b[j] + a[i + 1] * b[4 + j] + a[i + 2] * b[8 + j]
                + (j === 3 ? a[i + 3] : 0.0);
        }
    }
    return out;
};

/* The pose that another leads back from. */
const $inverse = (pose) => {
    const out = new Float64Array(12);
    for (let i = 0; i < 3; ++i) {
        for (let j = 0; j < 3; ++j) {
            out[4 * i + j] = pose[4 * j + i];
            out[4 * i + 3] -= pose[4 * j + i] * pose[4 * j + 3];
        }
    }
    return out;
};

/* A point of a body in base coordinates. */
const $point = (pose, p) =>
    [0, 4, 8].map((i) => pose[i] * p[0] + pose[i + 1] * p[1] + pose[i + 2] * p[2] + pose[i + 3]);
