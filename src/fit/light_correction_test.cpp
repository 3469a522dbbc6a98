#include "fit/light_correction.h"

#include "base/radiometry.shared.h"
#include "scenes/scenes.h"
#include "scenes/surfaces.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

constexpr float kSide = 2.0f;

/// Light on a floor as a solver finds it: less on the left, under something.
float foundAt(float x)
{
    return x < 0.6f ? 0.3f : 1.0f;
}

/// With `spread` of it where it is dim, as at a shadow's edge.
SurfelLighting foundOn(const Surfels& surfels, float spread = 0.7f)
{
    SurfelLighting found;
    for (const glm::vec3 place : surfels.position) {
        const float light = kPi * foundAt(place.x);
        found.irradiance.emplace_back(light);
        found.spread.push_back(place.x < 0.6f ? spread * light : 0.0f);
    }
    return found;
}

bool isInStrip(float x)
{
    return std::abs(x - 1.0f) < 0.1f;
}

/// Even light but for a strip, which gets so much of it and may get a fifth more or less.
SurfelLighting foundBeside(const Surfels& surfels, float ofStrip)
{
    SurfelLighting found;
    for (const glm::vec3 place : surfels.position) {
        const float light = isInStrip(place.x) ? ofStrip : 1.0f;
        found.irradiance.emplace_back(light);
        found.spread.push_back(isInStrip(place.x) ? 0.2f * light : 0.0f);
    }
    return found;
}

/// Something that fades from 1 to 0.3 on the left.
float fadeAt(float x)
{
    return std::min(0.3f + 0.7f * x / 0.6f, 1.0f);
}

/// Mean share of light over the surfels with low < x < high.
float shareBetween(const Surfels& surfels, const std::vector<float>& shares, float low, float high)
{
    float sum = 0.0f;
    float count = 0.0f;
    for (size_t s = 0; s < surfels.count(); ++s)
        if (surfels.position[s].x > low && surfels.position[s].x < high) {
            sum += shares[s];
            count += 1.0f;
        }
    return sum / count;
}

/// Every surfel sees this alone.
HitLists seeing(const Surfels& surfels, const std::function<HitTarget(uint32_t)>& target)
{
    HitLists hits;
    for (uint32_t s = 0; s < surfels.count(); ++s) {
        hits.targets.push_back(target(s));
        hits.firstTarget.push_back(s + 1);
    }
    return hits;
}

HitLists seeingNothing(const Surfels& surfels)
{
    return seeing(surfels, [](uint32_t) { return HitTarget::nothing(); });
}

HitLists seeingWhatIsNear(const Surfels& surfels)
{
    return seeing(surfels, [&](uint32_t s) {
        return HitTarget::of(Side::front(surfels.neighborsOf(s).back()), false);
    });
}

std::vector<float> sharesOf(const scenes::Surfaces& floor)
{
    const Surfels& surfels = floor.texels.surfels;
    return correctionOf(surfels, floor.radiance, seeingNothing(surfels), foundOn(surfels));
}

/// A floor that is dim all over, with a dark line at x = 0.3, two surfels wide.
scenes::Surfaces linedFloor()
{
    return scenes::Surfaces(scenes::square(kSide, 128, [](glm::vec3 p, glm::vec3) {
        const float line = std::abs(p.x - 0.3f) < 0.03f ? 0.5f : 1.0f;
        return glm::vec3(0.7f, 0.6f, 0.5f) * foundAt(p.x) * line;
    }));
}

} // namespace

// As little as 0.39 of the light is there; a little of the fade's foot stays paint.
TEST(LightCorrection, WhatFadesInTheDarkIsShade)
{
    const scenes::Surfaces floor(scenes::square(kSide, 128, [](glm::vec3 p, glm::vec3) {
        return glm::vec3(0.7f, 0.6f, 0.5f) * foundAt(p.x) * fadeAt(p.x);
    }));
    const auto shares = sharesOf(floor);
    EXPECT_NEAR(shareBetween(floor.texels.surfels, shares, 0.0f, 0.15f), 0.39f, 0.1f);
    EXPECT_NEAR(shareBetween(floor.texels.surfels, shares, 1.0f, 1.9f), 1.0f, 0.03f);
}

