// Runs the module in Node: every solution reaches its target, and the configuration is one.
// node check.mjs wasm.wasm

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { load } from "./ur5e.mjs";

const arm = await load(await readFile(process.argv[2]));
const near = (a, b, by) => a.every((x, i) => Math.abs(x - b[i]) < by);
const configuration = (k) =>
    [1, 2, 3, 4, 5, 6].map((i) => ((k * i * 2.399963) % (2 * Math.PI)) - Math.PI);
const targets = 20000;
let solutions = 0;
for (let k = 0; k < targets; k++) {
    const q = configuration(k);
    const { pose } = arm.fk(q);
    const found = arm.ik(pose);
    solutions += found.length;
    for (const solution of found) {
        assert(near(arm.fk(solution.q).pose, pose, 1e-8), `${k}: ${solution.q}`);
    }
    const regular = Math.min(...[2, 4].map((i) => Math.abs(Math.sin(q[i])))) > 1e-2;
    assert(!regular || found.some((it) => near(it.q, q, 1e-6)), `${k}: ${q} is lost`);
}
assert.equal(arm.ik([1, 0, 0, 9, 0, 1, 0, 0, 0, 0, 1, 0]).length, 0, "nine metres away");
const poses = Array.from({ length: targets }, (_, k) => arm.fk(configuration(k)).pose);
const clock = performance.now();
poses.forEach((pose) => arm.ik(pose));
const each = (1e3 * (performance.now() - clock)) / targets;
console.log(`${solutions} solutions to ${targets} targets, ${each.toFixed(1)} µs each`);
