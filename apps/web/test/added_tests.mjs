// Lamps that a visitor puts up, in Chromium: a part of page_test.mjs.

import assert from "node:assert/strict";
import { writeFile } from "node:fs/promises";
import { join } from "node:path";

import { drawn, show, test } from "./browser.mjs";

const LIKENESS = 28; // dB at least
const LAMP = { position: [3.2, 0.9, -0.6], lumens: 6400, kelvin: 4000 };

/** ms from a press of an arrow key on a lamp's ring until the GPU has drawn what that changed. */
function timeOfMove(page) {
    return page.evaluate(async () => {
        const canvas = document.getElementById("canvas");
        const gl = canvas.getContext("webgl2");
        const isDone = () =>
            gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
        const after = async (change) => {
            isDone();
            const before = canvas.dataset.drawn;
            const start = performance.now();
            change();
            while (canvas.dataset.drawn === before) await new Promise(requestAnimationFrame);
            isDone();
            return performance.now() - start;
        };
        const press = (key) => () =>
            document
                .querySelector(".ring")
                .dispatchEvent(
                    new KeyboardEvent("keydown", { key, bubbles: true, cancelable: true }),
                );
        await after(press("ArrowLeft"));
        const moved = await after(press("ArrowRight"));
        const plain = await after(() =>
            canvas.dispatchEvent(new WheelEvent("wheel", { deltaY: 0, cancelable: true })),
        );
        return { moved, plain };
    });
}

/** `shared` has the tab, the room, the folder, and compare() and programs of page_test.mjs. */
export function testAddedLamps(shared) {
    test("a new lamp lights the room as the program has it, with shadows and bounces", async (t) => {
        const { room, folder, compare } = shared();
        const off = room.lights.map((_, i) => `light${i}=0`).join("&");
        const file = join(folder, "new.json");
        const light = { ...LAMP, type: "sphere", radius: 0.06 };
        await writeFile(file, JSON.stringify({ lights: [light] }));
        const word = `lamp0=${LAMP.position.join(",")},${LAMP.lumens},${LAMP.kelvin}K`;
        await compare(
            t,
            "new",
            `${off}&${word}`,
            ["--lights", file, `--exposure=${room.exposure}`],
            LIKENESS,
        );
        const { moved, plain } = await timeOfMove(shared().tab.page);
        t.diagnostic(
            `a lamp that moves: ${moved.toFixed(0)} ms a picture, else ${plain.toFixed(0)} ms`,
        );
    });

    test("a lamp is dragged from the panel into the picture, moved, dimmed and removed", async () => {
        const {
            tab: { page },
            room,
        } = shared();
        await page.setViewportSize({ width: 800, height: 300 });
        await show(page, room.lights.map((_, i) => `light${i}=0`).join("&"));
        const changed = (from) => page.waitForFunction((hash) => location.hash !== hash, from);
        const hash = () => page.evaluate(() => location.hash);
        const button = page.getByRole("button", { name: "Put up a lamp" });
        await button.scrollIntoViewIfNeeded();
        const box = await button.boundingBox();
        await page.mouse.move(box.x + 10, box.y + 10);
        await page.mouse.down();
        await page.mouse.move(300, 200, { steps: 2 });
        await page.mouse.up();
        await page.waitForFunction(() => location.hash.includes("lamp0="));
        const ring = page.getByRole("button", { name: /^new lamp 1:/ });
        let last = await hash();
        await ring.press("PageUp");
        await changed(last);
        last = await hash();
        const at = await ring.boundingBox();
        await page.mouse.move(at.x + 18, at.y + 18);
        await page.mouse.down();
        await page.mouse.move(at.x - 60, at.y + 40, { steps: 2 });
        await page.mouse.up();
        await changed(last);
        assert.ok(!(await hash()).includes("off"));
        await ring.click();
        await page.waitForFunction(() => location.hash.includes(",off"));
        await page.getByLabel("brightness of new lamp 1").fill("3");
        await page.waitForFunction(
            () => location.hash.includes(",200,2700K") && !location.hash.includes("off"),
        );
        await button.click(); // another, where one looks
        await page.waitForFunction(() => location.hash.includes("lamp1="));
        await page.getByRole("button", { name: "remove new lamp 2" }).click();
        await page.getByRole("button", { name: "remove new lamp 1" }).click();
        await page.waitForFunction(() => !location.hash.includes("lamp"));
        await page.setViewportSize({ width: 640, height: 360 });
        await drawn(page);
    });
}
