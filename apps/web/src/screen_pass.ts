// One picture computed from others: a fragment shader over all pixels of a target.

import * as THREE from "three";

type Uniforms = Record<string, { value: unknown }>;

export class ScreenPass {
    readonly uniforms: Uniforms;
    private readonly scene = new THREE.Scene();
    private readonly camera = new THREE.Camera();

    constructor(fragmentShader: string, uniforms: Uniforms) {
        this.uniforms = uniforms;
        const material = new THREE.RawShaderMaterial({
            glslVersion: THREE.GLSL3,
            vertexShader:
                "in vec3 position;\nvoid main() { gl_Position = vec4(position.xy, 0.0, 1.0); }",
            fragmentShader,
            uniforms,
            depthTest: false,
            depthWrite: false,
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

    run(renderer: THREE.WebGLRenderer, target: THREE.WebGLRenderTarget): void {
        renderer.setRenderTarget(target);
        renderer.render(this.scene, this.camera);
        renderer.setRenderTarget(null);
    }
}

/** Linear light, in half floats; read by texelFetch unless `isSmooth`. */
export function lightTarget(
    width: number,
    height: number,
    isSmooth = false,
): THREE.WebGLRenderTarget {
    const filter = isSmooth ? THREE.LinearFilter : THREE.NearestFilter;
    return new THREE.WebGLRenderTarget(width, height, {
        type: THREE.HalfFloatType,
        minFilter: filter,
        magFilter: filter,
        depthBuffer: false,
    });
}

/** Rows of `width` numbers of four floats. */
export function floatTexture(data: Float32Array, width: number, height: number): THREE.DataTexture {
    const texture = new THREE.DataTexture(
        data as Float32Array<ArrayBuffer>,
        width,
        height,
        THREE.RGBAFormat,
        THREE.FloatType,
    );
    texture.needsUpdate = true;
    return texture;
}

/** Rows of `width` whole numbers of 16 bits. */
export function wordTexture(
    words: Uint16Array<ArrayBuffer>,
    width: number,
    height: number,
): THREE.DataTexture {
    const texture = new THREE.DataTexture(
        words,
        width,
        height,
        THREE.RedIntegerFormat,
        THREE.UnsignedShortType,
    );
    texture.internalFormat = "R16UI";
    texture.unpackAlignment = 2;
    texture.needsUpdate = true;
    return texture;
}
