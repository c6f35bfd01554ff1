// The robot of a WebAssembly module, for pages and for Node.

/** A robot from the bytes of `wasm.wasm`. Radians and metres; poses are three rows of [R | p]. */
export async function load(bytes) {
    const { instance } = await WebAssembly.instantiate(bytes);
    const { memory, numbers, fk, ik } = instance.exports;
    const all = new Float64Array(memory.buffer, numbers(), 36 + 7 * 16);
    const put = (values, place, length) => {
        if (values.length !== length || !Array.from(values).every((x) => typeof x === "number")) {
            throw new TypeError(`these are ${length} numbers: ${values}`);
        }
        all.set(values, place);
    };
    return {
        /** The pose of the tip and the origins of the links. */
        fk(q) {
            put(q, 0, 6);
            fk();
            const link = (i) => Array.from(all.subarray(18 + 3 * i, 21 + 3 * i));
            return { pose: Array.from(all.subarray(6, 18)), links: [0, 1, 2, 3, 4, 5].map(link) };
        },
        /** All solutions to a pose. */
        ik(pose) {
            put(pose, 6, 12);
            const solution = (_, i) => {
                const at = 36 + 7 * i;
                return { q: Array.from(all.subarray(at, at + 6)), residual: all[at + 6] };
            };
            return Array.from({ length: ik() }, solution);
        },
    };
}
