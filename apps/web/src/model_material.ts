// How a model that was dropped onto the page looks in the room's light: matte, by the probes,
// and straight from added lamps.

import * as THREE from "three";

import { ADDED_LIGHT } from "./added_shader";
import { VIEW_TRANSFORM } from "./formulas";
import { PROBE_LIGHT } from "./harmonics";

const VERTEX = `
uniform mat3 mapTurn;
out vec2 at;
out vec3 place;
out vec3 towards;
out vec3 light;
out vec4 paint;
${PROBE_LIGHT}
void main() {
    vec4 world = modelMatrix * vec4(position, 1.0);
    place = world.xyz;
    towards = normalize(mat3(modelMatrix) * normal);
    light = probeShading(place, towards);
    at = (mapTurn * vec3(uv, 1.0)).xy;
#ifdef USE_COLOR_ALPHA
    paint = color;
#elif defined(USE_COLOR)
    paint = vec4(color, 1.0);
#else
    paint = vec4(1.0);
#endif
    gl_Position = projectionMatrix * viewMatrix * world;
}`;

const FRAGMENT = `
precision highp float;
precision highp sampler2D;
uniform sampler2D map;
uniform bool hasMap;
uniform vec4 factor;
uniform vec3 glow;
uniform float leastAlpha;
uniform int view;
uniform float exposure;
in vec2 at;
in vec3 place;
in vec3 towards;
in vec3 light;
in vec4 paint;
layout(location = 0) out vec4 pixel;
${VIEW_TRANSFORM}
${ADDED_LIGHT}
void main() {
    vec4 albedo = factor * paint;
    if (hasMap) albedo *= texture(map, at);
    if (view == 0 || albedo.a < leastAlpha) discard; // a scan does not show it
    vec3 normal = normalize(gl_FrontFacing ? towards : -towards);
    vec3 radiance = albedo.rgb;
    if (view >= 2) {
        vec3 straight = addedLight(place, normal, turnOf(gl_FragCoord.xy));
        radiance = albedo.rgb * (light + straight) + glow;
    }
    vec3 seen = view == 3 ? radiance : srgbOf(view == 1 ? radiance : agxOf(exposure * radiance));
    pixel = vec4(seen, albedo.a);
}`;

type Uniforms = Record<string, { value: unknown }>;

/** `stops` is the room's exposure: what a model sends itself is as bright as its maker saw it. */
export function modelMaterial(
    given: THREE.Material,
    shared: Uniforms,
    stops: number,
): THREE.ShaderMaterial {
    const from = given as THREE.MeshStandardMaterial; // or a basic one, which has some of that
    const glow = new THREE.Vector3();
    if (from.emissive)
        glow.set(from.emissive.r, from.emissive.g, from.emissive.b).multiplyScalar(
            from.emissiveIntensity / 2 ** stops,
        );
    if (from.emissiveMap) glow.set(0, 0, 0); // where it glows is not looked up
    from.map?.updateMatrix();
    const material = new THREE.ShaderMaterial({
        glslVersion: THREE.GLSL3,
        vertexShader: VERTEX,
        fragmentShader: FRAGMENT,
        side: from.side,
        transparent: from.transparent,
        depthWrite: from.depthWrite,
        vertexColors: from.vertexColors,
        uniforms: {
            map: { value: from.map ?? null },
            mapTurn: { value: from.map?.matrix ?? new THREE.Matrix3() },
            hasMap: { value: Boolean(from.map) },
            factor: {
                value: new THREE.Vector4(from.color.r, from.color.g, from.color.b, from.opacity),
            },
            glow: { value: glow },
            leastAlpha: { value: from.alphaTest },
        },
    });
    Object.assign(material.uniforms, shared);
    return material;
}

const SHADE = `
precision highp float;
uniform int view;
in vec2 at;
layout(location = 0) out vec4 pixel;
void main() {
    if (view < 2) discard;
    pixel = vec4(0.0, 0.0, 0.0, 0.5 * (1.0 - smoothstep(0.3, 1.0, length(at))));
}`;

/** Where a model stands the room's own lamps, whose shadows are baked, reach less. */
export function contactShade(view: { value: number }): THREE.Mesh {
    const material = new THREE.ShaderMaterial({
        glslVersion: THREE.GLSL3,
        vertexShader: `
out vec2 at;
void main() {
    at = 2.0 * uv - 1.0;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`,
        fragmentShader: SHADE,
        transparent: true,
        depthWrite: false,
        polygonOffset: true,
        polygonOffsetFactor: -2,
        polygonOffsetUnits: -2,
        uniforms: {},
    });
    material.uniforms["view"] = view;
    const mesh = new THREE.Mesh(new THREE.PlaneGeometry(1, 1).rotateX(-Math.PI / 2), material);
    mesh.renderOrder = 1;
    return mesh;
}
