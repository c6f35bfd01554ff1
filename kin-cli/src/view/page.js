// The page: what is shown, and what hands do with it.

const isMechanism = Array.isArray(robot.chains);
const subject = isMechanism ? new MechanismView(robot, view) : new ArmView(robot, view);
const canvas = byId("scene");
const camera = new Camera(view.size);

/** Looks at the robot, with room for the arrows around the target. */
const fit = () => {
    const room = [-0.25, 0.25].flatMap((by) => [0, 1, 2].map((axis) =>
        origin(subject.target).map((x, i) => (i === axis ? x + by * view.size : x))));
    camera.frame([[0, 0, 0], ...subject.points(), ...(subject.canMove ? room : [])]);
};
fit();

const scene = new Scene(canvas, camera);
const gizmo = new Gizmo(subject.canTurn);

document.title = `${robot.name}: kinematics`;
byId("name").textContent = robot.name;
byId("about").textContent = subject.about();
byId("footer").textContent = `Made by kin view from ${robot.file}. `
    + "Angles in degrees, lengths in millimetres; roll, pitch and yaw about the base's axes, as in URDF.";
if (subject.why) {
    byId("notice").hidden = false;
    byId("notice").textContent = subject.why;
}
if (isMechanism) {
    byId("measures-title").textContent = "Loops";
    // The other postures of all chains at once are a thicket.
    byId("show-branches").checked = false;
}
if (robot.form && robot.form.target) {
    byId("target-of").textContent = `counts: ${robot.form.target}`;
}

const changed = (change) => {
    change();
    request();
};

const sliders = subject.joints.map((joint, i) =>
    slider(joint, travel(joint, view.size), (value) => changed(() => subject.setJoint(i, value))));
byId("joints").append(...sliders.map(({ row }) => row));
const showTarget = poseFields(byId("target"), true, (pose) => changed(() => {
    subject.setTarget(pose);
    subject.released();
}));
const showMeasures = measureRows(byId("measures"), subject.sampledMeasures());
const showBranches = branchList(byId("branches"), (i) => changed(() => subject.choose(i)));
const parameters = robot.form ? robot.form.parameters : [];
const endsOf = ({ joint }) => (joint === null ? [-Math.PI, Math.PI] : travel(robot.joints[joint], view.size));
const parameter = (() => {
    const [first] = parameters;
    if (!first) {
        return null;
    }
    byId("parameter-section").hidden = false;
    byId("parameter-name").textContent = parameters.map(({ name }) => name).join(", ");
    const solve = (value) => subject.solutionsAt([value, ...subject.parameters.slice(1)])
        .map(({ q, branch }) => ({ branch, within: robot.within_limits(q) !== null }));
    // Eliminations take longer than expressions.
    const samples = robot.form.search ? 45 : 180;
    const named = { ...first, label: parameters.length > 1 ? first.name : "value" };
    return new Parameter(byId("parameter"), named, endsOf(first), robot.form.most, samples, solve,
        (value) => changed(() => subject.setParameter(0, value)));
})();
// Where branches exist is shown by the first one.
const otherParameters = parameters.slice(1).map((own, i) => {
    const title = `${own.name}: given beside the target`;
    const made = slider({ ...own, title }, endsOf(own), (value) => changed(() => subject.setParameter(i + 1, value)));
    byId("parameter").append(made.row);
    return made;
});

const shown = () => Object.fromEntries(["branches", "axes", "frames", "names"]
    .map((name) => [name, byId(`show-${name}`).checked]));

const draw = () => {
    requested = false;
    scene.begin();
    scene.grid(view.size);
    subject.draw(scene, shown());
    if (subject.canMove) {
        gizmo.draw(scene, subject.target, subject.reached);
    }
    scene.finish();
    const { q } = subject;
    sliders.forEach(({ show }, i) => show(q[i], subject.inside(i)));
    showTarget(subject.target);
    const [text, kind] = subject.reach();
    byId("reach").textContent = text;
    byId("reach").className = kind;
    const branches = subject.branches();
    byId("branches-section").hidden = branches === null;
    if (branches) {
        const of = robot.form.search ? "found" : `of ${robot.form.branches}`;
        byId("branch-count").textContent = `${branches.length} ${of}, nearest marked`;
        showBranches(branches);
    }
    showMeasures(subject.measures());
    if (parameter) {
        parameter.show(subject.parameters[0], subject.isNewTarget, scene.colour);
        subject.isNewTarget = false;
        otherParameters.forEach(({ show }, i) => show(subject.parameters[i + 1]));
    }
};

let requested = false;
const request = () => {
    if (!requested) {
        requested = true;
        requestAnimationFrame(draw);
    }
};

const pointers = new Map();
const placeOf = (event) => {
    const { left, top } = canvas.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
};
canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    const place = placeOf(event);
    pointers.set(event.pointerId, place);
    const within = event.pointerType === "mouse" ? 11 : 24;
    const isFirst = pointers.size === 1 && subject.canMove;
    gizmo.held = isFirst ? gizmo.at(camera, subject.target, place, within) : null;
    canvas.classList.add("holding");
    request();
});
canvas.addEventListener("pointermove", (event) => {
    const before = pointers.get(event.pointerId);
    if (!before) {
        const over = subject.canMove && gizmo.at(camera, subject.target, placeOf(event), 11);
        canvas.style.cursor = over ? "pointer" : "";
        return;
    }
    const place = placeOf(event);
    const [dx, dy] = [place[0] - before[0], place[1] - before[1]];
    if (pointers.size === 2) {
        const [other] = [...pointers].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
        const apart = (p) => Math.max(10, Math.hypot(p[0] - other[0], p[1] - other[1]));
        camera.zoom(apart(before) / apart(place));
        camera.pan(dx / 2, dy / 2);
    } else if (gizmo.held) {
        subject.setTarget(gizmo.dragged(camera, subject.target, before, place));
    } else if (event.shiftKey || event.buttons === 4) {
        camera.pan(dx, dy);
    } else {
        camera.orbit(dx, dy);
    }
    pointers.set(event.pointerId, place);
    request();
});
const release = (event) => {
    pointers.delete(event.pointerId);
    if (gizmo.held) {
        gizmo.held = null;
        subject.released();
    }
    canvas.classList.remove("holding");
    request();
};
canvas.addEventListener("pointerup", release);
canvas.addEventListener("pointercancel", release);
canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    camera.zoom(Math.exp(0.0012 * event.deltaY));
    request();
}, { passive: false });
canvas.addEventListener("keydown", (event) => {
    const keys = {
        ArrowLeft: () => camera.orbit(-12, 0), ArrowRight: () => camera.orbit(12, 0),
        ArrowUp: () => camera.orbit(0, 12), ArrowDown: () => camera.orbit(0, -12),
        "+": () => camera.zoom(0.9), "=": () => camera.zoom(0.9), "-": () => camera.zoom(1.1),
    };
    if (keys[event.key]) {
        event.preventDefault();
        keys[event.key]();
        request();
    }
});
byId("home-view").addEventListener("click", () => changed(fit));
byId("shown").addEventListener("change", request);
window.addEventListener("resize", request);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", request);
// For the console, and for programs that look at the page.
window.kin = { robot, subject, camera, gizmo, request };
draw();