// A third of a floor, of its own paint: nobody beside it tells of gaps, and its light errs by a
// tenth beside the fortieth of all, and may by twice that.
TEST(LightCorrection, WhereTheMeshHasGapsLightThatIsNotSureWasLetIn)
{
    const scenes::Surfaces floor(scenes::square(kSide, 64, [](glm::vec3 p, glm::vec3) {
        return p.x < 0.6f ? glm::vec3(0.5f, 0.2f, 0.1f) : glm::vec3(0.1f, 0.2f, 0.5f);
    }));
    const Surfels& surfels = floor.texels.surfels;
    SurfelLighting found;
    found.irradiance.assign(surfels.count(), glm::vec3(1.0f));
    for (const glm::vec3 place : surfels.position)
        found.spread.push_back(place.x < 0.6f ? 0.1f : 0.0f);
    const auto sharesWith = [&](float gaps) {
        return correctionOf(surfels, floor.radiance, seeingNothing(surfels), found, gaps);
    };
    EXPECT_NEAR(shareBetween(surfels, sharesWith(0.0f), 0.0f, 0.5f), 1.0f, 5e-3f);
    const auto shares = sharesWith(1.0f);
    EXPECT_NEAR(shareBetween(surfels, shares, 0.0f, 0.5f), 0.769f / 0.95f, 0.02f);
    EXPECT_NEAR(shareBetween(surfels, shares, 0.7f, kSide), 1.0f, 0.01f);
}

// What the mesh has grown by throws a shadow that the texture has not.
TEST(LightCorrection, WhereTheMeshHasGapsAShadowMayBeNone)
{
    const scenes::Surfaces floor(scenes::square(kSide, 64, scenes::plain(glm::vec3(0.5f))));
    const Surfels& surfels = floor.texels.surfels;
    const SurfelLighting found = foundBeside(surfels, 0.87f);
    const auto sharesWith = [&](float gaps) {
        return correctionOf(surfels, floor.radiance, seeingNothing(surfels), found, gaps);
    };
    EXPECT_NEAR(shareBetween(surfels, sharesWith(1.0f), 0.95f, 1.05f), 1.0f / 0.87f, 0.03f);
    EXPECT_LT(shareBetween(surfels, sharesWith(0.0f), 0.95f, 1.05f), 1.06f);
}

// A greater step in the texture, where light is even. A twentieth more, and the room's level, which
// what leaks in everywhere makes a twentieth less.
TEST(LightCorrection, BrightPaintHasNoMoreLightThanIsBesideIt)
{
    const scenes::Surfaces floor(scenes::square(kSide, 64, [](glm::vec3 p, glm::vec3) {
        return glm::vec3(isInStrip(p.x) ? 0.5f / 0.8f : 0.5f);
    }));
    const Surfels& surfels = floor.texels.surfels;
    const auto shares = correctionOf(surfels, floor.radiance, seeingNothing(surfels),
                                     foundBeside(surfels, 1.0f), 1.0f);
    EXPECT_LT(shareBetween(surfels, shares, 0.95f, 1.05f), 1.12f);
}

TEST(LightCorrection, AnEdgeOfPaintIsNone)
{
    const scenes::Surfaces floor(scenes::square(kSide, 128, [](glm::vec3 p, glm::vec3) {
        return foundAt(p.x) * (p.x < 0.3f ? glm::vec3(0.1f) : glm::vec3(0.7f));
    }));
    const auto shares = sharesOf(floor);
    EXPECT_GT(shareBetween(floor.texels.surfels, shares, 0.0f, 0.25f), 0.85f);
}

TEST(LightCorrection, AnEdgeOfColourIsNone)
{
    const scenes::Surfaces floor(scenes::square(kSide, 128, [](glm::vec3 p, glm::vec3) {
        const glm::vec3 red(0.6f, 0.3f, 0.3f);
        return foundAt(p.x) * (p.x < 0.3f ? red : glm::vec3(0.5f));
    }));
    const auto shares = sharesOf(floor);
    EXPECT_NEAR(shareBetween(floor.texels.surfels, shares, 0.0f, 0.25f), 1.0f, 0.06f);
}

TEST(LightCorrection, AThinLineInTheOpenIsPaint)
{
    const scenes::Surfaces floor = linedFloor();
    EXPECT_GT(shareBetween(floor.texels.surfels, sharesOf(floor), 0.28f, 0.32f), 0.9f);
}

