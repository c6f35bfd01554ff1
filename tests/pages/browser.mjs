// Headless Chromium by its debugging protocol over a pipe: no packages.

import { spawn } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

const FLAGS = [
    "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--hide-scrollbars",
    "--disable-background-networking", "--disable-component-update", "--disable-sync", "--remote-debugging-pipe",
];

export class Browser {
    /** `CHROMIUM` is the program, by default `chromium`. */
    constructor() {
        this.folder = mkdtempSync(join(tmpdir(), "kin-pages-"));
        const flags = [...FLAGS, `--user-data-dir=${this.folder}`, "about:blank"];
        const stdio = ["ignore", "ignore", "ignore", "pipe", "pipe"];
        this.process = spawn(process.env.CHROMIUM ?? "chromium", flags, { stdio });
        this.next = 1;
        this.waiting = new Map();
        this.errors = [];
        let rest = "";
        this.process.stdio[4].on("data", (data) => {
            const messages = (rest + data).split("\0");
            rest = messages.pop();
            messages.forEach((message) => this.received(JSON.parse(message)));
        });
    }

    received({ id, result, error, method, params }) {
        if (method === "Runtime.exceptionThrown") {
            const { exception, text } = params.exceptionDetails;
            this.errors.push(exception?.description ?? text);
        }
        const waiting = this.waiting.get(id);
        if (waiting) {
            this.waiting.delete(id);
            error ? waiting.reject(new Error(error.message)) : waiting.resolve(result);
        }
    }

    send(method, params = {}) {
        const id = this.next++;
        this.process.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId: this.session })}\0`);
        return new Promise((resolve, reject) => this.waiting.set(id, { resolve, reject }));
    }

    /** Opens a page on a screen of so many pixels. */
    async open(url, width, height, { touch = false, dark = false } = {}) {
        this.session = undefined;
        const { targetId } = await this.send("Target.createTarget", { url: "about:blank" });
        this.session = (await this.send("Target.attachToTarget", { targetId, flatten: true })).sessionId;
        await this.send("Runtime.enable");
        await this.send("Page.enable");
        await this.send("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile: touch });
        const features = [{ name: "prefers-color-scheme", value: dark ? "dark" : "light" }];
        await this.send("Emulation.setEmulatedMedia", { features });
        await this.send("Page.navigate", { url });
        for (let tries = 0; tries < 100; ++tries) {
            if (await this.evaluate("window.kin !== undefined && document.readyState === 'complete'")) {
                await this.frame();
                return;
            }
            await new Promise((resolve) => setTimeout(resolve, 50));
        }
        throw new Error(`${url}: no page came up: ${this.errors.join("; ")}`);
    }

    /** The value of an expression in the page. */
    async evaluate(expression) {
        const asked = { expression, returnByValue: true, awaitPromise: true };
        const { result, exceptionDetails } = await this.send("Runtime.evaluate", asked);
        if (exceptionDetails) {
            throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
        }
        return result.value;
    }

    /** Until what has changed is drawn. */
    frame() {
        return this.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(1))))");
    }

    /** Drags with the left button, in steps. */
    async drag(from, to, steps = 12) {
        const event = (type, [x, y]) => this.send("Input.dispatchMouseEvent", {
            type, x, y, button: "left", buttons: type === "mouseReleased" ? 0 : 1, clickCount: 1,
        });
        await event("mousePressed", from);
        for (let step = 1; step <= steps; ++step) {
            await event("mouseMoved", [0, 1].map((i) => from[i] + ((to[i] - from[i]) * step) / steps));
        }
        await event("mouseReleased", to);
        await this.frame();
    }

    async screenshot(file) {
        const { data } = await this.send("Page.captureScreenshot", { format: "png" });
        writeFileSync(file, Buffer.from(data, "base64"));
    }

    close() {
        return new Promise((closed) => {
            this.process.on("exit", () => {
                rmSync(this.folder, { recursive: true, force: true, maxRetries: 9, retryDelay: 100 });
                closed();
            });
            this.process.kill();
        });
    }
}
