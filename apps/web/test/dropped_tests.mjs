// Models that are dropped onto the page, in Chromium: a part of page_test.mjs.

import assert from "node:assert/strict";

import { drawn, show, test } from "./browser.mjs";
import { ballGlb, drop } from "./glb.mjs";

const STAND = "panel=off&at=2.2,1.5,-3.6,3.14,-0.3";
const ON_FLOOR = [320, 240]; // pixels of the picture from there
const BALL = [320, 212]; // where a ball of 0.25 m is seen that stands there

/** Mean RGB, 0..255, of 8 x 8 pixels of a PNG. */
function colourAt(page, png, [x, y]) {
    return page.evaluate(
        async ({ base64, x, y }) => {
            const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
            const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
            const canvas = document.createElement("canvas");
            [canvas.width, canvas.height] = [bitmap.width, bitmap.height];
            const context = canvas.getContext("2d");
            context.drawImage(bitmap, 0, 0);
            const { data } = context.getImageData(x - 4, y - 4, 8, 8);
            return [0, 1, 2].map((c) => {
                let sum = 0;
                for (let i = c; i < data.length; i += 4) sum += data[i];
                return sum / 64;
            });
        },
        { base64: png.toString("base64"), x, y },
    );
}

/** `shared` has the tab and the room of page_test.mjs. */
export function testDroppedModels(shared) {
    test("a model that is dropped stands in the light of the lamps, old and new", async (t) => {
        const {
            tab: { page },
            room,
        } = shared();
        const under = async (...words) => {
            const off = room.lights.map((_, i) =>
                words.includes(`light${i}=1`) ? "" : `light${i}=0`,
            );
            await show(page, [STAND, ...off, ...words].filter(Boolean).join("&"));
            return colourAt(page, await page.screenshot(), BALL);
        };
        const light = (kind) => `light${room.lights.findIndex((one) => one.kind === kind)}=1`;
        const floor = await under(light("lamp"));
        await drop(page, "ball.glb", ballGlb(0.25, [0.8, 0.8, 0.8]), ...ON_FLOOR);
        await page.getByText("ball", { exact: true }).waitFor({ state: "attached" });
        await drawn(page);
        const [lamp, window, dark, added] = [
            await under(light("lamp")),
            await under(light("window")),
            await under(),
            await under("lamp0=3.2,0.9,-0.6,6400,6500K"),
        ];
        t.diagnostic(
            `a white ball: ${[lamp, window, dark, added].map((c) => c.map(Math.round)).join(" | ")}`,
        );
        assert.ok(lamp[1] > floor[1] + 20, "brighter than the floor behind it");
        assert.ok(lamp[0] > lamp[2] + 10, "warm under a lamp");
        assert.ok(window[2] > window[0], "blue at a window");
        assert.ok(Math.max(...dark) < 4, "black without light");
        assert.ok(added[1] > 40, "lit by a lamp that was put up");
        const sliders = (turn) =>
            page.evaluate((turn) => {
                const [turned, x] = ["turn ball", "move along x ball"].map((label) =>
                    document.querySelector(`[aria-label="${label}"]`),
                );
                if (turn !== undefined) turned.valueAsNumber = turn;
                turned.dispatchEvent(new Event("input"));
                return [turned.valueAsNumber, x.valueAsNumber];
            }, turn);
        const [, x] = await sliders(90);
        await page.mouse.move(...BALL);
        await page.mouse.down();
        await page.mouse.move(420, 250, { steps: 2 });
        await page.mouse.up();
        await drawn(page);
        const [turned, moved] = await sliders();
        assert.equal(turned, 90, "the panel knows how it is turned");
        assert.ok(Math.abs(moved - x) > 0.1, "and where it stands");
        const gone = await colourAt(page, await page.screenshot(), BALL);
        assert.ok(Math.abs(gone[1] - added[1]) > 10, "a drag moves it");
        assert.ok(
            (await page.evaluate(() => location.hash)).includes("at=2.2,1.5"),
            "and not the visitor",
        );
        await page.evaluate(() => document.querySelector("#models li button").click());
    });

    test("a model that cannot be shown is told of in a sentence", async () => {
        const { page } = shared().tab;
        await show(page, STAND);
        const sentence = async (name, bytes) => {
            await page.evaluate(() => (document.getElementById("trouble").hidden = true));
            await drop(page, name, bytes, ...ON_FLOOR);
            await page.locator("#trouble").waitFor();
            return page.locator("#trouble").innerText();
        };
        assert.match(
            await sentence("broken.glb", Buffer.from("glTF")),
            /broken\.glb cannot be shown: .*no whole GLB/,
        );
        const whole = ballGlb(0.2, [1, 1, 1]);
        assert.match(
            await sentence("cut.glb", whole.subarray(0, whole.length / 2)),
            /cut\.glb cannot be shown/,
        );
        const other = {
            asset: { version: "2.0" },
            buffers: [{ byteLength: 12, uri: "http://localhost/a.bin" }],
            bufferViews: [{ buffer: 0, byteLength: 12 }],
            scene: 0,
            scenes: [{ nodes: [0] }],
            nodes: [{ mesh: 0 }],
            accessors: [
                {
                    bufferView: 0,
                    componentType: 5126,
                    count: 1,
                    type: "VEC3",
                    min: [0, 0, 0],
                    max: [0, 0, 0],
                },
            ],
            meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],
        };
        assert.match(
            await sentence("other.gltf", Buffer.from(JSON.stringify(other))),
            /names other files/,
        );
        const none = { asset: { version: "2.0" }, scene: 0, scenes: [{ nodes: [] }] };
        for (const empty of [none, { ...none, scenes: [] }])
            assert.match(
                await sentence("none.gltf", Buffer.from(JSON.stringify(empty))),
                /no triangles/,
            );
        assert.equal(await page.locator("#models li").count(), 0);
        await page.evaluate(() => (document.getElementById("trouble").hidden = true));
    });
}
