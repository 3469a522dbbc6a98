// Places with directions, as src/output/web_bytes.h packs them.

import shared from "../../../src/scan/site.shared.h";
import { glslFrom } from "./formulas";
import type { Box, Rgb } from "./room";

/** fromOctahedral of src/scan/site.shared.h; x in the lower byte. */
export function directionFrom(word: number): Rgb {
    const x = (word & 255) / 127.5 - 1;
    const y = (word >> 8) / 127.5 - 1;
    const z = 1 - Math.abs(x) - Math.abs(y);
    const fold = Math.max(-z, 0);
    const way: Rgb = [x + (x >= 0 ? -fold : fold), y + (y >= 0 ? -fold : fold), z];
    const length = Math.hypot(...way);
    return way.map((value) => value / length) as Rgb;
}

/** Whether a number of a file can be one of things. */
export function isCount(value: number): boolean {
    return Number.isInteger(value) && value > 0;
}

export function siteFrom(view: DataView, at: number, box: Box): { place: Rgb; normal: Rgb } {
    const place = [0, 1, 2].map(
        (axis) =>
            (box.low[axis] ?? 0) +
            ((box.extent[axis] ?? 0) * view.getUint16(at + 2 * axis, true)) / 65535,
    ) as Rgb;
    return { place, normal: directionFrom(view.getUint16(at + 6, true)) };
}

/** The same of a vertex, whose word comes as a share of 65535. */
export const DIRECTION = `
${glslFrom(shared)}
vec3 directionOf(float share) {
    float word = floor(share * 65535.0 + 0.5);
    float high = floor(word / 256.0);
    return fromOctahedral(vec2(word - 256.0 * high, high) / 127.5 - 1.0);
}
`;
