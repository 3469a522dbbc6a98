// What the browser tests share: the program, Chromium, a static server, and pictures as numbers.

import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { createReadStream, existsSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { join, normalize } from "node:path";
import { test as testOfNode } from "node:test";
import { promisify } from "node:util";

const run = promisify(execFile);
const MOST = 60000; // ms of a test: a browser that hangs must not keep the others

/** A test of node's runner that ends. */
export function test(name, body) {
    testOfNode(name, { timeout: MOST }, body);
}

/** From the environment, which CMakeLists.txt sets. */
export const place = {
    program: process.env.RELAMP_PROGRAM,
    samples: process.env.RELAMP_SAMPLES,
    libraries: process.env.RELAMP_LIBRARIES,
    chromium: process.env.RELAMP_CHROMIUM,
};

export function relamp(...words) {
    return run(place.program, [...words.map(String), "-q"], { timeout: MOST });
}

// SwiftShader draws where there is no GPU.
const FLAGS = [
    "--no-sandbox",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
    "--force-color-profile=srgb",
];

export function launch(flags = []) {
    const require = createRequire(join(place.libraries, "node_modules/"));
    const { chromium } = require("playwright-core");
    return chromium.launch({ executablePath: place.chromium, args: [...FLAGS, ...flags] });
}

const TYPES = {
    html: "text/html",
    js: "text/javascript",
    css: "text/css",
    jpg: "image/jpeg",
    wasm: "application/wasm",
};

/** Serves a folder as any static server would; gives its address and a way to end it. It ends with node, too. */
export function serve(folder) {
    const server = createServer((request, response) => {
        const path = normalize(new URL(request.url, "http://localhost").pathname);
        const file = join(folder, path.endsWith("/") ? `${path}index.html` : path);
        if (!existsSync(file)) return response.writeHead(404).end();
        response.writeHead(200, { "content-type": TYPES[file.split(".").pop()] ?? "text/plain" });
        createReadStream(file).pipe(response);
    });
    server.unref();
    return new Promise((resolve) => {
        server.listen(0, "127.0.0.1", () =>
            resolve({
                url: `http://127.0.0.1:${server.address().port}/`,
                close: () => {
                    server.close();
                    server.closeAllConnections();
                },
            }),
        );
    });
}

/** A tab that keeps what the page complains of, and what it loads. */
export async function open(browser, options = {}) {
    const context = await browser.newContext({
        viewport: { width: 640, height: 360 },
        reducedMotion: "reduce",
        ...options,
    });
    context.setDefaultTimeout(MOST / 3);
    const page = await context.newPage();
    const complaints = [];
    const loaded = [];
    page.on("console", (message) => {
        if (["error", "warning"].includes(message.type())) complaints.push(message.text());
    });
    page.on("pageerror", (error) => complaints.push(String(error)));
    page.on("request", (request) => loaded.push(request.url()));
    return { page, complaints, loaded, close: () => context.close() };
}

/** Until all of the page is there, or it says why not. */
export async function settled(page) {
    await page.waitForFunction(() => document.body.dataset.state);
    await drawn(page);
}

/** Until the canvas shows what was set. */
export function drawn(page) {
    return page.evaluate(
        () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))),
    );
}

/** Goes to another state of the same page, without loading it again. */
export async function show(page, hash) {
    await page.evaluate((wanted) => (location.hash = wanted), hash);
    await drawn(page);
}

/** PSNR in dB of two PNGs, whose bytes are taken from 0 to 255; the larger is averaged down. */
export async function decibels(page, first, second) {
    const pictures = [first, second].map((png) => png.toString("base64"));
    return page.evaluate(async (given) => {
        const bitmaps = await Promise.all(
            given.map(async (base64) => {
                const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
                return createImageBitmap(new Blob([bytes], { type: "image/png" }));
            }),
        );
        const [width, height] = [bitmaps[1].width, bitmaps[1].height];
        const [a, b] = bitmaps.map((bitmap) => {
            const canvas = document.createElement("canvas");
            [canvas.width, canvas.height] = [bitmap.width, bitmap.height];
            const context = canvas.getContext("2d");
            context.drawImage(bitmap, 0, 0);
            const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
            const step = bitmap.width / width;
            const mean = new Float64Array(3 * width * height);
            for (let y = 0; y < bitmap.height; ++y)
                for (let x = 0; x < bitmap.width; ++x)
                    for (let c = 0; c < 3; ++c)
                        mean[3 * (Math.floor(y / step) * width + Math.floor(x / step)) + c] +=
                            data[4 * (y * bitmap.width + x) + c] / (step * step);
            return mean;
        });
        let sum = 0;
        for (let i = 0; i < a.length; ++i) sum += (a[i] - b[i]) ** 2;
        return 10 * Math.log10((255 * 255 * a.length) / Math.max(sum, 1e-9));
    }, pictures);
}

/** Says how like two PNGs are, and fails where that is less than `least` dB. */
export async function assertLike(t, page, name, [found, wanted], least) {
    const like = await decibels(page, found, wanted);
    t.diagnostic(`${name}: ${like.toFixed(1)} dB`);
    assert.ok(like >= least, `${name}: ${like} dB, less than ${least}`);
}
