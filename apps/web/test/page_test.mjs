// The page of the sample in Chromium: against the program's own pictures, and as a person uses it.

import assert from "node:assert/strict";
import { cp, mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before } from "node:test";
import { pathToFileURL } from "node:url";

import {
    assertLike,
    decibels,
    drawn,
    launch,
    open,
    place,
    relamp,
    serve,
    settled,
    show,
    test,
} from "./browser.mjs";
import { testDelightPage } from "./delight_page.mjs";
import { testExample } from "./lightmaps_example.mjs";
import { DAY, testTimeline } from "./timeline_tests.mjs";
import { testWeight } from "./weight.mjs";
import { testAddedLamps } from "./added_tests.mjs";
import { testDroppedModels } from "./dropped_tests.mjs";

const SIZE = ["--size", "640x360"];
const LIKENESS = { scan: 32, albedo: 32, lamp: 30, all: 30 }; // dB at least

let folder;
let browser;
let room;
let page; // the folder, and as a tab that all tests but those of loading share
let tab;

before(
    async () => {
        folder = await mkdtemp(join(tmpdir(), "relamp-page-"));
        const out = join(folder, "out");
        const launched = launch();
        await relamp("delight", join(place.samples, "bedroom/scan.glb"), "-o", out, "--page");
        page = join(folder, "page");
        await relamp("page", out, "-o", page, "--timeline", DAY);
        room = JSON.parse(await readFile(join(page, "room.json"), "utf8"));
        browser = await launched;
        tab = await open(browser);
        await tab.page.goto(`${pathToFileURL(join(page, "index.html"))}#panel=off`);
        await settled(tab.page);
    },
    { timeout: 120000 },
);

after(async () => {
    await browser?.close();
    await rm(folder, { recursive: true, force: true });
});

/** What `relamp relight` makes of the room from where a visitor begins. */
async function programs(name, ...words) {
    const file = join(folder, `${name}.png`);
    await relamp("relight", join(folder, "out"), ...SIZE, ...words, "-o", file);
    return readFile(file);
}

async function compare(t, name, hash, words, atLeast) {
    const seen = async () => {
        await show(tab.page, `panel=off&${hash}`);
        return tab.page.screenshot();
    };
    const pictures = await Promise.all([seen(), programs(name, ...words)]);
    await assertLike(t, tab.page, name, pictures, atLeast);
}

const alone = (wanted) => room.lights.map((_, i) => `light${i}=${i === wanted ? 1 : 0}`).join("&");

test("opened from a disk it is whole, without a complaint, and loads nothing from elsewhere", () => {
    assert.deepEqual(tab.complaints, []);
    assert.ok(tab.loaded.length > 8);
    for (const url of tab.loaded)
        assert.ok(url.startsWith(pathToFileURL(page).href) || url.startsWith("data:"), url);
});

testWeight(() => ({ page, browser, tab, room }));

test("it shows the scan as the program does", (t) =>
    compare(t, "scan", "show=scan", ["--show", "scan"], LIKENESS.scan));

test("it shows the albedo as the program does", (t) =>
    compare(t, "albedo", "show=albedo", ["--show", "albedo"], LIKENESS.albedo));

test("each lamp alone lights the room as the program has it", async (t) => {
    const lamps = room.lights.filter((light) => light.fixture !== undefined);
    assert.equal(lamps.length, 3);
    for (const lamp of lamps)
        await compare(
            t,
            `lamp${lamp.fixture}`,
            alone(room.lights.indexOf(lamp)),
            ["--fixture", `${lamp.fixture}=on`, `--exposure=${room.exposure}`],
            LIKENESS.lamp,
        );
});

test("all lights light the room as the program has it", (t) =>
    compare(
        t,
        "all",
        "",
        ["--lights", join(folder, "out/lights.json"), `--exposure=${room.exposure}`],
        LIKENESS.all,
    ));

test("a lamp of another colour temperature and brightness is as the program has it", (t) => {
    const at = room.lights.findIndex((light) => light.fixture === 2);
    const others = alone(at).replace(`light${at}=1`, `light${at}=0.5,2700K`);
    return compare(
        t,
        "warm",
        others,
        ["--fixture", "2=2700K,50%", `--exposure=${room.exposure}`],
        LIKENESS.lamp,
    );
});

