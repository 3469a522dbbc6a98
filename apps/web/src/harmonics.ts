// Light from all around in nine spherical harmonics, as src/output/web_harmonics.h has them.

import type { Rgb } from "./room";

export const HARMONICS = 9;

export function harmonicsOf([x, y, z]: Rgb): number[] {
    return [
        0.282095,
        0.488603 * y,
        0.488603 * z,
        0.488603 * x,
        1.092548 * x * y,
        1.092548 * y * z,
        0.315392 * (3 * z * z - 1),
        1.092548 * x * z,
        0.546274 * (x * x - y * y),
    ];
}

/** webDirectionOfRay of src/output/web_probes.h. */
export function directionOfRay(i: number, count: number): Rgb {
    const z = 1 - (2 * i + 1) / count;
    const turn = 2 * Math.PI * ((0.61803398875 * i) % 1);
    const r = Math.sqrt(Math.max(1 - z * z, 0));
    return [r * Math.cos(turn), r * Math.sin(turn), z];
}

/** Irradiance / pi at a place with a normal, between the probes of a lattice. */
export const PROBE_LIGHT = `
uniform highp sampler2D probeLight; // a row for each probe
uniform vec3 probeLow;
uniform float probeSpacing;
uniform ivec3 probeCount;

vec3 probeShading(vec3 place, vec3 n) {
    float basis[${HARMONICS}] = float[${HARMONICS}](
        0.282095,
        0.325735 * n.y, 0.325735 * n.z, 0.325735 * n.x,
        0.273137 * n.x * n.y, 0.273137 * n.y * n.z, 0.078848 * (3.0 * n.z * n.z - 1.0),
        0.273137 * n.x * n.z, 0.1365685 * (n.x * n.x - n.y * n.y));
    vec3 at = clamp((place - probeLow) / probeSpacing, vec3(0.0), vec3(probeCount - 1));
    ivec3 low = ivec3(floor(at));
    vec3 share = at - vec3(low);
    vec3 light = vec3(0.0);
    for (int corner = 0; corner < 8; ++corner) {
        ivec3 step = ivec3(corner & 1, (corner >> 1) & 1, corner >> 2);
        vec3 weights = mix(1.0 - share, share, vec3(step));
        float weight = weights.x * weights.y * weights.z;
        if (weight <= 0.0) continue;
        ivec3 cell = min(low + step, probeCount - 1);
        int row = (cell.z * probeCount.y + cell.y) * probeCount.x + cell.x;
        for (int i = 0; i < ${HARMONICS}; ++i)
            light += weight * basis[i] * texelFetch(probeLight, ivec2(i, row), 0).rgb;
    }
    return max(light, 0.0);
}
`;
