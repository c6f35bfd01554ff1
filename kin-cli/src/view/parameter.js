// The free parameter of an arm with a joint to spare: a slider, and under it where each branch
// exists.

class Parameter {
    /** `solve` has the solutions of the target at a value; so many are looked at between the ends. */
    constructor(place, parameter, [lower, upper], branches, count, solve, changed) {
        Object.assign(this, { parameter, lower, upper, branches, count, solve });
        const title = `${parameter.name}: given beside the target`;
        this.slider = slider({ ...parameter, title }, [lower, upper], changed);
        this.strip = element("canvas", { id: "strip", title: "where each branch exists; pale: beyond the limits" });
        this.text = element("p", { className: "intervals" });
        place.append(this.slider.row, this.strip, this.text);
        const choose = (event) => {
            const { left, width } = this.strip.getBoundingClientRect();
            const share = Math.max(0, Math.min(1, (event.clientX - left) / width));
            changed(lower + share * (upper - lower));
        };
        this.strip.addEventListener("pointerdown", (event) => {
            this.strip.setPointerCapture(event.pointerId);
            choose(event);
        });
        this.strip.addEventListener("pointermove", (event) => event.buttons && choose(event));
    }

    /** Whether a branch exists at a value, and whether within limits: 0, 1 or 2. */
    states(value) {
        const states = new Uint8Array(this.branches);
        this.solve(value).forEach(({ branch, within }) => (states[branch] = within ? 2 : 1));
        return states;
    }

    /** The intervals in which some branch exists, within limits or not; ends by bisection. */
    intervals(samples, level) {
        const is = (states) => states.some((state) => state >= level);
        const at = (k) => this.lower + ((this.upper - this.lower) * k) / this.count;
        const end = (k) => {
            let [inside, outside] = is(samples[k]) ? [at(k), at(k + 1)] : [at(k + 1), at(k)];
            for (let step = 0; step < 14; ++step) {
                const middle = (inside + outside) / 2;
                [inside, outside] = is(this.states(middle)) ? [middle, outside] : [inside, middle];
            }
            return inside;
        };
        const found = [];
        let from = is(samples[0]) ? this.lower : null;
        for (let k = 0; k < this.count; ++k) {
            const [here, next] = [is(samples[k]), is(samples[k + 1])];
            if (!here && next) {
                from = end(k);
            } else if (here && !next) {
                found.push([from, end(k)]);
                from = null;
            }
        }
        return from === null ? found : [...found, [from, this.upper]];
    }

    show(value, isNewTarget, colour) {
        this.slider.show(value);
        if (isNewTarget) {
            this.samples = Array.from({ length: this.count + 1 }, (_, k) =>
                this.states(this.lower + ((this.upper - this.lower) * k) / this.count));
            this.found = [2, 1].map((level) => this.intervals(this.samples, level));
            const { unit, scale } = shownAs(this.parameter.turns);
            const list = (found) => found.map((ends) =>
                `[${ends.map((x) => rounded(x * scale, 1)).join(", ")}] ${unit}`).join(" and ") || "nowhere";
            this.text.textContent = `Within limits: ${list(this.found[0])}. In reach: ${list(this.found[1])}.`;
            this.text.title = `Looked for at ${this.count + 1} values, ends by bisection; shorter intervals can be missed.`;
        }
        this.draw(value, colour);
    }

    draw(value, colour) {
        const ratio = window.devicePixelRatio || 1;
        const width = this.strip.clientWidth;
        const used = Array.from({ length: this.branches }, (_, b) => b)
            .filter((b) => this.samples.some((states) => states[b] > 0));
        const height = Math.max(1, used.length) * 9 + 20;
        this.strip.style.height = `${height}px`;
        this.strip.width = width * ratio;
        this.strip.height = height * ratio;
        const context = this.strip.getContext("2d");
        context.scale(ratio, ratio);
        const step = width / (this.count + 1);
        used.forEach((branch, row) => {
            context.fillStyle = branchColour(branch);
            this.samples.forEach((states, k) => {
                if (states[branch] > 0) {
                    context.globalAlpha = states[branch] === 2 ? 1 : 0.25;
                    context.fillRect(k * step, row * 9 + 1, step + 0.5, 7);
                }
            });
        });
        context.globalAlpha = 1;
        context.fillStyle = colour("muted");
        context.font = "11px system-ui, sans-serif";
        const { unit, scale } = shownAs(this.parameter.turns);
        [this.lower, (this.lower + this.upper) / 2, this.upper].forEach((x, i) => {
            context.textAlign = ["left", "center", "right"][i];
            context.fillText(`${rounded(x * scale, 0)} ${unit}`, (width * i) / 2, height - 4);
        });
        const place = ((value - this.lower) / (this.upper - this.lower)) * width;
        context.fillStyle = colour("ink");
        context.fillRect(place - 1, 0, 2, height - 16);
    }
}
