#include "thesis/flatten.h"

#include "scenes/scenes.h"

#include <cmath>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

constexpr int kPixels = 128;
constexpr float kSide = 2.0f; // texels of 16 mm, surfels of 63 mm

Flattened flattenScan(const Scan& scan, InstructionSet set = bestInstructionSet())
{
    Progress progress;
    return flatten(rasterizeAtlas(scan, progress), {}, progress, set);
}

glm::vec3 at(const Flattened& flat, int x, int y)
{
    return flat.at(0, static_cast<size_t>(y * kPixels + x));
}

/// Largest step between neighbouring texels of one row.
float largestStep(const Flattened& flat, int y)
{
    float largest = 0.0f;
    for (int x = 1; x < kPixels; ++x)
        largest = std::max(largest, std::abs(at(flat, x, y).g - at(flat, x - 1, y).g));
    return largest;
}

} // namespace

TEST(Flatten, LeavesAStepEdgeWhereItIs)
{
    const Scan scan = scenes::square(kSide, kPixels, [](glm::vec3 p, glm::vec3) {
        return p.x < 1.0f ? glm::vec3(0.1f) : glm::vec3(0.6f);
    });
    const Flattened flat = flattenScan(scan);
    for (const int y : {5, 64, 120}) {
        EXPECT_NEAR(at(flat, 63, y).g, 0.1f, 0.01f);
        EXPECT_NEAR(at(flat, 64, y).g, 0.6f, 0.02f);
    }
}

// Fine detail within the range of the filter goes: what is left of it is a fraction.
TEST(Flatten, TakesFineDetailOff)
{
    const Scan scan = scenes::square(kSide, kPixels, [](glm::vec3 p, glm::vec3) {
        return glm::vec3(0.3f + 0.05f * std::sin(200.0f * p.x) * std::sin(200.0f * p.z));
    });
    const Flattened flat = flattenScan(scan);
    for (int x = 10; x < 118; ++x) EXPECT_NEAR(at(flat, x, 64).g, 0.3f, 0.012f);
}

// A ramp as steep as a soft shadow comes out as gentle steps, without new edges, and flatter at the
// scale of a texel: no step is larger than the ramp over a surfel.
TEST(Flatten, FlattensARampWithoutMakingEdges)
{
    const Scan scan = scenes::square(
        kSide, kPixels, [](glm::vec3 p, glm::vec3) { return glm::vec3(0.2f + 0.1f * p.x); });
    const Flattened flat = flattenScan(scan);
    EXPECT_LT(largestStep(flat, 64), 0.01f);
    EXPECT_NEAR(at(flat, 64, 64).g, 0.3f, 0.01f);
}

// Two charts side by side in space, apart on the page: what is right of the seam is filtered with
// what is left of it, so both give what one chart would.
TEST(Flatten, WorksAcrossUvSeams)
{
    const auto paint = [](glm::vec3 p, glm::vec3) {
        return glm::vec3(0.3f + 0.04f * std::sin(60.0f * p.x));
    };
    const Scan whole = scenes::square(kSide, kPixels, paint);
    const Scan split = scenes::splitSquare(kSide, kPixels, paint);
    const Flattened ofWhole = flattenScan(whole);
    const Flattened ofSplit = flattenScan(split);
    const int width = split.pages[0].image.width;
    for (int x = 0; x < 8; ++x) { // right of the seam: first columns of the first chart
        const float apart = ofSplit.at(0, static_cast<size_t>(64 * width + 2 + x)).g;
        EXPECT_NEAR(apart, at(ofWhole, kPixels / 2 + x, 62).g, 0.006f) << x;
    }
}

// The floor and a wall meet at an edge; neither takes up the other's colour, though they are near.
TEST(Flatten, StopsAtGeometricEdges)
{
    const Scan scan = scenes::room(glm::vec3(2.0f), kPixels, [](glm::vec3, glm::vec3 n) {
        return n.y > 0.5f ? glm::vec3(0.30f) : glm::vec3(0.33f);
    });
    Progress progress;
    const Texels texels = rasterizeAtlas(scan, progress);
    const Flattened flat = flatten(texels, {}, progress);
    const TexelLoader loader(texels, 0);
    for (size_t i = 0; i < texels.pages[0].count(); ++i) {
        TexelBlock block;
        loader.load(i, 1, block);
        const float wanted = block.ny[0] > 0.5f ? 0.30f : 0.33f;
        ASSERT_NEAR(flat.at(0, texels.pages[0].pixel[i]).g, wanted, 0.005f);
    }
}

TEST(Flatten, IsTheSameForAllInstructionSets)
{
    const Scan scan = scenes::square(kSide, kPixels, [](glm::vec3 p, glm::vec3) {
        return glm::vec3(0.5f + 0.4f * std::sin(9.0f * p.x), 0.4f,
                         0.3f + 0.2f * std::cos(7.0f * p.z));
    });
    const Flattened narrow = flattenScan(scan, InstructionSet::baseline);
    const Flattened wide = flattenScan(scan);
    for (size_t i = 0; i < narrow.pages[0].size(); ++i) // a byte's rounding may fall the other way
        ASSERT_NEAR(narrow.pages[0][i], wide.pages[0][i], 1);
}

} // namespace relamp
