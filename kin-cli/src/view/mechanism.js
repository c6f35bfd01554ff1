// A parallel mechanism: its driven joints, its platform, and its loops.

class MechanismView {
    constructor(mechanism, { chains, why, size }) {
        this.mechanism = mechanism;
        this.chains = chains;
        this.size = size;
        this.why = why;
        const all = mechanism.chains.flatMap(({ arm, name }) => arm.joints.map((joint) => ({ ...joint, chain: name })));
        this.all = all;
        this.joints = mechanism.actuated.map((joint) => all[joint]);
        this.canTurn = mechanism.aim === "pose" && mechanism.freedom > 2;
        this.canMove = mechanism.aim !== null;
        this.whole = all.map(() => 0);
        this.reached = true;
        this.settle();
    }

    get q() {
        return this.mechanism.actuated.map((joint) => this.whole[joint]);
    }

    settle() {
        this.target = Array.from(this.mechanism.platform(this.whole));
        this.solve();
    }

    solve() {
        this.placed = this.canMove ? this.mechanism.ik(this.target) : [];
    }

    /** How far two sets of joint values of a chain are apart. */
    apart(chain, a, b) {
        const off = this.mechanism.chains[chain].arm.joints.map(({ turns }, i) => {
            const d = a[i] - b[i];
            return turns ? Math.abs(Math.atan2(Math.sin(d), Math.cos(d))) : Math.abs(d) / this.size;
        });
        return Math.max(...off);
    }

    setJoint(i, value) {
        const joint = this.mechanism.actuated[i];
        const wanted = this.whole.slice();
        // In steps, so that the loops stay in the assembly mode that they are in.
        const steps = Math.ceil(Math.abs(value - wanted[joint]) / (this.joints[i].turns ? 0.05 : 0.02 * this.size)) || 1;
        const from = wanted[joint];
        let found = { q: wanted, residual: 0 };
        for (let step = 1; step <= Math.min(steps, 60); ++step) {
            const q = found.q.slice();
            q[joint] = from + ((value - from) * step) / Math.min(steps, 60);
            found = this.mechanism.close(q, this.mechanism.actuated, 30);
            if (!(found.residual < 1e-7 * this.size)) {
                this.stuck = true;
                return;
            }
        }
        this.stuck = false;
        this.cameBack = false;
        this.reached = true;
        this.whole = found.q;
        this.settle();
    }

    /** The posture next to the present one, chain by chain. */
    setTarget(target) {
        this.target = Array.from(target);
        this.stuck = false;
        this.cameBack = false;
        this.solve();
        this.reached = this.placed.length > 0;
        if (!this.reached) {
            return;
        }
        const parts = this.mechanism.split(this.whole);
        const postures = this.placed.map(({ solutions }) => solutions.map((found, chain) => found.reduce((best, q) =>
            (this.apart(chain, q, parts[chain]) < this.apart(chain, best, parts[chain]) ? q : best))));
        const motion = (chains) => Math.max(...chains.map((q, chain) => this.apart(chain, q, parts[chain])));
        const nearest = postures.reduce((best, it) => (motion(it) < motion(best) ? it : best));
        this.whole = nearest.flat();
    }

    /** A platform that moves in a few ways alone takes the target back. */
    released() {
        this.cameBack = !this.reached && this.mechanism.aim === "pose" && this.mechanism.mobility < 6;
        if (this.reached || this.cameBack) {
            this.reached = true;
            this.settle();
        }
    }

    about() {
        const { mechanism } = this;
        return `${mechanism.base} to ${mechanism.platform}, ${mechanism.chains.length} chains, `
            + `${this.all.length} joints, ${mechanism.actuated.length} of them driven, mobility ${mechanism.mobility}.`;
    }

    reach() {
        if (this.stuck) {
            return ["The loops cannot follow that joint any further.", "bad"];
        }
        if (this.cameBack) {
            return [`Mobility ${this.mechanism.mobility}: the target came back to where the platform can be.`, ""];
        }
        return this.reached ? ["", ""] : ["No solution: out of reach of a chain.", "bad"];
    }

    branches() {
        return null;
    }

    /** How many postures each chain has here. */
    postures() {
        const parts = this.mechanism.split(this.whole);
        const here = this.placed.find(({ solutions }) => solutions.every((found, chain) =>
            found.some((q) => this.apart(chain, q, parts[chain]) < 1e-4)));
        return here ? here.solutions : [];
    }

    inside(i) {
        const { lower, upper } = this.joints[i];
        return this.q[i] >= lower - 1e-9 && this.q[i] <= upper + 1e-9;
    }

