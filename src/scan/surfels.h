#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// Clusters of texels of one place and one orientation, in the order of a space-filling curve.
///
/// Structure of arrays, one entry a surfel. Normals are of unit length, areas in m^2.
struct Surfels
{
    float size = 0.0f; // metres; edge of the cells that texels are gathered in
    std::vector<glm::vec3> position;
    std::vector<glm::vec3> normal;
    std::vector<float> area;

    // Surfels on the same surface nearby, itself first; those of s are
    // neighbor[firstNeighbor[s]] .. neighbor[firstNeighbor[s + 1] - 1].
    std::vector<uint32_t> firstNeighbor;
    std::vector<uint32_t> neighbor;

    [[nodiscard]] size_t count() const { return position.size(); }
    [[nodiscard]] std::span<const uint32_t> neighborsOf(size_t surfel) const
    {
        return {neighbor.data() + firstNeighbor[surfel], neighbor.data() + firstNeighbor[surfel + 1]};
    }
};

/// Where a texel belongs: its cell in space and the axis that it faces most.
///
/// Keys sort along a Morton curve; surfels of one cell follow each other.
class SurfelGrid
{
public:
    SurfelGrid(glm::vec3 low, float size) : low_(low), perMetre_(1.0f / size) {}

    [[nodiscard]] uint64_t keyOf(glm::vec3 position, glm::vec3 normal) const;
    [[nodiscard]] glm::ivec3 cellOf(glm::vec3 position) const;
    /// Key of the first surfel that can lie in a cell; the next kFacings keys are the same cell's.
    [[nodiscard]] static uint64_t firstKeyOf(glm::ivec3 cell);

    static constexpr uint64_t kFacings = 8; // six axes, rounded up to bits
    static constexpr int kMostCells = 1 << 20;

private:
    glm::vec3 low_;
    float perMetre_;
};

/// Finds for every surfel those within two cells' reach whose surface goes on from its own: not
/// turned away by more than 60 degrees and not on another level. `keys` are the surfels', ascending.
void connectNeighbors(Surfels& surfels, const SurfelGrid& grid, std::span<const uint64_t> keys);

} // namespace relamp
