#include "solve/by_gather.h"

#include "base/half.h"
#include "base/radiometry.shared.h"
#include "scenes/lit_room.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using scenes::LitRoom;

glm::vec3 rgbAt(const std::vector<uint16_t>& picture, uint32_t pixel)
{
    const uint16_t* rgb = &picture[3 * size_t{pixel}];
    return {floatFromHalf(rgb[0]), floatFromHalf(rgb[1]), floatFromHalf(rgb[2])};
}

/// The room, solved, and its layers.
struct Solved
{
    LitRoom room;
    Decomposition result;
    PageLayers layers;
    Texels texels;

    explicit Solved(const std::optional<Lights>& lights = {})
        : result(solve(room.scan, lights)), layers(layersOf(result)), texels(texelsOf(room.scan))
    {}

    static Decomposition solve(const Scan& scan, const std::optional<Lights>& lights)
    {
        Progress progress;
        return delight(scenes::copyOf(scan), {.lights = lights}, progress);
    }
    static PageLayers layersOf(const Decomposition& result)
    {
        Progress progress;
        return result.layers(0, progress);
    }
    static Texels texelsOf(const Scan& scan)
    {
        Progress progress;
        return rasterizeAtlas(scan, progress);
    }

    /// Calls visit(site, pixel) for texels that are not burnt out.
    template<class Visit>
    void forEachPlain(const Visit& visit) const
    {
        const Radiance radiance(room.scan.pages[0].image);
        for (size_t i = 0; i < texels.pages[0].count(); ++i) {
            const uint32_t pixel = texels.pages[0].pixel[i];
            const glm::vec3 rgb = radiance[pixel];
            if (std::max({rgb.r, rgb.g, rgb.b}) < 0.97f) visit(texels.siteOf(0, i), pixel);
        }
    }

    [[nodiscard]] float meanDirect() const
    {
        float sum = 0.0f;
        float count = 0.0f;
        forEachPlain([&](const TexelSite&, uint32_t pixel) {
            sum += rgbAt(layers.direct, pixel).g;
            count += 1.0f;
        });
        return sum / count;
    }
};

float quantile(std::vector<float> values, double share)
{
    const auto at =
        values.begin() + static_cast<ptrdiff_t>(share * (static_cast<double>(values.size()) - 1.0));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

} // namespace

// The room is lit by exact form factors and radiosity; nothing of that is known to the solver.
TEST(ByGather, AlbedoOfALitRoomComesBackInAbsoluteTerms)
{
    const Solved solved;
    std::vector<float> wrong;
    solved.forEachPlain([&](const TexelSite& site, uint32_t pixel) {
        const glm::vec3 ratio =
            rgbAt(solved.layers.albedo, pixel) / LitRoom::albedo(site.position, site.normal);
        wrong.push_back(std::abs(std::log(ratio.g)));
        wrong.push_back(std::abs(std::log(ratio.b)));
    });
    EXPECT_LT(quantile(wrong, 0.5), 0.04f);
    EXPECT_LT(quantile(wrong, 0.95), 0.1f);
}

TEST(ByGather, LightsAreTheLampWithItsErrorAndTheLoopCloses)
{
    const Solved solved;
    const Lights& lights = solved.result.lights();
    ASSERT_EQ(lights.fixtures.size(), 1u);
    EXPECT_LT(glm::distance(lights.fixtures[0].centre, LitRoom::kLampCentre), 0.05f);
    EXPECT_NEAR(lights.fixtures[0].area, LitRoom::kLampArea, 0.05f);
    EXPECT_NEAR(lights.fixtures[0].normal.y, -1.0f, 1e-3f);
    EXPECT_GT(lights.fixtures[0].error.g, 0.0f);
    EXPECT_EQ(lights.points.size(), 1u);
    EXPECT_LT(solved.result.closure().rmsError, 0.05f * solved.result.closure().rmsInput);
    EXPECT_GE(solved.result.optionsInForce().gather.rays, 16);
}

TEST(ByGather, LampShinesAndTheBurntOutSheetDoesNot)
{
    const Solved solved;
    ASSERT_FALSE(solved.layers.emission.empty());
    for (size_t i = 0; i < solved.texels.pages[0].count(); ++i) {
        const TexelSite site = solved.texels.siteOf(0, i);
        const uint32_t pixel = solved.texels.pages[0].pixel[i];
        const bool shines = solved.layers.emission[3 * size_t{pixel}] != 0;
        EXPECT_EQ(shines, solved.room.box.isLamp(site.position, site.normal));
    }
}

TEST(ByGather, EditedLightsAreBelieved)
{
    Lights lights = Solved().result.lights();
    const Solved once(lights);
    lights.fixtures[0].radiance *= 1.2f; // not clearly wrong: else it would not be believed
    const Solved brighter(lights);
    std::vector<float>
        ratio; // light is corrected anew under each: these lights do not fit the scan
    brighter.forEachPlain([&](const TexelSite&, uint32_t pixel) {
        const float before = rgbAt(once.layers.direct, pixel).g;
        if (before > 0.05f) ratio.push_back(rgbAt(brighter.layers.direct, pixel).g / before);
    });
    EXPECT_NEAR(quantile(ratio, 0.5), 1.2f, 0.01f);
    EXPECT_NEAR(quantile(ratio, 0.1), 1.2f, 0.05f);
    EXPECT_NEAR(quantile(ratio, 0.9), 1.2f, 0.05f);

    const Fixture disc{.centre = {3.0f, 2.4f, 4.0f},
                       .normal = {0, -1, 0},
                       .area = 0.2f,
                       .radiance = glm::vec3(50.0f)};
    lights.fixtures[0].radiance = glm::vec3(0.0f);
    lights.points.clear();
    lights.ambient = glm::vec3(0.1f);
    EXPECT_EQ(Solved(lights).meanDirect(), 0.0f);
    lights.fixtures.push_back(disc);
    const Solved withDisc(lights);
    EXPECT_EQ(withDisc.result.lights().fixtures.size(), 1u);
    float below = 0.0f;
    withDisc.forEachPlain([&](const TexelSite& site, uint32_t pixel) {
        if (glm::distance(site.position, {3.0f, 0.0f, 4.0f}) < 0.05f)
            below = rgbAt(withDisc.layers.direct, pixel).g;
    });
    EXPECT_NEAR(below, 50.0f * 0.2f / (2.4f * 2.4f) / kPi, 0.05f); // A L / (pi d^2), corrected
}

// The sheet is burnt out and no lamp; a person who says that it shines gets it, and no disc before
// it.
TEST(ByGather, FixtureOfAFileThatStandsOnWhatIsBurntOutIsThat)
{
    Lights lights = Solved().result.lights();
    lights.fixtures.push_back({.centre = LitRoom::kSheetCentre,
                               .normal = {1, 0, 0},
                               .area = 0.8f,
                               .radiance = glm::vec3(5.0f)});
    const Solved solved(lights);
    ASSERT_FALSE(solved.layers.emission.empty());
    size_t shining = 0;
    for (size_t i = 0; i < solved.texels.pages[0].count(); ++i) {
        const TexelSite site = solved.texels.siteOf(0, i);
        const bool shines =
            solved.layers.emission[3 * size_t{solved.texels.pages[0].pixel[i]}] != 0;
        if (shines && site.normal.x > 0.5f) ++shining;
    }
    EXPECT_GT(shining, 100u);
}

} // namespace relamp
