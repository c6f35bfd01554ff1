// Screenshots of pages: node look.mjs folder page.html ..., by a desk and on a phone, in both
// schemes.

import { basename, resolve } from "node:path";
import { Browser } from "./browser.mjs";

const [folder, ...pages] = process.argv.slice(2);
const browser = new Browser();
for (const page of pages) {
    const url = `file://${resolve(page)}`;
    const name = `${folder}/${basename(page, ".html")}`;
    await browser.open(url, 1280, 800);
    await browser.screenshot(`${name}-desk.png`);
    await browser.open(url, 390, 844, { touch: true, dark: true });
    await browser.screenshot(`${name}-phone.png`);
}
browser.errors.forEach((error) => console.error(error));
await browser.close();
