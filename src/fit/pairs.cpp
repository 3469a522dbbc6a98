#include "fit/pairs.h"

#include "base/radiometry.shared.h"
#include "lights/candidates.h"
#include "scan/one_room.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace relamp
{
namespace
{

constexpr float kSamePlaneFacing = 0.97f; // cosine
constexpr float kSameColor =
    0.6f; // length of the step in log r, g, b after brightness is taken out
constexpr float kDarkestPaired = 0.004f; // luminance; below, a byte's steps are too coarse

/// Colour without brightness, in logs.
glm::vec3 chromaOf(glm::vec3 radiance)
{
    return glm::log(glm::max(radiance, glm::vec3(kFaintest)) / luminance(radiance));
}

/// What tells whether two places are of one material.
struct PairPlace
{
    glm::vec3 position;
    glm::vec3 normal;
    glm::vec3 chroma;
    bool isDark;
};

std::vector<PairPlace> placesOf(std::span<const glm::vec3> shown, std::span<const uint32_t> surfels,
                                const Surfels& all)
{
    std::vector<PairPlace> places;
    for (size_t i = 0; i < shown.size(); ++i)
        places.push_back({all.position[surfels[i]], all.normal[surfels[i]], chromaOf(shown[i]),
                          luminance(shown[i]) < kDarkestPaired});
    return places;
}

bool areOnOnePlane(glm::vec3 p, glm::vec3 normalOfP, glm::vec3 q, glm::vec3 normalOfQ)
{
    return glm::dot(normalOfP, normalOfQ) >= kSamePlaneFacing &&
           std::abs(glm::dot(q - p, normalOfP)) <= 2.5f * kScanError;
}

bool couldBeOneMaterial(const PairPlace& p, const PairPlace& q)
{
    return !p.isDark && !q.isDark && areOnOnePlane(p.position, p.normal, q.position, q.normal) &&
           glm::distance(p.chroma, q.chroma) < kSameColor;
}

} // namespace

bool areOnOnePlane(const Surfels& surfels, uint32_t p, uint32_t q)
{
    return areOnOnePlane(surfels.position[p], surfels.normal[p], surfels.position[q],
                         surfels.normal[q]);
}

bool haveOneColor(glm::vec3 shownP, glm::vec3 shownQ)
{
    return std::min(luminance(shownP), luminance(shownQ)) >= kDarkestPaired &&
           glm::distance(chromaOf(shownP), chromaOf(shownQ)) < kSameColor;
}

std::vector<MaterialPair> drawPairs(std::span<const glm::vec3> shown,
                                    std::span<const uint32_t> surfels, const Surfels& all,
                                    const RayScene& scene, size_t perPlace)
{
    std::vector<MaterialPair> pairs;
    const std::vector<PairPlace> places = placesOf(shown, surfels, all);
    const auto count = static_cast<uint32_t>(places.size());
    if (count < 2) return pairs;
    std::mt19937 random(
        all.seed); // its raw numbers are the same everywhere; distributions need not be
    for (uint32_t p = 0; p < count; ++p) {
        size_t found = 0;
        for (size_t attempt = 0; attempt < 32 * perPlace && found < perPlace; ++attempt) {
            const uint32_t q = static_cast<uint32_t>(random()) % count;
            if (q == p || !couldBeOneMaterial(places[p], places[q]) ||
                !areInOneRoom(scene, {places[p].position, places[p].normal},
                              {places[q].position, places[q].normal}))
                continue;
            pairs.push_back({p, q});
            ++found;
        }
    }
    return pairs;
}

} // namespace relamp
