// The slider over time: against the program's film, and as a person uses it.

import assert from "node:assert/strict";
import { readFile, writeFile } from "node:fs/promises";
import { join } from "node:path";

import { assertLike, place, relamp, show, test } from "./browser.mjs";

const LIKENESS = 30; // dB at least
const FRAMES = 3;

export const DAY = join(place.samples, "bedroom/day.json");

/** `shared` gives the folder in which the sample's result is `out`, and a tab that shows its page with DAY. */
export function testTimeline(shared) {
    test("at a time of its timeline the room is as in the program's film", async (t) => {
        const { folder, room, tab } = shared();
        const film = join(folder, "film");
        const short = join(folder, "short.json"); // the same day in few frames
        const day = JSON.parse(await readFile(DAY, "utf8"));
        await writeFile(short, JSON.stringify({ ...day, seconds: FRAMES }));
        await relamp(
            "relight",
            join(folder, "out"),
            "--timeline",
            short,
            "--size",
            "640x360",
            "--fps",
            1,
            `--exposure=${room.exposure}`,
            "-o",
            film,
        );
        const [first, last] = [0, -1].map((i) => room.timeline.keys.at(i).time);
        const time = first + (last - first) / (FRAMES - 1);
        await show(tab.page, `panel=off&time=${time}`);
        const wanted = await readFile(join(film, "frame_0002.png"));
        const found = await tab.page.screenshot();
        await assertLike(t, tab.page, time.toFixed(1), [found, wanted], LIKENESS);
    });

    test("the slider over time sets the lamps, play goes from key to key where less motion is asked for", async () => {
        const { room, tab } = shared();
        await show(tab.page, "");
        const lamp = room.lights.findIndex((light) => light.fixture === 2);
        const isOn = tab.page.getByLabel(room.lights[lamp].name, { exact: true });
        await tab.page.getByLabel("time").fill("12");
        await tab.page.waitForFunction(() => location.hash === "#time=12");
        assert.equal(await isOn.isChecked(), false);
        assert.match(
            await tab.page.getByLabel("time").getAttribute("aria-valuetext"),
            /^12, noon$/,
        );
        await tab.page.getByRole("button", { name: "Play" }).click();
        await tab.page.waitForFunction(() => location.hash === "#time=19");
        await tab.page.getByRole("button", { name: "Pause" }).click();
        await isOn.click(); // a person's own light from there on
        await tab.page.waitForFunction((i) => {
            const has = (word) => location.hash.includes(word);
            return !has("time=") && has("light0=0.1") && !has(`light${i}=`);
        }, lamp);
        await show(tab.page, "panel=off");
    });
}
