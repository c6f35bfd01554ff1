// The target: arrows along the base's axes, rings about its own, and a dot in the plane of the
// screen.

class Gizmo {
    /** `turns`: whether rings have a meaning. */
    constructor(turns) {
        this.turns = turns;
        this.held = null;
    }

    /** Metres, so that it has the same size on every screen. */
    radius(camera, target) {
        const pixels = Math.max(56, Math.min(92, 0.13 * Math.min(camera.width, camera.height)));
        return pixels / camera.scaleAt(origin(target));
    }

    ring(target, axis, radius) {
        const [u, v] = [column(target, (axis + 1) % 3), column(target, (axis + 2) % 3)];
        return Array.from({ length: 49 }, (_, k) => {
            const angle = (2 * Math.PI * k) / 48;
            return add(add(origin(target), u, radius * Math.cos(angle)), v, radius * Math.sin(angle));
        });
    }

    arrow(target, axis, radius) {
        const along = [0, 0, 0];
        along[axis] = 1;
        return [add(origin(target), along, 0.25 * radius), add(origin(target), along, 1.45 * radius)];
    }

    draw(scene, target, reached) {
        const radius = this.radius(scene.camera, target);
        ["x", "y", "z"].forEach((name, axis) => {
            const colour = scene.colour(name);
            const [from, to] = this.arrow(target, axis, radius);
            const isHeld = (kind) => this.held?.kind === kind && this.held.axis === axis;
            scene.line(from, to, colour, isHeld("arrow") ? 5 : 3, { over: true });
            scene.point(to, colour, isHeld("arrow") ? 7 : 5, { over: true });
            if (this.turns) {
                const ring = this.ring(target, axis, radius);
                for (let k = 1; k < ring.length; ++k) {
                    const way = add(ring[k], origin(target), -1);
                    const behind = dot(way, scene.camera.towards) < -0.05 * radius;
                    const alpha = behind ? 0.2 : 0.75;
                    scene.line(ring[k - 1], ring[k], colour, isHeld("ring") ? 3.5 : 1.8, { over: true, alpha });
                }
            }
        });
        const colour = scene.colour(reached ? "good" : "warn");
        scene.point(origin(target), scene.colour("paper"), 7, { over: true, stroke: colour });
    }

    /** What is next to a place of the screen, not farther than so many pixels. */
    at(camera, target, place, within) {
        const radius = this.radius(camera, target);
        const far = (a, b) => distanceToSegment(place, camera.project(a), camera.project(b));
        const middle = camera.project(origin(target));
        if (Math.hypot(place[0] - middle[0], place[1] - middle[1]) < Math.max(10, 0.6 * within)) {
            return { kind: "dot", axis: -1 };
        }
        let found = null;
        let least = within;
        const offer = (distance, kind, axis) => {
            if (distance < least) {
                [least, found] = [distance, { kind, axis }];
            }
        };
        for (let axis = 0; axis < 3; ++axis) {
            offer(far(...this.arrow(target, axis, radius)), "arrow", axis);
            if (this.turns) {
                const ring = this.ring(target, axis, radius);
                for (let k = 1; k < ring.length; ++k) {
                    const way = add(ring[k], origin(target), -1);
                    if (dot(way, camera.towards) > -0.05 * radius) {
                        offer(far(ring[k - 1], ring[k]) + 2, "ring", axis);
                    }
                }
            }
        }
        return found;
    }

    /** The target after the pointer has gone from one place to another while holding a part. */
    dragged(camera, target, from, to) {
        const { kind, axis } = this.held;
        const by = [to[0] - from[0], to[1] - from[1]];
        const middle = camera.project(origin(target));
        const moved = (way) => {
            const pose = Array.from(target);
            [0, 1, 2].forEach((i) => (pose[4 * i + 3] += way[i]));
            return pose;
        };
        if (kind === "dot") {
            const metre = 1 / camera.scaleAt(origin(target));
            return moved(add(camera.right.map((x) => x * by[0] * metre), camera.up, -by[1] * metre));
        }
        if (kind === "arrow") {
            const radius = this.radius(camera, target);
            const way = [0, 0, 0];
            way[axis] = radius;
            const end = camera.project(add(origin(target), way));
            const seen = [end[0] - middle[0], end[1] - middle[1]];
            // An arrow that points at the eye goes no farther than its length.
            const square = Math.max(seen[0] ** 2 + seen[1] ** 2, 400);
            return moved(way.map((x) => (x * (seen[0] * by[0] + seen[1] * by[1])) / square));
        }
        const about = column(target, axis);
        const facing = dot(about, camera.towards);
        let angle;
        if (Math.abs(facing) > 0.35) {
            const angleOf = (p) => Math.atan2(-(p[1] - middle[1]), p[0] - middle[0]);
            const turned = angleOf(to) - angleOf(from);
            angle = Math.sign(facing) * Math.atan2(Math.sin(turned), Math.cos(turned));
        } else {
            // Seen from the side, along the near half.
            const along = cross(about, camera.towards);
            const seen = [dot(along, camera.right), -dot(along, camera.up)];
            const pixels = this.radius(camera, target) * camera.scaleAt(origin(target));
            angle = (seen[0] * by[0] + seen[1] * by[1]) / pixels;
        }
        const turned = product(turn(about, angle), [...target.slice(0, 3), 0, ...target.slice(4, 7), 0, ...target.slice(8, 11), 0]);
        [3, 7, 11].forEach((i) => (turned[i] = target[i]));
        return orthonormal(turned);
    }
}

const distanceToSegment = (p, a, b) => {
    const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    const square = dx * dx + dy * dy;
    const t = square > 0 ? Math.max(0, Math.min(1, ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / square)) : 0;
    return Math.hypot(p[0] - a[0] - t * dx, p[1] - a[1] - t * dy);
};
