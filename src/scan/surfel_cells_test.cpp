#include "scan/surfel_cells.h"

#include <algorithm>
#include <map>
#include <random>
#include <tuple>

#include <glm/vector_relational.hpp>
#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using Cell = std::tuple<int, int, int>;

/// Surfels in random cells near a corner of the grid and near another, some of them crowded.
struct Crowd
{
    Crowd()
    {
        std::mt19937 random(3);
        for (int i = 0; i < 600; ++i) {
            const int corner = i % 2 == 0 ? 0 : SurfelGrid::kMostCells - 12;
            const auto place = [&] { return corner + static_cast<int>(random() % 12); };
            const glm::ivec3 cell(place(), place(), place());
            keys.push_back(SurfelGrid::firstKeyOf(cell) + random() % SurfelGrid::kFacings);
            ++surfelsIn[{cell.x, cell.y, cell.z}];
        }
        std::sort(keys.begin(), keys.end());
    }

    std::vector<uint64_t> keys;
    std::map<Cell, uint32_t> surfelsIn;
};

} // namespace

TEST(SurfelCells, HaveTheSurfelsOfTheirKeys)
{
    const Crowd crowd;
    const SurfelCells cells(crowd.keys);
    for (const auto& [cell, count] : crowd.surfelsIn) {
        const auto [x, y, z] = cell;
        const auto [begin, end] = cells[{x, y, z}];
        ASSERT_EQ(end - begin, count);
        for (uint32_t s = begin; s < end; ++s)
            EXPECT_EQ(crowd.keys[s] / SurfelGrid::kFacings,
                      SurfelGrid::firstKeyOf({x, y, z}) / SurfelGrid::kFacings);
    }
    const auto [begin, end] = cells[{100, 100, 100}];
    EXPECT_EQ(begin, end);
}

TEST(SurfelCells, OfABoxAreVisitedOnceEach)
{
    const Crowd crowd;
    const SurfelCells cells(crowd.keys);
    for (const glm::ivec3 low : {glm::ivec3(0), glm::ivec3(3, 0, 5), glm::ivec3(7, 4, 2),
                                 glm::ivec3(SurfelGrid::kMostCells - 9)}) {
        const glm::ivec3 high = low + 4;
        for (const uint64_t leastKey : {uint64_t{0}, SurfelGrid::firstKeyOf(low + 1) + 5}) {
            std::map<Cell, uint32_t> visited;
            glm::ivec3 cell(0);
            cells.forEachFilled(
                low, high, leastKey,
                [&](glm::ivec3 asked) {
                    cell = asked;
                    return cell.x != low.x + 2;
                },
                [&](SurfelCells::Range range) {
                    visited[{cell.x, cell.y, cell.z}] += range.end - range.begin;
                });
            std::map<Cell, uint32_t> wanted = crowd.surfelsIn;
            std::erase_if(wanted, [&](const auto& entry) {
                const auto [x, y, z] = entry.first;
                const glm::ivec3 at(x, y, z);
                return glm::any(glm::lessThan(at, low)) || glm::any(glm::greaterThan(at, high)) ||
                       x == low.x + 2 ||
                       SurfelGrid::firstKeyOf(at) + SurfelGrid::kFacings <= leastKey;
            });
            EXPECT_FALSE(wanted.empty());
            EXPECT_EQ(visited, wanted);
        }
    }
}

TEST(SurfelCells, OfNobodyAreEmpty)
{
    const SurfelCells cells(std::span<const uint64_t>{});
    const auto [begin, end] = cells[{0, 0, 0}];
    EXPECT_EQ(begin, end);
}

} // namespace relamp
