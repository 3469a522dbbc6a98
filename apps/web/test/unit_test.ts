// What of the page needs no browser; run by node's own runner after esbuild has made it JavaScript.

import assert from "node:assert/strict";
import { test } from "node:test";

import {
    LAMP_RADIUS,
    intensityOf,
    lampsFrom,
    lumensFor,
    radianceOf,
    wordsOfLamps,
} from "../src/added_lamp";
import { blackbodyColour, luminance } from "../src/blackbody";
import { transportFrom } from "../src/bounces";
import { orbited, poseOf, turned, verticalView, walked } from "../src/camera";
import { ClusterCells } from "../src/cluster_cells";
import { glslFrom } from "../src/formulas";
import { fittingRoom } from "../src/levels";
import { stopsOf } from "../src/light_meter";
import { asFound, colourFromHex, presetsFor, weightOf } from "../src/light_mix";
import { Trouble, asRoom, partsOf } from "../src/room";
import type { Light, Rgb, Room, RoomCamera, TimelineOfRoom } from "../src/room";
import { keyBeside, settingOf, takeTime, weightsAt, weightsOf, wordsAt } from "../src/timeline";
import { directionFrom, siteFrom } from "../src/sites";
import { directionOfRay, harmonicsOf } from "../src/harmonics";
import { sensibleScale } from "../src/model_file";
import { Probes } from "../src/probes";
import { hashOf, initialState, stateFrom } from "../src/url_state";
import numbers from "./formulas.json";
import { Vector3 } from "three";

function near(found: number, wanted: number, by: number): void {
    assert.ok(Math.abs(found - wanted) <= by, `${found} is not ${wanted} to ${by}`);
}

function light(kind: Light["kind"], colour: Rgb = [2, 1, 0.5]): Light {
    return { name: kind, kind, colour, shines: [], maps: [] };
}

test("a blackbody has the colour that the program gives it", () => {
    assert.ok(numbers.blackbody.length >= 5);
    for (const { kelvin, colour } of numbers.blackbody)
        blackbodyColour(kelvin).forEach((value, i) => near(value, colour[i]!, 1e-4));
});

test("the exposure is that which the program finds by what is seen", () => {
    assert.ok(numbers.meter.length >= 4);
    for (const { light: pixels, stops } of numbers.meter)
        near(stopsOf(pixels.flatMap((rgb) => [...rgb, 1])), stops, 2e-3);
});

test("a lamp as it was found is its lightmap, and half of it at half its brightness", () => {
    assert.deepEqual(weightOf(light("lamp"), asFound()), [1, 1, 1]);
    assert.deepEqual(weightOf(light("lamp"), { ...asFound(), share: 0.5 }), [0.5, 0.5, 0.5]);
});

test("a lamp of another colour is as bright as it was found", () => {
    const lamp = light("lamp");
    for (const setting of [
        { share: 1, kelvin: 2700, colour: null },
        { share: 1, kelvin: null, colour: "#40c0ff" },
    ]) {
        const weight = weightOf(lamp, setting);
        const shown = lamp.colour.map((value, i) => value * weight[i]!) as Rgb;
        near(luminance(shown), luminance(lamp.colour), 1e-6);
    }
    const red = colourFromHex("#ff0000");
    near(luminance(red), 1, 1e-9);
    assert.equal(red[1], 0);
});

test("a lamp without blue gives none in any colour", () => {
    const weight = weightOf(light("lamp", [1, 1, 0]), { share: 1, kelvin: 12000, colour: null });
    assert.ok(weight.every(Number.isFinite));
});

test("night has the lamps alone, day all but the lamps", () => {
    const lights = [light("lamp"), light("window"), light("sky")];
    const share = (name: string) =>
        lights
            .map(presetsFor(lights).find((preset) => preset.name === name)!.settings)
            .map((setting) => setting.share);
    assert.deepEqual(share("Night"), [1, 0, 0]);
    assert.deepEqual(share("Day"), [0, 1, 1]);
    assert.deepEqual(
        presetsFor([light("lamp")]).map(({ name }) => name),
        ["As found", "Evening"],
    );
});

