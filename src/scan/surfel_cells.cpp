#include "scan/surfel_cells.h"

#include <array>

#include <glm/common.hpp>

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

uint64_t mortonOf(glm::ivec3 place)
{
    return spreadBits(static_cast<uint64_t>(place.x)) |
           spreadBits(static_cast<uint64_t>(place.y)) << 1 |
           spreadBits(static_cast<uint64_t>(place.z)) << 2;
}

uint64_t facingOf(glm::vec3 normal)
{
    const glm::vec3 size = glm::abs(normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return static_cast<uint64_t>(2 * axis + (normal[axis] < 0.0f ? 1 : 0));
}

/// For each axis, the bits of a brick's cells, by Morton code, whose place along it is below 0
/// to 4.
constexpr std::array<std::array<uint64_t, 5>, 3> kBelow = [] {
    std::array<std::array<uint64_t, 5>, 3> below{};
    for (uint64_t cell = 0; cell < 64; ++cell)
        for (uint64_t axis = 0; axis < 3; ++axis)
            for (uint64_t at = (cell >> axis & 1) + 2 * (cell >> (axis + 3) & 1); at < 4; ++at)
                below[axis][at + 1] |= uint64_t{1} << cell;
    return below;
}();

} // namespace

glm::ivec3 SurfelGrid::cellOf(glm::vec3 position) const
{
    const glm::vec3 cell = glm::floor(inCells(position));
    return glm::ivec3(glm::clamp(cell, glm::vec3(0.0f), glm::vec3(kMostCells - 1)));
}

uint64_t SurfelGrid::firstKeyOf(glm::ivec3 cell)
{
    return mortonOf(cell) * kFacings;
}

uint64_t SurfelGrid::keyOf(glm::vec3 position, glm::vec3 normal) const
{
    return firstKeyOf(cellOf(position)) + kParts * facingOf(frame_.fromScan(normal));
}

SurfelCells::SurfelCells(std::span<const uint64_t> keys) : bricks_(std::bit_ceil(keys.size() + 2))
{
    uint64_t last = ~uint64_t{0};
    for (size_t i = 0; i < keys.size(); ++i) {
        const uint64_t cell = keys[i] / SurfelGrid::kFacings;
        if (cell == last) continue;
        last = cell;
        Brick& brick = bricks_[slotOf(cell / kCells)];
        if (brick.filled == 0) brick = {cell / kCells, 0, static_cast<uint32_t>(begins_.size())};
        brick.filled |= uint64_t{1} << cell % kCells;
        begins_.push_back(static_cast<uint32_t>(i));
    }
    begins_.push_back(static_cast<uint32_t>(keys.size()));
}

size_t SurfelCells::slotOf(uint64_t key) const
{
    const size_t mask = bricks_.size() - 1;
    size_t slot = (key * 0x9e3779b97f4a7c15u >> 20) & mask;
    while (bricks_[slot].filled != 0 && bricks_[slot].key != key) slot = (slot + 1) & mask;
    return slot;
}

uint64_t SurfelCells::keyOfBrick(glm::ivec3 brick)
{
    return mortonOf(brick);
}

SurfelCells::Range SurfelCells::rangeOf(const Brick& brick, uint64_t cell) const
{
    const uint64_t before = brick.filled & ((uint64_t{1} << cell) - 1);
    const size_t at = brick.first + static_cast<size_t>(std::popcount(before));
    return {begins_[at], begins_[at + 1]};
}

SurfelCells::Range SurfelCells::operator[](glm::ivec3 cell) const
{
    const uint64_t morton = mortonOf(cell);
    const Brick& brick = bricks_[slotOf(morton / kCells)];
    if ((brick.filled >> morton % kCells & 1) == 0) return {};
    return rangeOf(brick, morton % kCells);
}

uint64_t SurfelCells::boxOf(glm::ivec3 low, glm::ivec3 high)
{
    const glm::ivec3 first = glm::max(low, glm::ivec3(0));
    const glm::ivec3 end = glm::min(high + 1, glm::ivec3(kEdge));
    uint64_t box = ~uint64_t{0};
    for (int axis = 0; axis < 3; ++axis)
        box &= kBelow[static_cast<size_t>(axis)][static_cast<size_t>(end[axis])] &
               ~kBelow[static_cast<size_t>(axis)][static_cast<size_t>(first[axis])];
    return box;
}

} // namespace relamp
