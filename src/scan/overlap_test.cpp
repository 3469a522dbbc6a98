#include "scan/overlap.h"

#include "scan/texels.h"
#include "scenes/refusal.h"
#include "scenes/scenes.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;

Texels rasterizeWhole(const Scan& scan)
{
    Progress progress;
    return rasterizeAtlas(scan, progress);
}

/// A square on the floor and its copy, moved.
Scan twoSquares(glm::vec3 way)
{
    Scan scan = scenes::square(2.0f, 64, scenes::plain(glm::vec3(0.5f)));
    scan.meshes[0].name = "first";
    scan.meshes.push_back(scan.meshes[0]);
    scan.meshes[1].name = "second";
    for (glm::vec3& p : scan.meshes[1].positions) p += way;
    return scan;
}

void turnOver(Mesh& mesh)
{
    for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
    for (glm::vec3& n : mesh.normals) n = -n;
}

size_t sharedPixels(const Texels& texels)
{
    const std::vector<bool>& isShared = texels.pages[0].isShared;
    return static_cast<size_t>(std::count(isShared.begin(), isShared.end(), true));
}

} // namespace

TEST(Overlap, TwoChartsOnOnePartAreCopied)
{
    const Scan scan = twoSquares({0.0f, 1.0f, 0.0f});
    const Texels texels = rasterizeWhole(scan);
    EXPECT_NEAR(texels.overlap.copied, 1.0, 0.05);
    EXPECT_EQ(texels.overlap.share(), texels.overlap.copied);
    EXPECT_THAT(texels.overlap.meshes, ElementsAre("first", "second"));
    EXPECT_GT(sharedPixels(texels), 3900u);
}

TEST(Overlap, OneOfThemTurnedOverIsMirrored)
{
    Scan scan = twoSquares({0.0f, 1.0f, 0.0f});
    for (glm::vec2& uv : scan.meshes[1].uvs) uv.x = 1.0f - uv.x;
    EXPECT_NEAR(rasterizeWhole(scan).overlap.mirrored, 1.0, 0.05);
}

TEST(Overlap, WhatLiesOnAnotherTileIsTiled)
{
    Scan scan = twoSquares({0.0f, 1.0f, 0.0f});
    for (glm::vec2& uv : scan.meshes[1].uvs) uv.x += 1.0f;
    EXPECT_NEAR(rasterizeWhole(scan).overlap.tiled, 1.0, 0.05);
}

// Half a page beyond the edge lies on the half that shows something else.
TEST(Overlap, WhatThePageRepeatsBeyondItsEdgeIsShared)
{
    Scan scan = scenes::square(2.0f, 64, scenes::plain(glm::vec3(0.5f)));
    for (glm::vec2& uv : scan.meshes[0].uvs) uv.x = 1.5f * uv.x - 0.25f;
    const Texels texels = rasterizeWhole(scan);
    EXPECT_GT(texels.overlap.tiled, 0.2);
    EXPECT_GT(sharedPixels(texels), 500u);
    EXPECT_LT(sharedPixels(texels), 4000u);
}

// Whoever comes first in the file: the one behind gets no light, and would be taken for enclosed.
TEST(Overlap, OfSkinsThatFaceAlikeTheOneInFrontHasTheTexels)
{
    for (const float up : {0.005f, -0.005f}) {
        const Scan scan = twoSquares({0.0f, up, 0.0f});
        const Texels texels = rasterizeWhole(scan);
        EXPECT_NEAR(texels.overlap.alike, 1.0, 0.05);
        EXPECT_EQ(texels.overlap.inOtherLight(), 0.0);
        EXPECT_EQ(sharedPixels(texels), 0u);
        const PageTexels& page = texels.pages[0];
        const float front = std::max(up, 0.0f);
        size_t inFront = 0;
        for (size_t i = 0; i < page.count(); ++i)
            inFront += std::abs(texels.siteOf(0, i).position.y - front) < 1e-3f ? 1u : 0u;
        EXPECT_GT(static_cast<double>(inFront), 0.95 * static_cast<double>(page.count())) << up;
    }
}

TEST(Overlap, SkinsThatFaceApartAreOpposite)
{
    Scan scan = twoSquares({0.0f, -0.005f, 0.0f});
    turnOver(scan.meshes[1]);
    const Texels texels = rasterizeWhole(scan);
    EXPECT_NEAR(texels.overlap.opposite, 1.0, 0.05);
    EXPECT_GT(sharedPixels(texels), 3900u);
}

TEST(Overlap, IsSaidToAHundredthOfAPerCent)
{
    Overlap overlap{.mirrored = 0.0248, .alike = 0.01, .meshes = {"chair"}};
    const std::string note = noteOn(overlap).value_or("");
    EXPECT_THAT(note, HasSubstr("3.48 % of its texels stand for several places"));
    EXPECT_THAT(note, HasSubstr("2.48 % mirrored"));
    EXPECT_THAT(note, HasSubstr("\"chair\""));
    EXPECT_FALSE(noteOn({.copied = 1e-4}).has_value());
}

TEST(Overlap, ThatSpoilsARoomIsRefusedUnlessAllowed)
{
    Scan scan = twoSquares({0.0f, 1.0f, 0.0f});
    EXPECT_THAT(scenes::refusalOf([&] { checkOverlap(rasterizeWhole(scan)); }),
                HasSubstr("--allow-overlap"));
    scan.options.allowOverlap = true;
    EXPECT_EQ(scenes::refusalOf([&] { checkOverlap(rasterizeWhole(scan)); }), "");
}

TEST(Overlap, DoubledSkinsAlikeAreNeverRefused)
{
    EXPECT_EQ(scenes::refusalOf([] {
                  checkOverlap(rasterizeWhole(twoSquares({0, 0.005f, 0})));
              }),
              "");
}

} // namespace relamp