test("the address holds all that a person sets, and nothing of what is as at first", () => {
    assert.equal(hashOf(initialState(3)), "");
    const state = initialState(3);
    state.show = "scan";
    state.against = "albedo";
    state.wipe = 0.25;
    state.stops = -1.5;
    state.isMetered = true;
    state.settings = [
        { share: 0, kelvin: null, colour: null },
        { share: 0.5, kelvin: 2700, colour: null },
        { share: 1, kelvin: null, colour: "#ff8800" },
    ];
    state.added = [
        { position: [1, 1.5, -2.25], lumens: 800, kelvin: 2700, isOn: true },
        { position: [-1, 0, 3], lumens: 25, kelvin: 6500, isOn: false },
    ];
    state.pose = { position: [1, 2.5, -3], yaw: 0.5, pitch: -0.25 };
    state.hasPanel = false;
    assert.deepEqual(stateFrom(`#${hashOf(state)}`, 3), state);
});

test("an address that means nothing is as none", () => {
    const nonsense = "#show=cellar&against=&wipe=x&stops=NaN&light0=&light9=0&at=1,2&__proto__=1";
    assert.deepEqual(stateFrom(nonsense, 2), initialState(2));
    assert.equal(stateFrom("#stops=1e9&wipe=-4", 1).stops, 10);
    assert.equal(stateFrom("#light0=-3,99K", 1).settings[0]!.share, 0);
});

const timeline: TimelineOfRoom = {
    seconds: 4,
    keys: [{ time: 6, name: "dawn" }, { time: 10 }],
    times: [6, 8, 10],
    weights: [[[0, 0, 0]], [[1, 0.5, 0]], [[1, 1, 1]]],
};

test("between two times of a timeline light changes evenly, beyond its ends not at all", () => {
    const at = (time: number) => weightsAt(timeline, time)[0];
    assert.deepEqual(
        [at(5), at(6), at(10), at(99)],
        [
            [0, 0, 0],
            [0, 0, 0],
            [1, 1, 1],
            [1, 1, 1],
        ],
    );
    assert.deepEqual(
        [at(7), at(8), at(9)],
        [
            [0.5, 0.25, 0],
            [1, 0.5, 0],
            [1, 0.75, 0.5],
        ],
    );
    assert.deepEqual([keyBeside(timeline, 6, 1), keyBeside(timeline, 7, -1)], [10, 6]);
    assert.deepEqual([wordsAt(timeline, 7.25), wordsAt(timeline, 10)], ["7.3, dawn", "10"]);
});

test("a lamp can be set to what a timeline makes of it", () => {
    const lamp = light("lamp");
    for (const weight of [
        [1, 0.6, 0.2],
        [0.5, 0.5, 0.5],
        [0.3, 2, 1],
    ] as Rgb[])
        weightOf(lamp, settingOf(lamp, weight)).forEach((value, i) =>
            near(value / weight[i]!, 1, 0.02),
        );
});

test("the address has the time in place of the lamps, and a page without one passes it over", () => {
    const room = { lights: [light("lamp")], timeline } as Room;
    const state = { ...initialState(1), time: 8 };
    takeTime(room, state);
    assert.deepEqual(weightsOf(room, state), [[1, 0.5, 0]]);
    assert.notDeepEqual(state.settings, initialState(1).settings);
    assert.equal(hashOf(state), "time=8");
    const other = stateFrom("#time=8", 1);
    takeTime({ lights: [light("lamp")] } as Room, other);
    assert.deepEqual(other, initialState(1));
    const before = { ...initialState(1), time: -1e9 };
    takeTime(room, before);
    assert.equal(before.time, 6);
});

const camera: RoomCamera = {
    position: [1, 2, 3],
    forward: [0.6, 0, -0.8],
    up: [0, 1, 0],
    fieldOfView: 1.3,
    across: "width",
};

test("a visitor begins where the program's camera stands, and walks where it looks", () => {
    const pose = poseOf(camera);
    const ahead = walked(pose, 0, 0, 2);
    ahead.position.forEach((value, i) =>
        near(value, camera.position[i]! + 2 * camera.forward[i]!, 1e-9),
    );
    near(walked(pose, 1, 0, 0).position[0], 1 + 0.8, 1e-9);
    assert.ok(turned(pose, 0, 9).pitch < Math.PI / 2);
});

test("the picture is as wide as the program's, and no more than that on a phone", () => {
    near(
        verticalView(camera, 16 / 9),
        (360 / Math.PI) * Math.atan((Math.tan(0.65) * 9) / 16),
        1e-9,
    );
    assert.ok(verticalView(camera, 0.46) < 90);
});

test("who orbits keeps his distance", () => {
    const centre = new Vector3(0, 1, 0);
    const from = (pose: { position: Rgb }) => new Vector3(...pose.position).distanceTo(centre);
    const pose = poseOf(camera);
    near(from(orbited(pose, centre, 0.4, 0.1)), from(pose), 1e-9);
});

