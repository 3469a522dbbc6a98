#include "shading/gather.h"

#include "base/parallel.h"
#include "lights/expand.shared.h"
#include "shading/gather.shared.h"

namespace relamp
{
namespace
{

/// Radiance that a ray meets; nothing from lamps, whose light is direct.
glm::vec3 radianceAt(const RadianceField& field, HitTarget target)
{
    const uint32_t surfel = target.side().surfel();
    if (target.side().isBack()) return field.back[surfel];
    if (!target.isClipped()) return field.plain[surfel];
    return field.shines[surfel] != 0 ? glm::vec3(0.0f) : field.clipped[surfel];
}

} // namespace

RadianceField fieldOf(const SurfelRadiance& radiance)
{
    const size_t surfels = radiance.plain.size();
    RadianceField field{.plain = radiance.plain,
                        .clipped = std::vector<glm::vec3>(surfels, glm::vec3(1.0f)),
                        .back = std::vector<glm::vec3>(surfels, glm::vec3(0.0f)),
                        .shines = std::vector<uint8_t>(surfels, 0)};
    for (const ClippedPatch& patch : radiance.clipped) field.clipped[patch.surfel] = patch.radiance;
    return field;
}

Gathered gather(const HitLists& hits, const RadianceField& field, std::span<const uint32_t> lists)
{
    const size_t count = lists.empty() ? hits.sideOfList.size() : lists.size();
    Gathered result;
    result.irradiance.resize(count);
    result.noise.resize(count);
    result.missed.resize(count);
    forEachChunk(count, 256, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            glm::vec3 sum(0.0f);
            float squares = 0.0f;
            float missed = 0.0f;
            const std::span targets = hits.targetsOf(lists.empty() ? i : lists[i]);
            for (const HitTarget target : targets) {
                if (target.isNothing()) {
                    missed += 1.0f;
                    continue;
                }
                const glm::vec3 radiance = radianceAt(field, target);
                sum += radiance;
                squares += luminance(radiance) * luminance(radiance);
            }
            const auto rays = static_cast<float>(targets.size());
            result.noise[i] = noiseOfRays(luminance(sum), squares, rays);
            result.irradiance[i] = irradiancePerRay(rays) * sum;
            result.missed[i] = irradiancePerRay(rays) * missed;
        }
    });
    return result;
}

} // namespace relamp
