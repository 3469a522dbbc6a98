#include "scan/texels.h"

#include "relamp/error.h"
#include "relamp/threads.h"
#include "scan/footprints.h"
#include "scan/overlap.h"
#include "scenes/scenes.h"

#include <cmath>
#include <set>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

Texels rasterize(const Scan& scan)
{
    Progress progress;
    return rasterizeAtlas(scan, progress);
}

/// Calls `visit(block, i, pixel)` for every texel of the first page.
template<class Visit>
void forEachTexel(const Texels& texels, const Visit& visit)
{
    const TexelLoader loader(texels, 0);
    const size_t count = texels.pages[0].count();
    TexelBlock block;
    for (size_t begin = 0; begin < count; begin += TexelBlock::kCapacity) {
        const size_t blockCount = std::min(TexelBlock::kCapacity, count - begin);
        loader.load(begin, blockCount, block);
        loader.loadSurfel(begin, blockCount, block);
        for (size_t i = 0; i < block.count; ++i) visit(block, i, texels.pages[0].pixel[begin + i]);
    }
}

const scenes::Paint kGreyPaint = scenes::plain(glm::vec3(0.5f));

/// The square again, with one colour a corner and no texture.
Scan vertexColored()
{
    Scan scan = scenes::square(2.0f, 4, kGreyPaint);
    scan.meshes[0].uvs.clear();
    scan.pages[0].ofVertices = true;
    scan.pages[0].image.width = 4;
    scan.pages[0].image.height = 1;
    scan.pages[0].image.half().resize(12);
    return scan;
}

} // namespace

TEST(Texels, AreasSumToTheMeshsArea)
{
    EXPECT_NEAR(rasterize(scenes::square(2.0f, 64, kGreyPaint)).area, 4.0, 1e-4);
    const Texels room = rasterize(scenes::room({4.0f, 2.5f, 3.0f}, 96, kGreyPaint));
    EXPECT_NEAR(room.area, 2.0 * (4.0 * 2.5 + 4.0 * 3.0 + 2.5 * 3.0), 0.01);
    double ofSurfels = 0.0;
    for (const float area : room.surfels.area) ofSurfels += static_cast<double>(area);
    EXPECT_NEAR(ofSurfels, room.area, 1e-3 * room.area);
}

// Cells are counted from the low corner: one far away would put all of a room into a single cell.
TEST(Texels, AVertexThatNoTriangleUsesChangesNoSurfel)
{
    Scan room = scenes::room({4.0f, 2.5f, 3.0f}, 64, kGreyPaint);
    const std::vector<uint64_t> keys = rasterize(room).surfels.key;
    room.meshes[0].positions.emplace_back(-9e4f);
    room.meshes[0].uvs.emplace_back(0.0f);
    EXPECT_EQ(rasterize(room).surfels.key, keys);
}

TEST(Texels, VerticesShareTheAreaOfTheirTriangles)
{
    const Scan scan = vertexColored();
    const Texels texels = rasterize(scan);
    EXPECT_EQ(texels.count(), 4u);
    EXPECT_NEAR(texels.area, 4.0, 1e-5);
}

// Pixel (column, row) of a page that a square fills has its centre at (column + 1/2, row + 1/2) /
// pixels.
// Sheets back to back share their vertices, and normals that cancel out are none: a ray along one
// ended the program.
TEST(Texels, VerticesOfTwoSheetsBackToBackFaceAsTheFirst)
{
    Scan scan = vertexColored();
    Mesh& mesh = scan.meshes[0];
    const std::vector<glm::uvec3> front = mesh.triangles;
    const glm::vec3 normal = mesh.normals[0];
    for (const glm::uvec3& t : front) mesh.triangles.emplace_back(t.x, t.z, t.y);
    mesh.normals.resize(2 * mesh.normals.size(), -normal);
    const Texels texels = rasterize(scan);
    for (size_t i = 0; i < texels.pages[0].count(); ++i) {
        EXPECT_EQ(texels.siteOf(0, i).normal, normal);
        EXPECT_EQ(Footprints(texels, 0).at(i, glm::vec2(0.5f)).normal, normal);
    }
}

// Beyond a sliver's rim the normals of its corners may cancel out.
TEST(Texels, SiteWhereNormalsCancelOutFacesAsItsFirstCorner)
{
    const Facet facet{.normal = {0, 2, 0}, .normalX = {0, -1, 0}};
    EXPECT_EQ(siteOn(facet, {2, 0}).normal, glm::vec3(0, 1, 0));
    EXPECT_EQ(siteOn(facet, {3, 0}).normal, glm::vec3(0, -1, 0));
}

