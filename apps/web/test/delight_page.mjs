// relamp delight --page: the page of a result that was never read again, and what is refused before any work.

import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { mkdir, readFile, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

import { assertLike, open, place, relamp, settled, test } from "./browser.mjs";

const LIKENESS = 30; // dB at least

/** What the program says of what it does not do. */
async function refusal(...words) {
    const ran = relamp(...words);
    return assert.rejects(ran).then(() => ran.catch(({ code, stderr }) => ({ code, stderr })));
}

/** A triangle whose light is in its vertices. */
const WITHOUT_TEXTURE = `ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
property uchar red
property uchar green
property uchar blue
element face 1
property list uchar int vertex_indices
end_header
0 0 0 200 190 180
1 0 0 200 190 180
0 1 0 255 255 255
3 0 1 2
`;

/** `shared` gives the folder in which `out` was written with --page, the room of its page, a browser, and in
 * `all.png` what the program makes of all lights. */
export function testDelightPage(shared) {
    test("delight --page shows the room as relamp page does", async (t) => {
        const { folder, browser, room } = shared();
        const page = join(folder, "out/page");
        const own = JSON.parse(await readFile(join(page, "room.json"), "utf8"));
        const ofLights = ({ lights }) =>
            lights.map(({ name, kind, fixture }) => [name, kind, fixture]);
        assert.deepEqual(ofLights(own), ofLights(room));
        const tab = await open(browser);
        try {
            const stops = `stops=${room.exposure - own.exposure}`;
            await tab.page.goto(`${pathToFileURL(join(page, "index.html"))}#panel=off&${stops}`);
            await settled(tab.page);
            const wanted = await readFile(join(folder, "all.png")); // of all lights, made for relamp page
            const found = await tab.page.screenshot();
            await assertLike(t, tab.page, "delight --page", [found, wanted], LIKENESS);
            assert.deepEqual(tab.complaints, []);
        } finally {
            await tab.close();
        }
    });

    test("delight --page refuses a folder of another before any work", async () => {
        const { folder } = shared();
        const out = join(folder, "taken");
        await mkdir(join(out, "page"), { recursive: true });
        await writeFile(join(out, "page/index.html"), "mine");
        const scan = join(place.samples, "bedroom/scan.glb");
        const { code, stderr } = await refusal("delight", scan, "-o", out, "--page");
        assert.equal(code, 1);
        assert.match(stderr, /index\.html.*--force/s);
        assert.equal(await readFile(join(out, "page/index.html"), "utf8"), "mine");
        assert.ok(!existsSync(join(out, "report.json")));
    });

    test("delight --page refuses a scan without a texture before any work", async () => {
        const { folder } = shared();
        const scan = join(folder, "vertices.ply");
        await writeFile(scan, WITHOUT_TEXTURE);
        const { code, stderr } = await refusal(
            "delight",
            scan,
            "-o",
            join(folder, "none"),
            "--page",
        );
        assert.equal(code, 1);
        assert.match(stderr, /colours of vertices/);
        assert.ok(!existsSync(join(folder, "none")));
    });
}