    sampledMeasures() {
        return [];
    }

    /** By chain, how its joints move the platform: columns at its origin, in metres. */
    columns() {
        const { chains, length } = this.mechanism;
        const parts = this.mechanism.split(this.whole);
        return chains.map(({ arm }, i) => {
            const n = arm.joints.length;
            const entries = arm.geometric_jacobian(parts[i]);
            return arm.joints.map((_, joint) => [0, 1, 2, 3, 4, 5].map((row) =>
                (row < 3 ? 1 : length) * entries[row * n + joint]));
        });
    }

    /** How well the chains hold the platform while the driven joints are locked: the least singular
     * value of the wrenches that they bear. */
    held(columns) {
        let first = 0;
        const rows = columns.flatMap((chain) => {
            const passive = chain.filter((_, joint) => !this.mechanism.actuated.includes(first + joint));
            first += chain.length;
            return perpendicular(passive);
        });
        return singularValues(rows)[5];
    }

    /** How far the loops are from allowing more motions than the mobility: of their equations the
     * least singular value that has to stay above zero, relative to the largest. */
    looped(columns) {
        const rows = columns.slice(1).flatMap((_, k) => [0, 1, 2, 3, 4, 5].map((row) => columns.flatMap((chain, i) => {
            const sign = i === 0 ? 1 : i === k + 1 ? -1 : 0;
            return chain.map((column) => sign * column[row]);
        })));
        const values = singularValues(rows);
        const least = values[this.all.length - this.mechanism.mobility - 1] ?? 0;
        return values[0] > 0 ? least / values[0] : 0;
    }

    measures() {
        const gap = this.mechanism.gap(this.whole);
        const told = gap < 1e-9 ? "closed to less than 1 nm" : `open by ${rounded(1e6 * gap, 3)} µm`;
        const measures = [{
            name: "loops", value: gap, text: told,
            title: "how far the chains' ends are apart, angles at the distance of the mechanism's length",
        }];
        const columns = this.columns();
        measures.push({
            name: "actuator singularity", value: this.held(columns),
            title: "0 where the platform can move while the driven joints are locked: least singular value of the wrenches of length 1 that the chains bear",
        }, {
            name: "kinematic singularity", value: this.looped(columns),
            title: "0 where the loops allow more motions than the mobility: singular value of their equations, by the largest",
        });
        const postures = this.postures();
        this.mechanism.chains.forEach(({ name }, i) => {
            if (postures[i]) {
                const count = postures[i].length;
                measures.push({
                    name, value: count, text: `${count} ${count === 1 ? "posture" : "postures"}`,
                    title: "solutions of this chain for the platform's pose; each goes with each of the others'",
                });
            }
        });
        return measures;
    }

    points() {
        const parts = this.mechanism.split(this.whole);
        return this.mechanism.chains.flatMap(({ arm }, i) => chainPoints(this.chains[i], arm.link_poses(parts[i])));
    }

    draw(scene, shown) {
        const parts = this.mechanism.split(this.whole);
        const postures = shown.branches ? this.postures() : [];
        this.mechanism.chains.forEach(({ arm }, i) => {
            const colour = branchColour(i);
            const poses = arm.link_poses(parts[i]);
            for (const q of postures[i] ?? []) {
                if (this.apart(i, q, parts[i]) > 1e-4) {
                    drawChain(scene, this.chains[i], arm.link_poses(q), { colour, width: 2.5, alpha: 0.35 });
                }
            }
            drawChain(scene, this.chains[i], poses, { colour, width: 5.5 });
            if (shown.axes) {
                drawAxes(scene, this.chains[i], poses, 0.6 * this.size, shown.names ? arm.joints.map(({ name }) => name) : null);
            }
            if (shown.frames) {
                poses.forEach((pose) => scene.frame(pose, 0.06 * this.size, 1.5, 0.8));
            }
        });
        const triad = 0.12 * this.size;
        scene.frame(IDENTITY, 1.3 * triad, 2.5);
        scene.frame(this.mechanism.platform(this.whole), triad, 2.5);
        this.drawPlatform(scene, parts);
    }

    /** The platform: the points at which the chains' last axes meet it, joined in a row. */
    drawPlatform(scene, parts) {
        const corners = this.mechanism.chains.map(({ arm }, i) => {
            const { axes } = this.chains[i];
            const poses = arm.link_poses(parts[i]);
            return transform(poses[poses.length - 1], axes[axes.length - 1].at);
        });
        corners.forEach((corner, i) => {
            scene.line(corner, corners[(i + 1) % corners.length], scene.colour("bone"), 4, { alpha: 0.8 });
        });
    }
}
