#include "solve/albedo_scale.h"

#include "base/half.h"
#include "base/radiometry.shared.h"
#include "relamp/delight.h"
#include "relamp/error.h"
#include "scenes/lit_room.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using scenes::LitRoom;

/// Albedo of the room where its lamps come out by what a person said.
struct ToldRoom
{
    Decomposition result;
    PageLayers layers;
    PageGeometry geometry;

    explicit ToldRoom(std::vector<glm::vec3> white, std::optional<Lights> lights = {},
                      Scan scan = LitRoom().scan)
        : result(delight(std::move(scan),
                         {.gather = {.quality = Quality::draft, .white = std::move(white)},
                          .lights = std::move(lights)})),
          layers(result.layers(0)), geometry(result.geometry(0))
    {}

    /// Mean of what is within a hand's breadth.
    [[nodiscard]] glm::vec3 albedoAt(glm::vec3 place) const
    {
        glm::vec3 sum(0.0f);
        float count = 0.0f;
        for (size_t i = 0; i < geometry.positions.size(); i += 3) {
            const float* n = &geometry.normals[i];
            const float* p = &geometry.positions[i];
            if (glm::vec3(n[0], n[1], n[2]) == glm::vec3(0.0f) ||
                glm::distance(place, {p[0], p[1], p[2]}) > 0.1f)
                continue;
            const uint16_t* rgb = &layers.albedo[i];
            sum += glm::vec3(floatFromHalf(rgb[0]), floatFromHalf(rgb[1]), floatFromHalf(rgb[2]));
            count += 1.0f;
        }
        return sum / count;
    }
};

constexpr float kDiffer = 0.1f;   // log: places of one paint
constexpr float kStop = 0.69315f; // log

constexpr glm::vec3 kOnWall{4.0f, 1.2f, 2.0f};
constexpr glm::vec3 kOnFloor{2.25f, 0.0f, 3.5f}; // on a dark stripe, far from white

} // namespace

// A grey wall that is called white: all else gets brighter as it does, and loses the cast that it
// had.
TEST(AlbedoScale, WhatAPersonCallsWhiteIsAsPaperAndAllElseFollows)
{
    const ToldRoom found({});
    const ToldRoom told({kOnWall});
    const glm::vec3 white = told.albedoAt(kOnWall);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(white[c], kWhitePaint, 0.04f);
    const glm::vec3 scale = white / found.albedoAt(kOnWall);
    const glm::vec3 floor = told.albedoAt(kOnFloor) / found.albedoAt(kOnFloor);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(floor[c] / scale[c], 1.0f, 0.04f);
    EXPECT_NE(told.result.lights().tempering.scale, found.result.lights().tempering.scale);
}

// Its ceiling has an albedo of 0.81. Whoever calls it white gets 0.87 there, and elsewhere as far
// as a draft makes it even.
TEST(AlbedoScale, IsThatOfTheWholeSample)
{
    constexpr glm::vec3 kOnCeiling{1.156f, 2.594f, -1.763f};
    constexpr glm::vec3 kElsewhereOnIt{2.604f, 2.602f, -3.204f};
    const ToldRoom told(
        {kOnCeiling}, {},
        coarsened(readScan(std::filesystem::path(RELAMP_SAMPLES) / "bedroom/scan.glb"), 512));
    const glm::vec3 there = told.albedoAt(kOnCeiling);
    const glm::vec3 elsewhere = told.albedoAt(kElsewhereOnIt);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(there[c], kWhitePaint, 0.04f);
        EXPECT_NEAR(elsewhere[c], kWhitePaint, 0.08f);
    }
}

// The file of lights has the scale, so that they give the same albedo again.
TEST(AlbedoScale, GoesWithTheLights)
{
    const ToldRoom told({kOnWall});
    const ToldRoom again({}, told.result.lights());
    const glm::vec3 ratio = again.albedoAt(kOnFloor) / told.albedoAt(kOnFloor);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(ratio[c], 1.0f, 0.05f);
}

