#include "albedo/doubts.h"

#include "scenes/scenes.h"
#include "scenes/surfaces.h"

#include <cmath>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

// Half of a floor in the dark; the edge runs along x = 1.
glm::vec3 halfLit(glm::vec3 place, glm::vec3)
{
    return glm::vec3(place.x < 1.0f ? 0.1f : 0.5f);
}

/// A floor of two metres on which `paint` is seen and `lit` is thought to be the light.
std::vector<SurfelTrust> trustUnder(const scenes::Paint& paint, const scenes::Paint& lit)
{
    const scenes::Surfaces floor(scenes::square(2.0f, 128, paint));
    const Surfels& surfels = floor.texels.surfels;
    SurfelLighting light{{}, std::vector<uint8_t>(surfels.count(), 1)};
    for (const glm::vec3 place : surfels.position) light.irradiance.push_back(lit(place, {}));
    std::vector<SurfelTrust> trust(surfels.count());
    doubtEdges(surfels, floor.radiance, light, trust);
    return trust;
}

size_t doubted(const std::vector<SurfelTrust>& trust)
{
    return static_cast<size_t>(
        std::count_if(trust.begin(), trust.end(), [](SurfelTrust t) { return t.edges < 0.5f; }));
}

} // namespace

TEST(Doubts, RoomSeenFromInsideHasNone)
{
    const scenes::Surfaces room(scenes::room({2, 2, 2}, 32, scenes::plain(glm::vec3(0.4f))));
    const auto trust = trustByView(scenes::hitListsOf(room, 64), room.texels.surfels.count());
    for (const SurfelTrust t : trust) {
        EXPECT_EQ(t.seen, 1.0f);
        EXPECT_EQ(t.front, 1.0f);
    }
}

TEST(Doubts, FloorUnderTheSkyIsLitByWhatIsNotInTheScan)
{
    const scenes::Surfaces floor(scenes::square(1.0f, 32, scenes::plain(glm::vec3(0.4f))));
    const auto trust = trustByView(scenes::hitListsOf(floor, 64), floor.texels.surfels.count());
    for (const SurfelTrust t : trust) EXPECT_EQ(t.seen, 0.0f);
}

// A sheet close above the floor that faces up, too, shows it its back.
TEST(Doubts, FloorUnderASheetSeesItsBack)
{
    const scenes::Panel floor{{1, 0, 1}, {0, 0, 1}, {1, 0, 0}};
    const scenes::Panel sheet{{0, 0.1f, 0}, {0, 0, 3}, {3, 0, 0}};
    const scenes::Panel both[] = {floor, sheet};
    const scenes::Surfaces room(scenes::panels(both, 64, scenes::plain(glm::vec3(0.4f))));
    const auto trust = trustByView(scenes::hitListsOf(room, 64), room.texels.surfels.count());
    EXPECT_EQ(trust[room.at({1.5f, 0, 1.5f}, {0, 1, 0})].front, 0.0f);
    EXPECT_EQ(trust[room.at({1.5f, 0.1f, 1.5f}, {0, 1, 0})].front, 1.0f);
}

TEST(Doubts, ShadowEdgeWhereTheTextureHasItIsTrusted)
{
    EXPECT_EQ(doubted(trustUnder(halfLit, halfLit)), 0u);
}

TEST(Doubts, ShadowEdgeWhereTheTextureHasNoneIsNot)
{
    const auto elsewhere = [](glm::vec3 place, glm::vec3) {
        return glm::vec3(place.x < 1.3f ? 0.1f : 0.5f);
    };
    EXPECT_GT(doubted(trustUnder(halfLit, elsewhere)), 10u);
}

TEST(Doubts, SomeTrustIsLeftAtAnyEdge)
{
    const auto opposite = [](glm::vec3 place, glm::vec3 normal) {
        return 0.06f / halfLit(place, normal);
    };
    float least = 1.0f;
    for (const SurfelTrust trust : trustUnder(halfLit, opposite))
        least = std::min(least, trust.edges);
    EXPECT_EQ(least, 0.1f);
}

// Tiles have edges, too; what tells of no shadow cannot be at odds with one.
TEST(Doubts, PatternUnderEvenLightIsTrusted)
{
    EXPECT_EQ(doubted(trustUnder(halfLit, scenes::plain(glm::vec3(0.7f)))), 0u);
}

// Both ways alike; a tenth is always left.
TEST(Doubts, LightThatWasCorrectedByMuchIsDoubted)
{
    std::vector<SurfelTrust> trust(4);
    doubtCorrections(std::vector<float>{1.0f, 0.95f, std::exp(-0.25f), 0.3f}, trust);
    EXPECT_FLOAT_EQ(trust[0].edges, 1.0f);
    EXPECT_FLOAT_EQ(trust[1].edges, 1.0f);
    EXPECT_NEAR(trust[2].edges, 0.5f, 0.01f);
    EXPECT_FLOAT_EQ(trust[3].edges, 0.1f);
}

} // namespace relamp
