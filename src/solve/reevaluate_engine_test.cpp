#include "solve/reevaluate_engine.h"

#include "scenes/apart_layers.h"
#include "scenes/gpu_scene.h"
#include "scenes/lit_room.h"
#include "scenes/solved.h"
#include "solve/room_solution.h"

#include <tuple>
#include <utility>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using scenes::Apart;

LampPowers times(LampPowers powers, float factor)
{
    for (glm::vec3& lamp : powers.lamps) lamp *= factor;
    return powers;
}

void expectLightAlike(const PageLayers& ofGpu, const PageLayers& ofCpu)
{
    scenes::expectAlike(ofGpu, ofCpu);
    for (const auto layer : {&PageLayers::direct, &PageLayers::indirect}) {
        const Apart apart = scenes::apart(ofGpu.*layer, ofCpu.*layer);
        EXPECT_LT(apart.beyond(3e-3f), 1e-3);
        EXPECT_LT(apart.most(), 0.02f);
    }
}

/// A room that one engine re-evaluates.
struct Room
{
    explicit Room(const EngineOptions& options)
        : room(scenes::LitRoom().scan), found(room.solved.found.found.powers),
          engine(std::make_shared<ReevaluateEngine>(room.texels, options))
    {}

    /// The room under these powers, as the engine makes it.
    Solution reevaluate(const LampPowers& powers)
    {
        DeviceLayers onDevice = engine->reevaluate(room.solved, powers);
        Solution solution = solutionOf(room.texels, room.solved, {}, closureOf(room.solved));
        solution.onDevice = std::move(onDevice);
        return solution;
    }
    [[nodiscard]] PageLayers layers(const Solution& solution) const
    {
        Progress progress;
        if (!solution.onDevice) return makeLayers(room.texels, 0, solution.texels, {}, progress);
        return solution.onDevice(0, solution.texels, {}, progress).value();
    }

    scenes::Solved room;
    LampPowers found;
    std::shared_ptr<ReevaluateEngine> engine;
};

void expectAlike(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b)
{
    ASSERT_EQ(a.size(), b.size());
    Apart apart(0.02f);
    for (size_t i = 0; i < a.size(); ++i) apart.add(a[i], b[i]);
    EXPECT_LT(apart.beyond(3e-3f), 1e-3);
    EXPECT_LT(apart.most(), 0.02f);
}

} // namespace

using GpuReevaluateEngine = scenes::GpuTest;

// Texels, and what doubts and the closed loop are made of: surfels and all their sides.
TEST_F(GpuReevaluateEngine, DoesTheSameOnEither)
{
    Room cpu({.engine = Engine::cpu});
    Room gpu({.engine = Engine::gpu});
    EXPECT_EQ(cpu.engine->inForce().engine.gpu, "cpu");
    EXPECT_EQ(gpu.engine->inForce().engine.gpu, device().description().name);
    const LampPowers powers = times(cpu.found, 1.6f);
    expectLightAlike(gpu.layers(gpu.reevaluate(powers)), cpu.layers(cpu.reevaluate(powers)));

    const SolvedRoom& found = gpu.room.solved;
    const SolvedRoom& expected = cpu.room.solved;
    expectAlike(found.lighting.irradiance, expected.lighting.irradiance);
    expectAlike(found.found.sides.albedo, expected.found.sides.albedo);
    expectAlike(found.found.sides.field.back, expected.found.sides.field.back);
    expectAlike(found.found.sides.direct, expected.found.sides.direct);
    EXPECT_EQ(found.found.sides.gathered.missed, expected.found.sides.gathered.missed);
    EXPECT_EQ(found.found.found.powers, expected.found.found.powers);
}

// Results are asked for layers long after others were re-evaluated, on the same device.
TEST_F(GpuReevaluateEngine, EarlierLayersStayWhatTheyAre)
{
    Room room({.engine = Engine::gpu});
    const Solution first = room.reevaluate(times(room.found, 0.5f));
    const PageLayers before = room.layers(first);
    const Solution second = room.reevaluate(times(room.found, 3.0f));
    const PageLayers after = room.layers(second);
    EXPECT_NE(before.albedo, after.albedo);
    EXPECT_NE(before.confidence, after.confidence);
    for (const auto& [solution, expected] : {std::tie(first, before), std::tie(second, after)}) {
        const PageLayers layers = room.layers(solution);
        EXPECT_EQ(layers.albedo, expected.albedo);
        EXPECT_EQ(layers.indirect, expected.indirect);
        EXPECT_EQ(layers.confidence, expected.confidence);
    }
}

// A lamp that is off is a burnt-out wall, which sends on what it gets.
TEST_F(GpuReevaluateEngine, ALampThatIsOffSendsOnWhatItGets)
{
    Room cpu({.engine = Engine::cpu});
    Room gpu({.engine = Engine::gpu});
    const LampPowers on = times(cpu.found, 1.1f);
    LampPowers off = times(cpu.found, 0.0f);
    off.outside = glm::vec3(0.5f);
    expectLightAlike(gpu.layers(gpu.reevaluate(on)), cpu.layers(cpu.reevaluate(on)));
    const auto shiningOf = [](const Room& room) {
        const std::vector<uint8_t>& shines = room.room.solved.found.sides.field.shines;
        return std::count(shines.begin(), shines.end(), 1);
    };
    EXPECT_NE(shiningOf(gpu), 0);
    expectLightAlike(gpu.layers(gpu.reevaluate(off)), cpu.layers(cpu.reevaluate(off)));
    EXPECT_EQ(shiningOf(gpu), 0);
}

TEST_F(GpuReevaluateEngine, LeavesADeviceInSoftwareAloneUnlessItIsAskedFor)
{
    const scenes::Solved room(scenes::LitRoom().scan);
    const bool isReal = device().description().isReal();
    EXPECT_EQ(ReevaluateEngine(room.texels, {}).inForce().engine.gpu != "cpu", isReal);
    EXPECT_EQ(ReevaluateEngine(room.texels, {.gpu = "0"}).inForce().engine.gpu,
              gpuDevices().at(0).name);
}

} // namespace relamp
