#include "lights/lamp_body.h"

#include "base/radiometry.shared.h"
#include "scenes/scenes.h"
#include "scenes/surfaces.h"

#include <cmath>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

const glm::vec3 kAxis(2.0f, 1.2f, 0.6f);
constexpr float kBodyRadius = 0.2f;
constexpr float kHeight = 0.3f;

/// Strips of a cylinder about kAxis that face between two angles about the vertical.
std::vector<scenes::Panel> shade(float from, float to, int strips)
{
    std::vector<scenes::Panel> panels;
    const auto at = [](float angle) {
        return kAxis + kBodyRadius * glm::vec3(std::sin(angle), 0.0f, std::cos(angle));
    };
    for (int i = 0; i < strips; ++i) {
        const float step = (to - from) / static_cast<float>(strips);
        const glm::vec3 a = at(from + step * static_cast<float>(i));
        const glm::vec3 b = at(from + step * static_cast<float>(i + 1));
        panels.push_back({a, {0, kHeight, 0}, b - a});
        const glm::vec3 out = 0.5f * (a + b) - kAxis;
        if (glm::dot(panels.back().normal(), out) < 0.0f)
            std::swap(panels.back().alongU, panels.back().alongV);
    }
    return panels;
}

/// A shade near the wall z = 0 of a room; it is white, the room grey.
struct RoomWithShade
{
    scenes::Surfaces surfaces;
    Candidate candidate;

    RoomWithShade(float from, float to)
        : surfaces(scenes::panels(partsOf(from, to), 48, [](glm::vec3 p, glm::vec3) {
              return glm::vec3(std::hypot(p.x - kAxis.x, p.z - kAxis.z) < 1.1f * kBodyRadius &&
                                       std::abs(p.y - 1.35f) < 0.2f
                                   ? 1.0f
                                   : 0.3f);
          }))
    {
        std::vector<ClippedPatch> patches = surfaces.radiance.clipped;
        candidate = candidateOf(std::move(patches));
    }

    static std::vector<scenes::Panel> partsOf(float from, float to)
    {
        std::vector<scenes::Panel> parts = scenes::wallsOf({4.0f, 2.5f, 3.0f});
        const auto strips = shade(from, to, 12);
        parts.insert(parts.end(), strips.begin(), strips.end());
        return parts;
    }
};

} // namespace

// Cameras saw the half of a lampshade that faces the room; the other half is as large, faces the
// wall and lies on the same cylinder.
TEST(LampBody, HalfAShadeIsMirroredToAWholeOne)
{
    const RoomWithShade room(-0.5f * kPi, 0.5f * kPi);
    const Candidate unseen = unseenSideOf(room.candidate, room.surfaces.texels, room.surfaces.rays);
    EXPECT_NEAR(unseen.area, room.candidate.area, 0.25f * room.candidate.area);
    EXPECT_LT(unseen.normal.z, -0.4f);
    for (const ClippedPatch& patch : unseen.patches) {
        const float distance = std::hypot(patch.position.x - kAxis.x, patch.position.z - kAxis.z);
        EXPECT_NEAR(distance, kBodyRadius, 0.05f);
        EXPECT_EQ(patch.surfel, Surfels::kNone);
    }
}

TEST(LampBody, WholeShadeHasNoUnseenSide)
{
    const RoomWithShade room(-kPi, kPi);
    EXPECT_TRUE(
        unseenSideOf(room.candidate, room.surfaces.texels, room.surfaces.rays).patches.empty());
}

// A panel is as thin as it looks, for all that anybody can tell.
TEST(LampBody, FlatLampHasNoUnseenSide)
{
    const RoomWithShade room(-0.2f, 0.2f);
    EXPECT_TRUE(
        unseenSideOf(room.candidate, room.surfaces.texels, room.surfaces.rays).patches.empty());
}

} // namespace relamp
