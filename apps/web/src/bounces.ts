// How the light of added lamps bounces: between clusters of the room's surface, as
// src/output/web_transport.h writes them, on the GPU.

import * as THREE from "three";

import { ADDED_LIGHT } from "./added_shader";
import type { AddedUniforms } from "./added_shader";
import { Trouble } from "./room";
import type { BouncesOfRoom, Rgb } from "./room";
import { ScreenPass, floatTexture, lightTarget, wordTexture } from "./screen_pass";
import { isCount, siteFrom } from "./sites";

// Of their rays, one that clusters ask in each bounce, as src/relight/follow_bounces.h has it:
// what is to come is ever less, and ever more even. What is left after them is some
// thousandths.
const STEPS = [1, 2, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4];
const COLUMNS = 64; // of textures of clusters

export interface Cluster {
    place: Rgb;
    normal: Rgb;
    albedo: Rgb;
}

export interface Transport {
    clusters: Cluster[];
    fronts: number;
    size: number; // m
    points: { place: Rgb; normal: Rgb }[]; // of clusters, one after the other
    rays: Uint16Array<ArrayBuffer>; // the same; what they met
}

const SITE = 8; // bytes
const CLUSTER = 11;

/** Throws Trouble where the bytes are damaged. */
export function transportFrom(about: BouncesOfRoom, bytes: Uint8Array): Transport {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const count = about.clusters;
    if (![count, about.points, about.rays].every(isCount) || !(about.size > 0)) throw damaged();
    const begin = { points: CLUSTER * count, rays: CLUSTER * count + SITE * count * about.points };
    if (begin.rays + count * about.rays > bytes.length) throw damaged(); // a byte each at least
    const clusters = Array.from({ length: count }, (_, i) => {
        const at = CLUSTER * i;
        const albedo = [8, 9, 10].map((c) => ((bytes[at + c] ?? 0) / 255) ** 2) as Rgb;
        return { ...siteFrom(view, at, about.box), albedo };
    });
    const points = Array.from({ length: count * about.points }, (_, i) =>
        siteFrom(view, begin.points + SITE * i, about.box),
    );
    const rays = new Uint16Array(count * about.rays);
    let at = begin.rays;
    for (let cluster = 0; cluster < count; ++cluster)
        for (let ray = 0, met = 0; ray < about.rays; ++ray) {
            let step = 255;
            while (step === 255) {
                step = bytes[at++] ?? -1;
                met += step;
            }
            if (step < 0 || met > count) throw damaged();
            rays[cluster * about.rays + ray] = met;
        }
    return { clusters, fronts: about.fronts, size: about.size, points, rays };
}

function damaged(): Trouble {
    return new Trouble("bounces.js is damaged; write the page again with relamp page.");
}

const HEAD = `
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp usampler2D;
layout(location = 0) out vec4 result;
const int kColumns = ${COLUMNS};
vec4 of(sampler2D values, int cluster) {
    return texelFetch(values, ivec2(cluster % kColumns, cluster / kColumns), 0);
}
`;

// A place each: what it receives straight from lamps.
const AT_POINTS = `${HEAD}
uniform sampler2D pointPlace;
uniform sampler2D pointNormal;
${ADDED_LIGHT}
void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec3 place = texelFetch(pointPlace, at, 0).xyz;
    vec3 normal = texelFetch(pointNormal, at, 0).xyz;
    result = vec4(addedLight(place, normal, turnOf(gl_FragCoord.xy)), 1.0);
}`;

// A cluster each: the mean of its places.
const START = `${HEAD}
uniform sampler2D atPoints;
uniform int clusters;
void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    int cluster = at.y * kColumns + at.x;
    int points = textureSize(atPoints, 0).x;
    vec3 sum = vec3(0.0);
    if (cluster < clusters)
        for (int i = 0; i < points; ++i) sum += texelFetch(atPoints, ivec2(i, cluster), 0).rgb;
    result = vec4(sum / float(points), 1.0);
}`;

