/* The other joints, from a value of the kept one. Solutions that share it span what the matrix takes
 * to zero; the vectors of monomials in that space are the eigenvectors of multiplication in it
 * (Auzinger and Stetter, ISNM 86, 1988). So many may share it. */
const $SHARING = 4;
/* Rounds of Weierstrass' iteration: those eigenvalues that are apart part by then as far as a start of
 * Newton's method needs it; and by what share of how far two are apart the last one moves one at most. */
const $ROUNDS = 12;
const $SETTLED = 1e-4;
/* Where a family of solutions has one value of the kept joint, the vectors of all its members are in the
 * space, and no matrix multiplies all of them by their ratios: a pivot is zero. The same next to it. */
const $OF_FAMILY = 1e-5;

const $zeros = (n) => new Array(n).fill(0.0);

const $square = (n) => $zeros(n).map(() => $zeros(n));

/* g^-1 h, for a positive definite g, and its least pivot; both are used up. */
const $solve_square = (g, h) => {
    const n = g.length;
    let least = Infinity;
    for (let c = 0; c < n; ++c) {
        least = g[c][c] < least ? g[c][c] : least;
        const pivot = 1.0 / $max(g[c][c], 1e-30);
        for (let i = 0; i < n; ++i) {
            const share = g[i][c] * pivot;
            for (let j = 0; i !== c && j < n; ++j) {
                g[i][j] -= share * g[c][j];
                h[i][j] -= share * h[c][j];
            }
        }
        for (let j = 0; j < n; ++j) {
            g[c][j] *= pivot;
            h[c][j] *= pivot;
        }
    }
    return { image: h, least };
};

/* Two functions of the half tangents whose ratio tells solutions apart, above and below: the
 * coefficients of 1, each of the two, and their product. What one hardly tells apart, of values that are
 * as large, others do. */
const $RATIOS = [
    [[0.31, 0.83, -0.57, 0.44], [0.92, -0.38, 0.29, 0.71]],
    [[-0.74, 0.35, 0.61, 0.27], [0.42, 0.66, 0.53, -0.81]],
    [[0.58, -0.47, 0.22, 0.89], [-0.33, 0.76, 0.85, 0.19]],
];

/* What multiplication by a ratio does to a space's vectors, in the sense of least squares, and the least
 * pivot. */
const $multiplication = (elimination, space, [of_above, of_below]) => {
    const n = space.length;
    const gram = $square(n);
    const image = $square(n);
    for (let i = 0; i < elimination.powers[0]; ++i) {
        for (let j = 0; j < elimination.powers[1]; ++j) {
            const columns = [0, 1, 2, 3].map((corner) =>
                $column(elimination, i + (corner % 2), j + (corner >> 1)));
            const seen = (weights) => space.map((vector) =>
                $dot(weights, columns.map((column) => vector[column])));
            const above = seen(of_above);
            const below = seen(of_below);
            for (let a = 0; a < n; ++a) {
                for (let b = 0; b < n; ++b) {
                    gram[a][b] += below[a] * below[b];
                    image[a][b] += below[a] * above[b];
                }
            }
        }
    }
    return $solve_square(gram, image);
};

/* The eigenvectors of two by two, from the quadratic. */
const $eigenvectors_of_pair = (t) => {
    const b = t[0][1];
    const c = t[1][0];
    const half = (t[0][0] - t[1][1]) * 0.5;
    const length = Math.sqrt($max(half * half + b * c, 0.0));
    /* The one without cancellation, of the two rows that tell it. */
    return [length, -length].map((root) => (root * half < 0.0 ? [b, root - half] : [root + half, c]));
};

/* a times b, of squares. */
const $times = (a, b) => a.map((row) => b[0].map((_, j) => {
    let sum = 0.0;
    for (let m = 0; m < b.length; ++m) {
        sum += row[m] * b[m][j];
    }
    return sum;
}));

/* r of t = q r, by Gram and Schmidt; q takes the place of t. */
const $orthogonalize = (t) => {
    const n = t.length;
    const r = $square(n);
    for (let j = 0; j < n; ++j) {
        for (let before = 0; before < j; ++before) {
            for (let i = 0; i < n; ++i) {
                r[before][j] += t[i][before] * t[i][j];
            }
            for (let i = 0; i < n; ++i) {
                t[i][j] -= r[before][j] * t[i][before];
            }
        }
        for (let i = 0; i < n; ++i) {
            r[j][j] += t[i][j] * t[i][j];
        }
        r[j][j] = $max(Math.sqrt(r[j][j]), 1e-150);
        for (let i = 0; i < n; ++i) {
            t[i][j] *= 1.0 / r[j][j];
        }
    }
    return r;
};