test("a damaged room is told of in a sentence", () => {
    for (const data of [null, 7, {}, { format: "relamp page 1" }])
        assert.throws(() => asRoom(data), Trouble);
    const part = { file: "a", type: "b", bytes: 1 };
    const room = {
        format: "relamp page 1",
        meshes: [],
        geometry: part,
        camera,
        box: { low: [0, 0, 0], high: [4, 3, 5] },
        exposure: 1,
        fixtures: 1,
        lights: [light("lamp")],
        timeline,
        pages: [{ albedo: { ...part, file: "albedo" } }],
    };
    assert.deepEqual(
        partsOf(asRoom(room)).map(({ file }) => file),
        ["a", "albedo"],
    );
    assert.throws(() => asRoom({ ...room, format: "relamp page 9" }), /another version/);
    for (const wrong of [
        { lights: [] },
        { camera: {} },
        { box: { low: [0, 0], high: [1, 1, 1] } },
        { exposure: null },
        { fixtures: 1e12 },
        { timeline: {} },
        { timeline: { ...timeline, weights: [[], [], []] } },
    ])
        assert.throws(() => asRoom({ ...room, ...wrong }), /damaged/);
});

test("a phone loads the smaller textures, and a small one is seen first", () => {
    const level = (side: number) => ({
        file: `a_${side}`,
        type: "image/webp",
        bytes: 9,
        width: side,
        height: side / 2,
    });
    const room = {
        geometry: { file: "g", type: "b", bytes: 1 },
        lights: [] as Light[],
        pages: [
            {
                albedo: { ...level(4096), smaller: [level(2048), level(1024)] },
                scan: { ...level(4096), smaller: [level(2048)] },
            },
        ],
    } as unknown as Room;
    const files = (most: number) => partsOf(fittingRoom(room, most)).map(({ file }) => file);
    assert.deepEqual(files(16384), ["g", "a_1024", "a_4096", "a_4096"]);
    assert.deepEqual(files(2048), ["g", "a_1024", "a_2048", "a_2048"]);
    room.pages[0]!.albedo = level(1024);
    assert.deepEqual(files(2048), ["g", "a_1024", "a_2048"]);
});

test("a shared header becomes GLSL ES without macros", () => {
    const glsl = glslFrom(
        '#pragma once\n#include "base/shared.h"\nSHARED_BEGIN\nSHARED_CONST kA = 2.0f;\n' +
            "SHARED_FN float f(float x)\n{\n    const float b = kA * x;\n    return b;\n}\nSHARED_END\n",
    );
    assert.equal(
        glsl,
        "const float kA = 2.0f;\n float f(float x)\n{\n    float b = kA * x;\n    return b;\n}",
    );
});

test("an added lamp sends its lumens all around, from its surface", () => {
    const lamp = { position: [0, 0, 0] as Rgb, lumens: 1000, kelvin: 3000, isOn: true };
    near(luminance(intensityOf(lamp)), 1000 / (4 * Math.PI * 100), 1e-6);
    const area = Math.PI * LAMP_RADIUS ** 2; // as seen
    near(luminance(radianceOf(lamp)) * area, luminance(intensityOf(lamp)), 1e-9);
    assert.deepEqual(intensityOf({ ...lamp, isOn: false }), [0, 0, 0]);
    assert.ok(lumensFor(0) > lumensFor(2));
    assert.equal(lumensFor(40), 25);
});

test("added lamps that an address has wrong are passed over", () => {
    const words = new URLSearchParams(
        "lamp0=1,2,3&lamp1=1,2,x,800,2700K&lamp2=1,2,3,1e9,99K&lamp3=1,2,3,-1,2700K&lamp4=0,0,0,800,2700K",
    );
    assert.deepEqual(wordsOfLamps(lampsFrom(words)), ["lamp0=1,2,3,25600,1000K"]);
});

const box = { low: [0, 0, 0], extent: [4, 2, 1] };

test("directions and places are as the program packs them", () => {
    directionFrom(128 | (128 << 8)).forEach((value, i) => near(value, [0, 0, 1][i]!, 0.02));
    directionFrom(255 | (128 << 8)).forEach((value, i) => near(value, [1, 0, 0][i]!, 0.02));
    directionFrom(0).forEach((value, i) => near(value, [0, 0, -1][i]!, 0.02));
    const view = new DataView(new Uint8Array([255, 255, 0, 128, 0, 0, 128, 255]).buffer);
    const { place, normal } = siteFrom(view, 0, box);
    place.forEach((value, i) => near(value, [4, 1, 0][i]!, 1e-3));
    near(normal[1], 1, 0.02);
});

