#include "shading/visibility.h"

#include "scenes/axes.h"
#include "scenes/scenes.h"
#include "scenes/surfaces.h"
#include "shading/lit_sides.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using scenes::kUp;

constexpr float kLampSide = 0.5f;   // m, side of the lamp
constexpr float kLampHeight = 2.0f; // of the lamp over the floor

/// Every second bit of a number, the lowest first.
int everySecondBit(int bits)
{
    int result = 0;
    for (int bit = 0; bit < 8; ++bit) result |= (bits >> 2 * bit & 1) << bit;
    return result;
}

/// A lamp that is no part of the scan, facing down, its centre above (x, z). Its patches lie along
/// a space-filling curve, as those of a scan do.
AreaLight lampOver(float x, float z)
{
    constexpr int kCells = 16;
    std::vector<ClippedPatch> patches;
    for (int i = 0; i < kCells * kCells; ++i) {
        const float u = (static_cast<float>(everySecondBit(i)) + 0.5f) / kCells - 0.5f;
        const float v = (static_cast<float>(everySecondBit(i >> 1)) + 0.5f) / kCells - 0.5f;
        patches.push_back({{x + kLampSide * u, kLampHeight, z + kLampSide * v},
                           -kUp,
                           kLampSide * kLampSide / (kCells * kCells),
                           0});
    }
    return AreaLight(std::move(patches));
}

constexpr scenes::Panel kShadedFloor{{0, 0, 0}, {0, 0, 4}, {4, 0, 0}};
/// Half of the room's width, a metre over the floor, seen from above.
constexpr scenes::Panel kShelf{{0, 1, 0}, {0, 0, 4}, {2, 0, 0}};
/// Across the floor at x = 2, without thickness, seen from x < 2.
constexpr scenes::Panel kScreen{{2, 0, 0}, {0, 0, 4}, {0, 1.5f, 0}};

struct Place
{
    glm::vec3 position;
    float share;
};

/// Parts of a room under a lamp.
class Lit
{
public:
    Lit(const std::vector<scenes::Panel>& parts, AreaLight lamp, InstructionSet set)
        : surfaces_(scenes::panels(parts, 64, scenes::plain(glm::vec3(0.5f)))),
          lamps_{std::move(lamp)}, coarse_{coarse()},
          visibility_(surfaces_.texels, surfaces_.rays, lamps_, coarse_,
                      {.raysPerProbe = 16, .set = set})
    {}

    /// What the texels of the floor see of the lamp.
    [[nodiscard]] std::vector<Place> floor() const;

private:
    [[nodiscard]] LampSight coarse() const
    {
        HitLists fronts;
        for (uint32_t s = 0; s < surfaces_.texels.surfels.count(); ++s)
            fronts.sideOfList.push_back(Side::front(s));
        return directOfLists(surfaces_.texels, surfaces_.rays, fronts, {lamps_[0]});
    }

    scenes::Surfaces surfaces_;
    std::vector<AreaLight> lamps_;
    std::vector<LampSight> coarse_;
    Visibility visibility_;
};

/// Calls `visit(place, share)` for the floor's texels and what they see of the first lamp.
template<class Visit>
void forEachShare(const Texels& texels, const Visibility& visibility, const Visit& visit)
{
    const PageTexels& page = texels.pages[0];
    const TexelLoader loader(texels, 0);
    for (size_t run = 0; run + 1 < page.runs.size(); ++run)
        forEachBlockOfRun(page, run, [&](size_t begin, size_t count) {
            TexelBlock block;
            float share[TexelBlock::kPadded];
            loader.load(begin, count, block);
            visibility.at(0, page.runs[run].surfel, block, 0, count, share);
            for (size_t i = 0; i < count; ++i)
                if (block.y[i] < 1e-3f && block.ny[i] > 0.5f)
                    visit(glm::vec3(block.x[i], block.y[i], block.z[i]), share[i]);
        });
}

std::vector<Place> Lit::floor() const
{
    std::vector<Place> places;
    forEachShare(surfaces_.texels, visibility_, [&](glm::vec3 place, float share) {
        places.push_back({place, share});
    });
    return places;
}

std::vector<Place> floorUnder(const std::vector<scenes::Panel>& parts, AreaLight lamp,
                              InstructionSet set = bestInstructionSet())
{
    return Lit(parts, std::move(lamp), set).floor();
}

/// Mean share of the floor between two x, in the middle of the room.
float meanBetween(const std::vector<Place>& places, float low, float high)
{
    float sum = 0.0f;
    float count = 0.0f;
    for (const Place& place : places) {
        if (place.position.x < low || place.position.x >= high ||
            std::abs(place.position.z - 2.0f) > 1.0f)
            continue;
        sum += place.share;
        count += 1.0f;
    }
    return sum / count;
}

} // namespace

