// Light as a screen shows it.
#include "image/view_transform.shared.h"

vec3 srgbFromLinear(vec3 linear)
{
    vec3 bright = 1.055 * pow(max(linear, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055;
    return mix(bright, 12.92 * linear, lessThanEqual(linear, vec3(0.0031308)));
}

vec3 shownAs(int view, vec3 light)
{
    if (view == 3) return light;
    vec3 rgb = min(light, vec3(kBrightest));
    if (view == 1) {
        rgb = agxInset(rgb);
        rgb = vec3(agxCurve(agxShare(rgb.r)), agxCurve(agxShare(rgb.g)), agxCurve(agxShare(rgb.b)));
        rgb = pow(clamp(agxOutset(rgb), 0.0, 1.0), vec3(2.2));
    } else if (view == 2) {
        rgb = acesOf(rgb);
    }
    return srgbFromLinear(clamp(rgb, 0.0, 1.0));
}
