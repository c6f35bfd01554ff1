/* 1/x, of an x that is nearer to 0 than `least` as if it were that far from it. */
const $reciprocal = (x, least) => 1.0 / $copysign($max(Math.abs(x), least), x);

/* The sum of products. */
const $dot = (a, b) => {
    let sum = 0.0;
    for (let i = 0; i < a.length; ++i) {
        sum += a[i] * b[i];
    }
    return sum;
};

/* A vector by its length, in its place. */
const $normalize = (x) => {
    const share = 1.0 / Math.sqrt($dot(x, x));
    for (let i = 0; i < x.length; ++i) {
        x[i] *= share;
    }
};

/* Pivots of four rows from the `first` on, in the columns from `column` on of those that they have;
 * `others` tells which rows behind have them too. */
const $factor_block = ({ rows, inverses }, first, column, others) => {
    const block = rows.slice(first, first + 4);
    for (let i = 0; i < 4; ++i) {
        const row = block[i];
        const at = column + i;
        const inverse = $reciprocal(row[at], 1e-30);
        inverses[first + i] = inverse;
        for (let l = i + 1; l < 4; ++l) {
            const other = block[l];
            const share = other[at] * inverse;
            other[at] = share;
            for (let j = at + 1; j < 12; ++j) {
                other[j] -= share * row[j];
            }
        }
    }
    const [a, b, c, d] = block;
    for (let i = first + 4; i < 16; ++i) {
        if (!others(i)) {
            continue;
        }
        const row = rows[i];
        for (let l = 0; l < 4; ++l) {
            let share = row[column + l];
            for (let m = 0; m < l; ++m) {
                share -= row[column + m] * block[m][column + l];
            }
            row[column + l] = share * inverses[first + l];
        }
        const p = row[column];
        const q = row[column + 1];
        const r = row[column + 2];
        const s = row[column + 3];
        for (let j = column + 4; j < 12; ++j) {
            row[j] = row[j] - p * a[j] - q * b[j] - r * c[j] - s * d[j];
        }
    }
};

/* The matrix as L U, in the order in which rows and columns stand: that was chosen for the arm, and
 * how far it can be trusted at a target is seen in what comes out. L has ones on its diagonal and
 * takes the place below that of U; of each row the twelve columns in which it may have entries. */
const $factorize = (loop, half) => {
    const { places } = loop;
    const rows = $matrix(loop, half, true);
    const factors = { rows, inverses: new Float64Array(16), places };
    $factor_block(factors, 0, 0, (i) => i >= 8 && !places[i].is_shifted);
    $factor_block(factors, 4, 0, (i) => i >= 8 && places[i].is_shifted);
    $factor_block(factors, 8, 4, () => true);
    $factor_block(factors, 12, 8, () => false);
    return factors;
};

/* The column of pivot i in its row. */
const $pivot_column = (i) => (i < 8 ? i % 4 : i - 4);

/* x becomes the solution of L y = x. */
const $substitute_forward = ({ rows, places }, x) => {
    for (let i = 0; i < 16; ++i) {
        const own = i < 8 ? i % 4 : 4;
        const first = places[i].is_shifted ? 4 : 0;
        for (let k = 0; k < own; ++k) {
            x[i] -= rows[i][k] * x[first + k];
        }
        for (let k = 8; k < i; ++k) {
            x[i] -= rows[i][k - 4] * x[k];
        }
    }
};

/* x becomes the solution of U y = x. */
const $substitute_back = ({ rows, inverses }, x) => {
    for (let i = 15; i >= 0; --i) {
        for (let j = i < 8 ? 8 : i + 1; j < 16; ++j) {
            x[i] -= rows[i][j - 4] * x[j];
        }
        for (let j = (i % 4) + 1; i < 8 && j < 4; ++j) {
            x[i] -= rows[i][j] * x[i - (i % 4) + j];
        }
        x[i] *= inverses[i];
    }
};

/* The vector that L U nearly takes to zero, of length 1: inverse iteration (Wilkinson, The Algebraic
 * Eigenvalue Problem, 1965, chapter 5) from L times a vector of ones. */
const $null_vector = (factors) => {
    const x = new Float64Array(16).fill(1.0);
    $substitute_back(factors, x);
    $normalize(x);
    $substitute_forward(factors, x);
    $substitute_back(factors, x);
    $normalize(x);
    return x;
};

/* The matrix as Q R by Householder's reflections, without Q: at twice the cost of L U, and never
 * worse than rounding. The determinant of Q is -1. */
