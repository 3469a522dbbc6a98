#include "fit/sun_rim.h"

#include "fit/pairs.h"
#include "lights/candidates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr float kAcross = 0.25f; // m; from light to dark, and as far along the rim errs alike

using Cell = std::array<int, 3>;

using Cells = std::map<Cell, std::vector<uint32_t>>; // surfels

Cell cellOf(glm::vec3 place)
{
    const glm::vec3 at = glm::floor(place / kAcross);
    return {static_cast<int>(at.x), static_cast<int>(at.y), static_cast<int>(at.z)};
}

/// All in a cell and the 26 around it.
std::vector<uint32_t> aroundOf(const Cells& cells, const Cell& cell)
{
    std::vector<uint32_t> around;
    for (int i = 0; i < 27; ++i) {
        const auto found =
            cells.find({cell[0] + i % 3 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i / 9 - 1});
        if (found != cells.end())
            around.insert(around.end(), found->second.begin(), found->second.end());
    }
    return around;
}

} // namespace

SunRim::SunRim(const Texels& texels, const SurfelRadiance& radiance, const LampSight& onSides)
{
    const Surfels& surfels = texels.surfels;
    Cells lit;
    Cells dark; // and not burnt out: what is tells nothing of its paint
    for (uint32_t s = 0; s < surfels.count(); ++s) {
        if (onSides[s].open <= 0.0f) continue;
        const bool isLit = onSides[s].visible > 0.5f * onSides[s].open;
        if (isLit || !isMostlyBurntOut(radiance, s))
            (isLit ? lit : dark)[cellOf(surfels.position[s])].push_back(s);
    }
    const auto arePair = [&](uint32_t p, uint32_t q) {
        const glm::vec3 way = surfels.position[q] - surfels.position[p];
        const float across2 = glm::dot(way, way);
        return across2 > kTouching * kTouching && across2 < kAcross * kAcross &&
               areOnOnePlane(surfels, p, q) &&
               (isMostlyBurntOut(radiance, p) ||
                haveOneColor(radiance.plain[p], radiance.plain[q]));
    };
    for (const auto& [cell, ofCell] : lit) {
        const std::vector<uint32_t> around = aroundOf(dark, cell);
        std::vector<MaterialPair> pairs;
        std::vector<uint32_t> others;
        for (const uint32_t p : ofCell) {
            others.clear();
            std::copy_if(around.begin(), around.end(), std::back_inserter(others),
                         [&](uint32_t q) { return arePair(p, q); });
            if (!others.empty()) pairs.push_back({p, others[p % others.size()]});
        }
        if (!pairs.empty()) cells_.push_back(std::move(pairs));
    }
    for (const MaterialPair pair : all()) surfels_.insert(surfels_.end(), {pair.p, pair.q});
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
