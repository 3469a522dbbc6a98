#include "scan/surfels.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr float kReach = 1.75f;     // of neighbours, in surfel sizes
constexpr float kMostStep = 0.6f;   // off the surface, in these
constexpr float kMostLevel = 0.25f; // between levels, likewise: of a bend, the two steps cancel out
constexpr float kSlack = 0.01f;     // for rounding, in these

bool isSameSurface(const Surfels& surfels, size_t a, size_t b)
{
    const glm::vec3 way = surfels.position[b] - surfels.position[a];
    if (surfels.isEnclosed(a) != surfels.isEnclosed(b)) return false;
    const float reach = kReach * surfels.size;
    const float offA = glm::dot(way, surfels.normal[a]);
    const float offB = glm::dot(way, surfels.normal[b]);
    return glm::dot(way, way) < reach * reach &&
           std::max(std::abs(offA), std::abs(offB)) < kMostStep * surfels.size &&
           0.5f * std::abs(offA + offB) < kMostLevel * surfels.size &&
           glm::dot(surfels.normal[a], surfels.normal[b]) > 0.5f;
}

/// Whether a cell, `way` from a surfel to its middle, may hold a neighbour: some of it is near and
/// on the surfel's level. In cells and the grid's frame.
bool mayHoldNeighbor(glm::vec3 normal, glm::vec3 way)
{
    const glm::vec3 atLeast = glm::max(glm::abs(way) - 0.5f, 0.0f);
    const glm::vec3 facing = glm::abs(normal);
    const float halfThickness = 0.5f * (facing.x + facing.y + facing.z);
    return glm::dot(atLeast, atLeast) < kReach * kReach + kSlack &&
           std::abs(glm::dot(way, normal)) < kMostStep + halfThickness + kSlack;
}

} // namespace

bool Surfels::isPartlyEnclosed(size_t surfel) const
{
    const uint64_t enclosed = key[surfel] | static_cast<uint64_t>(SurfelPart::enclosed);
    const size_t end = std::min<size_t>(surfel + SurfelGrid::kParts, count());
    return !isEnclosed(surfel) &&
           std::find(&key[surfel], &key[end - 1] + 1, enclosed) != &key[end - 1] + 1;
}

uint32_t Surfels::find(glm::vec3 place, glm::vec3 facing) const
{
    const uint64_t wanted = grid.keyOf(place, facing);
    const auto [begin, end] = cells[grid.cellOf(place)];
    uint32_t nearest = kNone;
    float leastStep = std::numeric_limits<float>::max();
    for (uint32_t s = begin; s < end; ++s) {
        if (key[s] / SurfelGrid::kParts != wanted / SurfelGrid::kParts) continue;
        const float step = std::abs(glm::dot(place - position[s], normal[s]));
        if (step >= leastStep) continue;
        leastStep = step;
        nearest = s;
    }
    if (nearest != kNone) return nearest;
    float least = 4.0f * size * size;
    forEachInReach(place, [&](size_t s) {
        const glm::vec3 way = position[s] - place;
        // A step off the surface, or a turn, counts as a detour.
        const float off = glm::dot(way, facing);
        const float turned = 1.0f - glm::dot(normal[s], facing);
        const float far = glm::dot(way, way) + 4.0f * off * off + size * size * turned * turned;
        if (far < least) {
            least = far;
            nearest = static_cast<uint32_t>(s);
        }
    });
    return nearest;
}

void connectNeighbors(Surfels& surfels)
{
    const size_t count = surfels.count();
    constexpr size_t kChunk = 1024;
    using Pair = std::pair<uint32_t, uint32_t>;
    std::vector<std::vector<Pair>> found((count + kChunk - 1) / kChunk); // each pair once
    forEachChunk(count, kChunk, [&](size_t begin, size_t end) {
        std::vector<Pair>& pairs = found[begin / kChunk];
        for (size_t s = begin; s < end; ++s) {
            const glm::vec3 normal = surfels.grid.frame().fromScan(surfels.normal[s]);
            surfels.forEachInReach(
                surfels.position[s], surfels.key[s],
                [&](glm::vec3 way) { return mayHoldNeighbor(normal, way); },
                [&](size_t other) {
                    if (other > s && isSameSurface(surfels, s, other))
                        pairs.emplace_back(static_cast<uint32_t>(s), static_cast<uint32_t>(other));
                });
        }
    });
    surfels.firstNeighbor.assign(count + 1, 1); // itself
    surfels.firstNeighbor.back() = 0;
    for (const auto& pairs : found)
        for (const auto& [a, b] : pairs) {
            ++surfels.firstNeighbor[a];
            ++surfels.firstNeighbor[b];
        }
    std::exclusive_scan(surfels.firstNeighbor.begin(), surfels.firstNeighbor.end(),
                        surfels.firstNeighbor.begin(), 0u);
    surfels.neighbor.resize(surfels.firstNeighbor.back());
    std::vector<uint32_t> to = surfels.firstNeighbor;
    for (uint32_t s = 0; s < count; ++s) surfels.neighbor[to[s]++] = s;
    for (const auto& pairs : found)
        for (const auto& [a, b] : pairs) {
            surfels.neighbor[to[a]++] = b;
            surfels.neighbor[to[b]++] = a;
        }
}

} // namespace relamp
