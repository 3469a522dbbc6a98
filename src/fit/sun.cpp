#include "fit/sun.h"

#include "base/radiometry.shared.h"
#include "lights/candidates.h"
#include "lights/lamp_body.h"

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr float kGrazing = 0.15f;  // cosine; below, an edge is too far off
constexpr float kBlackest = 0.08f; // albedo of what the sun may shine on; black cloth has 0.04

// Numerics.
constexpr float kFar = 1e4f; // m; a room's size beside it is nothing

} // namespace

std::vector<ClippedPatch> sunDisc(const Sun& sun, const Scan& scan)
{
    const glm::vec3 centre = boundsOf(scan).centre() + kFar * sun.direction;
    std::vector<ClippedPatch> patches = patchedDisc(centre, sun.direction, kFar * kSunHalfAngle);
    for (ClippedPatch& patch : patches) patch.normal = -sun.direction; // it shines back
    return patches;
}

glm::vec3 sunRadiance(const Sun& sun)
{
    return sun.irradiance / sunSolidAngle();
}

std::optional<Ray> rayToSun(glm::vec3 place, glm::vec3 normal, glm::vec3 towards)
{
    if (glm::dot(normal, towards) < kGrazing) return std::nullopt;
    return Ray{place + kScanError * normal, towards};
}

TexelMarks markShade(const Sun& sun, const Texels& texels, const SurfelRadiance& radiance,
                     const LitSides& sides, LampSight& onSides)
{
    const float brightness = luminance(sunRadiance(sun));
    std::vector<uint8_t> isPlainShaded(radiance.plain.size(), 0);
    for (size_t s = 0; s < isPlainShaded.size(); ++s) {
        const float plain = radiance.plainArea[s];
        if (plain <= 0.0f) continue;
        const float sent = kPi * luminance(radiance.plain[s]);
        const float without = luminance(sides.direct[s] + sides.gathered.irradiance[s]);
        AreaSample seen = onSides[s];
        const float with = without + brightness * seen.open;
        const bool isPaintWithout = sent >= kBlackest * without && sent < without;
        if (sent >= kBlackest * with || !isPaintWithout) continue; // black paint is black anyway
        isPlainShaded[s] = 1;
        seen.visible *= 1.0f - plain / (plain + radiance.clippedArea[s]);
        if (seen.open > 0.0f) onSides.set(s, seen);
    }
    TexelMarks marks;
    for (size_t p = 0; p < texels.pages.size(); ++p) {
        const PageTexels& page = texels.pages[p];
        std::vector<uint8_t>& ofPage = marks.emplace_back(page.count(), uint8_t{0});
        for (size_t run = 0; run + 1 < page.runs.size(); ++run)
            for (size_t i = page.runs[run].begin; i < page.runs[run + 1].begin; ++i)
                if (isPlainShaded[page.runs[run].surfel] != 0 &&
                    !radiance.isClipped[p][page.pixel[i]])
                    ofPage[i] = 1;
        texels.letGo(p);
    }
    return marks;
}

} // namespace relamp
