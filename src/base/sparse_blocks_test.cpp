#include "base/sparse_blocks.h"

#include "shading/lamp_sight.h"

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

constexpr size_t kSightPlaces = 3 * LampSight::kBlock - 10; // the last block is not full

/// Places of the middle block alone, each as much as its number.
LampSight sightOfMiddle()
{
    std::vector<AreaSample> seen(kSightPlaces);
    for (size_t i = LampSight::kBlock; i < 2 * LampSight::kBlock; ++i)
        seen[i] = {.open = static_cast<float>(i), .visible = 0.5f * static_cast<float>(i)};
    return LampSight(seen);
}

size_t placesKept(const LampSight& sight)
{
    size_t kept = 0;
    for (size_t b = 0; b < sight.blocks(); ++b)
        sight.forEachOf(b, [&](size_t, AreaSample) { ++kept; });
    return kept;
}

} // namespace

TEST(SparseBlocks, KeepThoseThatHoldSomething)
{
    const LampSight sight = sightOfMiddle();
    EXPECT_EQ(sight.size(), kSightPlaces);
    EXPECT_EQ(placesKept(sight), LampSight::kBlock);
    EXPECT_EQ(sight[LampSight::kBlock - 1].open, 0.0f);
    EXPECT_EQ(sight[LampSight::kBlock + 3].open, 67.0f);
    EXPECT_EQ(sight[LampSight::kBlock + 3].visible, 33.5f);
    EXPECT_EQ(sight[kSightPlaces - 1].open, 0.0f);
}

TEST(SparseBlocks, ChangeNoCopyOfThem)
{
    LampSight sight = sightOfMiddle();
    const LampSight copy = sight;
    sight.set(LampSight::kBlock, {.open = 1.0f, .visible = 1.0f});
    sight.set(kSightPlaces - 1, {.open = 2.0f, .visible = 1.0f}); // of a block that saw nothing
    EXPECT_EQ(sight[LampSight::kBlock].open, 1.0f);
    EXPECT_EQ(sight[kSightPlaces - 1].open, 2.0f);
    EXPECT_EQ(placesKept(sight), 2 * LampSight::kBlock - 10);
    EXPECT_EQ(copy[LampSight::kBlock].open, 64.0f);
    EXPECT_EQ(copy[kSightPlaces - 1].open, 0.0f);
}

TEST(SparseBlocks, OfTwoLampsAreTheSum)
{
    LampSight both = sightOfMiddle();
    LampSight other(kSightPlaces);
    other.set(0, {.open = 3.0f, .visible = 2.0f});
    other.set(LampSight::kBlock, {.open = 6.0f, .visible = 1.0f});
    both.add(other);
    EXPECT_EQ(both[0].open, 3.0f);
    EXPECT_EQ(both[LampSight::kBlock].open, 70.0f);
    EXPECT_EQ(both[LampSight::kBlock].visible, 33.0f);
    EXPECT_EQ(both[LampSight::kBlock + 1].open, 65.0f);
    EXPECT_EQ(other[0].open, 3.0f);
}

} // namespace relamp