/* The vector that belongs to the eigenvalue nearest to a value, by inverse iteration, in which two that are
 * complex do no harm. */
const $eigenvector = (given, value) => {
    const n = given.length;
    const r = $orthogonalize(given.map((row, i) => row.map((x, j) => (i === j ? x - value : x))));
    /* The inverse of r takes the last column to where the shifted matrix has nearly nothing left. */
    const x = $zeros(n);
    x[n - 1] = 1.0;
    for (let i = n - 2; i >= 0; --i) {
        let above = 0.0;
        for (let j = i + 1; j < n; ++j) {
            above += r[i][j] * x[j];
        }
        x[i] = -above / r[i][i];
    }
    return x;
};

/* The two eigenvalues of two by two. */
const $values_of_pair = (t) => {
    const mean = (t[0][0] + t[1][1]) * 0.5;
    const half = (t[0][0] - t[1][1]) * 0.5;
    const square = half * half + t[0][1] * t[1][0];
    const root = Math.sqrt(Math.abs(square));
    const real = square < 0.0 ? 0.0 : root;
    return { values: [[mean + real, root - real], [mean - real, real - root]], error: 0.0 };
};

/* The coefficients of the characteristic polynomial, from the second power's on down but for the first, which
 * is one (Faddeev and Faddeeva, Computational Methods of Linear Algebra, 1963). */
const $characteristic = (t) => {
    let power = t;
    return t.map((_, k) => {
        const coefficient = power.reduce((sum, row, i) => sum + row[i], 0.0) * (-1.0 / (k + 1));
        power = $times(t, power.map((row, i) => row.map((x, j) => (i === j ? x + coefficient : x))));
        return coefficient;
    });
};

/* Points none of which is another one's mirror image. */
const $ON_CIRCLE = [[0.921, 0.389], [-0.416, 0.909], [-0.936, -0.351], [0.378, -0.926]];

/* The eigenvalues as roots of the characteristic polynomial, all at once from points about their mean
 * (Weierstrass, Neuer Beweis des Satzes, dass jede ganze rationale Function einer Veränderlichen dargestellt
 * werden kann als ein Product aus linearen Functionen derselben Veränderlichen, 1891), and by how much the
 * last round moved one at most. */
const $values_of = (given) => {
    const n = given.length;
    const mean = given.reduce((sum, row, i) => sum + row[i], 0.0) * (1.0 / n);
    const t = given.map((row, i) => row.map((x, j) => (i === j ? x - mean : x)));
    const polynomial = $characteristic(t);
    const radius = Math.sqrt(t.reduce((sum, row) => sum + $dot(row, row), 0.0) * (1.0 / n));
    const values = $ON_CIRCLE.map((point) => point.map((x) => radius * x));
    let error = 0.0;
    for (let round = 0; round < $ROUNDS; ++round) {
        error = 0.0;
        values.forEach(([x, y], i) => {
            const above = polynomial.reduce((sum, coefficient) => {
                const [re, im] = $complex_product(sum, [x, y]);
                return [re + coefficient, im];
            }, [1.0, 0.0]);
            const below = values.reduce(
                (product, [u, v], j) => (j === i ? product : $complex_product(product, [x - u, y - v])),
                [1.0, 0.0]);
            const share = 1.0 / $max($dot(below, below), 1e-200);
            const moved = $complex_product(above, [below[0], -below[1]]).map((part) => part * share);
            error = $max($max(error, Math.abs(moved[0])), Math.abs(moved[1]));
            values[i] = [x - moved[0], y - moved[1]];
        });
    }
    return { values: values.map(([x, y]) => [x + mean, y]), error };
};

/* How near two eigenvalues come to each other, in units of the largest entry of the matrix, and which are
 * complex, and not one of two real ones that have nearly met; of none it is told where they are not known,
 * or the least pivot says that they are not told. */
const $told = (of, { values, error }, least) => {
    const largest = Math.max(...of.flat().map(Math.abs));
    const distances = values.flatMap(([x, y], i) =>
        values.slice(0, i).map(([u, v]) => Math.sqrt((x - u) * (x - u) + (y - v) * (y - v))));
    const apart = Math.min(...distances);
    const are_known = error < $SETTLED * apart && !(least < $OF_FAMILY);
    return {
        apart: are_known ? apart / largest : 0.0,
        are_complex: values.map(([, y]) => are_known && Math.abs(y) > 0.01 * largest),
    };
};

