#pragma once

#include "scan/wall_frame.h"

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace relamp
{

/// What sets surfels of one cell and one facing apart; bits of their keys.
enum class SurfelPart : uint64_t {
    upper = 1,    // of two layers, the one that the other lies behind
    enclosed = 2, // something stands or lies on it
};

/// Where a texel belongs: its cell in space and the axis that it faces most, in a frame of its own.
///
/// Keys sort along a Morton curve; surfels of one cell follow each other.
class SurfelGrid
{
public:
    SurfelGrid() = default;
    /// `low` is in the frame.
    SurfelGrid(WallFrame frame, glm::vec3 low, float size)
        : frame_(frame), low_(low), perMetre_(1.0f / size)
    {}

    [[nodiscard]] uint64_t keyOf(glm::vec3 position, glm::vec3 normal) const;
    [[nodiscard]] glm::ivec3 cellOf(glm::vec3 position) const;
    /// Key of the first surfel that can lie in a cell; the next kFacings keys are the same cell's.
    [[nodiscard]] static uint64_t firstKeyOf(glm::ivec3 cell);
    /// A place in units of cells.
    [[nodiscard]] glm::vec3 inCells(glm::vec3 position) const
    {
        return (frame_.fromScan(position) - low_) * perMetre_;
    }
    [[nodiscard]] const WallFrame& frame() const { return frame_; }

    static constexpr uint64_t kParts = 4;            // of a cell's surfels that face one way
    static constexpr uint64_t kFacings = 8 * kParts; // six axes, rounded up to bits
    static constexpr int kMostCells = 1 << 19;

private:
    WallFrame frame_;
    glm::vec3 low_{0.0f};
    float perMetre_ = 1.0f;
};

/// Index of the surfels of each cell of a grid: a hash table of bricks of 4 x 4 x 4 cells, each
/// with a bit for every cell that somebody is in. Empty cells, most of those that are asked for,
/// cost nothing.
class SurfelCells
{
public:
    SurfelCells() = default;
    /// `keys` are the surfels' own, ascending.
    explicit SurfelCells(std::span<const uint64_t> keys);

    /// Surfels of a cell: [begin, end).
    struct Range
    {
        uint32_t begin = 0;
        uint32_t end = 0;
    };
    [[nodiscard]] Range operator[](glm::ivec3 cell) const;

    /// Calls `visit(range)` for the cells of the box `low` .. `high` that surfels of `leastKey` or
    /// above are in and that `matters(cell)` is true for.
    template<class Matters, class Visit>
    void forEachFilled(glm::ivec3 low, glm::ivec3 high, uint64_t leastKey, const Matters& matters,
                       const Visit& visit) const;

private:
    static constexpr int kEdge = 4; // of a brick, in cells
    static constexpr uint64_t kCells = 64;
    struct Brick
    {
        uint64_t key = 0;    // Morton code of its place
        uint64_t filled = 0; // a bit for each cell, by Morton code; none: the slot is free
        uint32_t first = 0;  // of its filled cells, in begins_
    };
    [[nodiscard]] size_t slotOf(uint64_t key) const;
    [[nodiscard]] static uint64_t keyOfBrick(glm::ivec3 brick);
    [[nodiscard]] Range rangeOf(const Brick& brick, uint64_t cell) const;

    /// Place in its brick of the cell with a Morton code.
    static constexpr glm::ivec3 placeOf(uint64_t cell)
    {
        return {static_cast<int>((cell & 1) | (cell >> 2 & 2)),
                static_cast<int>((cell >> 1 & 1) | (cell >> 3 & 2)),
                static_cast<int>((cell >> 2 & 1) | (cell >> 4 & 2))};
    }
    /// Bits of the cells of the box `low` .. `high` of a brick.
    static uint64_t boxOf(glm::ivec3 low, glm::ivec3 high);

    std::vector<Brick> bricks_;    // by open addressing
    std::vector<uint32_t> begins_; // first surfel of each filled cell, then the number of surfels
};

template<class Matters, class Visit>
void SurfelCells::forEachFilled(glm::ivec3 low, glm::ivec3 high, uint64_t leastKey,
                                const Matters& matters, const Visit& visit) const
{
    const glm::ivec3 first = low / kEdge;
    const glm::ivec3 last = high / kEdge;
    const uint64_t leastCell = leastKey / SurfelGrid::kFacings;
    const uint64_t leastBrick = leastCell / kCells;
    for (int z = first.z; z <= last.z; ++z)
        for (int y = first.y; y <= last.y; ++y)
            for (int x = first.x; x <= last.x; ++x) {
                const uint64_t key = keyOfBrick({x, y, z});
                if (key < leastBrick) continue;
                const Brick& brick = bricks_[slotOf(key)];
                const glm::ivec3 corner = kEdge * glm::ivec3(x, y, z);
                uint64_t wanted = brick.filled & boxOf(low - corner, high - corner);
                if (key == leastBrick) wanted &= ~uint64_t{0} << leastCell % kCells;
                for (; wanted != 0; wanted &= wanted - 1) {
                    const auto cell = static_cast<uint64_t>(std::countr_zero(wanted));
                    if (matters(corner + placeOf(cell))) visit(rangeOf(brick, cell));
                }
            }
}

} // namespace relamp