test("rays, harmonics and packed directions are the program's", () => {
    for (const { i, count, direction, harmonics } of numbers.rays) {
        directionOfRay(i, count).forEach((value, axis) => near(value, direction[axis]!, 1e-5));
        harmonicsOf(direction as Rgb).forEach((value, k) => near(value, harmonics[k]!, 1e-5));
    }
    for (const { word, direction } of numbers.words)
        directionFrom(word).forEach((value, axis) => near(value, direction[axis]!, 1e-5));
});

test("probes add up the lights, each times its weight, and what is cut short is told of", () => {
    const about = {
        file: "probes",
        type: "",
        bytes: 0,
        low: [0, 0, 0] as Rgb,
        spacing: 1,
        count: [1, 1, 1] as Rgb,
        rays: 1,
        scales: [2, 16],
    };
    const even = new Array<number>(24).fill(127.5);
    const bytes = Uint8Array.from([
        0,
        0,
        255,
        255,
        255,
        ...even,
        255,
        0,
        127.5,
        255,
        ...even.slice(1),
    ]);
    const light = new Probes(about, bytes).harmonicsAt(0, [
        [1, 0, 0.5],
        [1, 1, 0],
    ]);
    near(light[0]!, 2 + 16, 1e-9);
    near(light[1]!, 0, 1e-9);
    near(light[2]!, 1, 1e-9);
    near(light[3]!, Math.sqrt(3) * (16 - 2 / 255), 0.2); // the second light comes from one side
    assert.throws(() => new Probes(about, bytes.subarray(1)), Trouble);
    for (const count of [[], [1, 1], [1, 1, -1], [1, 1, 1e300], [1, 1, NaN]] as Rgb[])
        assert.throws(() => new Probes({ ...about, count }, bytes), Trouble);
});

test("a model of absurd size is brought to one that can stand in the room", () => {
    assert.equal(sensibleScale(1.8, 4), 1);
    near(sensibleScale(180, 4) * 180, 1, 1e-9);
    near(sensibleScale(0.002, 4) * 0.002, 0.3, 1e-9);
    assert.equal(sensibleScale(0, 4), 1);
});

test("rays of clusters are sums of steps, and what is cut short is told of", () => {
    const about = {
        file: "bounces",
        type: "",
        bytes: 0,
        clusters: 1,
        fronts: 1,
        size: 1,
        points: 1,
        rays: 2,
        box,
    };
    const site = [0, 0, 0, 0, 0, 0, 128, 128];
    const bytes = Uint8Array.from([...site, 255, 0, 128, ...site, 0, 1]);
    const { rays, clusters } = transportFrom(about, bytes);
    assert.deepEqual([...rays], [0, 1]);
    assert.equal(clusters[0]!.albedo[0], 1);
    assert.throws(() => transportFrom(about, bytes.subarray(0, bytes.length - 1)), Trouble);
    assert.throws(
        () => transportFrom(about, Uint8Array.from([...bytes.subarray(0, -2), 0, 255])),
        Trouble,
    );
    for (const wrong of [{ clusters: -1 }, { clusters: 1e12 }, { rays: 1e300 }, { size: 0 }])
        assert.throws(() => transportFrom({ ...about, ...wrong }, bytes), Trouble);
});

test("a cell lists all clusters that its places are near", () => {
    const clusters = Array.from({ length: 60 }, (_, i) => ({
        place: [(i * 0.37) % 4, (i * 0.61) % 2, (i * 0.83) % 1] as Rgb,
        normal: [0, 1, 0] as Rgb,
        albedo: [1, 1, 1] as Rgb,
    }));
    const reach = 0.6;
    const cells = new ClusterCells(
        { clusters, fronts: 60, size: 0.4, points: [], rays: new Uint16Array() },
        reach,
    );
    for (let n = 0; n < 200; ++n) {
        const place = new Vector3((n * 0.7) % 4, (n * 0.31) % 2, (n * 0.13) % 1);
        const at = place
            .clone()
            .sub(cells.low)
            .divideScalar(cells.size)
            .floor()
            .clamp(new Vector3(), cells.count.clone().subScalar(1));
        const list = cells.lists[(at.z * cells.count.y + at.y) * cells.count.x + at.x]!;
        clusters.forEach((cluster, i) => {
            const isNear = place.distanceTo(new Vector3(...cluster.place)) < reach - 1e-6;
            assert.ok(!isNear || list.includes(i), `${i} is not listed near ${place.toArray()}`);
        });
    }
});
