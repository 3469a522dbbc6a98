// Exposure by what is seen, as src/image/light_meter.cpp has it: the log-average becomes middle grey.

import * as THREE from "three";

import { luminance } from "./blackbody";
import type { CommonUniforms } from "./surface";
import { VIEWS } from "./surface";

const KEY = 0.18;
const DELTA = 1e-5;
const MOST_STOPS = 32;
const LONGEST_SIDE = 240; // pixels of the picture that is measured
const ADAPTATION = 400; // ms in which an eye, and this, follows

/** Stops that light is to be multiplied by; `rgba` is linear. Black counts for nothing. */
export function stopsOf(rgba: ArrayLike<number>): number {
    let logs = 0;
    let pixels = 0;
    for (let i = 0; i + 3 < rgba.length; i += 4) {
        const brightness = luminance([rgba[i] ?? 0, rgba[i + 1] ?? 0, rgba[i + 2] ?? 0]);
        if (brightness <= 0) continue;
        logs += Math.log2(DELTA + brightness);
        ++pixels;
    }
    if (pixels === 0) return 0;
    return Math.min(Math.max(Math.log2(KEY) - logs / pixels, -MOST_STOPS), MOST_STOPS);
}

export class LightMeter {
    private readonly target = new THREE.WebGLRenderTarget(1, 1, { type: THREE.HalfFloatType });
    private wanted: number | null = null; // stops
    private shown: number | null = null;
    private last = 0; // ms, of the frame before
    private isBusy = false;
    private isStale = false;

    /** `changed` is told when there are other stops, or when it is worth measuring again. */
    constructor(private readonly changed: (isWorthMeasuring: boolean) => void) {}

    /** Forgets what was measured: it was switched off. */
    reset(): void {
        this.wanted = this.shown = null;
    }

    /** Stops for a frame, on the way from `before` to those that were measured. */
    stops(now: number, before: number): number {
        if (this.wanted === null) return before;
        const isStill = matchMedia("(prefers-reduced-motion: reduce)").matches;
        const passed = Math.min(now - this.last, ADAPTATION);
        this.last = now;
        this.shown = isStill ? this.wanted : (this.shown ?? before);
        this.shown += (1 - Math.exp((-3 * passed) / ADAPTATION)) * (this.wanted - this.shown);
        if (Math.abs(this.wanted - this.shown) < 0.01) this.shown = this.wanted;
        else this.changed(false);
        return this.shown;
    }

    /** Measures what a camera sees, without waiting for it. */
    async measure(
        renderer: THREE.WebGLRenderer,
        scene: THREE.Scene,
        camera: THREE.PerspectiveCamera,
        uniforms: CommonUniforms,
    ): Promise<void> {
        this.isStale = this.isBusy;
        if (this.isBusy) return;
        this.isBusy = true;
        const width = Math.round(LONGEST_SIDE * Math.min(1, camera.aspect));
        const height = Math.round(LONGEST_SIDE / Math.max(1, camera.aspect));
        this.target.setSize(width, height);
        uniforms.view.value = VIEWS.light;
        renderer.setRenderTarget(this.target);
        renderer.clear();
        renderer.render(scene, camera);
        renderer.setRenderTarget(null);
        const half = new Uint16Array(4 * width * height);
        try {
            await renderer.readRenderTargetPixelsAsync(this.target, 0, 0, width, height, half);
            this.wanted = stopsOf(Float32Array.from(half, THREE.DataUtils.fromHalfFloat));
        } finally {
            this.isBusy = false;
        }
        this.changed(this.isStale);
        this.isStale = false;
    }
}
