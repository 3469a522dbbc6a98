#include "fit/lamp_groups.h"

#include "scenes/axes.h"

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using scenes::kDown;

Candidate candidateAt(float x, float z, float area)
{
    return candidateOf({{{x, 3, z}, kDown, area, 0}});
}

/// A ceiling of `rows` by ten panels, a metre apart.
std::vector<Candidate> ceiling(int rows)
{
    std::vector<Candidate> panels;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < 10; ++column)
            panels.push_back(
                candidateAt(static_cast<float>(column), static_cast<float>(row), 0.36f));
    return panels;
}

LampGroups grouped(const std::vector<Candidate>& candidates, size_t given = SIZE_MAX)
{
    std::vector<uint8_t> isGiven(candidates.size(), 0);
    if (given < isGiven.size()) isGiven[given] = 1;
    return groupLamps(candidates, isGiven, 64);
}

} // namespace

TEST(LampGroups, UpToTheMostEveryLampStaysByItself)
{
    const LampGroups lamps = grouped(ceiling(6));
    ASSERT_EQ(lamps.groups.size(), 60u);
    for (const LampGroup& group : lamps.groups) EXPECT_THAT(group.ends, testing::IsEmpty());
    EXPECT_EQ(lamps.leftOut, 0u);
}

TEST(LampGroups, ManyPanelsAreGroupsOfNeighboursThatHoldAllOfThem)
{
    const LampGroups lamps = grouped(ceiling(30));
    ASSERT_EQ(lamps.groups.size(), 32u);
    size_t panels = 0;
    for (const LampGroup& group : lamps.groups) {
        ASSERT_GE(group.ends.size(), 9u);
        ASSERT_LE(group.ends.size(), 10u);
        EXPECT_EQ(group.ends.back(), group.whole.patches.size());
        EXPECT_NEAR(group.whole.area, 0.36f * static_cast<float>(group.ends.size()), 1e-4f);
        for (const ClippedPatch& patch : group.whole.patches)
            EXPECT_LT(glm::distance(patch.position, group.whole.centre), 3.0f);
        panels += group.ends.size();
    }
    EXPECT_EQ(panels, 300u);
    EXPECT_EQ(lamps.leftOut, 0u);
}

// A bulb is small, and what no lamp can burn out all around is lit from within.
TEST(LampGroups, WhatIsBurntOutAllAroundComesBeforeLargerFlatPieces)
{
    std::vector<Candidate> candidates;
    for (int i = 0; i < 70; ++i) { // each of its own size and level, so no family
        const auto step = static_cast<float>(i);
        candidates.push_back(candidateOf({{{step, 0.2f * step, 0}, kDown, 0.2f, 0}}));
    }
    candidates.push_back(
        candidateOf({{{2, 2, 2}, kDown, 0.005f, 0}, {{2, 2.1f, 2}, -kDown, 0.005f, 0}}));
    const LampGroups lamps = grouped(candidates);
    ASSERT_EQ(lamps.groups.size(), 64u);
    EXPECT_FLOAT_EQ(lamps.groups.back().whole.area, 0.01f);
    EXPECT_EQ(lamps.leftOut, 7u);
}

TEST(LampGroups, SpecksBeyondTheMostGroupNothingAndAreNotCounted)
{
    std::vector<Candidate> candidates = ceiling(6);
    for (int i = 0; i < 50; ++i)
        candidates.push_back(candidateAt(20.0f, static_cast<float>(i), 1e-3f));
    const LampGroups lamps = grouped(candidates);
    EXPECT_EQ(lamps.groups.size(), 64u);
    for (const LampGroup& group : lamps.groups) EXPECT_THAT(group.ends, testing::IsEmpty());
    EXPECT_EQ(lamps.leftOut, 0u);
}

TEST(LampGroups, WhatIsNotAlikeIsLeftOutAndCounted)
{
    std::vector<Candidate> globes;
    for (int i = 0; i < 70; ++i)
        globes.push_back(
            candidateOf({{{i, 2, 0}, {1, 0, 0}, 0.1f, 0}, {{i, 2, 0}, {-1, 0, 0}, 0.1f, 0}}));
    const LampGroups lamps = grouped(globes, 69);
    ASSERT_EQ(lamps.groups.size(), 64u);
    EXPECT_EQ(lamps.leftOut, 6u);
    EXPECT_NEAR(lamps.areaLeftOut, 1.2f, 1e-4f);
    EXPECT_TRUE(lamps.groups.back().isGiven);
}

TEST(LampGroups, GivenPanelStaysByItself)
{
    const LampGroups lamps = grouped(ceiling(30), 137);
    ASSERT_EQ(lamps.groups.size(), 33u);
    EXPECT_EQ(std::count_if(lamps.groups.begin(), lamps.groups.end(),
                            [](const LampGroup& g) { return g.isGiven && g.ends.empty(); }),
              1);
}

} // namespace relamp
