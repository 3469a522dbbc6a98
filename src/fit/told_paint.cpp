#include "fit/told_paint.h"

#include "lights/candidates.h"

#include <optional>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

std::optional<uint32_t> nearestTo(glm::vec3 place, const Surfels& surfels)
{
    std::optional<uint32_t> nearest;
    float least = kPointedAt;
    for (uint32_t s = 0; s < surfels.count(); ++s)
        if (const float way = glm::distance(surfels.position[s], place); way < least) {
            least = way;
            nearest = s;
        }
    return nearest;
}

/// The surfel whose paint can be seen at a place.
std::optional<uint32_t> paintAt(glm::vec3 place, const Surfels& surfels,
                                const SurfelRadiance& radiance, std::vector<std::string>& warnings)
{
    const std::optional<uint32_t> surfel = nearestTo(place, surfels);
    if (surfel && radiance.plainArea[*surfel] > 0.0f && isHardlyBurntOut(radiance, *surfel))
        return surfel;
    const std::string at = fmt::format("{}, {}, {}", place.x, place.y, place.z);
    const std::string what = surfel ? "the scan is burnt out at " + at + " and shows no paint there"
                                    : "no surface is within 30 cm of " + at;
    warnings.push_back(what + ": what was said of its paint was passed over");
    return std::nullopt;
}

} // namespace

ToldPaint toldPaintOf(const GatherOptions& options, const Surfels& surfels,
                      const SurfelRadiance& radiance, std::vector<std::string>& warnings)
{
    ToldPaint told;
    for (const auto& [a, b] : options.same) {
        const auto p = paintAt(a, surfels, radiance, warnings);
        const auto q = paintAt(b, surfels, radiance, warnings);
        if (p && q) told.same.push_back({*p, *q});
    }
    for (const glm::vec3 place : options.white)
        if (const auto p = paintAt(place, surfels, radiance, warnings)) told.white.push_back(*p);
    return told;
}

} // namespace relamp
