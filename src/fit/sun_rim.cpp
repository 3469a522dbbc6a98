#include "fit/sun_rim.h"

#include "fit/pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr float kAcross = 0.25f;     // m; from light to dark, and as far along the rim errs alike
constexpr float kLeastAcross = 0.1f; // m; twice what a reconstruction moves an edge

using Cell = std::array<int, 3>;

Cell cellOf(glm::vec3 place)
{
    const glm::vec3 at = glm::floor(place / kAcross);
    return {static_cast<int>(at.x), static_cast<int>(at.y), static_cast<int>(at.z)};
}

} // namespace

SunRim::SunRim(const Texels& texels, const SurfelRadiance& radiance,
               std::span<const AreaSample> onSides)
{
    const Surfels& surfels = texels.surfels;
    std::map<Cell, std::vector<uint32_t>> lit;
    std::map<Cell, std::vector<uint32_t>> dark;
    for (uint32_t s = 0; s < surfels.count(); ++s) {
        if (onSides[s].open <= 0.0f) continue;
        const bool isLit = onSides[s].visible > 0.5f * onSides[s].open;
        if (isLit || !isMostlyBurntOut(radiance, s))
            (isLit ? lit : dark)[cellOf(surfels.position[s])].push_back(s);
    }
    const auto arePair = [&](uint32_t p, uint32_t q) {
        const float across = glm::distance(surfels.position[p], surfels.position[q]);
        return across > kLeastAcross && across < kAcross && areOnOnePlane(surfels, p, q) &&
               (isMostlyBurntOut(radiance, p) ||
                haveOneColor(radiance.plain[p], radiance.plain[q]));
    };
    for (const auto& [cell, ofCell] : lit) {
        std::vector<MaterialPair> pairs;
        for (const uint32_t p : ofCell) {
            std::vector<uint32_t> others;
            for (int i = 0; i < 27; ++i) {
                const auto found =
                    dark.find({cell[0] + i % 3 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i / 9 - 1});
                if (found == dark.end()) continue;
                for (const uint32_t q : found->second)
                    if (arePair(p, q)) others.push_back(q);
            }
            if (!others.empty()) pairs.push_back({p, others[p % others.size()]});
        }
        if (pairs.empty()) continue;
        for (const MaterialPair pair : pairs) surfels_.insert(surfels_.end(), {pair.p, pair.q});
        cells_.push_back(std::move(pairs));
    }
    std::sort(surfels_.begin(), surfels_.end());
    surfels_.erase(std::unique(surfels_.begin(), surfels_.end()), surfels_.end());
}

std::vector<MaterialPair> SunRim::pairs(size_t perCell, uint32_t first) const
{
    const auto rowOf = [&](uint32_t surfel) {
        const auto at = std::lower_bound(surfels_.begin(), surfels_.end(), surfel);
        return first + static_cast<uint32_t>(at - surfels_.begin());
    };
    std::vector<MaterialPair> pairs;
    for (const std::vector<MaterialPair>& cell : cells_)
        for (size_t k = 0; k < perCell; ++k) {
            const MaterialPair pair = cell[k * cell.size() / perCell]; // some again, if few
            pairs.push_back({rowOf(pair.p), rowOf(pair.q)});
        }
    return pairs;
}

std::vector<MaterialPair> SunRim::all() const
{
    std::vector<MaterialPair> all;
    for (const std::vector<MaterialPair>& cell : cells_)
        all.insert(all.end(), cell.begin(), cell.end());
    return all;
}

} // namespace relamp
