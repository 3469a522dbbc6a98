#include "shading/enclosed_texels.h"

#include "base/radiometry.shared.h"
#include "scenes/scenes.h"

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

constexpr glm::vec3 kBoxLow(0.305f, 0.0f, 0.305f); // its edges cross texels
constexpr glm::vec3 kBoxHigh(0.7f, 0.4f, 0.7f);

/// A floor of one metre with a box on it, which has no bottom, or no side towards high x either.
Scan boxOnFloor(const scenes::Paint& paint, bool isOpenAtSide = false)
{
    const glm::vec3 size = kBoxHigh - kBoxLow;
    const glm::vec3 x(size.x, 0.0f, 0.0f);
    const glm::vec3 y(0.0f, size.y, 0.0f);
    const glm::vec3 z(0.0f, 0.0f, size.z);
    std::vector<scenes::Panel> panels{{glm::vec3(0.0f), {0.0f, 0.0f, 1.0f}, {1.0f, 0.0f, 0.0f}},
                                      {kBoxLow + y, z, x},
                                      {kBoxLow, z, y},
                                      {kBoxLow, y, x},
                                      {kBoxLow + z, x, y}};
    if (!isOpenAtSide) panels.push_back({kBoxLow + x, y, z});
    return scenes::panels(panels, 96, paint);
}

bool isUnderBox(glm::vec3 p, glm::vec3 n, float off)
{
    return n.y > 0.9f && p.y < 0.01f && p.x > kBoxLow.x + off && p.x < kBoxHigh.x - off &&
           p.z > kBoxLow.z + off && p.z < kBoxHigh.z - off;
}

struct BoxRoom
{
    explicit BoxRoom(const scenes::Paint& paint, bool isOpenAtSide = false)
        : scan(boxOnFloor(paint, isOpenAtSide)), scene(scan), texels(rasterizeAtlas(scan, progress))
    {}

    Progress progress;
    Scan scan;
    RayScene scene;
    Texels texels;
};

} // namespace

TEST(EnclosedTexels, AreTheFloorUnderABoxAndNothingElse)
{
    BoxRoom room(scenes::plain(glm::vec3(0.5f)));
    separateEnclosed(room.texels, room.scene, room.progress);
    size_t under = 0;
    const PageTexels& page = room.texels.pages[0];
    for (size_t i = 0; i < page.count(); ++i) {
        const TexelSite site = room.texels.siteOf(0, i);
        const bool isEnclosed = room.texels.surfels.isEnclosed(page.runs[page.runOf(i)].surfel);
        if (isUnderBox(site.position, site.normal, 0.02f)) {
            EXPECT_TRUE(isEnclosed);
            ++under;
        } else if (!isUnderBox(site.position, site.normal, -0.02f)) {
            EXPECT_FALSE(isEnclosed) << site.position.x << ' ' << site.position.y;
        }
    }
    EXPECT_GT(under, 100u);
}

// Before the open side six rays in ten meet a back, deep inside nine.
TEST(EnclosedTexels, UnderABoxThatIsOpenAtASideAreThoseDeepInside)
{
    BoxRoom room(scenes::plain(glm::vec3(0.5f)), true);
    separateEnclosed(room.texels, room.scene, room.progress);
    size_t deep = 0;
    const PageTexels& page = room.texels.pages[0];
    for (size_t i = 0; i < page.count(); ++i) {
        const TexelSite site = room.texels.siteOf(0, i);
        if (!isUnderBox(site.position, site.normal, 0.02f)) continue;
        const bool isEnclosed = room.texels.surfels.isEnclosed(page.runs[page.runOf(i)].surfel);
        const bool isInTheMiddle = std::abs(site.position.z - 0.5f) < 0.1f;
        if (site.position.x > kBoxHigh.x - 0.05f && isInTheMiddle) {
            EXPECT_FALSE(isEnclosed) << site.position.x << ' ' << site.position.z;
        }
        if (site.position.x < kBoxLow.x + 0.15f) {
            EXPECT_TRUE(isEnclosed) << site.position.x << ' ' << site.position.z;
            ++deep;
        }
    }
    EXPECT_GT(deep, 100u);
}

// The floor is grey and the light on it one; under the box it is a tenth. A texel under it that
// shows half of what the floor shows has half of its light, for its paint goes on.
TEST(EnclosedTexels, AtTheirRimThePaintAroundGoesOn)
{
    BoxRoom room([](glm::vec3 p, glm::vec3 n) {
        if (!isUnderBox(p, n, 0.0f)) return glm::vec3(0.4f);
        return glm::vec3(isUnderBox(p, n, 0.03f) ? 0.02f : 0.2f);
    });
    separateEnclosed(room.texels, room.scene, room.progress);
    const Surfels& surfels = room.texels.surfels;
    const SurfelRadiance radiance = collectRadiance(room.texels, room.progress);
    const std::vector<Rim> rims =
        rimsOf(surfels, radiance, std::vector<glm::vec3>(surfels.count(), glm::vec3(kPi)));
    const TexelLoader loader(room.texels, 0);
    TexelBlock block;
    ShadingBlock shading;
    size_t atRim = 0;
    for (size_t begin = 0; begin < room.texels.pages[0].count(); begin += 256) {
        const size_t count = std::min<size_t>(256, room.texels.pages[0].count() - begin);
        loader.load(begin, count, block);
        loader.loadSurfel(begin, count, block);
        for (size_t i = 0; i < count; ++i) {
            shading.direct.r[i] = shading.direct.g[i] = shading.direct.b[i] = 0.0f;
            shading.indirect.r[i] = shading.indirect.g[i] = shading.indirect.b[i] = 0.1f;
        }
        letRimsIn(rims, block, shading);
        for (size_t i = 0; i < count; ++i) {
            if (!surfels.isEnclosed(block.surfel[i])) continue;
            if (block.r[i] < 0.1f) {
                EXPECT_NEAR(shading.indirect.r[i], 0.1f, 1e-3f);
                continue;
            }
            EXPECT_NEAR(shading.indirect.r[i], 0.5f, 0.02f);
            ++atRim;
        }
    }
    EXPECT_GT(atRim, 20u);
}

TEST(EnclosedTexels, AtTheRimAreOpenInPart)
{
    BoxRoom room(scenes::plain(glm::vec3(0.5f)));
    separateEnclosed(room.texels, room.scene, room.progress);
    const TexelMarks open = openShares(room.texels, room.scene);
    const PageTexels& page = room.texels.pages[0];
    const float half =
        0.5f * std::sqrt(room.texels.facets.facets[page.facet[0]].texelArea); // edge of the floor's
    size_t inPart = 0;
    for (size_t i = 0; i < page.count(); ++i) {
        const TexelSite site = room.texels.siteOf(0, i);
        if (isUnderBox(site.position, site.normal, half + 0.001f))
            EXPECT_EQ(open[0][i], 0);
        else if (!isUnderBox(site.position, site.normal, 0.0f))
            EXPECT_EQ(open[0][i], 255);
        else if (open[0][i] > 0 && open[0][i] < 160) // its middle is under: about half at most
            ++inPart;
    }
    EXPECT_GT(inPart, 20u);
}

} // namespace relamp
