#include "fit/sun_directions.h"

#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "base/sampling.shared.h"
#include "fit/sun.h"
#include "fit/sun_rim.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr float kSeesOut = 0.6f; // share of a patch: the first directions are 3 degrees apart

// Numerics.
constexpr size_t kMostPatches = 8;   // largest; for time alone
constexpr size_t kDirections = 4096; // over the sphere; a window 3 m away moves by its sixth
constexpr size_t kFinalists = 3;     // of each patch, and in the end of all
constexpr size_t kFirstSites = 24;   // of a patch, in the first look; for time alone
constexpr size_t kSites = 400;       // in the last

/// What the light that is known makes of a surfel.
enum class Look : uint8_t { other, dark, bright };

/// Some surfels of many, evenly, that stand for all.
struct Sites
{
    std::vector<uint32_t> surfels;
    float weight = 0.0f; // m^2 that an m^2 of these stands for
    float area = 0.0f;   // m^2 of all
};

Sites someOf(const Surfels& surfels, std::span<const uint32_t> all, size_t most)
{
    Sites sites;
    for (const uint32_t s : all) sites.area += surfels.area[s];
    float chosen = 0.0f;
    const size_t count = std::min(most, all.size());
    for (size_t i = 0; i < count; ++i) {
        sites.surfels.push_back(all[i * all.size() / count]);
        chosen += surfels.area[sites.surfels.back()];
    }
    sites.weight = sites.area / std::max(chosen, 1e-9f);
    return sites;
}

/// A connected piece of surface that is brighter than known light makes it.
struct Patch
{
    std::vector<uint32_t> surfels;
    float area = 0.0f;
};

/// Places of a patch and of all else, from which to look for the sun.
struct View
{
    Sites patch;
    Sites bright; // elsewhere: one sun may throw many patches
    Sites dark;
};

struct Direction
{
    glm::vec3 towards{0.0f, 1.0f, 0.0f};
    float score = 0.0f; // area lit and predicted, of the area that is either; what is lit elsewhere
                        // counts where it is predicted
};

class DirectionSearch
{
public:
    DirectionSearch(const Texels& texels, const RayScene& outside, const SurfelRadiance& radiance,
                    std::span<const float> albedo);

    [[nodiscard]] SunDirections run() const;

private:
    [[nodiscard]] std::vector<Patch> patches() const;
    [[nodiscard]] View viewOf(const Patch& patch, size_t sites) const;
    [[nodiscard]] float areaSeeingOut(const Sites& sites, glm::vec3 towards) const;
    [[nodiscard]] Direction scored(const View& view, glm::vec3 towards) const;
    [[nodiscard]] std::vector<Direction> finalists(const Patch& patch) const;
    [[nodiscard]] Direction climbed(const View& view, Direction best, size_t& tried) const;

    const Surfels& surfels_;
    const RayScene& outside_;
    std::vector<Look> look_;
};

DirectionSearch::DirectionSearch(const Texels& texels, const RayScene& outside,
                                 const SurfelRadiance& radiance, std::span<const float> albedo)
    : surfels_(texels.surfels), outside_(outside), look_(texels.surfels.count())
{
    for (uint32_t s = 0; s < look_.size(); ++s) {
        if (albedo[s] * kWhitestPaper > 1.0f)
            look_[s] = Look::bright;
        else if (!isMostlyBurntOut(radiance, s))
            look_[s] = albedo[s] < kWhitestPaper ? Look::dark : Look::other;
    }
}

std::vector<Patch> DirectionSearch::patches() const
{
    DisjointSets sets(surfels_.count());
    for (uint32_t s = 0; s < look_.size(); ++s)
        for (const uint32_t n : surfels_.neighborsOf(s))
            if (look_[s] == Look::bright && look_[n] == Look::bright) sets.join(s, n);
    std::map<uint32_t, Patch> bySet;
    for (uint32_t s = 0; s < look_.size(); ++s) {
        if (look_[s] != Look::bright) continue;
        Patch& patch = bySet[sets.find(s)];
        patch.surfels.push_back(s);
        patch.area += surfels_.area[s];
    }
    std::vector<Patch> patches;
    for (auto& [set, patch] : bySet)
        if (patch.area >= kSpeck) patches.push_back(std::move(patch));
    std::stable_sort(patches.begin(), patches.end(),
                     [](const Patch& a, const Patch& b) { return a.area > b.area; });
    if (patches.size() > kMostPatches) patches.resize(kMostPatches);
    return patches;
}

