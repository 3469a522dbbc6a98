#include "fit/correction_map.h"

#include "scenes/scenes.h"

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

Texels texelsOf(const Scan& scan)
{
    Progress progress;
    return rasterizeAtlas(scan, progress);
}

} // namespace

TEST(CorrectionMap, TellsTheShareOfEverySurfelAgain)
{
    const Scan scan =
        scenes::room({3, 2, 4}, 96, [](glm::vec3, glm::vec3) { return glm::vec3(0.5f); });
    const Texels texels = texelsOf(scan);
    std::vector<float> lit(texels.surfels.count());
    for (size_t s = 0; s < lit.size(); ++s) lit[s] = 0.1f + 0.01f * static_cast<float>(s % 110);
    const std::vector<CorrectionMap> maps{correctionMapOf(texels, 0, lit)};
    EXPECT_EQ(maps[0].share.size(), scan.pages[0].image.pixels());
    const std::vector<float> read = correctionBy(maps, texels);
    ASSERT_EQ(read.size(), lit.size());
    for (size_t s = 0; s < lit.size(); ++s)
        EXPECT_NEAR(read[s], lit[s], 0.5f / CorrectionMap::kAll + 1e-4f) << s;
}

TEST(CorrectionMap, OfWhatWasNotCorrectedIsEmpty)
{
    const Scan scan =
        scenes::room({3, 2, 4}, 32, [](glm::vec3, glm::vec3) { return glm::vec3(0.5f); });
    const Texels texels = texelsOf(scan);
    const std::vector<CorrectionMap> maps{correctionMapOf(texels, 0, {})};
    EXPECT_TRUE(maps[0].isEmpty());
    EXPECT_TRUE(correctionBy(maps, texels).empty());
    EXPECT_TRUE(correctionBy({}, texels).empty());
}

} // namespace relamp