// What a lamp sent is what the scaled shading says.
TEST(AlbedoScale, LampsFollow)
{
    const Lights found = ToldRoom({}).result.lights();
    const Lights told = ToldRoom({kOnWall}).result.lights();
    ASSERT_FALSE(found.fixtures.empty());
    ASSERT_EQ(told.fixtures.size(), found.fixtures.size());
    for (int c = 0; c < 3; ++c) {
        const float scale = told.tempering.scale[c] / found.tempering.scale[c];
        EXPECT_NEAR(told.fixtures[0].radiance[c] / found.fixtures[0].radiance[c], scale, 1e-3f);
        EXPECT_NEAR(told.ambient[c], scale * found.ambient[c], 1e-4f);
    }
}

// Nobody's lights are divided by nothing.
TEST(AlbedoScale, OfNothingIsRefused)
{
    Lights lights = ToldRoom({}).result.lights();
    lights.tempering.scale.g = 0.0f;
    EXPECT_THROW(ToldRoom({}, lights), Error);
}

// A word can be wrong; it is followed, and the person told what it did.
TEST(AlbedoScale, WhatIsFarFromWhiteIsAskedAbout)
{
    const auto asks = [](const ToldRoom& room) {
        const std::vector<std::string> warnings = room.result.warnings();
        return std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
            return warning.find("is it white?") != std::string::npos;
        });
    };
    EXPECT_TRUE(asks(ToldRoom({kOnFloor})));
    EXPECT_FALSE(asks(ToldRoom({kOnWall})));
}

// Half of a room's light falls on what seems half as white again as paint, the rest on grey.
TEST(AlbedoScale, ARoomThatIsWhiterThanPaperLacksLight)
{
    const std::vector<float> light{1.0f, 1.0f};
    const float lacks = lackingLight(std::vector{1.5f * kWhitePaint, 0.3f}, light, kDiffer).log;
    EXPECT_GT(lacks, 0.15f);
    EXPECT_LT(lacks, std::log(1.5f));
    EXPECT_GT(lackingLight(std::vector{2.0f * kWhitePaint, 0.3f}, light, kDiffer).log, lacks);
}

TEST(AlbedoScale, ARoomOfUsualPaintLacksNone)
{
    EXPECT_NEAR(lackingLight(std::vector{0.75f, 0.333f}, std::vector{1.0f, 1.0f}, kDiffer).log,
                0.0f, 0.006f);
    EXPECT_EQ(lackingLight({}, {}, kDiffer).log, 0.0f);
    const float no = std::numeric_limits<float>::quiet_NaN();
    const float endless = std::numeric_limits<float>::infinity();
    const std::vector<float> paint{0.1f, 0.1f};
    EXPECT_EQ(lackingLight(paint, std::vector{1.0f, no}, kDiffer).log, 0.0f);
    EXPECT_EQ(lackingLight(paint, std::vector{1.0f, endless}, kDiffer).log, 0.0f);
    EXPECT_EQ(lackingLight(std::vector{0.1f, endless}, std::vector{1.0f, 1.0f}, kDiffer).log, 0.0f);
}

// Walls of 0.3 and a floor of 0.1: it may be, but light that is too strong is likelier.
TEST(AlbedoScale, ADarkRoomHasTooMuchLight)
{
    const LackingLight dark =
        lackingLight(std::vector{0.3f, 0.1f}, std::vector{1.0f, 1.0f}, kDiffer);
    EXPECT_LT(dark.log, -0.2f);
    EXPECT_GT(dark.log, -0.8f); // of -1.06
    EXPECT_GT(dark.error, 0.05f);
}

// Where places of one paint agree, so does the light of all of them with what lights it.
TEST(AlbedoScale, WhereLightIsEvenItIsBelieved)
{
    const auto lackWhere = [](float differ) {
        return lackingLight(std::vector{0.3f, 0.1f}, std::vector{1.0f, 1.0f}, differ).log;
    };
    EXPECT_LT(lackWhere(0.1f), lackWhere(0.05f));
    EXPECT_LT(lackWhere(0.05f), lackWhere(0.02f));
    EXPECT_NEAR(lackWhere(0.02f), 0.0f, 0.06f);
}

