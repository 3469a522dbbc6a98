#include "relight/radiosity_engine.h"

#include "relight/sky_bins.h"
#include "scenes/gpu_scene.h"
#include "scenes/lit_room.h"
#include "scenes/surfaces.h"

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using testing::HasSubstr;

/// A room that a light sky shines into from above.
struct Room
{
    Room()
        : surfaces(scanOf()),
          transport(transportOf(surfaces.texels, scenes::hitListsOf(surfaces, 64)))
    {}

    static Scan scanOf()
    {
        std::vector<scenes::Panel> walls = scenes::wallsOf(scenes::LitRoom::kSize);
        walls.erase(walls.begin() + 1);
        return scenes::panels(walls, 64, scenes::plain(glm::vec3(0.5f)));
    }
    [[nodiscard]] Bounced lit(RadiosityEngine& engine) const
    {
        const std::vector<glm::vec3> albedo(surfaces.texels.surfels.count(), glm::vec3(0.6f));
        const std::vector<glm::vec3> direct(transport.sides.size(), glm::vec3(0.1f));
        const std::vector<glm::vec3> sky(SkyBins::kCount, glm::vec3(0.5f, 0.7f, 1.0f));
        return engine.bounce(albedo, direct, sky);
    }

    scenes::Surfaces surfaces;
    Transport transport;
};

} // namespace

using GpuRadiosityEngine = scenes::GpuTest;

TEST_F(GpuRadiosityEngine, DoesTheSameOnEither)
{
    const Room room;
    RadiosityEngine cpu(room.transport, {.engine = Engine::cpu});
    RadiosityEngine gpu(room.transport, {.engine = Engine::gpu});
    EXPECT_EQ(cpu.name(), "cpu");
    EXPECT_EQ(gpu.name(), device().description().name);
    const Bounced expected = room.lit(cpu);
    const Bounced found = room.lit(gpu);
    EXPECT_EQ(found.bounces, expected.bounces);
    ASSERT_EQ(found.irradiance.size(), expected.irradiance.size());
    for (size_t s = 0; s < found.irradiance.size(); ++s)
        EXPECT_NEAR(found.irradiance[s].g, expected.irradiance[s].g,
                    0.002f * expected.irradiance[s].g + 1e-4f);
}

TEST_F(GpuRadiosityEngine, LeavesADeviceInSoftwareAloneUnlessItIsAskedFor)
{
    const Room room;
    const bool isReal = device().description().isReal();
    EXPECT_EQ(RadiosityEngine(room.transport, {}).name() != "cpu", isReal);
    EXPECT_EQ(RadiosityEngine(room.transport, {.gpu = "0"}).name(), gpuDevices().at(0).name);
}

TEST_F(GpuRadiosityEngine, SaysThatADeviceThatIsAskedForIsNotThere)
{
    const Room room;
    try {
        const RadiosityEngine none(room.transport, {.engine = Engine::gpu, .gpu = "no such"});
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::device);
        EXPECT_THAT(error.what(), HasSubstr("\"no such\""));
    }
}

} // namespace relamp
