#include "scan/rays.h"

#include "scenes/scenes.h"

#include <vector>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

constexpr size_t kOfPanel = 2; // triangles
constexpr Ray kUpwards{{0.3f, -1.0f, 0.6f}, {0.0f, 1.0f, 0.0f}};

/// Two squares, 1 m and 2 m above where the ray starts.
Scan twoPanels()
{
    const std::vector<scenes::Panel> panels{{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}},
                                            {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}}};
    return scenes::panels(panels, 4, scenes::plain(glm::vec3(0.5f)));
}

/// What all of a packet and some more meet, one by one and together.
std::vector<Hit> hitsOf(const RayScene& scene)
{
    const std::vector<Ray> rays(19, kUpwards);
    std::vector<Hit> hits(rays.size());
    scene.intersect(rays, hits, RayOrder::coherent);
    hits.push_back(scene.intersect(kUpwards));
    return hits;
}

bool isBlocked(const RayScene& scene)
{
    const std::vector<Ray> rays(19, kUpwards);
    std::vector<uint8_t> blocked(rays.size());
    scene.occluded(rays, blocked);
    const bool isOne = scene.occluded(kUpwards);
    for (const uint8_t b : blocked) EXPECT_EQ(b != 0, isOne);
    return isOne;
}

} // namespace

TEST(Rays, PassWhatIsOpenAndMeetWhatIsBehind)
{
    const Scan scan = twoPanels();
    ASSERT_EQ(scan.triangleCount(), 2 * kOfPanel);
    const RayScene whole(scan);
    const RayScene rest = whole.without({1, 1, 0, 0});
    for (const Hit& hit : hitsOf(whole)) {
        EXPECT_LT(hit.triangle, kOfPanel);
        EXPECT_NEAR(hit.distance, 1.0f, 1e-5f);
    }
    for (const Hit& hit : hitsOf(rest)) {
        EXPECT_GE(hit.triangle, kOfPanel); // numbers stay those of the scan
        EXPECT_FALSE(hit.missed());
        EXPECT_NEAR(hit.distance, 2.0f, 1e-5f);
    }
    EXPECT_TRUE(isBlocked(rest));
    EXPECT_FALSE(isBlocked(whole.without({1, 1, 1, 1})));
    EXPECT_TRUE(isBlocked(whole));
}

TEST(Rays, MeetAllWhereNothingIsOpen)
{
    const RayScene same = RayScene(twoPanels()).without({0, 0, 0, 0}); // that outlives the first
    for (const Hit& hit : hitsOf(same)) EXPECT_LT(hit.triangle, kOfPanel);
}

} // namespace relamp
