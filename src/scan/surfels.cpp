#include "scan/surfels.h"

#include "base/parallel.h"

#include <algorithm>
#include <bit>
#include <cmath>
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

/// Index of the first surfel of each cell, by open addressing.
class CellTable
{
public:
    explicit CellTable(std::span<const uint64_t> keys)
        : keys_(keys), slots_(std::bit_ceil(2 * keys.size() + 2), kEmpty)
    {
        for (size_t i = 0; i < keys.size(); ++i)
            if (i == 0 || cellKey(i) != cellKey(i - 1)) insert(static_cast<uint32_t>(i));
    }

    /// The surfels of a cell, as a range of indices.
    [[nodiscard]] std::pair<size_t, size_t> operator[](uint64_t firstKey) const
    {
        size_t slot = slotOf(firstKey);
        while (slots_[slot] != kEmpty && cellKey(slots_[slot]) != firstKey) slot = next(slot);
        if (slots_[slot] == kEmpty) return {0, 0};
        size_t end = slots_[slot];
        while (end < keys_.size() && cellKey(end) == firstKey) ++end;
        return {slots_[slot], end};
    }

private:
    static constexpr uint32_t kEmpty = ~0u;

    [[nodiscard]] uint64_t cellKey(size_t i) const
    {
        return keys_[i] / SurfelGrid::kFacings * SurfelGrid::kFacings;
    }
    [[nodiscard]] size_t slotOf(uint64_t key) const
    {
        return (key / SurfelGrid::kFacings * 0x9e3779b97f4a7c15u >> 20) & (slots_.size() - 1);
    }
    [[nodiscard]] size_t next(size_t slot) const { return (slot + 1) & (slots_.size() - 1); }
    void insert(uint32_t index)
    {
        size_t slot = slotOf(cellKey(index));
        while (slots_[slot] != kEmpty) slot = next(slot);
        slots_[slot] = index;
    }

    std::span<const uint64_t> keys_;
    std::vector<uint32_t> slots_;
};

bool isSameSurface(const Surfels& surfels, size_t a, size_t b)
{
    const glm::vec3 way = surfels.position[b] - surfels.position[a];
    const float reach = 1.75f * surfels.size;
    const float step = std::max(std::abs(glm::dot(way, surfels.normal[a])),
                                std::abs(glm::dot(way, surfels.normal[b])));
    return glm::dot(way, way) < reach * reach && step < 0.6f * surfels.size &&
           glm::dot(surfels.normal[a], surfels.normal[b]) > 0.5f;
}

/// The cells within the reach of isSameSurface.
template<class Visit>
void forEachCellAround(glm::ivec3 home, const Visit& visit)
{
    const glm::ivec3 low = glm::max(home - 2, glm::ivec3(0));
    const glm::ivec3 high = glm::min(home + 2, glm::ivec3(SurfelGrid::kMostCells - 1));
    for (int z = low.z; z <= high.z; ++z)
        for (int y = low.y; y <= high.y; ++y)
            for (int x = low.x; x <= high.x; ++x) visit(glm::ivec3(x, y, z));
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
    return firstKeyOf(cellOf(position)) + facingOf(normal);
}

void connectNeighbors(Surfels& surfels, const SurfelGrid& grid, std::span<const uint64_t> keys)
{
    const size_t count = surfels.count();
    constexpr size_t kChunk = 1024;
    const CellTable surfelsOfCell(keys);
    std::vector<std::vector<uint32_t>> found((count + kChunk - 1) / kChunk);
    surfels.firstNeighbor.assign(count + 1, 0);
    forEachChunk(count, kChunk, [&](size_t begin, size_t end) {
        std::vector<uint32_t>& list = found[begin / kChunk];
        for (size_t s = begin; s < end; ++s) {
            const size_t before = list.size();
            list.push_back(static_cast<uint32_t>(s));
            forEachCellAround(grid.cellOf(surfels.position[s]), [&](glm::ivec3 cell) {
                const auto [first, last] = surfelsOfCell[SurfelGrid::firstKeyOf(cell)];
                for (size_t other = first; other < last; ++other)
                    if (other != s && isSameSurface(surfels, s, other))
                        list.push_back(static_cast<uint32_t>(other));
            });
            surfels.firstNeighbor[s + 1] = static_cast<uint32_t>(list.size() - before);
        }
    });
    std::partial_sum(surfels.firstNeighbor.begin(), surfels.firstNeighbor.end(),
                     surfels.firstNeighbor.begin());
    surfels.neighbor.clear();
    surfels.neighbor.reserve(surfels.firstNeighbor.back());
    for (const auto& list : found) surfels.neighbor.insert(surfels.neighbor.end(), list.begin(), list.end());
}

} // namespace relamp
