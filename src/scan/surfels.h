#pragma once

#include "scan/surfel_cells.h"

#include <cstdint>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace relamp
{

/// Clusters of texels of one place and one orientation, in the order of a space-filling curve.
///
/// Structure of arrays, one entry a surfel. Normals are of unit length, areas in m^2.
struct Surfels
{
    float size = 0.0f; // metres; edge of the cells that texels are gathered in
    uint32_t seed = 1; // of the patterns that rays from surfels, and pairs of them, follow
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
    [[nodiscard]] bool isEnclosed(size_t surfel) const
    {
        return (key[surfel] & static_cast<uint64_t>(SurfelPart::enclosed)) != 0;
    }
    [[nodiscard]] std::span<const uint32_t> neighborsOf(size_t surfel) const
    {
        return {neighbor.data() + firstNeighbor[surfel],
                neighbor.data() + firstNeighbor[surfel + 1]};
    }

    /// Whether it lies open beside an enclosed part of its own cell and layer.
    [[nodiscard]] bool isPartlyEnclosed(size_t surfel) const;

    /// Whether one is in the ring around the other: they share an edge or a corner, wherever in
    /// their cells they lie.
    [[nodiscard]] bool areBeside(size_t a, size_t b) const
    {
        constexpr float kRing = 1.7f; // surfel sizes
        const glm::vec3 way = position[a] - position[b];
        return glm::dot(way, way) < kRing * kRing * size * size;
    }

    static constexpr uint32_t kNone = ~0u;
    /// The surfel that a texel at `place` facing `facing` belongs to, of layers the nearest; where
    /// there is no texel just there, the nearest that faces about the same way; kNone where nothing
    /// is near.
    [[nodiscard]] uint32_t find(glm::vec3 place, glm::vec3 facing) const;

    /// Calls `visit(surfel)` for all whose cell is at most two from that of `place`: all within a
    /// distance of `size`, and more.
    template<class Visit>
    void forEachInReach(glm::vec3 place, const Visit& visit) const
    {
        forEachInReach(
            place, 0, [](glm::vec3) { return true; }, visit);
    }
    /// The same for cells that surfels of `leastKey` or above are in and that `matters(way)` is
    /// true for: the way to the cell's middle, in cells and the grid's frame.
    template<class Matters, class Visit>
    void forEachInReach(glm::vec3 place, uint64_t leastKey, const Matters& matters,
                        const Visit& visit) const;
};

/// Finds for every surfel those within two cells' reach whose surface goes on from its own: not
/// turned away by more than 60 degrees, not on another level, and enclosed like it or open like it.
void connectNeighbors(Surfels& surfels);

template<class Matters, class Visit>
void Surfels::forEachInReach(glm::vec3 place, uint64_t leastKey, const Matters& matters,
                             const Visit& visit) const
{
    const glm::vec3 at = grid.inCells(place);
    const glm::ivec3 home = grid.cellOf(place);
    const glm::ivec3 low = glm::max(home - 2, glm::ivec3(0));
    const glm::ivec3 high = glm::min(home + 2, glm::ivec3(SurfelGrid::kMostCells - 1));
    cells.forEachFilled(
        low, high, leastKey, [&](glm::ivec3 cell) { return matters(glm::vec3(cell) + 0.5f - at); },
        [&](SurfelCells::Range range) {
            for (uint32_t surfel = range.begin; surfel < range.end; ++surfel) visit(size_t{surfel});
        });
}

} // namespace relamp