TEST(LightCorrection, AThinLineBesideWhatThrowsItIsShade)
{
    const scenes::Surfaces floor = linedFloor();
    const Surfels& surfels = floor.texels.surfels;
    const auto shares =
        correctionOf(surfels, floor.radiance, seeingWhatIsNear(surfels), foundOn(surfels));
    EXPECT_LT(shareBetween(surfels, shares, 0.28f, 0.32f), 0.75f);
}

// The same fade, as paint: no shadow's edge is near that could be elsewhere.
TEST(LightCorrection, LightThatIsSureIsKept)
{
    const scenes::Surfaces floor(scenes::square(
        kSide, 128, [](glm::vec3 p, glm::vec3) { return glm::vec3(0.7f * fadeAt(p.x)); }));
    const Surfels& surfels = floor.texels.surfels;
    SurfelLighting found;
    found.irradiance.assign(surfels.count(), glm::vec3(3.0f));
    found.spread.assign(surfels.count(), 0.0f);
    const auto sure = correctionOf(surfels, floor.radiance, seeingNothing(surfels), found);
    for (size_t s = 0; s < surfels.count(); ++s)
        found.spread[s] = surfels.position[s].x < 0.6f ? 3.0f : 0.0f;
    const auto unsure = correctionOf(surfels, floor.radiance, seeingNothing(surfels), found);
    EXPECT_GT(shareBetween(surfels, sure, 0.0f, 0.15f),
              1.3f * shareBetween(surfels, unsure, 0.0f, 0.15f));
}

// Two floors of one paint with nothing between: one is lit as it was found, of the other a third of
// the light is not there and nobody beside it tells.
TEST(LightCorrection, PlacesOfOnePaintTellEachOther)
{
    const scenes::Surfaces floor(scenes::square(kSide, 128, [](glm::vec3 p, glm::vec3) {
        const bool isGap = std::abs(p.x - 0.7f) < 0.1f;
        const float lit = p.x < 0.7f ? 0.2f : 1.0f;
        return isGap ? glm::vec3(0.05f, 0.2f, 0.6f) : lit * glm::vec3(0.7f, 0.6f, 0.5f);
    }));
    const auto shares = sharesOf(floor);
    EXPECT_NEAR(shareBetween(floor.texels.surfels, shares, 0.0f, 0.5f), 0.2f / 0.3f, 0.08f);
    EXPECT_NEAR(shareBetween(floor.texels.surfels, shares, 1.0f, 1.9f), 1.0f, 0.03f);
}

TEST(LightCorrection, DarkensDirectAndIndirectAlike)
{
    const scenes::Surfaces floor(scenes::square(kSide, 64, scenes::plain(glm::vec3(0.5f))));
    const TexelShading one = [](size_t, size_t, const TexelBlock& block, ShadingBlock& out) {
        for (RgbBlock* part : {&out.direct, &out.indirect})
            for (float* channel : {part->r, part->g, part->b})
                std::fill_n(channel, block.count, 1.0f);
    };
    const TexelShading shaded =
        corrected(floor.texels, one, std::vector<float>(floor.texels.surfels.count(), 0.25f));
    const TexelLoader loader(floor.texels, 0);
    TexelBlock block;
    loader.loadGeometry(0, 100, block);
    ShadingBlock out;
    shaded(0, 0, block, out);
    EXPECT_NEAR(out.direct.r[50], 0.25f, 1e-4f);
    EXPECT_NEAR(out.indirect.b[50], 0.25f, 1e-4f);
}

// A file says at most 1.28, and white walls that reflect that would glow ever more.
TEST(LightCorrection, NothingReflectsMoreThanItGets)
{
    const std::vector<glm::vec3> albedo{glm::vec3(1.0f), {0.2f, 0.5f, 0.9f}};
    const std::vector<glm::vec3> reflected =
        reflectanceBy(albedo, std::vector<float>{1.28f, 1.28f});
    EXPECT_EQ(reflected[0], glm::vec3(1.0f));
    EXPECT_EQ(reflected[1], glm::vec3(0.2f * 1.28f, 0.5f * 1.28f, 1.0f));
    EXPECT_EQ(reflectanceBy(albedo, {}), albedo);
}

} // namespace relamp
