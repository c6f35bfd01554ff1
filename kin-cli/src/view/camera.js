// What is seen, and from where.

class Camera {
    constructor(size) {
        this.size = size;
    }

    /** Looks at some points. */
    frame(points) {
        const ends = [Math.min, Math.max].map((end) => [0, 1, 2].map((i) => end(...points.map((p) => p[i]))));
        this.centre = add(ends[0], ends[1]).map((x) => x / 2);
        const radius = Math.max(...points.map((point) => Math.hypot(...add(point, this.centre, -1))));
        this.distance = 3.8 * Math.max(radius, 0.3 * this.size);
        this.azimuth = -0.9;
        this.elevation = 0.42;
    }

    /** Prepares for a canvas of so many CSS pixels. */
    look(width, height) {
        const [sa, ca] = [Math.sin(this.azimuth), Math.cos(this.azimuth)];
        const [se, ce] = [Math.sin(this.elevation), Math.cos(this.elevation)];
        this.right = [-sa, ca, 0];
        this.towards = [ce * ca, ce * sa, se];
        this.up = [-se * ca, -se * sa, ce];
        this.width = width;
        this.height = height;
        this.focal = 1.5 * Math.min(width, height);
    }

    /** Where a point is on the canvas, and how far from the eye. */
    project(point) {
        const d = add(point, this.centre, -1);
        const depth = Math.max(this.distance - dot(d, this.towards), 0.02 * this.distance);
        const scale = this.focal / depth;
        return [
            this.width / 2 + scale * dot(d, this.right),
            this.height / 2 - scale * dot(d, this.up),
            depth,
        ];
    }

    /** Pixels of a metre at a point. */
    scaleAt(point) {
        return this.focal / this.project(point)[2];
    }

    orbit(dx, dy) {
        this.azimuth -= 0.008 * dx;
        this.elevation = Math.max(-1.5, Math.min(1.5, this.elevation + 0.008 * dy));
    }

    pan(dx, dy) {
        const metre = this.distance / this.focal;
        this.centre = add(add(this.centre, this.right, -dx * metre), this.up, dy * metre);
    }

    zoom(factor) {
        this.distance = Math.max(0.3 * this.size, Math.min(20 * this.size, this.distance * factor));
    }
}
