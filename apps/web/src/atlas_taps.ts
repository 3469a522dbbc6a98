// Which clusters lie around each texel of a lightmap, and what light these bring it.

import * as THREE from "three";

import type { Bounces, Transport } from "./bounces";
import { rgbaFrom } from "./bounces";
import { ClusterCells } from "./cluster_cells";
import { ScreenPass, floatTexture, lightTarget } from "./screen_pass";
import { DIRECTION } from "./sites";

const VERTEX = `
uniform vec4 uvBox; // low, extent
uniform vec2 shift; // of textures that repeat
in float facing;
out vec3 place;
out vec3 towards;
${DIRECTION}
void main() {
    place = (modelMatrix * vec4(position, 1.0)).xyz;
    towards = directionOf(facing);
    gl_Position = vec4(2.0 * (uvBox.xy + uvBox.zw * uv - shift) - 1.0, 0.0, 1.0);
}`;

// The eight that count most, sixteen bits of its number and sixteen of its weight each. Weights
// as src/relight/light_probes.cpp has them.
const FIND = `
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp usampler2D;
uniform sampler2D clusterPlace;
uniform sampler2D clusterNormal;
uniform usampler2D cells;   // where in the list a cell begins, and how many it has
uniform usampler2D members;
uniform vec3 cellsLow;
uniform ivec3 cellsCount;
uniform float cellSize;
uniform float reach;
in vec3 place;
in vec3 towards;
layout(location = 0) out uvec4 first;
layout(location = 1) out uvec4 second;

uvec4 at(usampler2D list, int i) {
    int width = textureSize(list, 0).x;
    return texelFetch(list, ivec2(i % width, i / width), 0);
}
vec3 at(sampler2D list, int i) {
    int width = textureSize(list, 0).x;
    return texelFetch(list, ivec2(i % width, i / width), 0).xyz;
}

void main() {
    vec3 facing = normalize(towards);
    ivec3 cell = clamp(ivec3(floor((place - cellsLow) / cellSize)), ivec3(0), cellsCount - 1);
    uvec2 range = at(cells, (cell.z * cellsCount.y + cell.y) * cellsCount.x + cell.x).xy;
    float weight[8];
    uint cluster[8];
    for (int k = 0; k < 8; ++k) { weight[k] = 0.0; cluster[k] = 0u; }
    for (uint i = range.x; i < range.x + range.y; ++i) {
        uint one = at(members, int(i)).r;
        vec3 way = at(clusterPlace, int(one)) - place;
        float share = max(1.0 - dot(way, way) / (reach * reach), 0.0);
        float alike = max(dot(facing, at(clusterNormal, int(one))), 0.0);
        float value = share * share * (alike * alike * alike * alike + 1e-4);
        if (value <= weight[7]) continue;
        weight[7] = value;
        cluster[7] = one;
        for (int k = 7; k > 0; --k)
            if (weight[k] > weight[k - 1]) {
                float w = weight[k]; weight[k] = weight[k - 1]; weight[k - 1] = w;
                uint c = cluster[k]; cluster[k] = cluster[k - 1]; cluster[k - 1] = c;
            }
    }
    float sum = 0.0;
    for (int k = 0; k < 8; ++k) sum += weight[k];
    uint packed[8];
    for (int k = 0; k < 8; ++k)
        packed[k] = cluster[k] << 16 | uint(65535.0 * weight[k] / max(sum, 1e-20) + 0.5);
    first = uvec4(max(packed[0], 1u), packed[1], packed[2], packed[3]);
    second = uvec4(packed[4], packed[5], packed[6], packed[7]);
}`;

const TAPS_IN = `
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp usampler2D;
uniform usampler2D firstTaps;
uniform usampler2D secondTaps;
`;

const CLEAR = `precision highp float;
precision highp int;
layout(location = 0) out uvec4 first;
layout(location = 1) out uvec4 second;
void main() { first = uvec4(0u); second = uvec4(0u); }`;

// A texel that no surface covers has what its neighbour has.
const SPREAD = `${TAPS_IN}
layout(location = 0) out uvec4 first;
layout(location = 1) out uvec4 second;
void main() {
    ivec2 here = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(firstTaps, 0) - 1;
    ivec2 from = here;
    for (int i = 0; i < 9 && texelFetch(firstTaps, from, 0).x == 0u; ++i)
        from = clamp(here + ivec2(i % 3, i / 3) - 1, ivec2(0), last);
    first = texelFetch(firstTaps, from, 0);
    second = texelFetch(secondTaps, from, 0);
}`;