/* The vectors of monomials in a space of two or four, and what is told of what they are multiplied by; where
 * two are complex, one of a pair their real part, of more something else. */
const $monomial_vectors = (elimination, space, ratio) => {
    const { image, least } = $multiplication(elimination, space, ratio);
    const is_pair = space.length === 2;
    const of = is_pair ? $values_of_pair(image) : $values_of(image);
    const all = is_pair
        ? $eigenvectors_of_pair(image) : of.values.map(([real]) => $eigenvector(image, real));
    const vectors = all.map((weights) => space[0].map((_, i) => {
        let sum = 0.0;
        for (let b = 0; b < space.length; ++b) {
            sum += space[b][i] * weights[b];
        }
        return sum;
    }));
    return { vectors, told: $told(image, of, least) };
};

/* The last joint, or the last but one, from a vector of monomials: tan of its half is the share of two
 * neighbouring powers, and sine and cosine are had without dividing; of a slide the first power by the
 * power before. */
const $eliminated = ({ elimination, slides }, is_before, vector) => {
    const slide = slides[is_before ? 4 : 5];
    const most = elimination.powers[is_before ? 0 : 1];
    const others = slide ? Math.min(most, 3) + 1 : 4;
    let x = 0.0;
    let y = 0.0;
    for (let i = 0; i < (slide ? 1 : 3); ++i) {
        for (let j = 0; j < others; ++j) {
            const at = (power) => vector[is_before
                ? $column(elimination, j, power) : $column(elimination, power, j)];
            const a = at(i);
            const b = at(i + 1);
            y += slide ? a * b : (a + a) * b;
            x += slide ? a * a : (a - b) * (a + b);
        }
    }
    return slide ? y / x : $angle(y, x);
};

/* By what a joint, by its place in the loop, moves a line: its sine and cosine, or the square of its
 * slide and the slide. */
const $functions = ({ slides }, place, value) =>
    (slides[place] ? { sine: value * value, cosine: value } : $sin_cos(value));

/* The transpose of a rotation times a vector. */
const $rotate_back = (pose, [a, b, c]) => [
    a * pose[0] + b * pose[4] + c * pose[8],
    a * pose[1] + b * pose[5] + c * pose[9],
    a * pose[2] + b * pose[6] + c * pose[10],
];

/* A rotation times a direction. */
const $rotate = (pose, [a, b, c]) => [
    a * pose[0] + b * pose[1] + c * pose[2],
    a * pose[4] + b * pose[5] + c * pose[6],
    a * pose[8] + b * pose[9] + c * pose[10],
];

/* Of some vectors the one from the place `at` on, turned about z. */
const $turn = (sine, cosine, x, at = 0) => {
    const a = x[at];
    const b = x[at + 1];
    x[at] = cosine * a - sine * b;
    x[at + 1] = sine * a + cosine * b;
};

/* A direction and a point as a joint moves them, by its place in the loop. */
const $move = ({ slides }, place, { sine, cosine }, l, p) => {
    if (slides[place]) {
        p[2] += cosine;
    } else {
        $turn(sine, cosine, l);
        $turn(sine, cosine, p);
    }
};

/* The fourth joint's line in the frame of the kept one. */
const $see_line = ({ far_side }, kept, fifth, sixth) => {
    const { sine: s, cosine: c } = fifth;
    const by_fifth = (k, i) => far_side[k][i] + c * far_side[k + 1][i] + s * far_side[k + 2][i];
    const line = far_side[0].map((_, i) =>
        by_fifth(0, i) + by_fifth(3, i) * sixth.cosine + by_fifth(6, i) * sixth.sine);
    for (let v = 0; v < 12; v += 3) {
        $turn(-kept.sine, kept.cosine, line, v);
    }
    return line;
};

/* The third joint, and how far its functions are from being of one value. */
const $third = ({ third, slides }, line) => {
    const [x, y] = third.map((functional) => $dot(functional, line));
    if (slides[2]) {
        return { value: x, off: (x * x - y) / (1.0 + x * x) };
    }
    return { value: $angle(y, x), off: x * x + y * y - 1.0 };
};

/* The second joint, which takes the fourth's axis and the point on it from where the third leaves them
 * to where they are seen in the frame of the kept one; and how far it misses. */
