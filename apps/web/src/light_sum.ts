// Sums the lightmaps of a page, linear, each times its weight, into one texture: once a change of
// light, not once a frame.

import * as THREE from "three";

const VERTEX = `void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }`;

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
    private readonly scene = new THREE.Scene();
    private readonly camera = new THREE.Camera();

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
        this.weights = new THREE.DataTexture(
            new Float32Array(4 * count),
            count,
            1,
            THREE.RGBAFormat,
            THREE.FloatType,
        );
        this.target = new THREE.WebGLRenderTarget(width, height, {
            type: THREE.HalfFloatType,
            minFilter: THREE.LinearFilter,
            magFilter: THREE.LinearFilter,
            depthBuffer: false,
        });
        this.texture = this.target.texture;
        const material = new THREE.RawShaderMaterial({
            glslVersion: THREE.GLSL3,
            vertexShader: `in vec3 position;\n${VERTEX}`,
            fragmentShader: FRAGMENT,
            uniforms: {
                maps: { value: this.maps },
                weights: { value: this.weights },
                lights: { value: count },
            },
            depthTest: false,
        });
        const triangle = new THREE.BufferGeometry();
        triangle.setAttribute(
            "position",
            new THREE.Float32BufferAttribute([-1, -1, 0, 3, -1, 0, -1, 3, 0], 3),
        );
        const mesh = new THREE.Mesh(triangle, material);
        mesh.frustumCulled = false;
        this.scene.add(mesh);
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
        renderer.setRenderTarget(this.target);
        renderer.render(this.scene, this.camera);
        renderer.setRenderTarget(null);
    }
}
