#include "solve/resolve_engine.h"

#include "scenes/apart.h"
#include "scenes/gpu_scene.h"
#include "scenes/lit_room.h"
#include "scenes/solved.h"

#include <functional>
#include <optional>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using scenes::Apart;

/// What a page's texels get, in their order.
std::vector<glm::vec3> shadingOf(const Texels& texels, const TexelShading& shade)
{
    std::vector<glm::vec3> all;
    const TexelLoader loader(texels, 0);
    const size_t count = texels.pages[0].count();
    for (size_t begin = 0; begin < count; begin += TexelBlock::kCapacity) {
        TexelBlock block;
        ShadingBlock out;
        const size_t size = std::min(TexelBlock::kCapacity, count - begin);
        loader.load(begin, size, block);
        loader.loadSurfel(begin, size, block);
        shade(0, begin, block, out);
        for (size_t i = 0; i < size; ++i) {
            all.emplace_back(out.direct.r[i], out.direct.g[i], out.direct.b[i]);
            all.emplace_back(out.indirect.r[i], out.indirect.g[i], out.indirect.b[i]);
        }
    }
    return all;
}

LampPowers times(LampPowers powers, float factor)
{
    for (glm::vec3& lamp : powers.lamps) lamp *= factor;
    return powers;
}

/// A room that one engine resolves.
struct Room
{
    explicit Room(const EngineOptions& options)
        : room(scenes::LitRoom().scan), found(powersOf(room.solved)),
          engine(std::make_shared<ResolveEngine>(room.texels, options))
    {}

    TexelShading resolve(const LampPowers& powers) { return engine->resolve(room.solved, powers); }
    [[nodiscard]] std::vector<glm::vec3> shading(const TexelShading& shade) const
    {
        return shadingOf(room.texels, shade);
    }

    scenes::Solved room;
    LampPowers found;
    std::shared_ptr<ResolveEngine> engine;
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

using GpuResolveEngine = scenes::GpuTest;

// Texels, and what doubts and the closed loop are made of: surfels and all their sides.
TEST_F(GpuResolveEngine, DoesTheSameOnEither)
{
    Room cpu({.engine = Engine::cpu});
    Room gpu({.engine = Engine::gpu});
    EXPECT_EQ(cpu.engine->name(), "cpu");
    EXPECT_EQ(gpu.engine->name(), device().description().name);
    const LampPowers powers = times(cpu.found, 1.6f);
    expectAlike(gpu.shading(gpu.resolve(powers)), cpu.shading(cpu.resolve(powers)));

    const SolvedRoom& found = gpu.room.solved;
    const SolvedRoom& expected = cpu.room.solved;
    expectAlike(found.lighting.irradiance, expected.lighting.irradiance);
    expectAlike(found.found.sides.albedo, expected.found.sides.albedo);
    expectAlike(found.found.sides.field.back, expected.found.sides.field.back);
    expectAlike(found.found.sides.direct, expected.found.sides.direct);
    EXPECT_EQ(found.found.sides.gathered.missed, expected.found.sides.gathered.missed);
    EXPECT_EQ(found.found.found.ambient, expected.found.found.ambient);
}

// Results are asked for layers long after others were resolved, on the same device.
TEST_F(GpuResolveEngine, EarlierShadingStaysWhatItIs)
{
    Room room({.engine = Engine::gpu});
    const TexelShading first = room.resolve(times(room.found, 0.5f));
    const std::vector<glm::vec3> before = room.shading(first);
    const TexelShading second = room.resolve(times(room.found, 3.0f));
    const std::vector<glm::vec3> after = room.shading(second);
    EXPECT_NE(before, after);
    EXPECT_EQ(room.shading(first), before);
    EXPECT_EQ(room.shading(second), after);
}

// A lamp that is off is a burnt-out wall, which sends on what it gets.
TEST_F(GpuResolveEngine, ALampThatIsOffSendsOnWhatItGets)
{
    Room cpu({.engine = Engine::cpu});
    Room gpu({.engine = Engine::gpu});
    const LampPowers on = times(cpu.found, 1.1f);
    LampPowers off = times(cpu.found, 0.0f);
    off.ambient = glm::vec3(0.5f);
    expectAlike(gpu.shading(gpu.resolve(on)), cpu.shading(cpu.resolve(on)));
    for (Room* room : {&cpu, &gpu}) {
        std::vector<uint8_t>& shines = room->room.solved.found.shines;
        EXPECT_NE(std::count(shines.begin(), shines.end(), 1), 0);
        std::fill(shines.begin(), shines.end(), uint8_t{0});
    }
    expectAlike(gpu.shading(gpu.resolve(off)), cpu.shading(cpu.resolve(off)));
}

TEST_F(GpuResolveEngine, LeavesADeviceInSoftwareAloneUnlessItIsAskedFor)
{
    const scenes::Solved room(scenes::LitRoom().scan);
    const bool isReal = device().description().isReal();
    EXPECT_EQ(ResolveEngine(room.texels, {}).name() != "cpu", isReal);
    EXPECT_EQ(ResolveEngine(room.texels, {.gpu = "0"}).name(), gpuDevices().at(0).name);
}

} // namespace relamp
