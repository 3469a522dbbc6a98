#include "scan/surfels.h"

#include "base/parallel.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

/// Spreads 20 bits to every third.
uint64_t spreadBits(uint64_t v)
{
    v &= 0xfffff;
    v = (v | v << 32) & 0x1f00000000ffff;
    v = (v | v << 16) & 0x1f0000ff0000ff;
    v = (v | v << 8) & 0x100f00f00f00f00f;
    v = (v | v << 4) & 0x10c30c30c30c30c3;
    v = (v | v << 2) & 0x1249249249249249;
    return v;
}

uint64_t facingOf(glm::vec3 normal)
{
    const glm::vec3 size = glm::abs(normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return static_cast<uint64_t>(2 * axis + (normal[axis] < 0.0f ? 1 : 0));
}

constexpr float kReach = 1.75f;   // of neighbours, in surfel sizes
constexpr float kMostStep = 0.6f; // off the surface, in these
constexpr float kSlack = 0.01f;   // for rounding, in these

bool isSameSurface(const Surfels& surfels, size_t a, size_t b)
{
    const glm::vec3 way = surfels.position[b] - surfels.position[a];
    if (surfels.isBuried(a) != surfels.isBuried(b)) return false;
    const float reach = kReach * surfels.size;
    const float step = std::max(std::abs(glm::dot(way, surfels.normal[a])),
                                std::abs(glm::dot(way, surfels.normal[b])));
    return glm::dot(way, way) < reach * reach && step < kMostStep * surfels.size &&
           glm::dot(surfels.normal[a], surfels.normal[b]) > 0.5f;
}

/// Whether a cell, `way` from a surfel to its middle, may hold a neighbour: some of it is near and
/// on the surfel's level. In cells.
bool mayHoldNeighbor(glm::vec3 normal, glm::vec3 way)
{
    const glm::vec3 atLeast = glm::max(glm::abs(way) - 0.5f, 0.0f);
    const glm::vec3 facing = glm::abs(normal);
    const float halfThickness = 0.5f * (facing.x + facing.y + facing.z);
    return glm::dot(atLeast, atLeast) < kReach * kReach + kSlack &&
           std::abs(glm::dot(way, normal)) < kMostStep + halfThickness + kSlack;
}

} // namespace

glm::ivec3 SurfelGrid::cellOf(glm::vec3 position) const
{
    const glm::vec3 cell = glm::floor((position - low_) * perMetre_);
    return glm::ivec3(glm::clamp(cell, glm::vec3(0.0f), glm::vec3(kMostCells - 1)));
}

uint64_t SurfelGrid::firstKeyOf(glm::ivec3 cell)
{
    const uint64_t morton = spreadBits(static_cast<uint64_t>(cell.x)) |
                            spreadBits(static_cast<uint64_t>(cell.y)) << 1 |
                            spreadBits(static_cast<uint64_t>(cell.z)) << 2;
    return morton * kFacings;
}

uint64_t SurfelGrid::keyOf(glm::vec3 position, glm::vec3 normal) const
{
    return firstKeyOf(cellOf(position)) + kParts * facingOf(normal);
}

SurfelCells::SurfelCells(std::span<const uint64_t> keys)
    : slots_(std::bit_ceil(2 * keys.size() + 2))
{
    const auto cellKey = [&](size_t i) {
        return keys[i] / SurfelGrid::kFacings * SurfelGrid::kFacings;
    };
    for (size_t begin = 0, end = 0; begin < keys.size(); begin = end) {
        while (end < keys.size() && cellKey(end) == cellKey(begin)) ++end;
        slots_[slotOf(cellKey(begin))] = {
            cellKey(begin), {static_cast<uint32_t>(begin), static_cast<uint32_t>(end)}};
    }
}

size_t SurfelCells::slotOf(uint64_t key) const
{
    const size_t mask = slots_.size() - 1;
    size_t slot = (key / SurfelGrid::kFacings * 0x9e3779b97f4a7c15u >> 20) & mask;
    while (slots_[slot].range.end != 0 && slots_[slot].key != key) slot = (slot + 1) & mask;
    return slot;
}

SurfelCells::Range SurfelCells::operator[](uint64_t firstKey) const
{
    return slots_[slotOf(firstKey)].range;
}

bool Surfels::isPartlyBuried(size_t surfel) const
{
    const uint64_t buried = key[surfel] | static_cast<uint64_t>(SurfelPart::buried);
    const size_t end = std::min<size_t>(surfel + SurfelGrid::kParts, count());
    return !isBuried(surfel) &&
           std::find(&key[surfel], &key[end - 1] + 1, buried) != &key[end - 1] + 1;
}

uint32_t Surfels::find(glm::vec3 place, glm::vec3 facing) const
{
    const uint64_t wanted = grid.keyOf(place, facing);
    const auto [begin, end] = cells[wanted / SurfelGrid::kFacings * SurfelGrid::kFacings];
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
    std::vector<std::vector<uint32_t>> found((count + kChunk - 1) / kChunk);
    surfels.firstNeighbor.assign(count + 1, 0);
    forEachChunk(count, kChunk, [&](size_t begin, size_t end) {
        std::vector<uint32_t>& list = found[begin / kChunk];
        for (size_t s = begin; s < end; ++s) {
            const size_t before = list.size();
            list.push_back(static_cast<uint32_t>(s));
            surfels.forEachInReach(
                surfels.position[s],
                [&](size_t other) {
                    if (other != s && isSameSurface(surfels, s, other))
                        list.push_back(static_cast<uint32_t>(other));
                },
                [&](glm::vec3 way) { return mayHoldNeighbor(surfels.normal[s], way); });
            surfels.firstNeighbor[s + 1] = static_cast<uint32_t>(list.size() - before);
        }
    });
    std::partial_sum(surfels.firstNeighbor.begin(), surfels.firstNeighbor.end(),
                     surfels.firstNeighbor.begin());
    surfels.neighbor.clear();
    surfels.neighbor.reserve(surfels.firstNeighbor.back());
    for (const auto& list : found)
        surfels.neighbor.insert(surfels.neighbor.end(), list.begin(), list.end());
}

} // namespace relamp