// What was added may be wrong by all of it where little speaks for it, and by less where much does.
TEST(AlbedoScale, IsAsUnsureAsTheSurfacesLeaveIt)
{
    const std::vector<float> light{1.0f, 1.0f};
    const LackingLight little = lackingLight(std::vector{0.8f, 0.35f}, light, kDiffer);
    EXPECT_GT(little.log, 0.02f);
    EXPECT_FLOAT_EQ(little.error, little.log);
    const LackingLight much =
        lackingLight(std::vector{2.0f * kWhitePaint, 2.0f * kWhitePaint}, light, kDiffer);
    EXPECT_GT(much.log, 0.4f);
    EXPECT_GT(much.error, 0.05f);
    EXPECT_LT(much.error, 0.5f * much.log);
}

// All of them are off by what the scale is off by. What the fit alone did not know of a lamp, it
// still does not.
TEST(AlbedoScale, ItsErrorIsInThatOfTheLampsAndTheSun)
{
    FoundRoom room;
    room.radiance.plain = {glm::vec3(2.0f * kWhitePaint), glm::vec3(0.4f)};
    room.radiance.plainArea = {1.0f, 1.0f};
    room.radiance.clippedArea = {0.0f, 0.0f};
    room.found.lamps.push_back({.logError = glm::vec3(0.1f)});
    room.found.sun = {.sun = {}, .outside = RayScene(Scan{}), .onSides = {}};
    scaleAlbedo(std::vector<glm::vec3>(2, glm::vec3(kPi)),
                {.pairs = 1000, .albedo = kDiffer / kStop}, room);
    const float log = std::log(room.tempering.scale.g);
    EXPECT_NEAR(log,
                lackingLight(std::vector{2.0f * kWhitePaint, 0.4f},
                             std::vector{1.0f, luminance(glm::vec3(1.0f))}, kDiffer)
                    .log,
                0.006f);
    EXPECT_GT(log, 0.1f);
    const float error = room.found.sun->sun.error.g;
    EXPECT_GT(error, 0.05f);
    EXPECT_LE(error, log);
    EXPECT_NEAR(room.found.lamps[0].logError.g, std::hypot(0.1f, error), 1e-6f);
    EXPECT_TRUE(room.found.lamps[0].isDetermined);
}

// A person is told where all of a room's light was taken for much more or less than was found.
TEST(AlbedoScale, WhatIsFarFromHowRoomsArePaintedIsSaid)
{
    const auto saidOf = [](float paint) {
        FoundRoom room;
        room.radiance.plain = {glm::vec3(paint), glm::vec3(0.5f * paint)};
        room.radiance.plainArea = {1.0f, 1.0f};
        room.radiance.clippedArea = {0.0f, 0.0f};
        scaleAlbedo(std::vector<glm::vec3>(2, glm::vec3(kPi)), {}, room);
        return room.warnings;
    };
    EXPECT_TRUE(saidOf(0.7f).empty());
    ASSERT_EQ(saidOf(2.0f).size(), 1u);
    EXPECT_NE(saidOf(2.0f)[0].find("may be missing"), std::string::npos);
    ASSERT_EQ(saidOf(0.2f).size(), 1u);
    EXPECT_NE(saidOf(0.2f)[0].find("may be no lamp"), std::string::npos);
}

// A dark floor alone, of which no pairs were drawn, may be dark.
TEST(AlbedoScale, WhereNothingTellsLittleIsDone)
{
    FoundRoom floor;
    floor.radiance.plain = {glm::vec3(0.2f), glm::vec3(0.2f)};
    floor.radiance.plainArea = {1.0f, 1.0f};
    floor.radiance.clippedArea = {0.0f, 0.0f};
    scaleAlbedo(std::vector<glm::vec3>(2, glm::vec3(kPi)), {}, floor);
    EXPECT_GT(floor.tempering.scale.g, 0.75f);
    EXPECT_LT(floor.tempering.scale.g, 1.0f);
}

// A gap that hardly any light was found in, and a window that is brighter than any paper, are no
// reason to darken a room.
TEST(AlbedoScale, FewPlacesTellLittle)
{
    const std::vector<float> albedo{5.0f, 5.0f, 0.5f};
    EXPECT_LT(lackingLight(albedo, std::vector{0.01f, 0.02f, 1.0f}, kDiffer).log, 0.03f);
}

} // namespace relamp
