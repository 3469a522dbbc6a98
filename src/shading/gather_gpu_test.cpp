#include "shading/gather_gpu.h"

#include "scenes/apart.h"
#include "scenes/gpu_scene.h"
#include "scenes/lit_room.h"
#include "scenes/surfaces.h"
#include "shading/lit_sides_gpu.h"

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using scenes::Apart;

/// A box without its ceiling, so that rays leave it, whose front wall shows a burnt-out sheet.
Scan openBox()
{
    const scenes::LitRoom lit;
    std::vector<scenes::Panel> walls = scenes::wallsOf(scenes::LitRoom::kSize);
    walls.erase(walls.begin() + 1);
    Scan scan = scenes::panels(walls, 64, [&](glm::vec3 p, glm::vec3 n) {
        return glm::min(lit.box.photo(p, n), glm::vec3(1.0f));
    });
    scan.pages[0].image.clipsAtWhite = true;
    return scan;
}

/// Every surfel's parts and sides send something else.
RadianceField colourful(const scenes::Surfaces& surfaces)
{
    RadianceField field = fieldOf(surfaces.radiance);
    for (size_t s = 0; s < field.plain.size(); ++s) {
        field.clipped[s] = glm::vec3(1.0f + 0.01f * static_cast<float>(s % 100), 2.0f, 3.0f);
        field.back[s] = glm::vec3(0.1f, 0.2f, 0.003f * static_cast<float>(s % 50));
        field.shines[s] = s % 3 == 0 ? 1 : 0;
    }
    return field;
}

} // namespace

using GpuGather = scenes::GpuTest;

// Radiances are kept as halves.
TEST_F(GpuGather, GathersAsTheCpuDoes)
{
    const scenes::Surfaces box(openBox());
    const HitLists hits = scenes::hitListsOf(box, 32);
    const size_t surfels = box.texels.surfels.count();
    const RadianceField field = colourful(box);
    const Gathered expected = gather(hits, field);

    const GatherGpu gpu(device());
    const GpuSightLists lists(device(), hits, surfels);
    const gpu::Array<glm::uvec2> radiance(device(), fieldOnGpu(field));
    const GpuGathered gathered(device(), lists.count);
    gpu::Commands commands(device());
    gpu.gather(commands, lists, radiance, gathered, lists.count);
    commands.run();
    const std::vector<glm::vec4> found = gathered.irradiance.download();
    const std::vector<float> missed = gathered.missed.download();
    Apart light(0.01f);
    Apart noise(0.05f);
    float mostMissed = 0.0f;
    for (size_t i = 0; i < lists.count; ++i) {
        light.add(glm::vec3(found[i]), expected.irradiance[i]);
        noise.add(glm::vec3(found[i].w), glm::vec3(expected.noise[i]));
        EXPECT_NEAR(missed[i], expected.missed[i], 1e-5f);
        mostMissed = std::max(mostMissed, missed[i]);
    }
    EXPECT_LT(light.most(), 1e-3f);
    EXPECT_LT(noise.most(), 0.02f);
    EXPECT_GT(mostMissed, 1.0f);
}

// The four rounds that settle burnt-out walls and backs, and what is left after them.
TEST_F(GpuGather, SettlesSidesAsTheCpuDoes)
{
    scenes::Surfaces box(openBox());
    const HitLists hits = scenes::hitListsOf(box, 32);
    const Surfels& surfels = box.texels.surfels;
    for (size_t s = 0; s < surfels.count(); ++s) // of some, a gain was taken out
        box.radiance.white.emplace_back(s % 5 == 0 ? 1.25f : 1.0f, 1.0f, 0.875f);
    const glm::vec3 ambient(0.3f, 0.2f, 0.1f);
    std::vector<glm::vec3> direct;
    for (const Side side : hits.sideOfList)
        direct.emplace_back(5.0f * surfels.position[side.surfel()].y, 3.0f, 2.0f);
    std::vector<uint8_t> shines(surfels.count(), 0);
    for (size_t s = 0; s < surfels.count(); ++s) shines[s] = s % 11 == 0 ? 1 : 0;
    const LitSides sides = lightSides(box.texels, hits, box.radiance, direct, shines, ambient);
    const std::vector<glm::vec3> expected = indirectOfFronts(surfels, hits, sides);

    const GpuSurfels onGpu(device(), surfels);
    LitSidesGpu gpu(device(), hits, box.radiance, {shines, {}});
    gpu.setOutside(ambient);
    std::vector<glm::uvec2> halvesOfDirect;
    for (const glm::vec3 irradiance : direct)
        halvesOfDirect.push_back(packedHalves(glm::vec4(irradiance, 0.0f)));
    const gpu::Array<glm::uvec2> directOnGpu(device(), halvesOfDirect);
    gpu::Commands commands(device());
    gpu.light(commands, onGpu, directOnGpu);
    commands.run();
    Apart gathered(0.01f);
    const std::vector<glm::vec4> received = gpu.gathered().download();
    for (size_t i = 0; i < received.size(); ++i)
        gathered.add(glm::vec3(received[i]), sides.gathered.irradiance[i]);
    EXPECT_LT(gathered.most(), 2e-3f);
    Apart indirect(0.01f);
    const std::vector<glm::vec4> found = gpu.indirect().download();
    for (size_t s = 0; s < found.size(); ++s) {
        indirect.add(glm::vec3(found[s]), expected[s]);
        EXPECT_EQ(found[s].w, 1.0f);
    }
    EXPECT_LT(indirect.most(), 5e-3f);
}

} // namespace relamp
