// The shader's view transform on numbers, for page_test.mjs: asked for in a browser, answered by its GPU.

import * as THREE from "three";

import { VIEW_TRANSFORM } from "../src/formulas";

const FRAGMENT = `
precision highp float;
precision highp sampler2D;
uniform sampler2D lights;
layout(location = 0) out vec4 shown;
${VIEW_TRANSFORM}
void main() { shown = vec4(agxOf(texelFetch(lights, ivec2(gl_FragCoord.xy), 0).rgb), 1.0); }`;

/** AgX of each of `lights`, linear 0..1. */
function agxOnGpu(lights: number[][]): number[][] {
    const count = lights.length;
    const input = new THREE.DataTexture(
        new Float32Array(lights.flatMap((rgb) => [...rgb, 1])),
        count,
        1,
        THREE.RGBAFormat,
        THREE.FloatType,
    );
    input.needsUpdate = true;
    const triangle = new THREE.BufferGeometry();
    triangle.setAttribute(
        "position",
        new THREE.Float32BufferAttribute([-1, -1, 0, 3, -1, 0, -1, 3, 0], 3),
    );
    const mesh = new THREE.Mesh(
        triangle,
        new THREE.RawShaderMaterial({
            glslVersion: THREE.GLSL3,
            vertexShader: "in vec3 position; void main() { gl_Position = vec4(position, 1.0); }",
            fragmentShader: FRAGMENT,
            uniforms: { lights: { value: input } },
            depthTest: false,
        }),
    );
    mesh.frustumCulled = false;
    const scene = new THREE.Scene();
    scene.add(mesh);
    const target = new THREE.WebGLRenderTarget(count, 1, { type: THREE.FloatType });
    const renderer = new THREE.WebGLRenderer();
    renderer.setRenderTarget(target);
    renderer.render(scene, new THREE.Camera());
    const shown = new Float32Array(4 * count);
    renderer.readRenderTargetPixels(target, 0, 0, count, 1, shown);
    return lights.map((_, i) => [...shown.subarray(4 * i, 4 * i + 3)]);
}

(window as unknown as { agxOnGpu: typeof agxOnGpu }).agxOnGpu = agxOnGpu;
