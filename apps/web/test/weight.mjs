// What a page weighs: bytes, calls to the GPU, time of a frame.

import assert from "node:assert/strict";
import { readFile, readdir } from "node:fs/promises";
import { join } from "node:path";
import { gzipSync } from "node:zlib";

import { drawn, open, serve, settled, test } from "./browser.mjs";

const MOST_BYTES = 8e6; // of the sample's page
const MOST_FIRST = 1e6; // sent until the room is first seen
const MOST_PREVIEW = 0.2e6; // sent until its preview is
const FRAMES = 5;

/** Bytes of files, as they are and as most servers send them. */
async function weightOf(folder, files) {
    let bytes = 0;
    let sent = 0;
    for (const file of files) {
        const content = await readFile(join(folder, file));
        bytes += content.length;
        sent += file.endsWith(".jpg") ? content.length : gzipSync(content).length;
    }
    return {
        bytes,
        sent,
        words: `${(1e-6 * bytes).toFixed(2)} MB, ${(1e-6 * sent).toFixed(2)} sent`,
    };
}

/** Files of a page in the order in which they came; it is shown by a server. */
async function filesOf(page) {
    const entries = await page.evaluate(() =>
        [...performance.getEntriesByType("navigation"), ...performance.getEntriesByType("resource")]
            .sort((a, b) => a.responseEnd - b.responseEnd)
            .map(({ name }) => name),
    );
    const files = entries.filter((name) => !name.startsWith("data:"));
    return files.map((name) => new URL(name).pathname.slice(1) || "index.html");
}

/** `shared` gives the page's folder, what room.json says, a browser, and a tab that shows the page. */
export function testWeight(shared) {
    test("all of its files are less than the bound", async (t) => {
        const { page } = shared();
        const { bytes, words } = await weightOf(page, await readdir(page));
        t.diagnostic(words);
        assert.ok(bytes < MOST_BYTES, `${bytes} bytes`);
    });

    test("little is loaded before the preview and before the room are seen", async (t) => {
        const { page, browser, room } = shared();
        const server = await serve(page);
        const tab = await open(browser);
        try {
            await tab.page.goto(server.url);
            await settled(tab.page);
            const files = await filesOf(tab.page);
            const light = files.indexOf(`${room.lights[0].maps[0].file}.js`);
            assert.ok(light > 0 && light < files.length - 3, files.join(" "));
            const preview = await weightOf(page, ["index.html", "viewer.css", "preview.jpg"]);
            const first = await weightOf(page, files.slice(0, light + 1));
            const all = await weightOf(page, files);
            t.diagnostic(`preview ${preview.words}; first light ${first.words}; all ${all.words}`);
            assert.ok(
                preview.sent < MOST_PREVIEW && first.sent < MOST_FIRST && first.sent < all.sent,
            );
        } finally {
            await tab.close();
            server.close();
        }
    });

    test("a frame is a call to the GPU for each side of a surface, and one for the sky", async (t) => {
        const { tab, room } = shared();
        const canvas = tab.page.locator("#canvas");
        assert.equal(await canvas.getAttribute("data-calls"), String(2 * room.meshes.length + 1));
        await drawn(tab.page);
        const milliseconds = await tab.page.evaluate(async (frames) => {
            const start = performance.now();
            for (let i = 0; i < frames; ++i) {
                location.hash = `panel=off&stops=${i / 100}`;
                await new Promise(requestAnimationFrame);
            }
            return (performance.now() - start) / frames;
        }, FRAMES);
        t.diagnostic(`${milliseconds.toFixed(1)} ms a frame, drawn by software`);
    });
}
