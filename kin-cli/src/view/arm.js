// An arm: its joints, its target, and all solutions of it.

const PRIMES = [2, 3, 5, 7, 11, 13, 17, 19];

class ArmView {
    constructor(arm, { chains, why, size, coordinates }) {
        this.arm = arm;
        this.chain = chains[0];
        this.size = size;
        this.form = arm.form;
        this.why = why;
        this.joints = arm.joints;
        this.canTurn = !arm.form || arm.form.counts_rotation;
        this.isShort = arm.form !== null && arm.form !== undefined && arm.joints.length < coordinates;
        this.canMove = true;
        this.q = arm.joints.map((joint, i) => this.pleasant(joint, i));
        this.parameters = [];
        this.reached = true;
        this.settle();
    }

    /** A value to begin with: away from home, where many arms are singular, and within limits. */
    pleasant({ lower, upper, turns }, i) {
        const wish = turns ? [0.4, -0.9, 1.1, -0.6, 0.8, 0.5, 0.3][i % 7] : 0.15 * this.size;
        const [low, high] = [Math.max(lower, -1e3), Math.min(upper, 1e3)];
        const width = high - low;
        return wish > low + 0.05 * width && wish < high - 0.05 * width ? wish : low + (0.35 + 0.05 * (i % 4)) * width;
    }

    /** The target is where the arm is. */
    settle() {
        this.target = Array.from(this.arm.fk(this.q));
        this.parameters = this.form ? this.arm.redundancy(this.target, this.q) : [];
        this.reached = true;
        this.solve();
        this.isNewTarget = true;
    }

    solutionsAt(parameters) {
        return this.arm.ik_seeded_at(this.target, parameters, this.q);
    }

    /** All solutions, with how far they are from where the arm is. */
    solve() {
        if (!this.form) {
            this.solutions = [];
            return;
        }
        this.solutions = this.followed(this.solutionsAt(this.parameters)).map((solution) => {
            const inside = this.arm.within_limits(solution.q, this.q);
            return { ...solution, inside, off: this.apart(solution.q, this.q) };
        });
    }

    /** Solutions of an elimination come in the order of its roots, which change their places as the
     * target moves: here each keeps the number of the one before that it is nearest to. */
    followed(found) {
        const { search, branches, lanes } = this.form;
        if (!search) {
            return found;
        }
        // Those of a plan have numbers of their own.
        const first = lanes ? branches : 0;
        const [own, others] = [found.filter(({ branch }) => branch < first), found.filter(({ branch }) => branch >= first)];
        const before = (this.solutions ?? []).filter(({ branch }) => branch >= first);
        const pairs = others.flatMap((now, i) => before.map(({ q, branch }) => ({ i, branch, off: this.apart(now.q, q) })));
        const numbers = new Map();
        const taken = new Set();
        const take = (i, branch) => {
            numbers.set(i, branch);
            taken.add(branch);
        };
        for (const { i, branch } of pairs.sort((a, b) => a.off - b.off)) {
            if (!numbers.has(i) && !taken.has(branch)) {
                take(i, branch);
            }
        }
        others.forEach((_, i) => {
            if (!numbers.has(i)) {
                let branch = first;
                while (taken.has(branch)) {
                    ++branch;
                }
                take(i, branch);
            }
        });
        const renumbered = others.map((solution, i) => ({ ...solution, branch: numbers.get(i) }));
        return [...own, ...renumbered.sort((a, b) => a.branch - b.branch)];
    }

    /** The farthest that a joint of two configurations is apart, slides by the arm's size. */
    apart(a, b) {
        return Math.max(...this.joints.map(({ turns }, i) => {
            const d = a[i] - b[i];
            return turns ? Math.abs(Math.atan2(Math.sin(d), Math.cos(d))) : Math.abs(d) / this.size;
        }));
    }

    setJoint(i, value) {
        this.q[i] = value;
        this.settle();
    }

