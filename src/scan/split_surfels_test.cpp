#include "scan/split_surfels.h"

#include "scenes/scenes.h"

#include <cmath>
#include <set>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

Texels rasterizeLayered(const Scan& scan)
{
    Progress progress;
    return rasterizeAtlas(scan, progress, {.layered = true});
}

/// Two squares of one metre that face up, one `apart` metres over the other.
Scan twoLayers(float apart)
{
    const scenes::Panel lower{{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f}, {1.0f, 0.0f, 0.0f}};
    const scenes::Panel upper{{0.0f, apart, 0.0f}, {0.0f, 0.0f, 1.0f}, {1.0f, 0.0f, 0.0f}};
    return scenes::panels(std::vector{lower, upper}, 64, scenes::plain(glm::vec3(0.5f)));
}

/// Surfels whose texels lie on both layers.
size_t mixed(const Texels& texels, float middle)
{
    std::set<uint32_t> below;
    std::set<uint32_t> above;
    for (size_t p = 0; p < texels.pages.size(); ++p) {
        const PageTexels& page = texels.pages[p];
        for (size_t i = 0; i < page.count(); ++i)
            (texels.siteOf(p, i).position.y < middle ? below : above)
                .insert(page.runs[page.runOf(i)].surfel);
    }
    size_t both = 0;
    for (const uint32_t s : below) both += above.count(s);
    return both;
}

} // namespace

TEST(SplitSurfels, OfTwoLayersEachHasItsOwn)
{
    const Scan scan = twoLayers(0.03f);
    const Texels texels = rasterizeLayered(scan);
    ASSERT_GT(texels.surfels.size, 0.05f); // both lie in one cell
    EXPECT_EQ(mixed(texels, 0.015f), 0u);
    for (size_t s = 0; s < texels.surfels.count(); ++s) {
        const float y = texels.surfels.position[s].y;
        EXPECT_TRUE(std::abs(y) < 1e-4f || std::abs(y - 0.03f) < 1e-4f) << y;
        EXPECT_NEAR(texels.surfels.normal[s].y, 1.0f, 1e-4f);
        for (const uint32_t n : texels.surfels.neighborsOf(s))
            EXPECT_NEAR(texels.surfels.position[n].y, y, 1e-4f); // and goes on in it
    }
}

TEST(SplitSurfels, AThinSheetStaysOfOnePiece)
{
    const Scan scan = twoLayers(0.004f);
    const Texels texels = rasterizeLayered(scan);
    EXPECT_GT(mixed(texels, 0.002f), texels.surfels.count() / 2);
}

TEST(SplitSurfels, ASlopeIsNoStep)
{
    const scenes::Panel slope{{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f}, {1.0f, 0.8f, 0.0f}};
    const Scan scan = scenes::panels(std::vector{slope}, 64, scenes::plain(glm::vec3(0.5f)));
    const Texels texels = rasterizeLayered(scan);
    for (const uint64_t key : texels.surfels.key)
        EXPECT_EQ(key & static_cast<uint64_t>(SurfelPart::upper), 0u);
}

TEST(SplitSurfels, FindsTheLayerThatIsNearer)
{
    const Scan scan = twoLayers(0.03f);
    const Texels texels = rasterizeLayered(scan);
    const glm::vec3 up(0.0f, 1.0f, 0.0f);
    const uint32_t lower = texels.surfels.find({0.5f, 0.004f, 0.5f}, up);
    const uint32_t upper = texels.surfels.find({0.5f, 0.026f, 0.5f}, up);
    EXPECT_NEAR(texels.surfels.position[lower].y, 0.0f, 1e-4f);
    EXPECT_NEAR(texels.surfels.position[upper].y, 0.03f, 1e-4f);
}

TEST(SplitSurfels, MarkedTexelsLeaveTheirSurfelsAndKeepTheirArea)
{
    const Scan scan = scenes::square(1.0f, 64, scenes::plain(glm::vec3(0.5f)));
    Texels texels = rasterizeLayered(scan);
    const size_t before = texels.surfels.count();
    const PageTexels page = texels.pages[0];
    TexelMarks marks{std::vector<uint8_t>(page.count(), 0)};
    std::set<uint32_t> marked;
    for (size_t i = 0; i < page.count(); ++i)
        if (texels.siteOf(0, i).position.x < 0.49f) {
            marks[0][i] = 1;
            marked.insert(page.pixel[i]);
        }
    splitSurfels(texels, marks, SurfelPart::enclosed);
    findNeighbors(texels.surfels);
    EXPECT_GT(texels.surfels.count(), before); // the cells that x = 0.49 m runs through
    double area = 0.0;
    for (size_t s = 0; s < texels.surfels.count(); ++s) {
        area += static_cast<double>(texels.surfels.area[s]);
        for (const uint32_t n : texels.surfels.neighborsOf(s))
            EXPECT_EQ(texels.surfels.isEnclosed(n), texels.surfels.isEnclosed(s));
    }
    EXPECT_NEAR(area, 1.0, 1e-4);
    ASSERT_EQ(texels.pages[0].count(), page.count());
    for (size_t i = 0; i < page.count(); ++i) {
        const uint32_t surfel = texels.pages[0].runs[texels.pages[0].runOf(i)].surfel;
        EXPECT_EQ(texels.surfels.isEnclosed(surfel), marked.contains(texels.pages[0].pixel[i]));
    }
}

} // namespace relamp
