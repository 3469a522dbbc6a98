#include "shading/gathered_light.h"

#include "base/radiometry.shared.h"
#include "scenes/axes.h"
#include "scenes/radiosity.h"
#include "scenes/surfaces.h"
#include "shading/lit_sides.h"

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using scenes::kUp;

constexpr scenes::Panel kFloor{{0, 0, 0}, {0, 0, 2}, {2, 0, 0}};

/// 0.4 m squared, a metre over the floor's middle, facing down.
constexpr scenes::Panel kLamp{{0.8f, 1.0f, 0.8f}, {0.4f, 0, 0}, {0, 0, 0.4f}};

AreaLight lamp()
{
    std::vector<ClippedPatch> patches;
    for (int i = 0; i < 256; ++i) {
        const float u = (static_cast<float>(i % 16) + 0.5f) / 16.0f;
        const float v = (static_cast<float>(i / 16) + 0.5f) / 16.0f;
        patches.push_back({kLamp.at(u, v), -kUp, 0.16f / 256.0f, 0});
    }
    return AreaLight(std::move(patches));
}

/// Calls visit(place, shading, i) for every texel of a floor under the lamp.
template<class Visit>
void forEachShaded(const std::vector<AreaLight>& lamps, glm::vec3 indirect, const Visit& visit)
{
    const scenes::Surfaces floor(
        scenes::panels(std::vector<scenes::Panel>{kFloor}, 64, scenes::plain(glm::vec3(0.5f))));
    HitLists fronts;
    for (uint32_t s = 0; s < floor.texels.surfels.count(); ++s)
        fronts.sideOfList.push_back(Side::front(s));
    std::vector<LampSight> coarse;
    std::vector<LampPatches> patches;
    for (const AreaLight& light : lamps) {
        coarse.push_back(directOfLists(floor.texels, floor.rays, fronts, {light}));
        patches.emplace_back(light);
    }
    const auto light = std::make_shared<GatheredLight>(GatheredLight{
        std::make_shared<const CastLamps>(std::move(patches),
                                          Visibility(floor.texels, floor.rays, lamps, coarse, {}),
                                          floor.texels.surfels),
        std::vector(lamps.size(), glm::vec3(3.0f, 2.0f, 1.0f)),
        std::vector<glm::vec3>(floor.texels.surfels.count(), indirect)});
    const TexelShading shade = shadingOf(floor.texels, light);
    const TexelLoader loader(floor.texels, 0);
    const size_t texels = floor.texels.pages[0].count();
    for (size_t begin = 0; begin < texels; begin += TexelBlock::kCapacity) {
        TexelBlock block;
        loader.load(begin, std::min(TexelBlock::kCapacity, texels - begin), block);
        ShadingBlock shading;
        shade(0, begin, block, shading);
        for (size_t i = 0; i < block.count; ++i)
            visit(glm::vec3(block.x[i], block.y[i], block.z[i]), shading, i);
    }
}

} // namespace

// Shading is irradiance / pi: the same light on all surfels is the same on all texels.
TEST(GatheredLight, EvenLightIsEvenBetweenSurfels)
{
    forEachShaded({}, kPi * glm::vec3(0.4f, 0.2f, 0.1f),
                  [](glm::vec3, const ShadingBlock& shading, size_t i) {
                      EXPECT_NEAR(shading.indirect.r[i], 0.4f, 1e-5f);
                      EXPECT_NEAR(shading.indirect.b[i], 0.1f, 1e-5f);
                      EXPECT_EQ(shading.direct.r[i], 0.0f);
                  });
}

TEST(GatheredLight, DirectLightIsThePanelsFormFactorTimesItsRadiance)
{
    forEachShaded({lamp()}, glm::vec3(0.0f),
                  [](glm::vec3 place, const ShadingBlock& shading, size_t i) {
                      const float exact = scenes::irradianceFrom(kLamp, place, kUp) / kPi;
                      EXPECT_NEAR(shading.direct.r[i], 3.0f * exact, 0.09f * exact);
                      EXPECT_NEAR(shading.direct.b[i], exact, 0.03f * exact);
                  });
}

TEST(GatheredLight, LampsAddUp)
{
    float once = 0.0f;
    float twice = 0.0f;
    const auto sumInto = [](float& sum) {
        return [&sum](glm::vec3, const ShadingBlock& shading, size_t i) {
            sum += shading.direct.g[i];
        };
    };
    forEachShaded({lamp()}, glm::vec3(0.0f), sumInto(once));
    forEachShaded({lamp(), lamp()}, glm::vec3(0.0f), sumInto(twice));
    EXPECT_NEAR(twice, 2.0f * once, 1e-3f * once);
}

} // namespace relamp
