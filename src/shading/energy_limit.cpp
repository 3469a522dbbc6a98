#include "shading/energy_limit.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"

#include <algorithm>
#include <limits>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr float kNearestCamera = 0.15f; // m; no phone is in focus nearer
constexpr float kSlit = 0.2f;           // of directions: through less no camera looks

/// Whether hardly a ray of its front goes as far as a camera would have to be away.
bool isHidden(const Surfels& surfels, const HitLists& hits, uint32_t surfel)
{
    const std::span targets = hits.targetsOf(surfel); // the first lists are those of fronts
    float far = kSlit * static_cast<float>(targets.size());
    for (const HitTarget target : targets) {
        const bool isNear =
            !target.isNothing() && glm::distance(surfels.position[target.side().surfel()],
                                                 surfels.position[surfel]) < kNearestCamera;
        if (!isNear && (far -= 1.0f) < 0.0f) return false;
    }
    return true;
}

} // namespace

std::vector<float> energyLimit(const Surfels& surfels, const HitLists& hits, const LitSides& sides)
{
    std::vector<float> received(surfels.count());
    forEach(received.size(), [&](size_t s) {
        received[s] = luminance(sides.direct[s] + sides.gathered.irradiance[s]);
    });
    std::vector<float> limit(surfels.count(), std::numeric_limits<float>::max());
    forEach(limit.size(), [&](size_t s) {
        if (!isHidden(surfels, hits, static_cast<uint32_t>(s))) return;
        float most = 0.0f; // around it: direct light of few rays misses the edge of a shadow
        for (const uint32_t n : surfels.neighborsOf(s)) most = std::max(most, received[n]);
        limit[s] = kWhitestPaper * most / kPi;
    });
    return limit;
}

} // namespace relamp