View DirectionSearch::viewOf(const Patch& patch, size_t sites) const
{
    std::vector<uint8_t> isOfPatch(look_.size(), 0);
    for (const uint32_t s : patch.surfels) isOfPatch[s] = 1;
    std::vector<uint32_t> bright;
    std::vector<uint32_t> dark;
    for (uint32_t s = 0; s < look_.size(); ++s) {
        if (look_[s] == Look::dark) dark.push_back(s);
        if (look_[s] == Look::bright && isOfPatch[s] == 0) bright.push_back(s);
    }
    return {someOf(surfels_, patch.surfels, sites), someOf(surfels_, bright, sites),
            someOf(surfels_, dark, 4 * sites)};
}

/// Rays of one direction from places side by side are traced together.
float DirectionSearch::areaSeeingOut(const Sites& sites, glm::vec3 towards) const
{
    std::vector<Ray> rays;
    std::vector<float> areas;
    for (const uint32_t s : sites.surfels)
        if (const auto ray = rayToSun(surfels_.position[s], surfels_.normal[s], towards)) {
            rays.push_back(*ray);
            areas.push_back(surfels_.area[s]);
        }
    std::vector<uint8_t> blocked(rays.size());
    outside_.occluded(rays, blocked);
    float area = 0.0f;
    for (size_t i = 0; i < rays.size(); ++i)
        if (blocked[i] == 0) area += areas[i];
    return sites.weight * area;
}

Direction DirectionSearch::scored(const View& view, glm::vec3 towards) const
{
    Direction direction{towards};
    if (towards.y <= 0.0f) return direction;
    const float lit = areaSeeingOut(view.patch, towards);
    if (lit < kSeesOut * view.patch.area) return direction;
    const float bright = areaSeeingOut(view.bright, towards);
    direction.score =
        (lit + bright) / (view.patch.area + bright + areaSeeingOut(view.dark, towards));
    return direction;
}

/// Directions, evenly over the sky, that a look from a few places does not rule out.
std::vector<Direction> DirectionSearch::finalists(const Patch& patch) const
{
    const View view = viewOf(patch, kFirstSites);
    std::vector<Direction> ranked(kDirections);
    forEachChunk(kDirections, 64, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            ranked[i] =
                scored(view, evenDirection(evenPoint(static_cast<float>(i), glm::vec2(0.5f))));
    });
    std::stable_sort(ranked.begin(), ranked.end(),
                     [](const Direction& a, const Direction& b) { return a.score > b.score; });
    ranked.resize(kFinalists);
    std::erase_if(ranked, [](const Direction& d) { return d.score <= 0.0f; });
    return ranked;
}

/// The best direction around, from half the distance of the first ones to a sixteenth of the disc.
Direction DirectionSearch::climbed(const View& view, Direction start, size_t& tried) const
{
    Direction best = scored(view, start.towards);
    float step = std::sqrt(kPi / static_cast<float>(kDirections));
    while (step > kSunHalfAngle / 8.0f) {
        const glm::vec3 side = glm::normalize(
            glm::cross(best.towards,
                       std::abs(best.towards.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1)));
        const glm::vec3 up = glm::cross(side, best.towards);
        std::array<Direction, 8> around;
        forEach(around.size(), [&](size_t k) {
            const float angle = static_cast<float>(k) * kPi / 4.0f;
            around[k] = scored(view, glm::normalize(best.towards + step * (std::cos(angle) * side +
                                                                           std::sin(angle) * up)));
        });
        tried += around.size();
        const Direction& most = *std::max_element(
            around.begin(), around.end(),
            [](const Direction& a, const Direction& b) { return a.score < b.score; });
        if (most.score > best.score)
            best = most;
        else
            step *= 0.5f;
    }
    return best;
}

SunDirections DirectionSearch::run() const
{
    SunDirections found;
    std::vector<Direction> best;
    for (const Patch& patch : patches()) {
        found.tried += kDirections / 2; // are above the horizon
        const std::vector<Direction> starts = finalists(patch);
        if (starts.empty()) continue;
        const View view = viewOf(patch, kSites);
        for (const Direction& start : starts) best.push_back(climbed(view, start, found.tried));
    }
    std::stable_sort(best.begin(), best.end(),
                     [](const Direction& a, const Direction& b) { return a.score > b.score; });
    const auto isKnown = [&](glm::vec3 towards) {
        return std::any_of(found.towards.begin(), found.towards.end(), [&](glm::vec3 other) {
            return glm::distance(towards, other) < kSunHalfAngle;
        });
    };
    for (const Direction& direction : best)
        if (found.towards.size() < kFinalists && direction.score > 0.0f &&
            !isKnown(direction.towards))
            found.towards.push_back(direction.towards);
    return found;
}

} // namespace

SunDirections sunDirections(const Texels& texels, const RayScene& outside,
                            const SurfelRadiance& radiance, std::span<const float> albedo)
{
    return DirectionSearch(texels, outside, radiance, albedo).run();
}

} // namespace relamp