test("the sky alone lights the room as the program has it", async (t) => {
    const at = room.lights.findIndex((light) => light.kind === "sky");
    const file = join(folder, "sky.json");
    const pane = { id: 0, dim: 1e-6 }; // on, or it would be open to the sky, which it was not
    await writeFile(
        file,
        JSON.stringify({ sky: { radiance: room.lights[at].colour }, fixtures: [pane] }),
    );
    await compare(
        t,
        "sky",
        `${alone(at)}&stops=4`,
        ["--lights", file, `--exposure=${room.exposure + 4}`],
        LIKENESS.lamp,
    );
});

test("where one asks for it, a dim lamp alone is exposed as the program exposes it", async (t) => {
    const lamp = alone(room.lights.findIndex((light) => light.fixture === 60));
    await show(tab.page, `panel=off&${lamp}&exposure=auto`);
    await tab.page.waitForFunction(
        (stops) => Number(document.getElementById("canvas").dataset.stops) > stops + 1,
        room.exposure,
    );
    await drawn(tab.page);
    await compare(t, "metered", `${lamp}&exposure=auto`, ["--fixture", "60=on"], LIKENESS.lamp);
});

testTimeline(() => ({ folder, room, tab }));

test("a page whose graphics memory was taken away shows the same when it has it back", async () => {
    await show(tab.page, "panel=off&light0=0.5");
    await tab.page.waitForFunction(() => performance.now() > 10500); // earlier it gives up
    const before = await tab.page.screenshot();
    const loaded = tab.page.waitForEvent("load");
    await tab.page.evaluate(() => {
        const context = document.getElementById("canvas").getContext("webgl2");
        const extension = context.getExtension("WEBGL_lose_context");
        extension.loseContext();
        setTimeout(() => extension.restoreContext(), 100);
    });
    await loaded;
    await settled(tab.page);
    assert.ok((await decibels(tab.page, await tab.page.screenshot(), before)) > 45);
});

testAddedLamps(() => ({ tab, room, folder, compare }));
testDroppedModels(() => ({ tab, room }));

test("the shader's view transform gives the numbers of the program's", async () => {
    const numbers = JSON.parse(await readFile(new URL("formulas.json", import.meta.url), "utf8"));
    const other = await open(browser);
    await other.page.addScriptTag({ path: join(place.libraries, "formulas_probe.js") });
    const shown = await other.page.evaluate(
        (lights) => window.agxOnGpu(lights),
        numbers.agx.map(({ light }) => light),
    );
    numbers.agx.forEach((row, i) =>
        row.shown.forEach((value, c) => {
            const apart = Math.abs(shown[i][c] - value);
            assert.ok(apart < 1e-3, `${row.light}: ${shown[i]}, not ${row.shown}`);
        }),
    );
    await other.close();
});

test("a wipe shows one view beside the other, and arrow keys move it", async () => {
    await show(tab.page, "panel=off&show=scan&against=albedo&wipe=0.5");
    const left = { clip: { x: 0, y: 60, width: 300, height: 300 } }; // below the words
    const seen = await tab.page.screenshot(left);
    await show(tab.page, "panel=off&show=scan");
    const scan = await tab.page.screenshot(left);
    assert.ok((await decibels(tab.page, seen, scan)) > 60);
    await show(tab.page, "panel=off&show=scan&against=albedo&wipe=0.5");
    await tab.page.locator("#wipe").press("ArrowRight");
    await tab.page.waitForFunction(() => location.hash.includes("wipe=0.52"));
});

test("a click on a lamp switches it, and the address tells", async () => {
    await show(tab.page, "panel=off");
    const at = room.lights.findIndex((light) => light.fixture === 2);
    await tab.page.mouse.click(320, 20); // the ceiling lamp, from where a visitor begins
    await tab.page.waitForFunction((i) => location.hash.includes(`light${i}=0`), at);
    await tab.page.mouse.click(320, 20);
    await tab.page.waitForFunction((i) => !location.hash.includes(`light${i}=`), at);
});

