// Sums the lightmaps of a page, linear, each times its weight, into one texture: once a change of
// light, not once a frame.

import * as THREE from "three";

import { ScreenPass, floatTexture, lightTarget } from "./screen_pass";

const FRAGMENT = `
precision highp float;
precision highp sampler2D;
precision highp sampler2DArray;
uniform sampler2DArray maps;   // fourth roots
uniform sampler2D weights;     // of a light each, times its map's scale
uniform int lights;
layout(location = 0) out vec4 sum;
void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec3 light = vec3(0.0);
    for (int i = 0; i < lights; ++i) {
        vec3 root = texelFetch(maps, ivec3(at, i), 0).rgb;
        light += texelFetch(weights, ivec2(i, 0), 0).rgb * root * root * root * root;
    }
    sum = vec4(light, 1.0);
}`;

export class LightSum {
    readonly texture: THREE.Texture;
    private readonly target: THREE.WebGLRenderTarget;
    private readonly maps: THREE.DataArrayTexture;
    private readonly weights: THREE.DataTexture;
    private readonly pass: ScreenPass;

    /** `scales` are of the maps, one a light; layers may come later. */
    constructor(
        private readonly width: number,
        private readonly height: number,
        private readonly scales: number[],
    ) {
        const count = scales.length;
        this.maps = new THREE.DataArrayTexture(
            new Uint8Array(4 * width * height * count),
            width,
            height,
            count,
        );
        this.weights = floatTexture(new Float32Array(4 * count), count, 1);
        this.target = lightTarget(width, height, true);
        this.texture = this.target.texture;
        this.pass = new ScreenPass(FRAGMENT, {
            maps: { value: this.maps },
            weights: { value: this.weights },
            lights: { value: count },
        });
    }

    setMap(light: number, pixels: Uint8Array): void {
        this.maps.image.data?.set(pixels, light * 4 * this.width * this.height);
        this.maps.addLayerUpdate(light);
        this.maps.needsUpdate = true;
    }

    sum(renderer: THREE.WebGLRenderer, weights: number[][]): void {
        const data = this.weights.image.data as Float32Array;
        weights.forEach((weight, i) => {
            for (let c = 0; c < 3; ++c) data[4 * i + c] = (weight[c] ?? 0) * (this.scales[i] ?? 0);
        });
        this.weights.needsUpdate = true;
        this.pass.run(renderer, this.target);
    }
}