    /** Goes to the solution nearest to where the arm is, one within limits if there is any. */
    setTarget(target) {
        this.target = Array.from(target);
        if (!this.form) {
            const found = this.arm.approach(target, this.q, 60);
            this.reached = found.residual < 1e-6 * this.size;
            if (this.reached) {
                this.q = Array.from(found.q, (x, i) => (this.joints[i].repeats ? Math.atan2(Math.sin(x), Math.cos(x)) : x));
            }
            return;
        }
        this.isNewTarget = true;
        this.goToNearest();
        for (let i = 0; i < this.parameters.length && !this.reached; ++i) {
            this.giveWay(i);
        }
        if (!this.reached && this.isShort) {
            this.comeNear();
        }
    }

    /** Where a target is out of reach at the parameters, one moves to the next value at which it
     * is not. */
    giveWay(i) {
        const held = this.parameters[i];
        const step = this.form.parameters[i].turns ? 0.02 : 0.005 * this.size;
        for (let k = 1; k <= 80 && !this.reached; ++k) {
            this.parameters[i] = held + (k % 2 === 1 ? step : -step) * Math.ceil(k / 2);
            this.goToNearest();
        }
        if (!this.reached) {
            this.parameters[i] = held;
        }
    }

    /** An arm with fewer joints than targets have coordinates takes the target along, as near to
     * where it was sent as it can. */
    comeNear() {
        const { q } = this.arm.approach(this.target, this.q, 60);
        const inside = this.arm.within_limits(q, this.q);
        if (inside) {
            this.q = inside;
        }
        this.settle();
    }

    setParameter(i, value) {
        this.parameters[i] = value;
        this.isNewTarget = this.isNewTarget || i > 0;
        this.goToNearest();
    }

    goToNearest() {
        this.solve();
        this.reached = this.solutions.length > 0;
        if (this.reached) {
            const nearest = this.solutions.reduce((best, it) => {
                const rank = (s) => (s.inside ? 0 : 100) + s.off;
                return rank(it) < rank(best) ? it : best;
            });
            this.goTo(nearest);
        }
    }

    goTo(solution) {
        this.q = Array.from(solution.inside ?? solution.q);
        this.solve();
    }

    choose(i) {
        this.goTo(this.solutions[i]);
        this.isNewTarget = true;
    }

    /** What of the target is not counted follows the arm. */
    released() {
        if (this.reached && this.form) {
            this.settle();
        }
    }

    about() {
        const { arm } = this;
        const plan = this.form ? ` Plan: ${this.form.plan}.` : "";
        return `${arm.base} to ${arm.tip}, ${arm.joints.length} joints.${plan}`;
    }

    reach() {
        if (!this.form) {
            return this.reached
                ? ["Followed by Newton's method from the present configuration: one solution, not all.", ""]
                : ["Not reached by Newton's method from the present configuration.", "bad"];
        }
        if (this.isShort) {
            return ["The arm has too few joints to reach all targets: the target follows it. "
                + "`kin view --target` takes targets of which less counts.", ""];
        }
        if (this.reached) {
            return ["", ""];
        }
        const at = this.parameters.length > 0 ? " at this value of the free parameter" : "";
        return [`No solution: ${this.arm.why_none(this.target)}${at}.`, "bad"];
    }

    posture(branch) {
        if (branch >= this.form.branches) {
            return "beside the plan's branches";
        }
        const words = this.form.postures.map(({ name, words }) => `${name} ${words[branch]}`);
        return words.length > 0 ? words.join(", ") : this.form.branches > 1 ? `branch ${branch}` : "the only branch";
    }

    branches() {
        if (!this.form) {
            return null;
        }
        const here = this.solutions.filter(({ off }) => this.reached && off < 1e-4);
        return this.solutions.map((solution) => ({
            colour: branchColour(solution.branch),
            posture: this.posture(solution.branch),
            singular: solution.singular,
            within: solution.inside !== null,
            beyond: this.joints.filter((_, i) => this.arm.inside(i, solution.q[i]) === null)
                .map(({ name }) => name).join(", "),
            current: solution === here[0],
            motion: `${rounded(solution.off * DEGREES, 1)}°`,
        }));
    }

