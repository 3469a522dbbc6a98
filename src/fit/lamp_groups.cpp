#include "fit/lamp_groups.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr float kTilt = 0.03f; // radians; of a small piece's normal

// Numerics.
constexpr size_t kMostParts = 32; // that all families are cut into, for time alone

using Members = std::vector<uint32_t>; // indices of candidates, ascending

/// Sets of alike candidates, each like its largest, so that no chain of small steps joins a panel
/// and a speck.
std::vector<Members> familiesOf(std::span<const Candidate> candidates,
                                std::span<const uint8_t> isGiven)
{
    std::vector<Members> families;
    for (uint32_t c = 0; c < candidates.size(); ++c) {
        if (isGiven[c] != 0 || candidates[c].area < kSpeck) continue;
        const auto family = std::find_if(families.begin(), families.end(), [&](const Members& f) {
            return areAlike(candidates[f.front()], candidates[c]);
        });
        if (family == families.end())
            families.push_back({c});
        else
            family->push_back(c);
    }
    std::erase_if(families, [](const Members& f) { return f.size() == 1; });
    return families;
}

/// Cuts across the longest side of the box around their centres; returns the far half.
Members cutInHalf(std::span<const Candidate> candidates, Members& members)
{
    glm::vec3 least = candidates[members.front()].centre;
    glm::vec3 most = least;
    for (const uint32_t c : members) {
        least = glm::min(least, candidates[c].centre);
        most = glm::max(most, candidates[c].centre);
    }
    const glm::vec3 extent = most - least;
    int axis = extent.x >= extent.y ? 0 : 1;
    if (extent.z > extent[axis]) axis = 2;
    std::stable_sort(members.begin(), members.end(), [&](uint32_t a, uint32_t b) {
        return candidates[a].centre[axis] < candidates[b].centre[axis];
    });
    const auto middle = members.begin() + static_cast<ptrdiff_t>(members.size() / 2);
    Members far(middle, members.end());
    members.erase(middle, members.end());
    std::sort(members.begin(), members.end());
    std::sort(far.begin(), far.end());
    return far;
}

/// Divides the families among neighbours until there are `most` sets.
void divide(std::span<const Candidate> candidates, size_t most, std::vector<Members>& sets)
{
    while (!sets.empty() && sets.size() < most) {
        const auto largest =
            std::max_element(sets.begin(), sets.end(), [](const Members& a, const Members& b) {
                return a.size() < b.size();
            });
        if (largest->size() == 1) break;
        Members far = cutInHalf(candidates, *largest);
        sets.push_back(std::move(far));
    }
}

LampGroup groupOf(std::span<const Candidate> candidates, const Members& members,
                  std::span<const uint8_t> isGiven)
{
    const bool given = isGiven[members.front()] != 0;
    if (members.size() == 1) return {candidates[members.front()], {}, given};
    std::vector<ClippedPatch> patches;
    std::vector<uint32_t> ends;
    for (const uint32_t c : members) {
        const auto& ofOne = candidates[c].patches;
        patches.insert(patches.end(), ofOne.begin(), ofOne.end());
        ends.push_back(static_cast<uint32_t>(patches.size()));
    }
    return {candidateOf(std::move(patches)), std::move(ends), given};
}

} // namespace

bool areOfOneSize(const Candidate& a, const Candidate& b)
{
    return std::max(a.area, b.area) < kAboutEqual * std::min(a.area, b.area);
}

bool areAlike(const Candidate& a, const Candidate& b)
{
    if (!areOfOneSize(a, b) || !isFlat(a) || !isFlat(b)) return false;
    const glm::vec3 normal = glm::normalize(a.normal);
    const glm::vec3 way = b.centre - a.centre;
    return glm::dot(normal, glm::normalize(b.normal)) > kSameFacing &&
           std::abs(glm::dot(way, normal)) < kTouching + kTilt * glm::length(way);
}

LampGroups groupLamps(std::vector<Candidate> candidates, std::span<const uint8_t> isGiven,
                      size_t most)
{
    std::vector<Members> sets;
    if (candidates.size() > most && candidates[most].area > kSpeck)
        sets = familiesOf(candidates, isGiven);
    divide(candidates, std::min(most / 2, kMostParts), sets);
    std::vector<uint8_t> isInSet(candidates.size(), 0);
    for (const Members& set : sets)
        for (const uint32_t c : set) isInSet[c] = 1;
    for (uint32_t c = 0; c < candidates.size(); ++c)
        if (isInSet[c] == 0) sets.push_back({c});

    const auto areaOf = [&](const Members& set) {
        return std::accumulate(set.begin(), set.end(), 0.0f,
                               [&](float sum, uint32_t c) { return sum + candidates[c].area; });
    };
    const auto rank = [&](const Members& set) {
        const bool isRound = !isFlat(candidates[set.front()]);
        return std::tuple(isGiven[set.front()] != 0, isRound, areaOf(set));
    };
    std::stable_sort(sets.begin(), sets.end(),
                     [&](const Members& a, const Members& b) { return rank(a) > rank(b); });
    LampGroups result;
    while (sets.size() > most && isGiven[sets.back().front()] == 0) {
        for (const uint32_t c : sets.back())
            if (candidates[c].area > kSpeck) {
                ++result.leftOut;
                result.areaLeftOut += candidates[c].area;
            }
        sets.pop_back();
    }
    std::sort(sets.begin(), sets.end());
    for (const Members& set : sets) result.groups.push_back(groupOf(candidates, set, isGiven));
    return result;
}

size_t raysToGroup(size_t lamps)
{
    return static_cast<size_t>(std::ceil(std::sqrt(static_cast<double>(lamps))));
}

} // namespace relamp