TEST(Texels, LieWhereTheirPixelCentresAre)
{
    const Scan scan = scenes::square(2.0f, 64, kGreyPaint);
    const Texels texels = rasterize(scan);
    EXPECT_EQ(texels.count(), 64u * 64u);
    forEachTexel(texels, [](const TexelBlock& block, size_t i, uint32_t pixel) {
        ASSERT_NEAR(block.x[i], 2.0f * (static_cast<float>(pixel % 64) + 0.5f) / 64.0f, 1e-5f);
        ASSERT_NEAR(block.z[i], 2.0f * (static_cast<float>(pixel / 64) + 0.5f) / 64.0f, 1e-5f);
        ASSERT_NEAR(block.y[i], 0.0f, 1e-6f);
        ASSERT_NEAR(block.ny[i], 1.0f, 1e-6f);
    });
}

TEST(Texels, ShowTheRadianceOfTheirPixels)
{
    const Scan scan =
        scenes::square(2.0f, 64, [](glm::vec3 p, glm::vec3) { return glm::vec3(p.x, p.z, 0.25f); });
    const Texels texels = rasterize(scan);
    forEachTexel(texels, [](const TexelBlock& block, size_t i, uint32_t) {
        ASSERT_NEAR(block.r[i], block.x[i], 1e-3f * block.x[i]);
        ASSERT_NEAR(block.g[i], block.z[i], 1e-3f * block.z[i]);
        ASSERT_NEAR(block.b[i], 0.25f, 1e-4f);
    });
}

TEST(Texels, FactorAndVertexColorsMultiplyTheTexture)
{
    Scan scan = scenes::square(2.0f, 64, kGreyPaint);
    scan.meshes[0].factor = {1.0f, 0.5f, 1.0f};
    for (const glm::vec3& p : scan.meshes[0].positions)
        scan.meshes[0].colors.emplace_back(0.5f * p.x, 1.0f, 1.0f);
    const Texels texels = rasterize(scan);
    forEachTexel(texels, [](const TexelBlock& block, size_t i, uint32_t) {
        ASSERT_NEAR(block.r[i], 0.25f * block.x[i], 1e-3f);
        ASSERT_NEAR(block.g[i], 0.25f, 1e-3f);
    });
}

TEST(Texels, OfOneSurfelFollowEachOtherAndLieTogether)
{
    const Scan scan = scenes::room({4.0f, 2.5f, 3.0f}, 96, kGreyPaint);
    const Texels texels = rasterize(scan);
    const Surfels& surfels = texels.surfels;
    std::set<uint32_t> seen;
    for (size_t run = 0; run + 1 < texels.pages[0].runs.size(); ++run)
        EXPECT_TRUE(seen.insert(texels.pages[0].runs[run].surfel).second);
    EXPECT_EQ(seen.size(), surfels.count());
    forEachTexel(texels, [&](const TexelBlock& block, size_t i, uint32_t) {
        const glm::vec3 place(block.x[i], block.y[i], block.z[i]);
        ASSERT_LT(glm::distance(place, surfels.position[block.surfel[i]]),
                  std::sqrt(3.0f) * surfels.size);
        const glm::vec3 normal(block.nx[i], block.ny[i], block.nz[i]);
        ASSERT_GT(glm::dot(normal, surfels.normal[block.surfel[i]]), 0.99f);
    });
}

// Neighbours lie on the same wall: the surface is followed, not the straight way round a corner.
TEST(Surfels, NeighborsAreOnTheSameSurface)
{
    const Scan scan = scenes::room({4.0f, 2.5f, 3.0f}, 96, kGreyPaint);
    const Texels texels = rasterize(scan);
    const Surfels& surfels = texels.surfels;
    size_t most = 0;
    for (size_t s = 0; s < surfels.count(); ++s) {
        EXPECT_EQ(surfels.neighborsOf(s).front(), s);
        for (const uint32_t n : surfels.neighborsOf(s))
            EXPECT_GT(glm::dot(surfels.normal[s], surfels.normal[n]), 0.99f);
        most = std::max(most, surfels.neighborsOf(s).size());
    }
    EXPECT_GE(most, 9u);
}

TEST(Texels, AreTheSameOnAnyNumberOfThreads)
{
    const Scan scan = scenes::room({4.0f, 2.5f, 3.0f}, 96, kGreyPaint);
    const auto run = [&](int threads) {
        const ThreadLimit limit(threads);
        return rasterize(scan);
    };
    const Texels one = run(1);
    const Texels eight = run(8);
    EXPECT_EQ(one.pages[0].pixel, eight.pages[0].pixel);
    EXPECT_EQ(one.pages[0].facet, eight.pages[0].facet);
    EXPECT_EQ(one.surfels.neighbor, eight.surfels.neighbor);
    EXPECT_TRUE(one.surfels.position == eight.surfels.position);
}

TEST(Texels, OverlappingUvsAreRefusedWithTheirShare)
{
    Scan scan = scenes::square(2.0f, 64, kGreyPaint);
    scan.meshes.push_back(scan.meshes[0]);
    for (glm::vec3& p : scan.meshes[1].positions) p.y += 1.0f;
    const Texels texels = rasterize(scan);
    EXPECT_NEAR(texels.overlap.share(), 1.0, 0.05);
    try {
        checkOverlap(texels);
        FAIL() << "overlap was accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::unsupported);
        EXPECT_THAT(error.what(), testing::HasSubstr("% of its texels"));
    }
}

