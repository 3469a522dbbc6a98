#include "base/radiometry.shared.h"
#include "fit/missed.h"

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

/// A grey floor: lamp 0 lights its first half, lamp 1 does just the same, lamp 2 nothing.
FitData halfLitFloor()
{
    FitData data{.lamps = 3};
    for (int i = 0; i < 64; ++i) {
        const float lit = i < 32 ? 0.1f + 0.01f * static_cast<float>(i) : 0.0f;
        data.direct.insert(data.direct.end(), {lit, lit, 0.0f});
        data.gathered.emplace_back(0.2f);
        data.missed.push_back(0.0f);
        data.radiance.emplace_back(0.5f * (0.2f + 10.0f * lit) / kPi);
    }
    return data;
}

std::vector<float> missedFrom(std::span<const std::vector<uint8_t>> gone)
{
    std::vector<MaterialPair> pairs;
    for (uint32_t p = 0; p < 32; ++p) pairs.push_back({p, p + 32});
    PowersOptions options{.oneChannel = true};
    options.alike = {{0, 1}};
    return missed(halfLitFloor(), pairs, options, gone);
}

} // namespace

// Two lamps that do the same stand in for each other, so that neither is missed; both are.
TEST(Missed, OneOfTwoEqualLampsIsNotMissedAndBothAre)
{
    const std::vector<std::vector<uint8_t>> gone{{1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    const std::vector<float> rises = missedFrom(gone);
    EXPECT_LT(rises[0], 1e-3f);
    EXPECT_LT(rises[1], 1e-3f);
    EXPECT_GT(rises[2], 0.02f);
}

TEST(Missed, LampThatLightsNothingIsNotMissed)
{
    const std::vector<std::vector<uint8_t>> gone{{0, 0, 1}};
    EXPECT_LT(missedFrom(gone)[0], 1e-4f);
}

} // namespace relamp
