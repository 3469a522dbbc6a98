// The light of added lamps straight from them, with soft shadows, in GLSL.

import * as THREE from "three";

import { LAMP_RADIUS, MOST_LAMPS } from "./added_lamp";
import { SHADOW_LOOKUP } from "./shadow_tiles";

/**
 * What a place receives of added lamps, over pi. Shadows as in R. Fernando, "Percentage-Closer Soft
 * Shadows", 2005: what is in the way, in the mean, says how wide their edge is.
 */
export const ADDED_LIGHT = `
${SHADOW_LOOKUP}
uniform int lamps;
uniform vec3 lampPlace[${MOST_LAMPS}];
uniform vec3 lampIntensity[${MOST_LAMPS}];
const float kLampRadius = ${LAMP_RADIUS.toFixed(3)};

// Noise whose neighbours differ most: J. Jimenez, "Next generation post processing in Call of
// Duty", 2014.
float turnOf(vec2 pixel) {
    return 6.2831853 * fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715))));
}

// Where a way beside that to a place ends on the place's own plane, as a share of it.
float endOf(vec3 way, vec3 beside, vec3 normal) {
    return clamp(dot(way, normal) / min(dot(beside, normal), -1e-4), 0.8, 1.25);
}

float seenShare(int lamp, vec3 way, vec3 normal, float turn) {
    const int kLooks = 8;
    const int kSamples = 16;
    const mat2 kGolden = mat2(-0.7373688, 0.6754903, -0.6754903, -0.7373688);
    float reach = length(way);
    vec3 ahead = way / reach;
    vec3 other = abs(ahead.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
    vec3 across = normalize(cross(ahead, other));
    vec3 beside = cross(ahead, across);
    float here = 1.0 - 0.012 / reach;
    vec2 spoke = vec2(cos(turn), sin(turn));
    float sum = 0.0;
    float count = 0.0;
    for (int i = 0; i < kLooks; ++i) {
        vec2 at = 2.5 * kLampRadius * sqrt((float(i) + 0.5) / float(kLooks)) * spoke;
        vec3 look = way + at.x * across + at.y * beside;
        float share = shareOfWay(lamp, look) / endOf(way, look, normal);
        if (share < here) { sum += share; count += 1.0; }
        spoke = kGolden * spoke;
    }
    if (count == 0.0) return 1.0;
    if (count == float(kLooks) && sum < 0.9 * count) return 0.0;
    float blocker = sum / count;
    float width = clamp(kLampRadius * (1.0 - blocker) / blocker,
                        2.0 * reach / float(shadowSide), 2.5 * kLampRadius);
    float seen = 0.0;
    for (int i = 0; i < kSamples; ++i) {
        vec2 at = width * sqrt((float(i) + 0.5) / float(kSamples)) * spoke;
        vec3 look = way + at.x * across + at.y * beside;
        if (shareOfWay(lamp, look) >= here * endOf(way, look, normal)) seen += 1.0;
        spoke = kGolden * spoke;
    }
    return seen / float(kSamples);
}

vec3 addedLight(vec3 place, vec3 normal, float turn) {
    vec3 light = vec3(0.0);
    for (int lamp = 0; lamp < lamps; ++lamp) {
        vec3 way = place - lampPlace[lamp];
        float squared = dot(way, way);
        float cosine = -dot(way, normal) / max(sqrt(squared), 1e-6);
        if (cosine <= 0.0 || lampIntensity[lamp] == vec3(0.0)) continue;
        float off = 0.005 + 1.5 * sqrt(squared) / float(shadowSide); // a texel's width
        light += seenShare(lamp, way + off * normal, normal, turn) * cosine /
            max(squared, kLampRadius * kLampRadius) * lampIntensity[lamp];
    }
    return light / 3.14159265;
}
`;

export interface AddedUniforms {
    lamps: { value: number };
    lampPlace: { value: THREE.Vector3[] };
    lampIntensity: { value: THREE.Vector3[] };
    shadowTiles: { value: THREE.Texture | null };
    shadowSide: { value: number };
    [name: string]: { value: unknown };
}

export function addedUniforms(): AddedUniforms {
    const vectors = () => Array.from({ length: MOST_LAMPS }, () => new THREE.Vector3());
    return {
        lamps: { value: 0 },
        lampPlace: { value: vectors() },
        lampIntensity: { value: vectors() },
        shadowTiles: { value: null },
        shadowSide: { value: 1 },
    };
}
