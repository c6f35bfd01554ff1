// Drawing: lines of the canvas, the farthest first.

class Scene {
    constructor(canvas, camera) {
        this.canvas = canvas;
        this.camera = camera;
        this.context = canvas.getContext("2d");
        this.pieces = [];
    }

    /** Makes room, and reads the colours of the page. */
    begin() {
        const { canvas, context } = this;
        const ratio = window.devicePixelRatio || 1;
        const [width, height] = [canvas.clientWidth, canvas.clientHeight];
        if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
            canvas.width = Math.round(width * ratio);
            canvas.height = Math.round(height * ratio);
        }
        context.setTransform(ratio, 0, 0, ratio, 0, 0);
        context.clearRect(0, 0, width, height);
        context.lineCap = "round";
        context.lineJoin = "round";
        this.camera.look(width, height);
        this.pieces.length = 0;
        const style = getComputedStyle(document.documentElement);
        this.colour = (name) => style.getPropertyValue(`--${name}`).trim();
    }

    line(a, b, colour, width, { alpha = 1, dash = null, over = false } = {}) {
        const [from, to] = [this.camera.project(a), this.camera.project(b)];
        const depth = over ? -1 : (from[2] + to[2]) / 2;
        this.pieces.push({ depth, from, to, colour, width, alpha, dash });
    }

    point(at, colour, radius, { alpha = 1, over = false, stroke = null } = {}) {
        const place = this.camera.project(at);
        this.pieces.push({ depth: over ? -1 : place[2], place, colour, radius, alpha, stroke });
    }

    label(at, text, colour, dx = 8, dy = -8) {
        const place = this.camera.project(at);
        this.pieces.push({ depth: -2, place, colour, text, dx, dy, alpha: 1 });
    }

    /** Three axes of a pose, x, y and z in the usual colours. */
    frame(pose, length, width = 2, alpha = 1) {
        ["x", "y", "z"].forEach((name, j) => {
            const end = add(origin(pose), column(pose, j), length);
            this.line(origin(pose), end, this.colour(name), width, { alpha });
        });
    }

    /** The plane z = 0 around the base. */
    grid(size) {
        const step = 10 ** Math.floor(Math.log10(size));
        const cell = size / step > 5 ? step : size / step > 2 ? step / 2 : step / 5;
        const count = Math.ceil(1.05 * size / cell);
        const reach = count * cell;
        for (let i = -count; i <= count; ++i) {
            const axis = i === 0 ? 1.4 : 0.8;
            this.line([i * cell, -reach, 0], [i * cell, reach, 0], this.colour("grid"), axis);
            this.line([-reach, i * cell, 0], [reach, i * cell, 0], this.colour("grid"), axis);
        }
        // The grid lies below all that is drawn.
        this.pieces.forEach((piece) => (piece.depth = Infinity));
        const named = cell >= 1 ? `${cell} m` : `${Math.round(1000 * cell)} mm`;
        this.label([reach, reach, 0], `grid ${named}`, this.colour("muted"), -20, 14);
    }

    finish() {
        const { context } = this;
        this.pieces.sort((a, b) => b.depth - a.depth);
        for (const piece of this.pieces) {
            context.globalAlpha = piece.alpha;
            if (piece.text !== undefined) {
                context.font = "12px system-ui, sans-serif";
                context.fillStyle = piece.colour;
                // A place that is seen has its words in the picture, too.
                const { clientWidth } = context.canvas;
                const room = clientWidth - context.measureText(piece.text).width - 4;
                const isSeen = piece.place[0] <= clientWidth;
                const x = piece.place[0] + piece.dx;
                context.fillText(piece.text, isSeen ? Math.min(x, room) : x, piece.place[1] + piece.dy);
            } else if (piece.place) {
                context.beginPath();
                context.arc(piece.place[0], piece.place[1], piece.radius, 0, 2 * Math.PI);
                context.fillStyle = piece.colour;
                context.fill();
                if (piece.stroke) {
                    context.lineWidth = 2;
                    context.strokeStyle = piece.stroke;
                    context.stroke();
                }
            } else {
                context.beginPath();
                context.setLineDash(piece.dash ?? []);
                context.moveTo(piece.from[0], piece.from[1]);
                context.lineTo(piece.to[0], piece.to[1]);
                context.lineWidth = piece.width;
                context.strokeStyle = piece.colour;
                context.stroke();
                context.setLineDash([]);
            }
        }
        context.globalAlpha = 1;
    }
}

/** The corners of a chain, from its base to its tip. */
const chainPoints = ({ bones }, poses) =>
    [IDENTITY, ...poses].flatMap((pose, link) => bones[link].map((point) => transform(pose, point)));

/** A chain in a colour. */
const drawChain = (scene, chain, poses, style) => {
    const points = chainPoints(chain, poses);
    for (let i = 1; i < points.length; ++i) {
        scene.line(points[i - 1], points[i], style.colour, style.width, style);
    }
};

/** The axes of a chain's joints, and marks where they are. */
const drawAxes = (scene, { axes }, poses, size, names) => {
    axes.forEach(({ at, direction, turns }, i) => {
        const [middle, along] = [transform(poses[i], at), rotate(poses[i], direction)];
        const [from, to] = [add(middle, along, -0.13 * size), add(middle, along, 0.13 * size)];
        scene.line(from, to, scene.colour("muted"), 1.2, { dash: [7, 3, 1.5, 3] });
        const half = 0.028 * size;
        const ends = [add(middle, along, -half), add(middle, along, half)];
        scene.line(...ends, scene.colour("paper"), turns ? 15 : 11);
        scene.line(...ends, scene.colour("accent"), turns ? 11 : 7);
        if (names) {
            scene.label(to, names[i], scene.colour("ink"));
        }
    });
};
