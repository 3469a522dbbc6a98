// The view transform is one text for the program and for the browser: src/image/view_transform.shared.h.

import shared from "../../../src/image/view_transform.shared.h";

/** GLSL ES 3 of a shared header: its macros undone, and no constant that is none there. */
export function glslFrom(header: string): string {
    return header
        .replace(/^\s*#.*$/gm, "")
        .replace(/^SHARED_(BEGIN|END)$/gm, "")
        .replace(/\bconst (float|vec[234]) /g, "$1 ")
        .replace(/\bSHARED_CONST\b/g, "const float")
        .replace(/\bSHARED_FN\b/g, "")
        .trim();
}

export const VIEW_TRANSFORM = `${glslFrom(shared)}

// As ViewTransform::displayed with View::agx: linear 0..1 of linear light.
vec3 agxOf(vec3 light) {
    vec3 rgb = agxInset(min(light, vec3(kBrightest)));
    rgb = vec3(agxCurve(agxShare(rgb.r)), agxCurve(agxShare(rgb.g)), agxCurve(agxShare(rgb.b)));
    return pow(clamp(agxOutset(rgb), 0.0, 1.0), vec3(2.2));
}

vec3 srgbOf(vec3 linear) {
    vec3 rgb = clamp(linear, 0.0, 1.0);
    return mix(12.92 * rgb, 1.055 * pow(rgb, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, rgb));
}
`;
