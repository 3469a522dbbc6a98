// How a surface of the room looks: as scanned, as albedo, or in the light of the lightmaps.

import * as THREE from "three";

import { ADDED_LIGHT } from "./added_shader";
import type { AddedUniforms } from "./added_shader";
import { VIEW_TRANSFORM } from "./formulas";
import { DIRECTION } from "./sites";

export const VIEWS = { scan: 0, albedo: 1, relit: 2, light: 3 }; // light: linear, for the meter

const VERTEX = `
uniform vec4 uvBox; // low, extent
in float facing;
out vec2 at;
out vec3 place;
out vec3 towards;
${DIRECTION}
void main() {
    place = (modelMatrix * vec4(position, 1.0)).xyz;
    towards = directionOf(facing);
    at = uvBox.xy + uvBox.zw * uv;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

const FRAGMENT = `
precision highp float;
precision highp sampler2D;
uniform sampler2D albedo;
uniform sampler2D scan;
uniform sampler2D shading;  // irradiance / pi of all that is on
uniform sampler2D bounced;  // the same of added lamps, by way of surfaces
uniform sampler2D shining;  // R + 256 G: 1 + the place of the fixture that a texel is of; 0: of none
uniform sampler2D emission; // of fixtures: radiance, and whether it is on
uniform vec3 shiningAlbedo; // shown of all that ever shines
uniform int view;
uniform float exposure;     // that light is multiplied by
in vec2 at;
in vec3 place;
in vec3 towards;
layout(location = 0) out vec4 pixel;
${VIEW_TRANSFORM}
${ADDED_LIGHT}

vec4 emissionOf(ivec2 texel) {
    ivec2 last = textureSize(shining, 0) - 1;
    vec4 id = floor(texelFetch(shining, clamp(texel, ivec2(0), last), 0) * 255.0 + 0.5);
    int place = int(id.r + 256.0 * id.g);
    if (place == 0) return vec4(0.0);
    return view == 1 ? vec4(shiningAlbedo, 1.0) : texelFetch(emission, ivec2(place - 1, 0), 0);
}

// What shines of the four texels around, as a texture would mix them.
vec4 glow() {
    vec2 where = at * vec2(textureSize(shining, 0)) - 0.5;
    ivec2 low = ivec2(floor(where));
    vec2 share = where - vec2(low);
    return mix(mix(emissionOf(low), emissionOf(low + ivec2(1, 0)), share.x),
               mix(emissionOf(low + ivec2(0, 1)), emissionOf(low + ivec2(1, 1)), share.x), share.y);
}

void main() {
    if (view == 0) {
        pixel = vec4(srgbOf(texture(scan, at).rgb), 1.0);
        return;
    }
    vec4 lamp = glow();
    vec3 paint = texture(albedo, at).rgb;
    vec3 light = view == 1 ? vec3(1.0) : texture(shading, at).rgb;
    if (view >= 2 && lamps > 0)
        light += texture(bounced, at).rgb + addedLight(place, normalize(towards), turnOf(gl_FragCoord.xy));
    vec3 radiance = mix(paint * light, vec3(0.0), lamp.a) + lamp.rgb;
    if (view == 3) {
        pixel = vec4(radiance, 1.0);
        return;
    }
    pixel = vec4(srgbOf(view == 1 ? radiance : agxOf(exposure * radiance)), 1.0);
}`;

const SKY = `
precision highp float;
uniform int view;
uniform float exposure;
uniform vec3 sky; // radiance
layout(location = 0) out vec4 pixel;
${VIEW_TRANSFORM}
void main() {
    pixel = vec4(view == 2 ? srgbOf(agxOf(exposure * sky)) : view == 3 ? sky : vec3(0.0), 1.0);
}`;

export interface SurfaceTextures {
    albedo: THREE.Texture | null;
    scan: THREE.Texture | null;
    shading: THREE.Texture;
    bounced: THREE.Texture | null;
    shining: THREE.Texture | null;
    emission: THREE.Texture;
}

const WRAPS: Record<string, THREE.Wrapping> = {
    repeat: THREE.RepeatWrapping,
    mirror: THREE.MirroredRepeatWrapping,
    clamp: THREE.ClampToEdgeWrapping,
};

export function wrappingOf(word: string): THREE.Wrapping {
    return WRAPS[word] ?? THREE.ClampToEdgeWrapping;
}

/** What all surfaces share. */
export interface CommonUniforms {
    view: { value: number };
    exposure: { value: number };
    sky: { value: THREE.Vector3 };
    [name: string]: { value: unknown };
}

export function commonUniforms(): CommonUniforms {
    return {
        view: { value: VIEWS.relit },
        exposure: { value: 1 },
        sky: { value: new THREE.Vector3() },
    };
}

export function surfaceMaterial(
    textures: SurfaceTextures,
    uvBox: number[],
    shiningAlbedo: number[],
    common: CommonUniforms,
    added: AddedUniforms,
): THREE.ShaderMaterial {
    const material = new THREE.ShaderMaterial({
        glslVersion: THREE.GLSL3,
        vertexShader: VERTEX,
        fragmentShader: FRAGMENT,
        uniforms: {
            uvBox: { value: new THREE.Vector4(...uvBox) },
            shiningAlbedo: { value: new THREE.Vector3(...shiningAlbedo) },
        },
    });
    Object.assign(material.uniforms, common, added);
    for (const [name, value] of Object.entries(textures)) material.uniforms[name] = { value };
    return material;
}

/** Of fixtures, what they send now. */
export function emissionTexture(fixtures: number): THREE.DataTexture {
    const count = Math.max(fixtures, 1);
    return new THREE.DataTexture(
        new Float32Array(4 * count),
        count,
        1,
        THREE.RGBAFormat,
        THREE.FloatType,
    );
}

/** What is seen through holes of the scan, behind everything. */
export function beyondHoles(common: CommonUniforms): THREE.Mesh {
    const triangle = new THREE.BufferGeometry();
    triangle.setAttribute(
        "position",
        new THREE.Float32BufferAttribute([-1, -1, 0, 3, -1, 0, -1, 3, 0], 3),
    );
    const material = new THREE.ShaderMaterial({
        glslVersion: THREE.GLSL3,
        vertexShader: "void main() { gl_Position = vec4(position.xy, 1.0, 1.0); }",
        fragmentShader: SKY,
        depthTest: false,
        depthWrite: false,
    });
    Object.assign(material.uniforms, common);
    const mesh = new THREE.Mesh(triangle, material);
    mesh.frustumCulled = false;
    mesh.renderOrder = -1;
    return mesh;
}

/** Backs of surfaces are black. Theirs is the further one where a front and a back meet in an edge. */
export function backMaterial(): THREE.Material {
    return new THREE.MeshBasicMaterial({
        color: 0x000000,
        side: THREE.BackSide,
        polygonOffset: true,
        polygonOffsetFactor: 2,
        polygonOffsetUnits: 2,
    });
}