TEST(Texels, TiledTexturesCountAsOverlapping)
{
    Scan scan = scenes::square(2.0f, 64, kGreyPaint);
    for (glm::vec2& uv : scan.meshes[0].uvs) uv *= 4.0f;
    EXPECT_GT(rasterize(scan).overlap.share(), 0.5);
}

// Each triangle is moved so that its centroid lies on the page; of its half a page, an eighth hangs
// over the edge then. 1/4 beyond, 3/4 on it.
TEST(Texels, WhatHangsOverAnyEdgeOfThePageIsAmbiguous)
{
    for (const glm::vec2 shift : {glm::vec2(0.5f, 0.0f), glm::vec2(0.0f, 0.5f)}) {
        Scan scan = scenes::square(2.0f, 64, kGreyPaint);
        for (glm::vec2& uv : scan.meshes[0].uvs) uv += shift;
        const Texels texels = rasterize(scan);
        EXPECT_NEAR(static_cast<double>(texels.count()), 0.75 * 64 * 64, 64.0) << shift.x;
        EXPECT_NEAR(texels.overlap.share(), 1.0 / 3.0, 0.02) << shift.x;
    }
}

TEST(Texels, UvsOnAnotherTileAreFoundByWrapping)
{
    Scan scan =
        scenes::square(2.0f, 64, [](glm::vec3 p, glm::vec3) { return glm::vec3(p.x, p.z, 0.0f); });
    for (glm::vec2& uv : scan.meshes[0].uvs) uv += glm::vec2(3.0f, -2.0f);
    const Texels texels = rasterize(scan);
    EXPECT_EQ(texels.count(), 64u * 64u);
    EXPECT_EQ(texels.overlap.share(), 0.0);
    forEachTexel(texels, [](const TexelBlock& block, size_t i, uint32_t) {
        ASSERT_NEAR(block.r[i], block.x[i], 2e-3f);
    });
}

TEST(Texels, AbsurdUvsNeitherHangNorCrash)
{
    Scan scan = scenes::square(2.0f, 64, kGreyPaint);
    scan.meshes[0].uvs[0] = {-1e30f, 1e30f};
    EXPECT_GE(rasterize(scan).overlap.share(), 0.0);
}

// A large scan keeps where rays start; of few texels, all.
TEST(Texels, SitesOfALargeScanAreThoseOfAnyOther)
{
    const Scan scan = scenes::room({4.0f, 2.5f, 3.0f}, 96, kGreyPaint);
    const Texels texels = rasterize(scan);
    setenv("RELAMP_PIXELS_IN_MEMORY", "0", 1);
    const Texels large = rasterize(scan);
    unsetenv("RELAMP_PIXELS_IN_MEMORY");
    ASSERT_FALSE(texels.isLarge);
    ASSERT_TRUE(large.isLarge);
    ASSERT_EQ(large.surfels.key, texels.surfels.key);
    const SurfelSites sites(texels);
    const SurfelSites sitesOfLarge(large);
    for (uint32_t s = 0; s < texels.surfels.count(); ++s) {
        ASSERT_EQ(sitesOfLarge.countOf(s), sites.countOf(s));
        for (size_t i = 0; i < sites.countOf(s); ++i) {
            EXPECT_EQ(sitesOfLarge.at(s, i).position, sites.at(s, i).position);
            EXPECT_EQ(sitesOfLarge.texelOf(s, i).texel, sites.texelOf(s, i).texel);
        }
    }
}

TEST(Texels, SitesOfALargeSurfelAreFewAndItsOwn)
{
    const Scan scan = scenes::square(2.0f, 512, kGreyPaint);
    setenv("RELAMP_PIXELS_IN_MEMORY", "0", 1);
    Progress progress;
    const Texels large = rasterizeAtlas(scan, progress, {.smallest = 0.1});
    unsetenv("RELAMP_PIXELS_IN_MEMORY");
    const SurfelSites sites(large);
    for (uint32_t s = 0; s < large.surfels.count(); ++s) {
        ASSERT_LE(sites.countOf(s), 32u);
        std::set<std::pair<float, float>> places;
        for (size_t i = 0; i < sites.countOf(s); ++i) {
            const TexelSite site = sites.at(s, i);
            const TexelIndex at = sites.texelOf(s, i);
            EXPECT_EQ(site.position, large.siteOf(at.page, at.texel).position);
            EXPECT_EQ(large.surfels.find(site.position, site.normal), s);
            places.emplace(site.position.x + site.position.y, site.position.z);
        }
        EXPECT_EQ(places.size(), sites.countOf(s));
    }
    EXPECT_EQ(sites.countOf(large.surfels.find({0.0f, 0.0f, 0.0f}, large.surfels.normal[0])), 32u);
}

} // namespace relamp
