/* What of an array is no number, by its place and its type: of text, as pages have it, + makes text. */
const $no_number = (values) => {
    const place = Array.from(values).findIndex((x) => typeof x !== "number");
    return place < 0 ? null : `${place} is ${values[place] === null ? null : typeof values[place]}`;
};

/* A robot whose functions take arrays of so many numbers alone: too few would be answered by NaN,
 * and a matrix of sixteen by another pose. By function, what its first arguments are. */
const $counted = (robot, joints, functions) => {
    const lengths = {
        q: [joints, "a value of each joint"],
        seed: [joints, "a value of each joint"],
        pose: [12, "the rows of the rotation with the translation at their ends"],
    };
    const counted = { ...robot };
    for (const [name, parameters] of Object.entries(functions)) {
        const answer = robot[name];
        const check = (given, i) => {
            const is_left_out = given[i] === undefined && i >= answer.length;
            if (!(parameters[i] in lengths) || is_left_out) {
                return;
            }
            const [length, meaning] = lengths[parameters[i]];
            if (given[i]?.length !== length) {
                const count = given[i]?.length ?? typeof given[i];
                throw new TypeError(
                    `${name}: ${parameters[i]} is ${length} numbers, ${meaning}, and not ${count}`);
            }
            const other = $no_number(given[i]);
            if (other !== null) {
                throw new TypeError(`${name}: ${parameters[i]} is numbers, and entry ${other}`);
            }
        };
        if (answer) {
            counted[name] = (...given) => {
                parameters.forEach((_, i) => check(given, i));
                return answer(...given);
            };
        }
    }
    return Object.freeze(counted);
};
