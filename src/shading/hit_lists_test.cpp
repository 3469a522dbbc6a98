#include "shading/hit_lists.h"

#include "base/radiometry.shared.h"
#include "relamp/threads.h"
#include "scenes/axes.h"
#include "scenes/radiosity.h"
#include "scenes/surfaces.h"

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using scenes::kDown;
using scenes::kUp;

constexpr glm::vec3 kHitRoom(2.0f, 1.5f, 3.0f);

float missedShare(std::span<const HitTarget> targets)
{
    float missed = 0.0f;
    for (const HitTarget target : targets) missed += target.isNothing() ? 1.0f : 0.0f;
    return missed / static_cast<float>(targets.size());
}

std::vector<scenes::Panel> withoutCeiling()
{
    std::vector<scenes::Panel> walls = scenes::wallsOf(kHitRoom);
    walls.erase(walls.begin() + 1);
    return walls;
}

/// Two squares above each other, both facing up.
std::vector<scenes::Panel> shelves()
{
    return {{{0, 0, 0}, {0, 0, 2}, {2, 0, 0}}, {{0, 1, 0}, {0, 0, 2}, {2, 0, 0}}};
}

/// Dark, with a bright spot in its ceiling.
Scan spottedRoom()
{
    return scenes::room(kHitRoom, 32, [](glm::vec3 p, glm::vec3 n) {
        const bool isSpot = n.y < -0.5f && std::abs(p.x - 1.0f) + std::abs(p.z - 1.5f) < 0.5f;
        return glm::vec3(isSpot ? 0.9f : 0.02f);
    });
}

uint32_t nameOf(HitTarget target)
{
    return target.isNothing() ? ~0u : 2 * target.side().index + (target.isClipped() ? 1 : 0);
}

std::vector<uint32_t> namesOf(const HitLists& lists)
{
    std::vector<uint32_t> names;
    for (const HitTarget target : lists.targets) names.push_back(nameOf(target));
    return names;
}

} // namespace

TEST(HitLists, NothingLeavesAClosedBox)
{
    const scenes::Surfaces box(scenes::room(kHitRoom, 32, scenes::plain(glm::vec3(0.4f))));
    const HitLists lists = scenes::hitListsOf(box, 32);
    EXPECT_EQ(lists.sideOfList.size(), box.texels.surfels.count()); // fronts alone
    EXPECT_EQ(missedShare(lists.targets), 0.0f);
}

// Rays are cosine-distributed, so the share that leaves is irradiance / pi of a hole that shines.
TEST(HitLists, RaysLeaveThroughAHoleByItsFormFactor)
{
    const scenes::Surfaces box(
        scenes::panels(withoutCeiling(), 32, scenes::plain(glm::vec3(0.4f))));
    const HitLists lists = scenes::hitListsOf(box, 64);
    const scenes::Panel ceiling = scenes::wallsOf(kHitRoom)[1];
    float missed = 0.0f;
    float expected = 0.0f;
    for (const uint32_t s : box.facing(kUp)) {
        const float share =
            scenes::irradianceFrom(ceiling, box.texels.surfels.position[s], kUp) / kPi;
        EXPECT_NEAR(missedShare(lists.targetsOf(s)), share, 0.12f);
        missed += missedShare(lists.targetsOf(s));
        expected += share;
    }
    EXPECT_NEAR(missed, expected, 0.01f * expected);
}

TEST(HitLists, BurntOutTexelsAreTold)
{
    const scenes::Surfaces box(scenes::room(
        kHitRoom, 32, [](glm::vec3, glm::vec3 n) { return glm::vec3(n.y < -0.5f ? 1.0f : 0.3f); }));
    const HitLists lists = scenes::hitListsOf(box, 32);
    for (const uint32_t s : box.facing(kUp))
        for (const HitTarget target : lists.targetsOf(s)) {
            const bool isCeiling = box.texels.surfels.normal[target.side().surfel()].y < -0.5f;
            EXPECT_EQ(target.isClipped(), isCeiling);
        }
}

TEST(HitLists, BacksThatAreSeenLookAroundThemselves)
{
    const scenes::Surfaces two(scenes::panels(shelves(), 32, scenes::plain(glm::vec3(0.4f))));
    const HitLists lists = scenes::hitListsOf(two, 32);
    const uint32_t low = two.at({1, 0, 1}, kUp);
    const uint32_t high = two.at({1, 1, 1}, kUp);
    size_t backs = 0;
    for (const HitTarget target : lists.targetsOf(low)) {
        if (target.isNothing()) continue;
        EXPECT_TRUE(target.side().isBack());
        ++backs;
    }
    EXPECT_GT(3 * backs, lists.targetsOf(low).size());
    EXPECT_EQ(missedShare(lists.targetsOf(high)), 1.0f);

    const int32_t list = lists.listOfSide[Side::back(high).index];
    ASSERT_NE(list, HitLists::kNoList);
    for (const HitTarget target : lists.targetsOf(static_cast<size_t>(list)))
        if (!target.isNothing()) {
            EXPECT_FALSE(target.side().isBack());
        }
    EXPECT_EQ(lists.listOfSide[Side::back(low).index], HitLists::kNoList);
}

// A bright spot that one ray in thirty meets is noise. Fronts share the rays that there are.
TEST(HitLists, MoreRaysGoWhereTheyDoNotAgree)
{
    const scenes::Surfaces spotted(spottedRoom());
    const HitLists ofSpotted = scenes::hitListsOf(spotted, 16);
    const size_t below = ofSpotted.targetsOf(spotted.at({1.0f, 0.0f, 1.5f}, kUp)).size();
    EXPECT_GE(below, 16u);
    EXPECT_EQ(ofSpotted.targetsOf(spotted.at({1.0f, 1.5f, 0.2f}, kDown)).size(), 8u);
    size_t all = 0;
    for (size_t s = 0; s < spotted.texels.surfels.count(); ++s)
        all += ofSpotted.targetsOf(s).size();
    EXPECT_LE(all, 16 * spotted.texels.surfels.count());
}

// Rays of a side are one sequence, however many of it are cast at first and wherever its list lies.
TEST(HitLists, OfMoreRaysBeginLikeThoseOfFewer)
{
    const scenes::Surfaces spotted(spottedRoom());
    const HitLists some = scenes::hitListsOf(spotted, 8);
    const HitLists more = scenes::hitListsOf(spotted, 24);
    size_t unequal = 0; // lists of other lengths
    for (size_t s = 0; s < spotted.texels.surfels.count(); ++s) {
        const std::span ofSome = some.targetsOf(s);
        const std::span ofMore = more.targetsOf(s);
        if (ofMore.size() > 12) ++unequal;
        for (size_t i = 0; i < std::min(ofSome.size(), ofMore.size()); ++i)
            ASSERT_EQ(nameOf(ofSome[i]), nameOf(ofMore[i])) << s << ", " << i;
    }
    EXPECT_GT(unequal, 0u);
    EXPECT_LT(unequal, spotted.texels.surfels.count());
}

TEST(HitLists, AreTheSameOnAnyNumberOfThreads)
{
    const scenes::Surfaces two(scenes::panels(shelves(), 32, scenes::plain(glm::vec3(0.4f))));
    const auto run = [&](int threads) {
        const ThreadLimit limit(threads);
        return scenes::hitListsOf(two, 32);
    };
    const HitLists one = run(1);
    const HitLists eight = run(8);
    EXPECT_EQ(one.firstTarget, eight.firstTarget);
    EXPECT_EQ(one.listOfSide, eight.listOfSide);
    EXPECT_EQ(namesOf(one), namesOf(eight));
}

} // namespace relamp
