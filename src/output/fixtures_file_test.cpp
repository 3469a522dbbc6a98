#include "output/fixtures_file.h"

#include "image/write_image.h"
#include "relamp/error.h"

#include <span>

#include <gmock/gmock.h>

namespace relamp
{

TEST(FixturesFile, EveryNumberComesBackExactly)
{
    const FixtureMap map{5,
                         2,
                         {FixtureMap::kNone, FixtureMap::kWall, 0, 1, 254, 255, 256, 65535, 65536,
                          kLargestFixtureId}};
    const auto png = encodePng(rgbOf(map), {map.width, map.height}, 3);
    const FixtureMap again =
        fixtureMapFrom(readImage(std::as_bytes(std::span(png)), "fixtures.png"), "fixtures.png");
    EXPECT_EQ(again.width, 5);
    EXPECT_EQ(again.height, 2);
    EXPECT_EQ(again.id, map.id);
}

// As docs/guide/results.md tells people who read it by other means.
TEST(FixturesFile, RedCountsFromOneAndWhiteIsNobodys)
{
    EXPECT_THAT(rgbOf({3, 1, {6, FixtureMap::kNone, FixtureMap::kWall}}),
                testing::ElementsAre(7, 0, 0, 0, 0, 0, 255, 255, 255));
}

// Half floats do not hold the numbers.
TEST(FixturesFile, PicturesOfMoreThanEightBitsAreRefused)
{
    Image fine{.width = 1, .height = 1};
    fine.rgb = std::vector<uint16_t>{0, 0, 0};
    EXPECT_THROW(static_cast<void>(fixtureMapFrom(fine, "fixtures.png")), Error);
}

} // namespace relamp
