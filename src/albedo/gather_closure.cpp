#include "albedo/gather_closure.h"
#include "base/radiometry.shared.h"

#include <cmath>

namespace relamp
{
namespace
{

constexpr int kBounces = 6; // a room's walls keep about half at each

/// What all sides send out once light has bounced about on the albedo.
RadianceField bounced(const HitLists& hits, const LitSides& sides)
{
    RadianceField field = sides.field;
    for (int bounce = 0; bounce < kBounces; ++bounce) {
        const Gathered gathered = gather(hits, field);
        for (size_t list = 0; list < hits.sideOfList.size(); ++list) {
            const Side side = hits.sideOfList[list];
            const glm::vec3 irradiance = sides.direct[list] + gathered.irradiance[list];
            const glm::vec3 leaving = sides.albedo[side.surfel()] * irradiance / kPi;
            if (side.isBack())
                field.back[side.surfel()] = leaving;
            else
                field.plain[side.surfel()] = field.clipped[side.surfel()] = leaving;
        }
    }
    return field;
}

} // namespace

Closure closeLoop(const HitLists& hits, const SurfelRadiance& radiance, const LitSides& sides)
{
    return closureOf(radiance, bounced(hits, sides).plain);
}

Closure closureOf(const SurfelRadiance& radiance, std::span<const glm::vec3> again)
{
    double error = 0.0;
    double input = 0.0;
    double area = 0.0;
    for (size_t s = 0; s < radiance.plain.size(); ++s) {
        const float weight = radiance.plainArea[s];
        const glm::vec3 difference = again[s] - radiance.plain[s];
        error += static_cast<double>(weight * glm::dot(difference, difference) / 3.0f);
        input +=
            static_cast<double>(weight * glm::dot(radiance.plain[s], radiance.plain[s]) / 3.0f);
        area += static_cast<double>(weight);
    }
    if (area <= 0.0) return {};
    return {static_cast<float>(std::sqrt(error / area)),
            static_cast<float>(std::sqrt(input / area))};
}

} // namespace relamp
