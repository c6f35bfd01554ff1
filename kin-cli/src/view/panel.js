// The panel beside the picture. Names of the robot file go in as text, never as markup.

const element = (tag, properties = {}, ...children) => {
    const made = document.createElement(tag);
    for (const [name, value] of Object.entries(properties)) {
        if (name.startsWith("aria") || name === "for") {
            made.setAttribute(name.replace("aria", "aria-").toLowerCase(), value);
        } else {
            made[name] = value;
        }
    }
    made.append(...children);
    return made;
};

const byId = (id) => document.getElementById(id);

const DEGREES = 180 / Math.PI;

/** As it is shown: degrees and millimetres are read more easily than radians and metres. */
const shownAs = (turns) => (turns ? { unit: "°", scale: DEGREES, digits: 2 } : { unit: "mm", scale: 1000, digits: 1 });

const rounded = (x, digits) => (Object.is(Math.round(x * 10 ** digits), -0) ? 0 : x).toFixed(digits).replace(/^-(0(\.0*)?)$/, "$1");

/** What can be typed: a number of which sine and cosine are known. */
const isTyped = (text) => text !== "" && Math.abs(Number(text)) <= 1e9;

/** A slider with a number beside it; values in radians or metres. */
const slider = (joint, [lower, upper], changed) => {
    const { unit, scale, digits } = shownAs(joint.turns);
    const label = joint.label ?? joint.name;
    const named = { ariaLabel: `${joint.name}, ${joint.turns ? "degrees" : "millimetres"}` };
    const range = element("input", {
        type: "range", min: lower * scale, max: upper * scale, step: "any", ...named,
    });
    const number = element("input", { type: "number", step: "any", ...named });
    const row = element("div", { className: "joint" },
        element("label", { textContent: label, title: joint.title ?? joint.name }), range, number,
        element("span", { className: "unit", textContent: unit }));
    range.addEventListener("input", () => changed(Number(range.value) / scale));
    number.addEventListener("change", () => {
        if (isTyped(number.value)) {
            changed(Number(number.value) / scale);
        }
    });
    const show = (value, inside = true) => {
        if (document.activeElement !== range || Math.abs(Number(range.value) - value * scale) > 1e-3) {
            range.value = value * scale;
        }
        if (document.activeElement !== number) {
            number.value = rounded(value * scale, digits);
        }
        row.classList.toggle("beyond", !inside);
        row.title = inside ? "" : "outside its limits";
    };
    return { row, show };
};

/** Where a slider ends: the limits, or a turn, or twice the robot's size where there are none, or none that a
 * slider gets near. */
const travel = (joint, size) => {
    const free = joint.turns ? Math.PI : 2 * size;
    const at = (x, otherwise) => (Math.abs(x) < 1e6 ? x : otherwise);
    return [at(joint.lower, -free), at(joint.upper, free)];
};

/** Six numbers of a pose. */
const poseFields = (place, turns, changed) => {
    const names = ["x", "y", "z", ...(turns ? ["roll", "pitch", "yaw"] : [])];
    const inputs = names.map((name, i) => {
        const long = i < 3 ? `${name}, millimetres` : `${name}, degrees`;
        const input = element("input", { type: "number", step: "any", ariaLabel: long });
        const short = i < 3 ? name : ["R", "P", "Y"][i - 3];
        place.append(element("label", { title: long }, short, input,
            element("span", { className: "unit", textContent: i < 3 ? "mm" : "°" })));
        return input;
    });
    let shown = null;
    inputs.forEach((input, i) => input.addEventListener("change", () => {
        if (!isTyped(input.value)) {
            return;
        }
        const value = Number(input.value);
        const [p, angles] = [origin(shown), rollPitchYaw(shown)];
        if (i < 3) {
            p[i] = value / 1000;
        } else {
            angles[i - 3] = value / DEGREES;
        }
        changed(poseOf(p, angles));
    }));
    return (pose) => {
        shown = pose;
        const numbers = [...origin(pose).map((x) => 1000 * x), ...rollPitchYaw(pose).map((x) => DEGREES * x)];
        inputs.forEach((input, i) => {
            if (document.activeElement !== input) {
                input.value = rounded(numbers[i], i < 3 ? 1 : 2);
            }
        });
    };
};

/** Rows of measures: a name, a bar and a value, or a text; bars relative to the largest value seen. */
const measureRows = (place, samples) => {
    const rows = new Map();
    const largest = ({ name }) => Math.max(0, ...samples.flat().filter((it) => it.name === name).map(({ value }) => Math.abs(value)));
    return (measures) => {
        for (const { name, title, value, text: told } of measures) {
            if (!rows.has(name)) {
                const bar = element("i");
                const text = element("span", { className: "value" });
                place.append(element("div", { className: told === undefined ? "measure" : "measure plain", title },
                    element("span", { textContent: name }),
                    element("span", { className: "bar" }, bar), text));
                rows.set(name, { bar, text, largest: largest({ name }) });
            }
            const row = rows.get(name);
            const size = Math.abs(value);
            row.largest = Math.max(row.largest, size);
            const share = row.largest > 0 ? size / row.largest : 0;
            row.bar.style.width = `${(100 * share).toFixed(1)}%`;
            row.bar.classList.toggle("low", share < 0.05);
            row.text.textContent = told ?? (size > 0 && size < 1e-3 ? value.toExponential(1) : rounded(value, 4));
        }
    };
};

/** The colour of a branch, told apart from its neighbours on either scheme. */
const HUES = [212, 28, 140, 340, 265, 178, 50, 310];
const branchColour = (branch) => {
    const dark = matchMedia("(prefers-color-scheme: dark)").matches;
    const round = Math.floor(branch / HUES.length) % 2;
    const lightness = (dark ? 66 : 44) + (round ? (dark ? -14 : 14) : 0);
    return `hsl(${HUES[branch % HUES.length]} 70% ${lightness}%)`;
};

/** The list of branches; `choose` is told which one was clicked. */
const branchList = (place, choose) => {
    const rows = [];
    return (branches) => {
        while (rows.length < branches.length) {
            const i = rows.length;
            const row = {
                swatch: element("span", { className: "swatch" }),
                posture: element("span", { className: "posture" }),
                limits: element("span", { className: "limits" }),
                motion: element("span", { className: "motion", title: "how far the joints are from where they are now" }),
            };
            row.button = element("button", { type: "button", className: "branch" },
                row.swatch, row.posture, row.limits, row.motion);
            row.button.addEventListener("click", () => choose(i));
            rows.push(row);
            place.append(row.button);
        }
        rows.forEach(({ button, swatch, posture, limits, motion }, i) => {
            const branch = branches[i];
            button.hidden = !branch;
            if (!branch) {
                return;
            }
            swatch.style.background = branch.colour;
            posture.textContent = branch.posture + (branch.singular ? " · singular" : "");
            limits.textContent = branch.within ? "in limits" : "beyond";
            limits.title = branch.within ? "all joints are within their limits" : `outside the limits: ${branch.beyond}`;
            limits.className = `limits ${branch.within ? "good" : "bad"}`;
            motion.textContent = branch.current ? "here" : branch.motion;
            button.classList.toggle("current", branch.current);
            button.setAttribute("aria-current", branch.current ? "true" : "false");
        });
    };
};