const $second = (loop, line, third) => {
    const { behind, slides } = loop;
    const from = [2, 6, 10].map((i) => behind[2][i]);
    const at = [3, 7, 11].map((i) => behind[2][i]);
    $move(loop, 2, third, from, at);
    const l = $rotate(behind[1], from);
    const p = $point(behind[1], at);
    const far_l = $rotate_back(behind[0], line.slice(0, 3));
    const far_p = $rotate_back(behind[0], [0, 1, 2].map((i) => line[3 + i] - behind[0][4 * i + 3]));
    const value = slides[1] ? far_p[2] - p[2] : $angle(
        l[0] * far_l[1] - l[1] * far_l[0] + (p[0] * far_p[1] - p[1] * far_p[0]),
        l[0] * far_l[0] + l[1] * far_l[1] + (p[0] * far_p[0] + p[1] * far_p[1]),
    );
    const functions = $functions(loop, 1, value);
    $move(loop, 1, functions, l, p);
    let off = 0.0;
    for (let i = 0; i < 3; ++i) {
        off = $max(off, Math.abs(l[i] - far_l[i]));
        off = $max(off, Math.abs(p[i] - far_p[i]));
    }
    return { value, functions, off };
};

/* The joint whose axis was followed: where its x axis goes the other way round; slides do not turn
 * it. `functions` are by place in the loop. */
const $fourth = ({ behind, slides }, functions) => {
    let x = [1.0, 0.0, 0.0];
    for (let i = 3; i < 9; ++i) {
        const next = (i + 1) % 6;
        x = $rotate_back(behind[i % 6], x);
        if (i < 8 && !slides[next]) {
            $turn(-functions[next].sine, functions[next].cosine, x);
        }
    }
    return $angle(x[1], x[0]);
};

/* The joints that go with a value of the kept one, from a vector of monomials; and how far two cosines
 * and sines are from being of an angle, or powers of a slide: what an extraneous root shows itself
 * by. */
const $joints_of_vector = (loop, kept, vector) => {
    const { joints, backwards } = loop.elimination;
    const functions = [$sin_cos(kept)];
    const sixth = $eliminated(loop, false, vector);
    const fifth = $eliminated(loop, true, vector);
    functions[4] = $functions(loop, 4, fifth);
    functions[5] = $functions(loop, 5, sixth);
    const line = $see_line(loop, functions[0], functions[4], functions[5]);
    const third = $third(loop, line);
    functions[2] = $functions(loop, 2, third.value);
    const second = $second(loop, line, functions[2]);
    functions[1] = second.functions;
    const values = [kept, second.value, third.value, $fourth(loop, functions), fifth, sixth];
    const q = new Array(6);
    joints.forEach((joint, i) => (q[joint] = backwards ? -values[i] : values[i]));
    return { q, inconsistency: $max(second.off, Math.abs(third.off)) };
};

/* The joints that go with a value of the kept one: from what is taken to zero there, by the pivots that
 * were chosen for the arm, or by reflections where those do not do. */
const $recover = (loop, kept) => {
    const half = $sin_cos(0.5 * kept);
    const vector = $null_vector($factorize(loop, half));
    /* Not a number is not less. */
    const is_good = $miss(loop, half, vector) < 1e-9;
    const [found] = is_good ? [vector] : $null_space($triangulate(loop, half), 1).space;
    return $joints_of_vector(loop, kept, found);
};

/* What is nearly taken to zero at a value of the kept joint: so many vectors of a basis, of which the
 * first are those of fewer, and about how long what they are taken to is. */
const $null_space_at = (loop, kept, count) =>
    $null_space($triangulate(loop, $sin_cos(0.5 * kept)), count);

/* The configurations that share a value of the kept joint or have nearly met there: those of the
 * vectors in what is nearly taken to zero that are monomials. */
const $recover_sharing = (loop, kept, space, ratio) => {
    const { vectors, told } = $monomial_vectors(loop.elimination, space, ratio);
    return { starts: vectors.map((vector) => $joints_of_vector(loop, kept, vector)), told };
};

/* How many of some vectors are of no solution, complex or off by more than a solution may be; none where an
 * eigenvalue, or what is taken to zero, is not known as well as the eigenvalues are apart. */
const $extraneous = ({ starts, told }, lengths, off) => {
    const is_none = ({ inconsistency }, n) => told.are_complex[n] || inconsistency > off;
    return lengths[lengths.length - 1] < 1e-4 * told.apart ? starts.filter(is_none).length : 0;
};
