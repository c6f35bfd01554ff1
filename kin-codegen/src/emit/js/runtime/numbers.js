/* x where a < b, else y, also where a or b is NaN. */
const $select = (a, b, x, y) => (a < b ? x : y);

/* The larger of two numbers, the second where either is NaN. */
const $max = (a, b) => (b < a ? a : b);

/* x with the sign of y. */
const $copysign = (x, y) => (y < 0.0 || Object.is(y, -0) ? -Math.abs(x) : Math.abs(x));

/* The integer nearest to x, of two the even one, for |x| < 2^51. */
const $round = (x) => x + 6755399441055744.0 - 6755399441055744.0;

/* Sine and cosine of x radians, within 1.5e-16 for |x| up to 1.6e6, without meaning beyond
 * 3e15: reduction by pi/2 in two parts (Cody and Waite), minimax polynomials. The same digits in
 * every browser, which Math.sin does not promise. */
const $sin_cos = (x) => {
    const quarters = $round(x * 0.6366197723675814);
    const halves = $round(0.5 * quarters);
    /* Of x = pi halves + pi/2 odd + r: whether halves is odd, 1 or -1; odd itself. */
    const flips = halves - 2.0 * $round(0.5 * halves);
    const odd = quarters - 2.0 * halves;
    const sign = 1.0 - 2.0 * (flips * flips);
    const even = 1.0 - odd * odd;
    const r = x - quarters * 1.5707963267341256 - quarters * 6.077100506506192e-11;
    const z = r * r;
    const zz = z * z;
    const s = -0.1666666666666663 + z * 0.008333333333322118
        + zz * (-0.000198412698295886 + z * 2.7557313621048824e-6
        + zz * (-2.5050747708379155e-8 + z * 1.589622690454601e-10));
    const c = 0.0416666666666666 + z * -0.0013888888888874138
        + zz * (2.480158728949087e-5 + z * -2.7557314354952887e-7
        + zz * (2.0875723643570178e-9 + z * -1.1359667673654324e-11));
    const of_sine = r + r * (z * s);
    const of_cosine = 1.0 - (0.5 * z - zz * c);
    return {
        sine: sign * (even * of_sine + odd * of_cosine),
        cosine: sign * (even * of_cosine - odd * of_sine),
    };
};

/* The angle x, radians, moved by a multiple of 2 pi into (-pi, pi]. */
const $wrap = (x) => {
    const turns = $round(x * 0.15915494309189535);
    const r = x - turns * 6.2831853069365025 - turns * 2.430840202602477e-10;
    const at_most = r > Math.PI ? Math.PI : r;
    return at_most <= -Math.PI ? Math.PI : at_most;
};

/* The angle of the vector (x, y) in [-pi, pi] radians, within 3.3e-16 relative. */
const $atan2 = (y, x) => {
    const ax = Math.abs(x);
    const ay = Math.abs(y);
    const large = ay > ax ? ay : ax;
    const small = ay > ax ? ax : ay;
    const past_quarter = 0.25 * large < small;
    const past_three_quarters = 0.75 * large < small;
    const center = (past_quarter ? 0.5 : 0.0) + (past_three_quarters ? 0.5 : 0.0);
    const head = (past_quarter ? 0.4636476090008061 : 0.0)
        + (past_three_quarters ? 0.7853981633974483 - 0.4636476090008061 : 0.0);
    const tail = (past_quarter ? 2.2698777452961687e-17 : 0.0)
        + (past_three_quarters ? 3.061616997868383e-17 - 2.2698777452961687e-17 : 0.0);
    const below = large + center * small;
    const t = (small - center * large) / (below > 5e-324 ? below : 5e-324);
    const z = t * t;
    const zz = z * z;
    const low = -0.33333333333332543 + z * 0.19999999999588905
        + zz * (-0.14285714212326123 + z * 0.11111104766168227);
    const high = -0.09090604830403615 + z * 0.07683764998433239
        + zz * (-0.0652617146549674 + z * 0.046093150867149844);
    const octant = tail + (t + t * (z * (low + zz * zz * high)));
    /* angle = axis +- (head + octant), with the sign and the axis of the sector. */
    const steep = ax < ay;
    const left = x < 0.0;
    const axis = (steep ? 1.5707963267948966 : 0.0) + (left && !steep ? Math.PI : 0.0);
    const way = steep !== left ? -1.0 : 1.0;
    const offset = head + (octant + way * (axis * 3.898171832295186e-17));
    return $copysign(axis + way * offset, y);
};

/* The angle of the vector (x, y) in (-pi, pi] radians, 0 for (0, 0), within 3.5e-16 relative:
 * by other polynomials, as the lanes of branches have it. */
const $angle = (y, x) => {
    const ax = Math.abs(x);
    const ay = Math.abs(y);
    const large = ax < ay ? ay : ax;
    const small = ax < ay ? ax : ay;
    const diagonal = 0.4142135623730951 * large < small ? 1.0 : 0.0;
    const steep = ax < ay ? -1.0 : 1.0;
    const left = x < 0.0 ? -1.0 : 1.0;
    const along = large + diagonal * small;
    const across = small - diagonal * large;
    const t = across / (along < 5e-324 ? 5e-324 : along);
    const z = t * t;
    const z2 = z * z;
    const z4 = z2 * z2;
    const low = -0.33333333333330145 + z * 0.19999999999087453
        + z2 * (-0.14285714195131147 + z * 0.11111106648068127);
    const middle = -0.09090782280478897 + z * 0.0769006640103143
        + z2 * (-0.06641104411324127 + z * 0.05692449982584821);
    const high = -0.04358835218285214 + z * 0.0212566297845034;
    const octant = t + t * (z * (low + z4 * (middle + z4 * high)));
    const flat = steep < 0.0 ? 1.5707963267948966 : 0.0;
    const upright = 0.5 < diagonal ? 0.7853981633974483 : flat;
    const axis = Math.abs(upright - (left < 0.0 ? Math.PI : 0.0));
    const angle = $copysign(axis + steep * left * octant, y);
    return -Math.PI < angle ? angle : Math.PI;
};
