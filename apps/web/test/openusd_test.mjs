// OpenUSD's own library reads a scene of `delight --usd`. Debian has none, nor has its Blender; npm
// has one that runs in a browser, in three-usdz-loader.

import assert from "node:assert/strict";
import { cp, mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before } from "node:test";

import { launch, open, place, relamp, serve, test } from "./browser.mjs";

// What this build of the library lacks: volumes, plugins of shaders, and lights in what it draws with.
const OF_THE_BUILD = /schema type 'UsdVol|' pluginFactory '|doesn't support prim type '\w*Light/;

let folder;
let browser;
let server;
let tab;
let scene;
let lamps; // the scene, composed

before(
    async () => {
        folder = await mkdtemp(join(tmpdir(), "relamp-usd-"));
        const launched = launch(["--enable-features=SharedArrayBuffer"]);
        const room = join(place.samples, "bedroom/scan.glb");
        await relamp("delight", room, "-o", join(folder, "out"), "--usd", "--quality", "draft");
        scene = await readFile(join(folder, "out/scan.usda"), "utf8");
        await cp(join(place.libraries, "node_modules/three-usdz-loader/external"), folder, {
            recursive: true,
        });
        const page = '<link rel="icon" href="data:,"><script src="emHdBindings.js"></script>';
        await writeFile(join(folder, "index.html"), `<!doctype html>${page}`);
        server = await serve(folder);
        browser = await launched;
        tab = await open(browser);
        await tab.page.goto(server.url);
        lamps = await composed(scene);
    },
    { timeout: 120000 },
);

after(async () => {
    await browser?.close();
    server?.close();
    await rm(folder, { recursive: true, force: true });
});

/**
 * The stage that the library composes of a scene, as text, and what it draws: for each prim the
 * calls of its renderer with what it gives them, arrays by their length.
 */
async function composed(text) {
    tab.complaints.length = 0;
    const found = await tab.page.evaluate(async (usda) => {
        window.library ??= await window.getUsdModule(undefined, "");
        await window.library.ready;
        const file = `${crypto.randomUUID()}.usda`;
        window.library.FS.createDataFile("/", file, new TextEncoder().encode(usda), true, true);
        const drawn = {};
        const short = (given) => (ArrayBuffer.isView(given) ? given.length : given);
        const create = (_, id) => {
            drawn[id] = {};
            return new Proxy(
                {},
                {
                    get:
                        (_, call) =>
                        (...given) =>
                            (drawn[id][call] ??= []).push(given.map(short)),
                },
            );
        };
        const renderer = { createRPrim: create, createBPrim: create, createSPrim: create };
        renderer.CommitResources = () => undefined;
        const driver = new window.library.HdWebSyncDriver(renderer, file);
        window.driver = driver; // the library looks for it there
        driver.Draw();
        return { stage: driver.GetStage().ExportToString(), drawn };
    }, text);
    return { ...found, complaints: tab.complaints.filter((words) => !OF_THE_BUILD.test(words)) };
}

const namesOf = (stage, type) =>
    [...stage.matchAll(new RegExp(`def ${type} "(\\w+)"`, "g"))].map(([, name]) => name);

test("a scene is read without complaint, its mesh and its material arrive", async () => {
    const { stage, drawn, complaints } = lamps;
    assert.deepEqual(complaints, []);
    const corners = scene.match(/faceVertexIndices = \[([^\]]*)/)[1].split(",").length;
    const mesh = drawn["/Room/Geometry/scan"];
    assert.deepEqual(mesh.updateIndices, [[corners]]);
    assert.deepEqual(mesh.setMaterial, [["/Room/Materials/page_0"]]);
    const nodes = drawn["/Room/Materials/page_0"].updateNode;
    const [, , albedo] = nodes.find(([, path]) => path.endsWith("/albedo"));
    assert.equal(albedo.file, "./albedo.png");
    assert.deepEqual(namesOf(stage, "Mesh"), ["scan"]);
});

test("its lamps are lights, or surfaces that shine, as the variant says", async () => {
    const shining = await composed(
        scene.replace('string light = "lamps"', 'string light = "emissive"'),
    );
    assert.deepEqual(shining.complaints, []);
    const lights = "(?:Rect|Disk|Sphere)Light";
    const { fixtures } = JSON.parse(await readFile(join(folder, "out/lights.json"), "utf8"));
    const named = fixtures.map(({ name }) => name.replaceAll(" ", "_"));
    for (const name of named) {
        assert.ok(namesOf(lamps.stage, lights).includes(name), name);
        assert.ok(!namesOf(shining.stage, lights).includes(name), name);
    }
    const emission = /inputs:emissiveColor.connect = <\/Room\/Materials\/page_0\/emission/;
    assert.match(shining.stage, emission);
    assert.doesNotMatch(lamps.stage, emission);
});

test("what is no scene is told, and where", async () => {
    await assert.rejects(composed(scene.replace("def Scope", "def Scope Scope")));
    assert.match(tab.complaints.join(), /syntax error .*Scope/);
});
