// Opens a robot's page, moves a slider, drags the target, and holds what the page shows against
// `kin check --at`, the interpreter: node check.mjs path/to/kin robot.urdf ...

import { execFileSync } from "node:child_process";
import assert from "node:assert/strict";
import { basename, resolve } from "node:path";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { Browser } from "./browser.mjs";

const [kin, ...robots] = process.argv.slice(2);
const folder = mkdtempSync(join(tmpdir(), "kin-check-"));
const browser = new Browser();

/** What the interpreter has: all solutions of the pose of a configuration. */
const expected = (robot, q) => {
    const said = execFileSync(kin, ["check", robot, "--json", "--at", q.map((x) => x.toFixed(17)).join(",")]);
    const { replay } = JSON.parse(said).files[0];
    return replay.found.filter(({ solution }) => solution !== null).map((found) => found.q);
};

const turned = (x) => Math.atan2(Math.sin(x), Math.cos(x));

/** What the page has, by what a reader sees of it. */
const compare = async (robot, what) => {
    const shown = await browser.evaluate(`({
        q: window.kin.subject.q,
        turns: window.kin.subject.joints.map(({ turns }) => turns),
        numbers: [...document.querySelectorAll("#joints input[type=number]")].map(({ value }) => Number(value)),
        target: [...document.querySelectorAll("#target input")].map(({ value }) => Number(value)),
        pose: Array.from((window.kin.robot.platform ?? window.kin.robot.fk)(window.kin.subject.q)),
        rows: [...document.querySelectorAll(".branch:not([hidden])")].map((row) => row.innerText),
        current: document.querySelectorAll(".branch.current:not([hidden])").length,
        solutions: window.kin.subject.solutions.map(({ q }) => Array.from(q)),
    })`);
    shown.numbers.forEach((number, i) => {
        const value = shown.turns[i] ? (number * Math.PI) / 180 : number / 1000;
        assert.ok(Math.abs(value - shown.q[i]) < 1e-4, `${what}: joint ${i + 1} shows ${number}`);
    });
    [3, 7, 11].forEach((entry, i) => {
        assert.ok(Math.abs(shown.target[i] / 1000 - shown.pose[entry]) < 1e-4, `${what}: target`);
    });
    const all = expected(robot, shown.q);
    assert.equal(shown.rows.length, all.length, `${what}: rows of branches`);
    assert.equal(shown.current, 1, `${what}: one branch is where the arm is`);
    for (const q of all) {
        const near = shown.solutions.some((own) => own.every((x, i) =>
            Math.abs(shown.turns[i] ? turned(x - q[i]) : x - q[i]) < 1e-6));
        assert.ok(near, `${what}: ${q} is not shown`);
    }
    return shown;
};

for (const robot of robots) {
    const page = join(folder, `${basename(robot)}.html`);
    execFileSync(kin, ["view", robot, "-o", page]);
    await browser.open(`file://${resolve(page)}`, 1280, 800);
    const first = await compare(robot, `${robot}, at first`);
    await browser.evaluate(`(() => {
        const range = document.querySelectorAll("#joints input[type=range]")[1];
        range.value = Number(range.value) + 0.04 * (range.max - range.min);
        range.dispatchEvent(new Event("input", { bubbles: true }));
    })()`);
    await browser.frame();
    const moved = await compare(robot, `${robot}, a slider moved`);
    assert.notDeepEqual(moved.target, first.target);
    // By its arrow along z, to where it stays in reach.
    const way = await browser.evaluate(`(() => {
        const { robot, subject } = window.kin;
        const moved = (by) => subject.target.map((x, i) => (i === 11 ? x + by : x));
        const reached = (by) => robot.ik_seeded_at(moved(by), subject.parameters, subject.q).length > 0;
        return reached(-0.1) ? -1 : 1;
    })()`);
    await browser.evaluate(`document.getElementById("home-view").click()`);
    await browser.frame();
    const end = await browser.evaluate(`(() => {
        const { gizmo, camera, subject } = window.kin;
        const [, end] = gizmo.arrow(subject.target, 2, gizmo.radius(camera, subject.target));
        return camera.project(end).slice(0, 2);
    })()`);
    await browser.drag(end, [end[0], end[1] - 20 * way]);
    const dragged = await compare(robot, `${robot}, the target dragged`);
    assert.ok(way * (dragged.target[2] - moved.target[2]) > 5, `${robot}: the target went its way`);
    assert.ok(Math.abs(dragged.target[0] - moved.target[0]) < 0.2, `${robot}: and nowhere else`);
    const milliseconds = await browser.evaluate(`(() => {
        const { subject } = window.kin;
        const start = performance.now();
        for (let k = 0; k < 100; ++k) {
            subject.setTarget(subject.target);
            subject.measures();
        }
        return (performance.now() - start) / 100;
    })()`);
    console.log(`${robot}: ${dragged.rows.length} branches as the interpreter has them; ${milliseconds.toFixed(2)} ms for a target`);
}
assert.deepEqual(browser.errors, []);
await browser.close();
rmSync(folder, { recursive: true });
