#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace relamp
{

/// What sets surfels of one cell and one facing apart; bits of their keys.
enum class SurfelPart : uint64_t {
    upper = 1,  // of two layers, the one that the other lies behind
    buried = 2, // something stands or lies on it
};

/// Where a texel belongs: its cell in space and the axis that it faces most.
///
/// Keys sort along a Morton curve; surfels of one cell follow each other.
class SurfelGrid
{
public:
    SurfelGrid() = default;
    SurfelGrid(glm::vec3 low, float size) : low_(low), perMetre_(1.0f / size) {}

    [[nodiscard]] uint64_t keyOf(glm::vec3 position, glm::vec3 normal) const;
    [[nodiscard]] glm::ivec3 cellOf(glm::vec3 position) const;
    /// Key of the first surfel that can lie in a cell; the next kFacings keys are the same cell's.
    [[nodiscard]] static uint64_t firstKeyOf(glm::ivec3 cell);
    /// A place in units of cells.
    [[nodiscard]] glm::vec3 inCells(glm::vec3 position) const
    {
        return (position - low_) * perMetre_;
    }

    static constexpr uint64_t kParts = 4;            // of a cell's surfels that face one way
    static constexpr uint64_t kFacings = 8 * kParts; // six axes, rounded up to bits
    static constexpr int kMostCells = 1 << 19;

private:
    glm::vec3 low_{0.0f};
    float perMetre_ = 1.0f;
};

/// Index of the surfels of each cell of a grid, by open addressing.
class SurfelCells
{
public:
    SurfelCells() = default;
    /// `keys` are the surfels' own, ascending.
    explicit SurfelCells(std::span<const uint64_t> keys);

    /// The surfels of the cell that begins at `firstKey`: [begin, end).
    struct Range
    {
        uint32_t begin = 0;
        uint32_t end = 0;
    };
    [[nodiscard]] Range operator[](uint64_t firstKey) const;

private:
    struct Slot
    {
        uint64_t key = 0;
        Range range; // empty: nobody is here
    };
    [[nodiscard]] size_t slotOf(uint64_t key) const;

    std::vector<Slot> slots_;
};

/// Clusters of texels of one place and one orientation, in the order of a space-filling curve.
///
/// Structure of arrays, one entry a surfel. Normals are of unit length, areas in m^2.
struct Surfels
{
    float size = 0.0f; // metres; edge of the cells that texels are gathered in
    SurfelGrid grid;
    SurfelCells cells;
    std::vector<uint64_t> key; // of grid, ascending
    std::vector<glm::vec3> position;
    std::vector<glm::vec3> normal;
    std::vector<float> area;

    // Surfels on the same surface nearby, itself first; those of s are
    // neighbor[firstNeighbor[s]] .. neighbor[firstNeighbor[s + 1] - 1].
    std::vector<uint32_t> firstNeighbor;
    std::vector<uint32_t> neighbor;

    [[nodiscard]] size_t count() const { return position.size(); }
    [[nodiscard]] bool isBuried(size_t surfel) const
    {
        return (key[surfel] & static_cast<uint64_t>(SurfelPart::buried)) != 0;
    }
    [[nodiscard]] std::span<const uint32_t> neighborsOf(size_t surfel) const
    {
        return {neighbor.data() + firstNeighbor[surfel],
                neighbor.data() + firstNeighbor[surfel + 1]};
    }

    /// Whether it lies open beside a buried part of its own cell and layer.
    [[nodiscard]] bool isPartlyBuried(size_t surfel) const;

    static constexpr uint32_t kNone = ~0u;
    /// The surfel that a texel at `place` facing `facing` belongs to, of layers the nearest; where
    /// there is no texel just there, the nearest that faces about the same way; kNone where nothing
    /// is near.
    [[nodiscard]] uint32_t find(glm::vec3 place, glm::vec3 facing) const;

    /// Calls `visit(surfel)` for all whose cell is at most two from that of `place`: all within a
    /// distance of `size`, and more; of cells that
    /// `matters(way)` is true for, the way to the cell's middle in cells.
    template<class Visit, class Matters>
    void forEachInReach(glm::vec3 place, const Visit& visit, const Matters& matters) const;
    template<class Visit>
    void forEachInReach(glm::vec3 place, const Visit& visit) const
    {
        forEachInReach(place, visit, [](glm::vec3) { return true; });
    }
};

/// Finds for every surfel those within two cells' reach whose surface goes on from its own: not
/// turned away by more than 60 degrees, not on another level, and buried like it or open like it.
void connectNeighbors(Surfels& surfels);

template<class Visit, class Matters>
void Surfels::forEachInReach(glm::vec3 place, const Visit& visit, const Matters& matters) const
{
    const glm::vec3 at = grid.inCells(place);
    const glm::ivec3 home = grid.cellOf(place);
    const glm::ivec3 low = glm::max(home - 2, glm::ivec3(0));
    const glm::ivec3 high = glm::min(home + 2, glm::ivec3(SurfelGrid::kMostCells - 1));
    for (int z = low.z; z <= high.z; ++z)
        for (int y = low.y; y <= high.y; ++y)
            for (int x = low.x; x <= high.x; ++x) {
                if (!matters(glm::vec3(x, y, z) + 0.5f - at)) continue;
                const auto [begin, end] = cells[SurfelGrid::firstKeyOf({x, y, z})];
                for (uint32_t surfel = begin; surfel < end; ++surfel) visit(size_t{surfel});
            }
}

} // namespace relamp
