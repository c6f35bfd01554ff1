/* Functionals on lines as seen behind a motion, on those in front of it. */
const $see_in_front = (motion, functionals) => {
    const back = $inverse(motion);
    const front = functionals.map(() => new Float64Array(15));
    for (let k = 0; k < 15; ++k) {
        const line = new Float64Array(15);
        line[k] = 1.0;
        $move_line(back, line);
        front.forEach((functional, i) => {
            functional[k] = $dot(functionals[i], line);
        });
    }
    return front;
};

/* Of complex numbers. */
const $complex_square = ([re, im]) => re * re + im * im;
const $complex_product = ([a, b], [c, d]) => [a * c - b * d, a * d + b * c];
const $complex_difference = ([a, b], [c, d]) => [a - c, b - d];
const $to_unit = (vector) => {
    const length = Math.sqrt(vector.reduce((sum, x) => sum + $complex_square(x), 0.0));
    return vector.map(([re, im]) => [re / length, im / length]);
};

/* The complex weights of the combinations of six functionals that do not see what turns with
 * exp(-i angle), at right angles to each other and of length 1: by elimination with the largest
 * pivots. */
const $unseen = (functionals) => {
    const rows = [0, 3, 6, 9].map((v) => functionals.map((it) => [it[v], -it[v + 1]]));
    const pivots = [];
    for (let k = 0; k < 4; ++k) {
        let [row, column, largest] = [k, 0, -1.0];
        for (let i = k; i < 4; ++i) {
            for (let j = 0; j < 6; ++j) {
                if ($complex_square(rows[i][j]) > largest && !pivots.includes(j)) {
                    [row, column, largest] = [i, j, $complex_square(rows[i][j])];
                }
            }
        }
        [rows[k], rows[row]] = [rows[row], rows[k]];
        pivots.push(column);
        const [re, im] = rows[k][column];
        const share = 1.0 / $max(largest, 1e-60);
        const pivot = rows[k].map((x) => $complex_product([share * re, -share * im], x));
        rows.forEach((entries, i) => {
            const by = entries[column];
            rows[i] = i === k ? pivot : entries.map((x, j) => $complex_difference(x, $complex_product(by, pivot[j])));
        });
    }
    const free = [0, 1, 2, 3, 4, 5].filter((j) => !pivots.includes(j));
    const [one, other] = free.map((it) => {
        const vector = functionals.map(() => [0.0, 0.0]);
        vector[it] = [1.0, 0.0];
        pivots.forEach((column, k) => {
            vector[column] = $complex_difference([0.0, 0.0], rows[k][it]);
        });
        return vector;
    });
    const first = $to_unit(one);
    const along = first.reduce(
        (sum, [re, im], j) => $complex_difference(sum, $complex_product([-re, im], other[j])), [0.0, 0.0]);
    const second = $to_unit(other.map((x, j) => $complex_difference(x, $complex_product(along, first[j]))));
    return [first, second];
};

/* What of an elimination depends on the value of a joint that is given behind the kept one: the
 * functionals that half the angle is enough for, and those of the third joint. */
const $moved = ({ functionals, third }, behind) => {
    const six = $see_in_front(behind, functionals);
    const combined = (weights, part) =>
        six[0].map((_, k) => six.reduce((sum, it, j) => sum + weights[j][part] * it[k], 0.0));
    return {
        functionals: $unseen(six).flatMap((weights) => [combined(weights, 0), combined(weights, 1)]),
        third: $see_in_front(behind, third),
    };
};