test("drag turns, keys walk, a narrow window is filled", async () => {
    await show(tab.page, "panel=off");
    await tab.page.mouse.move(300, 250);
    await tab.page.mouse.down();
    await tab.page.mouse.move(360, 250, { steps: 3 });
    await tab.page.mouse.up();
    await tab.page.waitForFunction(() => location.hash.includes("at="));
    const before = await tab.page.evaluate(() => location.hash);
    await tab.page.locator("#canvas").press("KeyW", { delay: 200 });
    await tab.page.waitForFunction((hash) => location.hash !== hash, before);
    await tab.page.setViewportSize({ width: 300, height: 500 });
    await drawn(tab.page);
    const size = await tab.page.evaluate(() => {
        const { width, height } = document.getElementById("canvas");
        return [width, height];
    });
    assert.deepEqual(size, [300, 500]);
    await tab.page.setViewportSize({ width: 640, height: 360 });
});

test("from a server, on a phone, lamps are switched and dimmed by the panel", async () => {
    const server = await serve(page);
    const phone = await open(browser, {
        viewport: { width: 390, height: 780 },
        hasTouch: true,
        isMobile: true,
        colorScheme: "dark",
    });
    await phone.page.goto(`${server.url}#light0=0`);
    await settled(phone.page);
    const first = phone.page.getByLabel(room.lights[0].name, { exact: true });
    assert.equal(await first.isChecked(), false);
    await first.tap();
    await phone.page.waitForFunction(() => !location.hash.includes("light0"));
    await phone.page.getByLabel(`brightness of ${room.lights[1].name}`).fill("0.5");
    await phone.page.waitForFunction(() => location.hash.includes("light1=0.5"));
    await phone.page.getByRole("button", { name: "Night" }).tap();
    await phone.page.waitForFunction(() => location.hash.includes("light0=0"));
    assert.deepEqual(phone.complaints, []);
    await phone.close();
    server.close();
});

test("<relamp-room> shows the room on another page", async () => {
    await writeFile(
        join(folder, "other.html"),
        '<link rel="icon" href="data:,"><script src="page/relamp-room.js"></script><relamp-room src="page/"></relamp-room>',
    );
    const server = await serve(folder);
    const other = await open(browser);
    await other.page.goto(`${server.url}other.html`);
    const frame = other.page.frameLocator("relamp-room iframe");
    await frame.locator("body[data-state=ready]").waitFor();
    assert.equal(await frame.locator("#panel").isVisible(), false);
    assert.deepEqual(other.complaints, []);
    await other.close();
    server.close();
});

testDelightPage(() => ({ folder, browser, room }));

testExample(() => ({ folder, browser, room, programs }));

test("a damaged or missing file is told of in a sentence", async () => {
    const broken = join(folder, "broken");
    await cp(page, broken, { recursive: true });
    const address = pathToFileURL(join(broken, "index.html")).href;
    const sentence = async (isRoomThere) => {
        const other = await open(browser);
        await other.page.goto(address);
        await settled(other.page);
        const text = await other.page.locator("#trouble").innerText();
        assert.equal(await other.page.locator("#preview").isVisible(), !isRoomThere);
        await other.close();
        return text;
    };
    await writeFile(join(broken, "geometry.js"), 'relampPart("geometry", "AAAA");');
    assert.match(await sentence(false), /geometry\.js is damaged/);
    await cp(join(page, "geometry.js"), join(broken, "geometry.js"));
    await writeFile(join(broken, "bounces.js"), 'relampPart("bounces", "AAAA");');
    assert.match(await sentence(true), /bounces\.js is damaged/);
    await rm(join(broken, "geometry.js"));
    assert.match(await sentence(false), /geometry\.js is missing/);
});

test("without WebGL 2 there is a sentence and the picture", async () => {
    const blind = await launch(["--disable-3d-apis"]);
    const other = await open(blind);
    await other.page.goto(pathToFileURL(join(page, "index.html")).href);
    await settled(other.page);
    assert.match(await other.page.locator("#trouble").innerText(), /WebGL 2/);
    assert.ok(await other.page.locator("#preview").isVisible());
    await blind.close();
});

test("after all that there was no complaint", () => assert.deepEqual(tab.complaints, []));