    inside(i) {
        const { lower, upper } = this.joints[i];
        return this.q[i] >= lower - 1e-9 && this.q[i] <= upper + 1e-9;
    }

    /** The measures of configurations here and there, so that those of one can be compared. */
    sampledMeasures() {
        return Array.from({ length: 150 }, (_, k) => this.measures(this.joints.map((joint, i) => {
            const [lower, upper] = travel(joint, this.size);
            // Multiples of irrational numbers fill the cube evenly.
            return lower + (upper - lower) * ((k * Math.sqrt(PRIMES[i % PRIMES.length])) % 1);
        })));
    }

    measures(q = this.q) {
        const n = this.joints.length;
        const entries = this.arm.geometric_jacobian(q);
        const rows = Array.from({ length: 6 }, (_, i) => Array.from(entries.slice(n * i, n * i + n)));
        const rank = Math.min(6, n);
        const product = (values) => values.reduce((all, x) => all * x, 1);
        const all = singularValues(rows).slice(0, rank);
        const linear = singularValues(rows.slice(0, 3)).slice(0, Math.min(3, n));
        const measures = [
            { name: "smallest singular value", value: all[all.length - 1], title: "of the geometric Jacobian, metres and radians" },
            { name: "inverse condition number", value: all[0] > 0 ? all[all.length - 1] / all[0] : 0, title: "smallest over largest singular value; 0 where the arm is singular" },
            { name: "manipulability", value: product(all), title: "product of the singular values of the geometric Jacobian (Yoshikawa), metres and radians" },
            { name: "of the translation", value: product(linear), title: "the same of its first three rows" },
        ];
        const own = this.arm.singularities;
        if (own) {
            const values = own.values(q);
            own.each.forEach(({ name, unit }, i) => measures.push({
                name: `${name} singularity`, value: values[i + 1], title: `0 where the arm is singular so; ${unit}`,
            }));
        }
        return measures;
    }

    points() {
        const all = [this.q, ...this.solutions.map(({ q }) => q)];
        return all.flatMap((q) => chainPoints(this.chain, this.arm.link_poses(q)));
    }

    draw(scene, shown) {
        const poses = this.arm.link_poses(this.q);
        if (shown.branches && this.form) {
            for (const { q, branch, off } of this.solutions) {
                if (off > 1e-4) {
                    drawChain(scene, this.chain, this.arm.link_poses(q),
                        { colour: branchColour(branch), width: 3, alpha: 0.55 });
                }
            }
        }
        const current = this.solutions.find(({ off }) => off < 1e-4);
        const colour = shown.branches && current && this.reached ? branchColour(current.branch) : scene.colour("bone");
        drawChain(scene, this.chain, poses, { colour: scene.colour("paper"), width: 10 });
        drawChain(scene, this.chain, poses, { colour, width: 6.5 });
        if (shown.axes) {
            drawAxes(scene, this.chain, poses, this.size, shown.names ? this.arm.moves.map((_, i) => this.joints[i]?.name ?? "") : null);
        }
        const triad = 0.12 * this.size;
        scene.frame(IDENTITY, 1.3 * triad, 2.5);
        scene.frame(this.arm.fk(this.q), triad, 2.5);
        if (shown.frames) {
            poses.forEach((pose) => scene.frame(pose, 0.7 * triad, 1.5, 0.8));
            this.arm.frames.forEach((frame, i) => {
                const pose = this.arm.fk_frame(this.q, i);
                scene.frame(pose, 0.5 * triad, 1.2, 0.7);
                if (shown.names) {
                    scene.label(origin(pose), frame.name, scene.colour("muted"));
                }
            });
        }
        if (shown.names) {
            scene.label([0, 0, 0], this.arm.base, scene.colour("muted"), 8, 16);
            scene.label(origin(this.arm.fk(this.q)), this.arm.tip, scene.colour("muted"), 10, 18);
        }
    }
}