// The middle of the floor is known to lie in shade, though nothing stands there.
TEST(Visibility, MarkedTexelsSeeNothing)
{
    const scenes::Surfaces floor(
        scenes::panels({&kShadedFloor, 1}, 64, scenes::plain(glm::vec3(0.5f))));
    const Surfels& surfels = floor.texels.surfels;
    HitLists fronts;
    for (uint32_t s = 0; s < surfels.count(); ++s) fronts.sideOfList.push_back(Side::front(s));
    const AreaLight lamp = lampOver(2, 2);
    LampSight coarse = directOfLists(floor.texels, floor.rays, fronts, {lamp});
    TexelMarks inShade{std::vector<uint8_t>(floor.texels.pages[0].count(), 0)};
    for (size_t i = 0; i < inShade[0].size(); ++i)
        inShade[0][i] = floor.texels.siteOf(0, i).position.x < 2.0f ? 1 : 0;
    for (uint32_t s = 0; s < surfels.count(); ++s)
        if (surfels.position[s].x < 2.0f) coarse.set(s, {.open = coarse[s].open});
    Visibility visibility(floor.texels, floor.rays, {}, {}, {});
    visibility.add(floor.rays, lamp, coarse, 16, {}, inShade);
    float before = 0.0f; // mean shares beside the edge
    float behind = 0.0f;
    float counts[2] = {};
    forEachShare(floor.texels, visibility, [&](glm::vec3 place, float share) {
        if (place.x > 1.8f && place.x < 1.92f) before += share, counts[0] += 1.0f;
        if (place.x > 2.08f && place.x < 2.2f) behind += share, counts[1] += 1.0f;
    });
    EXPECT_LT(before, 0.02f * counts[0]);
    EXPECT_GT(behind, 0.98f * counts[1]);
}

// Half as high as the lamp, the shelf throws a penumbra from x = 1.75 to 2.25.
TEST(Visibility, RaysGoWhereALampBringsMuchOfTheLight)
{
    const std::vector<scenes::Panel> parts{kShadedFloor, kShelf};
    const scenes::Surfaces room(scenes::panels(parts, 64, scenes::plain(glm::vec3(0.5f))));
    HitLists fronts;
    for (uint32_t s = 0; s < room.texels.surfels.count(); ++s)
        fronts.sideOfList.push_back(Side::front(s));
    const AreaLight lamp = lampOver(2, 2);
    const LampSight coarse = directOfLists(room.texels, room.rays, fronts, {lamp});
    const auto errorAt = [&](float openShare) {
        const std::vector<float> shares(room.texels.surfels.count(), openShare);
        Visibility visibility(room.texels, room.rays, {}, {}, {});
        visibility.add(room.rays, lamp, coarse, 8, shares);
        float sum = 0.0f;
        forEachShare(room.texels, visibility, [&](glm::vec3 place, float share) {
            const float exact = std::clamp((place.x - 1.75f) / kLampSide, 0.0f, 1.0f);
            if (std::abs(place.z - 2.0f) < 1.0f) sum += (share - exact) * (share - exact);
        });
        return sum;
    };
    EXPECT_LT(errorAt(1.0f), 0.8f * errorAt(0.0f));
}

TEST(Visibility, NothingInTheWayIsAll)
{
    for (const Place& place : floorUnder({kShadedFloor}, lampOver(2.0f, 2.0f)))
        EXPECT_EQ(place.share, 1.0f);
}

// From the lamp's near edge at x = 1.25 the shelf's shadow ends at 2.75, from the far one at 3.25.
TEST(Visibility, WhatIsUnderAShelfSeesNothing)
{
    for (const Place& place : floorUnder({kShadedFloor, kShelf}, lampOver(1.0f, 2.0f))) {
        if (place.position.x < 2.5f) {
            EXPECT_EQ(place.share, 0.0f);
        }
        if (place.position.x > 3.5f) {
            EXPECT_EQ(place.share, 1.0f);
        }
    }
}

// Half as high as the lamp, the edge throws a penumbra as wide as the lamp; it rises evenly.
TEST(Visibility, PenumbraRisesFromNothingToAll)
{
    const std::vector<Place> places = floorUnder({kShadedFloor, kShelf}, lampOver(2.0f, 2.0f));
    float last = 0.0f;
    for (float x = 1.5f; x < 2.5f; x += 0.0625f) {
        const float share = meanBetween(places, x, x + 0.0625f);
        const float exact = std::clamp((x + 0.03125f - 1.75f) / kLampSide, 0.0f, 1.0f);
        EXPECT_NEAR(share, exact, 0.12f) << x;
        EXPECT_GE(share, last - 0.01f) << x;
        last = share;
    }
    EXPECT_EQ(last, 1.0f);
}

// Behind the screen all is dark to 4.25 m, though its lit side is nearer than a surfel.
TEST(Visibility, NoLightGoesThroughAThinWall)
{
    for (const Place& place : floorUnder({kShadedFloor, kScreen}, lampOver(1.0f, 2.0f))) {
        if (place.position.x < 1.85f) {
            EXPECT_EQ(place.share, 1.0f) << place.position.x;
        }
        if (place.position.x > 2.15f) {
            EXPECT_EQ(place.share, 0.0f) << place.position.x;
        }
    }
}

TEST(Visibility, IsTheSameOnAllInstructionSets)
{
    const auto shares = [](InstructionSet set) {
        return floorUnder({kShadedFloor, kShelf}, lampOver(2.0f, 2.0f), set);
    };
    const std::vector<Place> narrow = shares(InstructionSet::baseline);
    for (const InstructionSet set : scenes::widerSets()) {
        const std::vector<Place> wide = shares(set);
        for (size_t i = 0; i < narrow.size(); ++i)
            ASSERT_NEAR(wide[i].share, narrow[i].share, 1e-5f);
    }
}

} // namespace relamp