const LIGHT = `${TAPS_IN}
uniform sampler2D received;
layout(location = 0) out vec4 light;
vec3 tap(uint word) {
    int cluster = int(word >> 16);
    int columns = textureSize(received, 0).x;
    ivec2 at = ivec2(cluster % columns, cluster / columns);
    return float(word & 65535u) / 65535.0 * texelFetch(received, at, 0).rgb;
}
void main() {
    uvec4 a = texelFetch(firstTaps, ivec2(gl_FragCoord.xy), 0);
    uvec4 b = texelFetch(secondTaps, ivec2(gl_FragCoord.xy), 0);
    light = vec4(tap(a.x) + tap(a.y) + tap(a.z) + tap(a.w), 1.0);
    light.rgb += tap(b.x) + tap(b.y) + tap(b.z) + tap(b.w);
}`;

function tapTarget(width: number, height: number): THREE.WebGLRenderTarget {
    const target = new THREE.WebGLRenderTarget(width, height, {
        count: 2,
        format: THREE.RGBAIntegerFormat,
        type: THREE.UnsignedIntType,
        internalFormat: "RGBA32UI",
        minFilter: THREE.NearestFilter,
        magFilter: THREE.NearestFilter,
        depthBuffer: false,
    });
    return target;
}

/** The uniforms of FIND that are of the room. */
export function cellUniforms(transport: Transport): Record<string, { value: unknown }> {
    const reach = 1.5 * transport.size;
    const cells = new ClusterCells(transport, reach);
    const count = transport.clusters.length;
    const list = (pick: "place" | "normal") => ({
        value: floatTexture(
            rgbaFrom(
                transport.clusters.map((cluster) => cluster[pick]),
                count,
            ),
            count,
            1,
        ),
    });
    return {
        clusterPlace: list("place"),
        clusterNormal: list("normal"),
        ...cells.uniforms(),
        reach: { value: reach },
    };
}

/** Light that came by way of surfaces, on the lightmap of one page. */
export class AtlasTaps {
    readonly light: THREE.WebGLRenderTarget;
    private readonly taps: THREE.WebGLRenderTarget;
    private readonly sum: ScreenPass;

    /** `surfaces` are the meshes of the page with the box of their texture coordinates. */
    constructor(
        renderer: THREE.WebGLRenderer,
        surfaces: { mesh: THREE.Mesh; uvBox: number[] }[],
        room: Record<string, { value: unknown }>,
        bounces: Bounces,
        size: { width: number; height: number },
    ) {
        const { width, height } = size;
        this.light = lightTarget(width, height, true);
        this.taps = tapTarget(width, height);
        const other = tapTarget(width, height);
        new ScreenPass(CLEAR, {}).run(renderer, this.taps);
        const scene = new THREE.Scene();
        for (const { mesh, uvBox } of surfaces) addSurface(scene, mesh, uvBox, room);
        renderer.setRenderTarget(this.taps);
        renderer.render(scene, new THREE.Camera());
        renderer.setRenderTarget(null);
        const words = {
            firstTaps: { value: this.taps.textures[0] },
            secondTaps: { value: this.taps.textures[1] },
        };
        const others = {
            firstTaps: { value: other.textures[0] },
            secondTaps: { value: other.textures[1] },
        };
        new ScreenPass(SPREAD, words).run(renderer, other);
        new ScreenPass(SPREAD, others).run(renderer, this.taps);
        other.dispose();
        this.sum = new ScreenPass(LIGHT, {
            ...words,
            received: { value: bounces.received.texture },
        });
    }

    update(renderer: THREE.WebGLRenderer): void {
        this.sum.run(renderer, this.light);
    }
}

const MOST_REPEATS = 4; // of a texture, along u and v, that are drawn

function addSurface(
    scene: THREE.Scene,
    mesh: THREE.Mesh,
    uvBox: number[],
    room: Record<string, { value: unknown }>,
): void {
    const [lowU = 0, lowV = 0, wide = 1, high = 1] = uvBox;
    const places = (low: number, extent: number) => {
        const first = Math.floor(low + 1e-4);
        const last = Math.max(first, Math.ceil(low + extent - 1e-4) - 1);
        return Array.from(
            { length: Math.min(last - first + 1, MOST_REPEATS) },
            (_, i) => first + i,
        );
    };
    for (const u of places(lowU, wide))
        for (const v of places(lowV, high)) {
            const material = new THREE.ShaderMaterial({
                glslVersion: THREE.GLSL3,
                vertexShader: VERTEX,
                fragmentShader: FIND,
                side: THREE.DoubleSide,
                depthTest: false,
                depthWrite: false,
            });
            Object.assign(material.uniforms, room, {
                uvBox: { value: new THREE.Vector4(lowU, lowV, wide, high) },
                shift: { value: new THREE.Vector2(u, v) },
            });
            const drawn = new THREE.Mesh(mesh.geometry, material);
            drawn.frustumCulled = false;
            drawn.matrixAutoUpdate = false;
            drawn.matrix.copy(mesh.matrix);
            drawn.updateMatrixWorld(true);
            scene.add(drawn);
        }
}
