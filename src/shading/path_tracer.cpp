#include "shading/path_tracer.h"

#include "base/radiometry.shared.h"
#include "base/sampling.shared.h"
#include "scan/surface_point.h"
#include "shading/area_direct.h"
#include "shading/area_direct.shared.h"

#include <algorithm>

namespace relamp
{
namespace
{

constexpr float kGrazing = 1e-4f;    // cosine that a lamp is seen at, at least
constexpr int kSureBounces = 2;      // before chance decides whether a path goes on
constexpr float kMostLikely = 0.95f; // that it does, or it would not end between white walls

glm::vec3 startAt(const TexelSite& place)
{
    return place.position + kOffSurface * place.normal;
}

} // namespace

/// What a ray met.
struct PathTracer::Surface
{
    enum Kind { nothing, lamp, wall };

    Kind kind = nothing;
    TexelSite site{}; // on the side that was met
    uint32_t surfel = 0;
};

PathTracer::Surface PathTracer::surfaceAt(const Ray& ray) const
{
    const Hit hit = scene_.intersect(ray);
    if (hit.missed()) return {};
    const glm::vec3 position = ray.origin + hit.distance * ray.direction;
    const glm::vec3 normal = normalAt(texels_, hit);
    const uint32_t surfel = texels_.surfels.find(position, normal);
    if (surfel == Surfels::kNone) return {};
    const TexelSite site{position, hit.front ? normal : -normal};
    if (hit.front && room_.shines[surfel] != 0) {
        const auto [page, pixel] = nearestPixelAt(texels_, hit);
        if (room_.isClipped[page][pixel]) return {Surface::lamp, site, surfel};
    }
    return {Surface::wall, site, surfel};
}

/// Radiance that a white surface at `place` shows of the lamps, by one point on them.
glm::vec3 PathTracer::fromLamps(const TexelSite& place, float share) const
{
    if (room_.lamps.isDark()) return glm::vec3(0.0f);
    const auto [texel, area] = room_.lamps.at(share);
    const glm::vec3 origin = startAt(place);
    const glm::vec3 way = texel.position - origin;
    const float received = area * patchFormFactor(way, place.normal, texel.normal, texel.area);
    if (received <= 0.0f) return glm::vec3(0.0f);
    const float distance = glm::length(way);
    const glm::vec3 direction = way / distance;
    if (scene_.occluded({.origin = origin,
                         .direction = direction,
                         .farthest = std::max(distance - kOffLamp, 0.0f)}))
        return glm::vec3(0.0f);
    if (!texel.isOfScan) return received / kPi * texel.radiance; // no other way finds it
    const float byChance = glm::dot(direction, place.normal) / kPi;
    const float byPoint =
        distance * distance / (area * std::max(-glm::dot(direction, texel.normal), kGrazing));
    return byChance / (byChance + byPoint) * texel.radiance;
}

glm::vec3 PathTracer::fromUnseen(const TexelSite& place, Random& random) const
{
    return room_.unseenLights ? room_.unseenLights(place, random) : glm::vec3(0.0f);
}

/// The same by a ray that met one by chance.
glm::vec3 PathTracer::metLamp(const TexelSite& place, const Surface& lamp) const
{
    const glm::vec3 radiance = room_.emission[lamp.surfel];
    const glm::vec3 way = lamp.site.position - startAt(place);
    const float distance = std::max(glm::length(way), kOffSurface);
    const float facing = -glm::dot(way, lamp.site.normal) / distance;
    if (facing <= 0.0f || room_.lamps.isDark()) return glm::vec3(0.0f);
    const float byChance = std::max(glm::dot(way, place.normal), 0.0f) / (distance * kPi);
    const float byPoint =
        room_.lamps.density(radiance) * distance * distance / std::max(facing, kGrazing);
    return byChance / (byChance + byPoint) * radiance;
}

/// Adds what one path finds that leaves `place` in the direction that `first` chooses among all
/// with the density cos / pi.
void PathTracer::follow(TexelSite place, glm::vec2 first, Random& random, TracedShading& sum) const
{
    glm::vec3 carried(1.0f); // of what is found next, how much reaches the start
    glm::vec2 u = first;
    for (int bounce = 0;; ++bounce) {
        const glm::vec3 direction = cosineDirection(place.normal, u);
        const Surface met = surfaceAt({.origin = startAt(place), .direction = direction});
        if (met.kind == Surface::nothing) {
            const glm::vec3 share = room_.outside ? room_.outside(direction) : glm::vec3(1.0f);
            sum.indirect += carried * room_.ambient * share;
            return;
        }
        if (met.kind == Surface::lamp) {
            (bounce == 0 ? sum.direct : sum.indirect) += carried * metLamp(place, met);
            return;
        }
        carried *= room_.albedo[met.surfel];
        place = met.site;
        if (bounce >= kSureBounces) {
            const float likely =
                std::min({std::max({carried.r, carried.g, carried.b}), kMostLikely});
            if (random.next() >= likely) return;
            carried /= likely; // who goes on goes for those who do not
        }
        sum.indirect += carried * fromLamps(place, random.next());
        sum.indirect += carried * fromUnseen(place, random);
        u = {random.next(), random.next()};
    }
}

TracedShading PathTracer::shade(const TexelSite& site, size_t paths, Random random) const
{
    const auto count = static_cast<float>(paths);
    const glm::vec2 shift{random.next(), random.next()}; // braces: in this order everywhere
    TracedShading sum;
    for (size_t i = 0; i < paths; ++i) {
        // Strata over the lamps' power, and an even sequence over the directions, shifted at
        // random: each point alone lies anywhere, all together lie evenly.
        const auto at = static_cast<float>(i);
        sum.direct += fromLamps(site, (at + random.next()) / count);
        sum.direct += fromUnseen(site, random);
        follow(site, evenPoint(at, shift), random, sum);
    }
    return {sum.direct / count, sum.indirect / count};
}

} // namespace relamp
