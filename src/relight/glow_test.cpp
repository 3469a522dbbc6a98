#include "relight/glow.h"

#include "base/radiometry.shared.h"
#include "scenes/radiosity.h"
#include "scenes/scenes.h"
#include "scenes/surfaces.h"

#include <cmath>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

constexpr float kAlbedo = 0.5f;

/// A closed box of 3 x 2.5 x 3 m, a square of its floor lit so that it receives pi.
struct SpottedRoom
{
    explicit SpottedRoom(float halfWidth)
        : surfaces(scenes::room({3.0f, 2.5f, 3.0f}, 64, scenes::plain(glm::vec3(kAlbedo)))),
          transport(transportOf(surfaces.texels, scenes::hitListsOf(surfaces, 64))),
          albedo(surfaces.texels.surfels.count(), glm::vec3(kAlbedo)),
          ofLight(transport.sides.size()), direct(transport.sides.size(), glm::vec3(0.0f))
    {
        const Surfels& surfels = surfaces.texels.surfels;
        for (size_t i = 0; i < direct.size(); ++i) {
            const uint32_t s = transport.sides[i].surfel();
            const glm::vec3 off = glm::abs(surfels.position[s] - glm::vec3(1.5f, 0.0f, 1.5f));
            if (surfels.normal[s].y < 0.9f || std::max(off.x, off.z) > halfWidth) continue;
            ofLight.set(i, {.open = kPi, .visible = kPi});
            direct[i] = glm::vec3(kPi);
            area += surfels.area[s];
            middle += surfels.area[s] * surfels.position[s];
        }
    }

    [[nodiscard]] std::optional<Glow> glow() const
    {
        return findGlow(transport, surfaces.texels, albedo, ofLight, glm::vec3(1.0f),
                        sentDirectly(transport, surfaces.texels.surfels, albedo, direct));
    }

    scenes::Surfaces surfaces;
    Transport transport;
    std::vector<glm::vec3> albedo;
    LampSight ofLight;
    std::vector<glm::vec3> direct;
    float area = 0.0f;      // m^2 that is lit
    glm::vec3 middle{0.0f}; // of that, times its area
};

} // namespace

// A small bright square sends by Lambert's formula, to the far ceiling and to a wall that it nearly
// touches: without the grain of 64 rays.
TEST(Glow, SmallBrightSquareSendsByItsFormFactor)
{
    const SpottedRoom room(0.3f);
    const Surfels& surfels = room.surfaces.texels.surfels;
    const std::optional<Glow> glow = room.glow();
    ASSERT_TRUE(glow);
    const std::vector<glm::vec3> irradiance =
        irradianceFrom(*glow, room.transport, surfels, std::vector<float>(surfels.count(), 1.0f));
    const float half = 0.5f * std::sqrt(room.area);
    const glm::vec3 corner = room.middle / room.area - glm::vec3(half, 0, half);
    const scenes::Panel lit{corner, {0, 0, 2 * half}, {2 * half, 0, 0}};
    for (const glm::vec3 facing : {glm::vec3(0, -1, 0), glm::vec3(1, 0, 0)})
        for (const uint32_t s : room.surfaces.facing(facing)) {
            const float exact =
                kAlbedo * scenes::irradianceFrom(lit, surfels.position[s], surfels.normal[s]);
            EXPECT_NEAR(irradiance[s].g, exact, 0.03f * exact + 1e-4f);
        }
}

TEST(Glow, IsKnownForWhatDimsOrColoursIt)
{
    SpottedRoom room(0.3f);
    const std::optional<Glow> white = room.glow();
    for (glm::vec3& light : room.direct) light *= glm::vec3(0.1f, 0.2f, 0.3f);
    const std::optional<Glow> dim = findGlow(
        room.transport, room.surfaces.texels, room.albedo, room.ofLight, {0.1f, 0.2f, 0.3f},
        sentDirectly(room.transport, room.surfaces.texels.surfels, room.albedo, room.direct));
    ASSERT_TRUE(white && dim);
    EXPECT_EQ(white->sides, dim->sides);
    EXPECT_EQ(white->gain, dim->gain);
}

TEST(Glow, EvenLightHasNone)
{
    EXPECT_FALSE(SpottedRoom(1.5f).glow()); // all of the floor
}

} // namespace relamp
