#include "relight/radiosity_gpu.h"

#include "relight/sky_bins.h"
#include "scenes/apart.h"
#include "scenes/gpu_scene.h"
#include "scenes/lit_room.h"
#include "scenes/surfaces.h"

#include <cmath>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using scenes::Apart;

/// A room, and a light in it: colours, a bright spot on the floor, and what comes through where the
/// ceiling is open.
struct TwinRoom
{
    explicit TwinRoom(bool isOpen)
        : surfaces(scanOf(isOpen)),
          transport(transportOf(surfaces.texels, scenes::hitListsOf(surfaces, 64)))
    {
        const Surfels& surfels = surfaces.texels.surfels;
        for (size_t s = 0; s < surfels.count(); ++s)
            albedo.push_back(scenes::LitRoom::albedo(surfels.position[s], surfels.normal[s]));
        for (const Side side : transport.sides) {
            const glm::vec3 off = surfels.position[side.surfel()] - glm::vec3(2.0f, 0.0f, 2.5f);
            direct.push_back(glm::vec3(90.0f, 70.0f, 40.0f) / (1.0f + 40.0f * glm::dot(off, off)));
        }
        if (isOpen) sky = std::vector<glm::vec3>(SkyBins::kCount, glm::vec3(0.5f, 0.7f, 1.0f));
    }

    static Scan scanOf(bool isOpen)
    {
        std::vector<scenes::Panel> walls = scenes::wallsOf(scenes::LitRoom::kSize);
        if (isOpen) walls.erase(walls.begin() + 1);
        return scenes::panels(walls, 64, scenes::plain(glm::vec3(0.5f)));
    }

    scenes::Surfaces surfaces;
    Transport transport;
    std::vector<glm::vec3> albedo;
    std::vector<glm::vec3> direct;
    std::vector<glm::vec3> sky;
};

} // namespace

using GpuRadiosity = scenes::GpuTest;

// What is sent is kept as halves; all else is the same sums in another order.
TEST_F(GpuRadiosity, BouncesAsTheCpuDoes)
{
    for (const bool isOpen : {false, true}) {
        const TwinRoom room(isOpen);
        RadiosityGpu gpu(device(), room.transport);
        for (const float power : {1.0f, 1e-4f, 3e3f}) { // a candle, the sun
            std::vector<glm::vec3> direct = room.direct;
            std::vector<glm::vec3> sky = room.sky;
            for (auto* light : {&direct, &sky})
                for (glm::vec3& value : *light) value *= power;
            const Bounced expected = bounce(room.transport, room.albedo, direct, sky);
            const Bounced found = gpu.bounce(room.albedo, direct, sky);
            EXPECT_EQ(found.bounces, expected.bounces);
            EXPECT_GT(found.bounces, 2u);
            Apart light(0.01f * power);
            Apart noise(0.1f * power);
            for (size_t s = 0; s < expected.irradiance.size(); ++s) {
                light.add(found.irradiance[s], expected.irradiance[s]);
                noise.add(glm::vec3(found.noise[s]), glm::vec3(expected.noise[s]));
            }
            EXPECT_LT(light.most(), 2e-3f);
            EXPECT_LT(noise.most(), 0.01f);
        }
    }
}

// The bright spot, as a glow that others have looked for.
TEST_F(GpuRadiosity, LeavesWhatIsKnownToOthersAsTheCpuDoes)
{
    const TwinRoom room(false);
    std::vector<glm::vec3> spot;
    for (const glm::vec3 irradiance : room.direct)
        spot.push_back(irradiance.r > 20.0f ? 0.9f * irradiance : glm::vec3(0.0f));
    const std::vector<glm::vec3> bySpot(room.albedo.size(), glm::vec3(0.3f, 0.2f, 0.1f));
    const Bounced all = bounce(room.transport, room.albedo, room.direct, {});
    const Bounced expected = bounce(room.transport, room.albedo, room.direct, {}, {spot, bySpot});
    const Bounced found =
        RadiosityGpu(device(), room.transport).bounce(room.albedo, room.direct, {}, {spot, bySpot});
    Apart light(0.01f);
    Apart change(0.01f);
    for (size_t s = 0; s < expected.irradiance.size(); ++s) {
        light.add(found.irradiance[s], expected.irradiance[s]);
        change.add(all.irradiance[s], expected.irradiance[s]);
    }
    EXPECT_LT(light.most(), 2e-3f);
    EXPECT_GT(change.beyond(0.05f), 0.2);
}

TEST_F(GpuRadiosity, DarknessStaysDark)
{
    const TwinRoom room(false);
    const std::vector<glm::vec3> nothing(room.direct.size(), glm::vec3(0.0f));
    const Bounced found = RadiosityGpu(device(), room.transport).bounce(room.albedo, nothing, {});
    EXPECT_THAT(found.irradiance, testing::Each(glm::vec3(0.0f)));
}

// Sums are added up in one order.
TEST_F(GpuRadiosity, SameLightGivesTheSameBits)
{
    const TwinRoom room(true);
    RadiosityGpu gpu(device(), room.transport);
    const Bounced once = gpu.bounce(room.albedo, room.direct, room.sky);
    gpu.bounce(room.albedo, room.direct, {});
    const Bounced again = gpu.bounce(room.albedo, room.direct, room.sky);
    EXPECT_EQ(once.irradiance, again.irradiance);
    EXPECT_EQ(once.noise, again.noise);
}

} // namespace relamp