// What a cluster sends of what it receives from lamps and from others; or, at last, what it
// receives from others.
const BOUNCE = `${HEAD}
uniform sampler2D direct;
uniform sampler2D albedo;
uniform sampler2D sent;
uniform usampler2D rays;
uniform int clusters;
uniform int stride;    // of rays, one that is asked; 0: none
uniform bool isLast;
void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    int cluster = at.y * kColumns + at.x;
    if (cluster >= clusters) { // nothing is there, and rays that met nothing read it
        result = vec4(0.0);
        return;
    }
    vec3 received = vec3(0.0);
    if (stride > 0) {
        int count = textureSize(rays, 0).x;
        for (int ray = cluster % stride; ray < count; ray += stride)
            received += of(sent, int(texelFetch(rays, ivec2(ray, cluster), 0).r)).rgb;
        received *= float(stride) / float(count);
    }
    vec3 sends = of(albedo, cluster).rgb * (of(direct, cluster).rgb + received);
    result = vec4(isLast ? received : sends, 1.0);
}`;

export class Bounces {
    /** Of clusters: irradiance / pi by way of surfaces; and what they send in all. */
    readonly received: THREE.WebGLRenderTarget;
    readonly columns = COLUMNS;
    private readonly points: THREE.WebGLRenderTarget;
    private readonly direct: THREE.WebGLRenderTarget;
    private readonly sent: [THREE.WebGLRenderTarget, THREE.WebGLRenderTarget];
    private readonly atPoints: ScreenPass;
    private readonly start: ScreenPass;
    private readonly bounce: ScreenPass;

    constructor(transport: Transport, added: AddedUniforms) {
        const count = transport.clusters.length;
        const perCluster = transport.points.length / count;
        const rows = Math.floor(count / COLUMNS) + 1; // one entry more than there are: nothing
        this.points = lightTarget(perCluster, count);
        this.direct = lightTarget(COLUMNS, rows);
        this.received = lightTarget(COLUMNS, rows);
        this.sent = [lightTarget(COLUMNS, rows), lightTarget(COLUMNS, rows)];
        const sites = (pick: (site: { place: Rgb; normal: Rgb }) => Rgb) => ({
            value: floatTexture(
                rgbaFrom(transport.points.map(pick), perCluster * count),
                perCluster,
                count,
            ),
        });
        this.atPoints = new ScreenPass(AT_POINTS, {
            ...added,
            pointPlace: sites(({ place }) => place),
            pointNormal: sites(({ normal }) => normal),
        });
        this.start = new ScreenPass(START, {
            atPoints: { value: this.points.texture },
            clusters: { value: count },
        });
        const albedo = rgbaFrom(
            transport.clusters.map((cluster) => cluster.albedo),
            COLUMNS * rows,
        );
        this.bounce = new ScreenPass(BOUNCE, {
            direct: { value: this.direct.texture },
            albedo: { value: floatTexture(albedo, COLUMNS, rows) },
            sent: { value: null },
            rays: { value: wordTexture(transport.rays, transport.rays.length / count, count) },
            clusters: { value: count },
            stride: { value: 0 },
            isLast: { value: false },
        });
    }

    /** Follows the light of the lamps that are set. */
    follow(renderer: THREE.WebGLRenderer): void {
        this.atPoints.run(renderer, this.points);
        this.start.run(renderer, this.direct);
        let [from, to] = this.sent;
        for (const stride of [0, ...STEPS]) {
            this.bounceOnce(renderer, from, to, stride, false);
            [from, to] = [to, from];
        }
        this.bounceOnce(renderer, from, this.received, 1, true);
        this.sending = from.texture;
    }

    /** Radiance of clusters, laid out as `received`; null: they send nothing. */
    sending: THREE.Texture | null = null;

    /** There are no lamps. */
    forget(): void {
        this.sending = null;
    }

    private bounceOnce(
        renderer: THREE.WebGLRenderer,
        from: THREE.WebGLRenderTarget,
        to: THREE.WebGLRenderTarget,
        stride: number,
        isLast: boolean,
    ): void {
        const { uniforms } = this.bounce;
        uniforms["sent"]!.value = from.texture;
        uniforms["stride"]!.value = stride;
        uniforms["isLast"]!.value = isLast;
        this.bounce.run(renderer, to);
    }
}

export function rgbaFrom(values: Rgb[], count: number): Float32Array {
    const data = new Float32Array(4 * count);
    values.forEach((value, i) => data.set(value, 4 * i));
    return data;
}
