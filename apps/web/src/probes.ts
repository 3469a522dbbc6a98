// The light in the air of the room: a lattice of probes, of each light by itself, as
// src/output/web_probes.h writes them, and of added lamps by way of surfaces.

import * as THREE from "three";

import { HARMONICS, directionOfRay, harmonicsOf } from "./harmonics";
import { Trouble } from "./room";
import type { ProbesOfRoom, Rgb } from "./room";
import { ScreenPass, floatTexture, lightTarget, wordTexture } from "./screen_pass";
import { isCount } from "./sites";

const CHANNELS = 3 * HARMONICS;

// What lamps of the room send is summed; added lamps send by way of the clusters that a probe's
// rays meet.
const SUM = `
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp usampler2D;
uniform sampler2D ofRoom;
uniform usampler2D met;
uniform sampler2D basis;   // of rays
uniform sampler2D sending; // of clusters
uniform bool hasSending;
layout(location = 0) out vec4 light;
void main() {
    ivec2 at = ivec2(gl_FragCoord.xy); // harmonic, probe
    light = texelFetch(ofRoom, at, 0);
    if (!hasSending) return;
    int rays = textureSize(met, 0).x;
    int columns = textureSize(sending, 0).x;
    vec3 sum = vec3(0.0);
    for (int ray = 0; ray < rays; ++ray) {
        int cluster = int(texelFetch(met, ivec2(ray, at.y), 0).r);
        ivec2 place = ivec2(cluster % columns, cluster / columns);
        sum += texelFetch(basis, ivec2(at.x, ray), 0).r * texelFetch(sending, place, 0).rgb;
    }
    light.rgb += 12.5663706 / float(rays) * sum;
}`;

export class Probes {
    readonly count: number;
    private readonly met: Uint16Array<ArrayBuffer>;
    private readonly lights: Uint8Array; // one after the other
    private readonly ofRoom: Float32Array;
    private readonly texture: THREE.DataTexture;
    private readonly target: THREE.WebGLRenderTarget;
    private readonly pass: ScreenPass;

    /** Throws Trouble where the bytes are damaged. */
    constructor(
        private readonly about: ProbesOfRoom,
        bytes: Uint8Array,
    ) {
        const [x, y, z] = about.count;
        if (![x, y, z, about.rays].every(isCount)) throw damaged();
        this.count = x * y * z;
        const words = this.count * about.rays;
        if (bytes.length !== 2 * words + this.count * CHANNELS * about.scales.length)
            throw damaged();
        const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
        this.met = Uint16Array.from({ length: words }, (_, i) => view.getUint16(2 * i, true));
        this.lights = bytes.subarray(2 * words);
        this.ofRoom = new Float32Array(4 * HARMONICS * this.count);
        this.texture = floatTexture(this.ofRoom, HARMONICS, this.count);
        this.target = lightTarget(HARMONICS, this.count);
        this.pass = new ScreenPass(SUM, {
            ofRoom: { value: this.texture },
            met: { value: wordTexture(this.met, about.rays, this.count) },
            basis: { value: basisTexture(about.rays) },
            sending: { value: null },
            hasSending: { value: false },
        });
    }

    /** Irradiance harmonics of one probe under the lights of the room, each times its weight. */
    harmonicsAt(probe: number, weights: Rgb[]): number[] {
        const sum = new Array<number>(CHANNELS).fill(0);
        weights.forEach((weight, light) => {
            const at = (light * this.count + probe) * CHANNELS;
            const scale = this.about.scales[light] ?? 0;
            for (let c = 0; c < 3; ++c) {
                if (!weight[c]) continue;
                const mean = weight[c]! * scale * ((this.lights[at + c] ?? 0) / 255) ** 4;
                sum[c]! += mean;
                for (let i = 1; i < HARMONICS; ++i) {
                    const share = (this.lights[at + 3 * i + c] ?? 0) / 127.5 - 1;
                    sum[3 * i + c]! += mean * Math.sqrt(i < 4 ? 3 : 5) * share;
                }
            }
        });
        return sum;
    }

    uniforms(): Record<string, { value: unknown }> {
        return {
            probeLight: { value: this.target.texture },
            probeLow: { value: new THREE.Vector3(...this.about.low) },
            probeSpacing: { value: this.about.spacing },
            probeCount: { value: this.about.count },
        };
    }

    update(renderer: THREE.WebGLRenderer, weights: Rgb[], sending: THREE.Texture | null): void {
        for (let probe = 0; probe < this.count; ++probe)
            this.harmonicsAt(probe, weights).forEach((value, i) => {
                this.ofRoom[4 * (probe * HARMONICS + Math.floor(i / 3)) + (i % 3)] = value;
            });
        this.texture.needsUpdate = true;
        this.pass.uniforms["sending"]!.value = sending;
        this.pass.uniforms["hasSending"]!.value = sending !== null;
        this.pass.run(renderer, this.target);
    }
}

function damaged(): Trouble {
    return new Trouble("probes.js is damaged; write the page again with relamp page.");
}

function basisTexture(rays: number): THREE.DataTexture {
    const data = new Float32Array(4 * HARMONICS * rays);
    for (let ray = 0; ray < rays; ++ray)
        harmonicsOf(directionOfRay(ray, rays)).forEach(
            (value, i) => (data[4 * (ray * HARMONICS + i)] = value),
        );
    return floatTexture(data, HARMONICS, rays);
}
