// The three.js example of docs/guide/lightmaps.md, as its reader sets it up.

import assert from "node:assert/strict";
import { cp, readFile, symlink } from "node:fs/promises";
import { join } from "node:path";

import { assertLike, open, place, relamp, serve, test } from "./browser.mjs";

const LIKENESS = 30; // dB at least
const ASPECT = 16 / 9;

/** What the example calls a room's camera. */
function viewOf({ position, forward, fieldOfView }) {
    const vertical = 2 * Math.atan(Math.tan(fieldOfView / 2) / ASPECT);
    return [position, position.map((value, i) => value + forward[i]), (180 / Math.PI) * vertical];
}

/** `shared` gives the folder in which the sample's result is `out`, a browser, and the program's pictures. */
export function testExample(shared) {
    test("the example of lightmaps sums them as the program does", async (t) => {
        const { folder, browser, room, programs } = shared();
        const site = join(folder, "example");
        const lightmaps = join(site, "lightmaps");
        const bake = ["--bake", "--per-lamp", "png", "-o", lightmaps];
        const words = ["--fixture", "0=on", "--fixture", "2=50%", `--exposure=${room.exposure}`];
        const [wanted] = await Promise.all([
            programs("mixed", ...words),
            relamp("relight", join(folder, "out"), ...bake),
        ]);
        await cp(new URL("../example/lightmaps.html", import.meta.url), join(site, "index.html"));
        await cp(join(folder, "out/scan.glb"), join(site, "room.glb"));
        await symlink(join(place.libraries, "node_modules/three"), join(site, "three"));
        const { lights } = JSON.parse(await readFile(join(lightmaps, "lightmaps.json"), "utf8"));
        const share = ({ fixture }) => ({ 0: 1, 2: 0.5 })[fixture] ?? 0;
        const server = await serve(site);
        const tab = await open(browser);
        try {
            await tab.page.goto(server.url);
            await tab.page.waitForFunction(() => window.mix);
            await tab.page.evaluate(
                ([view, stops, shares]) => {
                    window.look(...view, stops);
                    window.mix(shares);
                },
                [viewOf(room.camera), room.exposure, lights.map(share)],
            );
            const found = await tab.page.screenshot();
            await assertLike(t, tab.page, "mixed", [found, wanted], LIKENESS);
            assert.deepEqual(tab.complaints, []);
        } finally {
            await tab.close();
            server.close();
        }
    });
}