const $triangulate = (loop, half) => {
    const rows = $matrix(loop, half, false);
    const inverses = new Float64Array(16);
    for (let c = 0; c < 16; ++c) {
        let square = 0.0;
        for (let i = c; i < 16; ++i) {
            square += rows[i][c] * rows[i][c];
        }
        const x = rows[c][c];
        const root = Math.sqrt(square);
        /* Without cancellation by the choice of sign. */
        const image = c === 15 ? x : $select(x, 0.0, root, -root);
        const weight = 1.0 / $max(square - image * x, 1e-30);
        rows[c][c] = x - image;
        /* The reflection takes from each row its share of these. */
        const along = new Float64Array(16);
        for (let i = c; i < 16; ++i) {
            const row = rows[i];
            const share = row[c];
            for (let j = c + 1; j < 16; ++j) {
                along[j] += share * row[j];
            }
        }
        for (let i = c; i < 16; ++i) {
            const row = rows[i];
            const share = row[c];
            for (let j = c + 1; j < 16; ++j) {
                row[j] -= along[j] * weight * share;
            }
        }
        rows[c][c] = image;
        inverses[c] = $reciprocal(image, 1e-30);
    }
    return { rows, inverses };
};

/* One step of inverse iteration on the transpose of R times R. */
const $improve = ({ rows, inverses }, x) => {
    for (let i = 0; i < 16; ++i) {
        for (let j = 0; j < i; ++j) {
            x[i] -= rows[j][i] * x[j];
        }
        x[i] *= inverses[i];
    }
    $normalize(x);
    for (let i = 15; i >= 0; --i) {
        for (let j = i + 1; j < 16; ++j) {
            x[i] -= rows[i][j] * x[j];
        }
        x[i] *= inverses[i];
    }
};

/* Starts that no arm is square to: the fractional parts of multiples of the golden ratio, about 0. */
const $first_vector = (n) => new Float64Array(16).map((_, i) => {
    const x = ((((n + 1) * i) % 61) + 1) * 0.6180339887498948;
    return x - Math.trunc(x) - 0.48;
});

/* About the norm of the inverse, and no more. */
const $inverse_norm = (triangle) => {
    const x = $first_vector(0);
    $improve(triangle, x);
    return Math.sqrt($dot(x, x));
};

/* An orthonormal basis of what Q R nearly takes to zero: the least right singular vectors, by
 * subspace iteration; and about how long what they are taken to is. */
const $null_space = (triangle, count) => {
    const space = Array.from({ length: count }, (_, n) => $first_vector(n));
    const lengths = new Float64Array(count);
    for (let round = 0; round < 3; ++round) {
        space.forEach((vector, n) => {
            $improve(triangle, vector);
            for (const before of space.slice(0, n)) {
                const along = $dot(before, vector);
                for (let i = 0; i < 16; ++i) {
                    vector[i] -= along * before[i];
                }
            }
            lengths[n] = 1.0 / Math.sqrt($dot(vector, vector));
            $normalize(vector);
        });
    }
    return { space, lengths };
};

/* The determinant as a polynomial in the joint that is kept: by reflections, or with the pivots that
 * were chosen for the arm. Its noise is no number where the target is none. */
const $sampled_polynomial = (loop, is_reflected) => {
    const { degree, fold } = loop.elimination;
    const count = degree <= 8 ? 24 : 32;
    const values = new Float64Array(count);
    const largest = new Float64Array(16);
    /* How fast the determinants change with the entries. */
    let slopes = 0.0;
    for (let k = 0; k < count; ++k) {
        const part = (96 / count) * k;
        const half = { sine: $sine_of_part(part), cosine: $cosines[part] };
        const matrix = is_reflected ? $triangulate(loop, half) : $factorize(loop, half);
        const { rows } = matrix;
        /* Fifteen reflections have the determinant -1. */
        values[k] = is_reflected ? -1.0 : 1.0;
        for (let i = 0; i < 16; ++i) {
            const pivot = rows[i][is_reflected ? i : $pivot_column(i)];
            values[k] *= pivot;
            largest[i] = $max(largest[i], Math.abs(pivot));
        }
        if (is_reflected) {
            slopes += Math.abs(values[k]) * $inverse_norm(matrix);
        }
    }
    const f = $transform(degree, values);
    const shift = (2.220446049250313e-16 * slopes) / f.size;
    /* What rounding leaves of a pivot that is zero for all angles may be the same for all, so that the
     * harmonics that have to vanish do. */
    for (const most of largest) {
        f.noise = $max(2.220446049250313e-16 / most, f.noise);
    }
    return { ...(fold === null ? f : $divided_by_fold(fold, f)), shift };
};

/* Above this noise no pivot can be trusted that was not chosen for the target. */
const $NOISY = 3e-13;

const $polynomial = (loop) => {
    const f = $sampled_polynomial(loop, false);
    return f.noise < $NOISY ? f : $sampled_polynomial(loop, true);
};
