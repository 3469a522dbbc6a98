#include "fit/camera_search.h"

#include "fit/lamps.h"
#include "fit/pairs.h"
#include "scan/gain.h"
#include "scenes/lit_room.h"
#include "scenes/surfaces.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using scenes::LitRoom;

/// Logarithm of an exposure that wanders over the room by 0.8 stops.
float exposureAt(glm::vec3 place)
{
    return 0.3f * std::sin(1.9f * place.x + 0.6f) * std::cos(1.7f * place.z - 0.4f);
}

CameraModel cameraOf(Scan scan)
{
    const scenes::Surfaces room(std::move(scan));
    Progress progress;
    return findLamps(room.texels, room.rays, scenes::hitListsOf(room, 64), room.radiance, {},
                     roomsOf(room.texels.surfels, room.rays), progress)
        .camera;
}

/// Logarithm of paint that is uneven by 6 % from one decimetre to the next.
float unevenPaintAt(glm::vec3 place)
{
    const glm::vec3 cell = glm::floor(place / 0.1f);
    const float any = 43758.5f * std::sin(glm::dot(cell, glm::vec3(12.99f, 78.23f, 37.72f)));
    return 0.2f * (any - std::floor(any) - 0.5f);
}

/// By how much the gain is more off the exposure in the middle of one wall than of another.
float offBetweenWalls(const Gain& gain)
{
    const glm::vec3 size = LitRoom::kSize;
    const glm::vec3 walls[] = {
        {0.0f, 0.5f, 0.5f}, {1.0f, 0.5f, 0.5f}, {0.5f, 0.5f, 0.0f}, {0.5f, 0.5f, 1.0f}};
    std::vector<float> off;
    for (const glm::vec3 wall : walls)
        off.push_back(logAt(gain, wall * size).g - exposureAt(wall * size));
    return std::ranges::max(off) - std::ranges::min(off);
}

} // namespace

// Pairs on each wall tell how the exposure wanders there; without those from wall to wall they are
// 0.46 apart.
TEST(CameraSearch, DriftIsFoundFromWallToWall)
{
    const LitRoom lit;
    const CameraModel camera =
        cameraOf(scenes::room(LitRoom::kSize, 96, [&](glm::vec3 place, glm::vec3 normal) {
            return glm::min(std::exp(exposureAt(place)) * lit.box.photo(place, normal), 1.0f);
        }));
    EXPECT_TRUE(camera.hasDrifted());
    ASSERT_EQ(camera.gains.size(), 1u);
    EXPECT_LT(offBetweenWalls(camera.gains[0]), 0.3f);
    for (const float slope : camera.response.slope) EXPECT_EQ(slope, 1.0f);
}

// Under a drift brackets look straight: without one beside it no slope is found here.
TEST(CameraSearch, BracketsAreFoundUnderADrift)
{
    constexpr float kBrackets = 0.65f; // what they raise the light to
    const LitRoom lit;
    const CameraModel camera =
        cameraOf(scenes::room(LitRoom::kSize, 96, [&](glm::vec3 place, glm::vec3 normal) {
            const float exposure =
                0.2f * std::sin(1.1f * place.x + 0.6f) * std::cos(1.1f * place.z + 2.0f) +
                0.1f * std::sin(2.2f * place.y - 1.1f * place.z);
            const glm::vec3 radiance =
                std::exp(exposure + unevenPaintAt(place)) * lit.box.photo(place, normal);
            return glm::min(glm::pow(radiance, glm::vec3(kBrackets)), 1.0f);
        }));
    EXPECT_TRUE(camera.hasDrifted());
    const auto& slopes = camera.response.slope;
    const float mean =
        std::accumulate(slopes.begin(), slopes.end(), 0.0f) / static_cast<float>(slopes.size());
    EXPECT_NEAR(mean, 1.0f / kBrackets, 0.2f);
}

} // namespace relamp
