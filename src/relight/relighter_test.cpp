#include "relamp/relight.h"

#include "base/half.h"
#include "base/radiometry.shared.h"
#include "relamp/error.h"
#include "relamp/threads.h"
#include "relight/relighter_state.h"
#include "scenes/form_factors.h"
#include "scenes/lit_room.h"
#include "scenes/refusal.h"
#include "scenes/scenes.h"
#include "scenes/temporary_folder.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace relamp
{
namespace
{

/// A scan whose texture is its albedo.
DelitRoom painted(Scan scan)
{
    DelitRoom room;
    room.scan = std::make_shared<const Scan>(std::move(scan));
    room.albedo.push_back(room.scan->pages[0].image);
    room.isLit = false;
    return room;
}

/// The lit room of the tests with its true albedo, and the panel that lights it.
DelitRoom litRoom()
{
    const scenes::LitRoom lit;
    DelitRoom room;
    room.scan = scenes::copyOf(lit.scan);
    room.albedo.push_back(
        scenes::room(scenes::LitRoom::kSize, 96, scenes::LitRoom::albedo).pages[0].image);
    room.captured.fixtures.push_back({scenes::LitRoom::kLampCentre,
                                      {0, -1, 0},
                                      scenes::LitRoom::kLampArea,
                                      scenes::LitRoom::kLampRadiance});
    return room;
}

Relighting bulb(glm::vec3 position, glm::vec3 intensity)
{
    Relighting lighting;
    NewLight light;
    light.position = position;
    light.emission = intensity;
    lighting.lights.push_back(light);
    return lighting;
}

Image lit(const DelitRoom& room, const Relighting& lighting, const RelightOptions& options = {})
{
    Progress progress;
    return relight(room, lighting, options, progress).at(0);
}

glm::vec3 at(const Image& image, size_t pixel)
{
    return {floatFromHalf(image.half()[3 * pixel]), floatFromHalf(image.half()[3 * pixel + 1]),
            floatFromHalf(image.half()[3 * pixel + 2])};
}

/// Calls visit(site, radiance) for every texel.
template<class Visit>
void forEachTexel(const DelitRoom& room, const Image& image, const Visit& visit)
{
    Progress progress;
    const Texels texels = rasterizeAtlas(*room.scan, progress);
    for (size_t i = 0; i < texels.pages[0].count(); ++i)
        visit(texels.siteOf(0, i), at(image, texels.pages[0].pixel[i]));
}

double rmsBetween(const Image& a, const Image& b)
{
    double sum = 0.0;
    for (size_t i = 0; i < a.half().size(); ++i) {
        const double off =
            static_cast<double>(floatFromHalf(a.half()[i]) - floatFromHalf(b.half()[i]));
        sum += off * off;
    }
    return std::sqrt(sum / static_cast<double>(a.half().size()));
}

} // namespace

// A file of another room that somebody copied into a result's folder.
TEST(Relighter, MapOfFixturesOfAnotherSizeIsRefusedByTheNameOfItsFile)
{
    DelitRoom room = litRoom();
    room.folder = "kitchen";
    room.fixtures.assign(room.scan->pages.size(), FixtureMap{1, 1, {FixtureMap::kNone}});
    EXPECT_THAT(scenes::refusalOf([&] { const Relighter relighter(room); }),
                testing::HasSubstr("kitchen/fixtures*.png: the map of fixtures has another size"));
}

TEST(Relighter, MapOfCorrectionsOfAnotherSizeIsRefusedByTheNameOfItsFile)
{
    DelitRoom room = litRoom();
    room.folder = "kitchen";
    room.correction.assign(room.scan->pages.size(), CorrectionMap{1, 1, {CorrectionMap::kAll}});
    EXPECT_THAT(
        scenes::refusalOf([&] { const Relighter relighter(room); }),
        testing::HasSubstr("kitchen/correction*.png: the map of corrections has another size"));
}

// Half of a lamp's light was found to be there. What another sends nobody has seen. Hardly
// anything bounces.
TEST(Relighter, CorrectionIsOfTheRoomsOwnLampsAlone)
{
    DelitRoom whole = litRoom();
    whole.albedo[0] = scenes::room(scenes::LitRoom::kSize, 96,
                                   [](glm::vec3, glm::vec3) { return glm::vec3(0.01f); })
                          .pages[0]
                          .image;
    whole.captured.fixtures[0].id = 3;
    DelitRoom half = whole;
    const Image& page = half.scan->pages[0].image;
    half.correction.push_back(
        {page.width, page.height,
         std::vector<uint8_t>(page.pixels(), uint8_t{CorrectionMap::kAll / 2})});
    const Relighting other = bulb({1.0f, 1.0f, 1.0f}, glm::vec3(10.0f));
    Relighting own = darkened(whole.captured);
    setFixture(own, whole.captured, "3=on");
    Relighting both = own;
    both.lights = other.lights;
    const Image byOwn = lit(whole, own);
    const Image byOther = lit(whole, other);
    const Image corrected = lit(half, both);
    glm::dvec3 sum(0.0);
    for (size_t pixel = 0; pixel < page.pixels(); ++pixel) {
        if (at(byOwn, pixel).r > 0.5f) continue; // the lamp
        sum += glm::dvec3(at(byOwn, pixel).r, at(byOther, pixel).r, at(corrected, pixel).r);
    }
    EXPECT_GT(sum.x, 0.3 * sum.y);
    EXPECT_NEAR(sum.z / (0.5 * sum.x + sum.y), 1.0, 0.01);
}

// Every bounce, against radiosity of the box by Lambert's formula.
TEST(Relighter, CapturedLightPutBackShowsTheRoomAsItWas)
{
    const DelitRoom room = litRoom();
    const scenes::LitRoom lit;
    Relighting lighting = darkened(room.captured);
    setFixture(lighting, room.captured, "0=on");
    const Image image = relamp::lit(room, lighting);
    double error = 0.0;
    double all = 0.0;
    forEachTexel(room, image, [&](const TexelSite& site, glm::vec3 radiance) {
        if (lit.box.isLamp(site.position, site.normal)) return;
        const glm::vec3 exact = scenes::LitRoom::albedo(site.position, site.normal) *
                                lit.box.irradiance(site.position, site.normal) / kPi;
        if (std::max({exact.r, exact.g, exact.b}) > 1.0f) return;
        error += static_cast<double>(glm::dot(radiance - exact, radiance - exact)) / 3.0;
        all += 1.0;
    });
    EXPECT_GT(-10.0 * std::log10(error / all), 36.0); // dB
}

// A light that somebody puts up all over the ceiling, on floor and walls by their configuration
// factors. Each paint reflects another channel, so nothing bounces twice.
TEST(Relighter, RectangleLightsFloorAndWallsByTheTextbook)
{
    const glm::vec3 size(4.0f, 2.5f, 5.0f);
    const DelitRoom room = painted(scenes::room(size, 96, [](glm::vec3, glm::vec3 n) {
        return 0.5f * glm::vec3(n.y > 0.5f, n.x > 0.5f, n.z > 0.5f);
    }));
    Relighting lighting;
    NewLight& ceiling = lighting.lights.emplace_back();
    ceiling.type = LightType::rectangle;
    ceiling.position = {2.0f, 2.5f, 2.5f};
    ceiling.along = {1.0f, 0.0f, 0.0f};
    ceiling.size = {size.x, size.z};
    ceiling.emission = glm::vec3(1.0f);
    glm::dvec3 sum(0.0);
    glm::dvec3 count(0.0);
    forEachTexel(room, lit(room, lighting), [&](const TexelSite& site, glm::vec3 radiance) {
        const glm::dvec3 on =
            glm::step(glm::dvec3(0.5), glm::dvec3(site.normal.y, site.normal.x, site.normal.z));
        sum += on * glm::dvec3(radiance) / 0.5;
        count += on;
    });
    const double onFloor = scenes::opposite(4.0, 5.0, 2.5);
    EXPECT_NEAR(sum.r / count.r, onFloor, 0.005 * onFloor);
    const double onSide = scenes::adjacent(5.0, 2.5, 4.0);
    EXPECT_NEAR(sum.g / count.g, onSide, 0.005 * onSide);
    const double onFront = scenes::adjacent(4.0, 2.5, 5.0);
    EXPECT_NEAR(sum.b / count.b, onFront, 0.005 * onFront);
}

// A closed box whose walls emit e = 1, for lights lie on them, and reflect rho shows e / (1 - rho)
// everywhere, and reflects rho of that.
TEST(Relighter, FurnaceReachesTheGeometricSeries)
{
    const glm::vec3 size(4.0f, 2.5f, 5.0f);
    const float rho = 0.5f;
    const DelitRoom room = painted(scenes::room(size, 96, scenes::plain(glm::vec3(rho))));
    Relighting lighting;
    for (const scenes::Panel& wall : scenes::wallsOf(size)) {
        NewLight& light = lighting.lights.emplace_back();
        light.type = LightType::rectangle;
        light.position = wall.at(0.5f, 0.5f);
        light.direction = wall.normal();
        light.along = glm::normalize(wall.alongU);
        light.size = {glm::length(wall.alongU), glm::length(wall.alongV)};
        light.emission = glm::vec3(1.0f);
    }
    double sum = 0.0;
    double count = 0.0;
    forEachTexel(room, lit(room, lighting), [&](const TexelSite&, glm::vec3 radiance) {
        sum += static_cast<double>(radiance.g);
        count += 1.0;
    });
    const double exact = static_cast<double>(rho / (1.0f - rho));
    EXPECT_NEAR(sum / count, exact, 0.005 * exact);
}

TEST(Relighter, RepaintedIsAsIfItHadNeverBeenOtherwise)
{
    const DelitRoom room = litRoom();
    Relighting lighting = darkened(room.captured);
    setFixture(lighting, room.captured, "0=on");
    DelitRoom other = litRoom();
    other.albedo[0] =
        scenes::room(scenes::LitRoom::kSize, 96, scenes::plain(glm::vec3(0.3f))).pages[0].image;
    const Image expected = relamp::lit(other, lighting);

    Progress progress;
    Relighter relighter(room, {}, progress);
    relighter.light(lighting, progress);
    EXPECT_NE(relighter.radiance(0, progress).half(), expected.half());
    EXPECT_THROW(relighter.repaint({}, {}), Error);
    relighter.repaint(other.albedo, other.confidence);
    relighter.light(lighting, progress);
    EXPECT_EQ(relighter.radiance(0, progress).half(), expected.half());
}

TEST(Relighter, LampShinesWhenOnAndReflectsWhenOff)
{
    const DelitRoom room = litRoom();
    const scenes::LitRoom lit;
    Relighting lighting = bulb({2.0f, 1.0f, 2.5f}, glm::vec3(2.0f));
    lighting.fixtures = darkened(room.captured).fixtures;
    const auto meanOfLamp = [&](const Image& image) {
        glm::dvec3 sum(0.0);
        double count = 0.0;
        forEachTexel(room, image, [&](const TexelSite& site, glm::vec3 radiance) {
            const glm::vec3 off = glm::abs(site.position - scenes::LitRoom::kLampCentre);
            if (off.y > 0.01f || off.x > 0.3f || off.z > 0.2f) return;
            sum += glm::dvec3(radiance);
            count += 1.0;
        });
        return glm::vec3(sum / count);
    };
    const glm::vec3 off = meanOfLamp(relamp::lit(room, lighting));
    const float distance = 1.5f;
    EXPECT_GT(off.g, 0.2f * 0.7f / kPi * 2.0f / (distance * distance)); // some of the bulb's light
    EXPECT_LT(off.g, 1.0f);
    setFixture(lighting, room.captured, "0=on");
    EXPECT_NEAR(meanOfLamp(relamp::lit(room, lighting)).r, 40.0f, 0.5f);
    setFixture(lighting, room.captured, "0=25%");
    EXPECT_NEAR(meanOfLamp(relamp::lit(room, lighting)).r, 10.0f, 0.2f);
}

// A floor under a small ceiling panel in the air: its shadow is dark, beside it is E = I cos / d^2.
TEST(Relighter, WhatStandsBeforeALightCastsAShadow)
{
    const std::vector<scenes::Panel> panels{{{0, 0, 0}, {0, 0, 4}, {4, 0, 0}},
                                            {{1.5f, 1, 1.5f}, {1, 0, 0}, {0, 0, 1}}};
    const DelitRoom room = painted(scenes::panels(
        panels, 128, [](glm::vec3, glm::vec3 n) { return glm::vec3(n.y > 0.5f ? 0.5f : 0.0f); }));
    const glm::vec3 place(2.0f, 2.0f, 2.0f);
    const Image image = lit(room, bulb(place, glm::vec3(4.0f)));
    forEachTexel(room, image, [&](const TexelSite& site, glm::vec3 radiance) {
        if (site.normal.y < 0.5f) return;
        const glm::vec3 off = glm::abs(site.position - glm::vec3(2.0f, 0.0f, 2.0f));
        const float from = std::max(off.x, off.z);
        if (from < 0.95f) {
            EXPECT_LT(radiance.g, 0.003f);
        } else if (from > 1.08f) {
            const glm::vec3 way = place - site.position;
            const float distance = glm::length(way);
            const float exact = 0.5f / kPi * 4.0f * way.y / (distance * distance * distance);
            EXPECT_NEAR(radiance.g, exact, 0.02f * exact);
        }
    });
}

// The same under a wide panel: the few rays of a texel leave no grain in the penumbra, and what
// many rays say is what they say.
TEST(Relighter, PenumbraOfAPanelIsSmoothAndWhereItBelongs)
{
    const std::vector<scenes::Panel> panels{{{0, 0, 0}, {0, 0, 4}, {4, 0, 0}},
                                            {{1.5f, 0.5f, 1.5f}, {1, 0, 0}, {0, 0, 1}}};
    const DelitRoom room = painted(scenes::panels(
        panels, 128, [](glm::vec3, glm::vec3 n) { return glm::vec3(n.y > 0.5f ? 0.5f : 0.0f); }));
    NewLight panel;
    panel.type = LightType::rectangle;
    panel.position = {2, 2, 2};
    panel.size = {3, 3};
    panel.emission = glm::vec3(1.0f);
    Relighting lighting;
    lighting.lights.push_back(panel);
    const Image few = lit(room, lighting, {.shadowRays = 4});
    const Image many = lit(room, lighting, {.shadowRays = 1024});
    EXPECT_LT(rmsBetween(few, many), 0.0105); // 0.0128 as the rays say it
}

// A plate below a panel hides 7 % of it from all of the floor, where all rays of a surfel's ring
// miss the plate in one place of fourteen. What the plate hides, it would send if it shone.
TEST(Relighter, WhatIsHardlyHiddenHasNoHolesOfFullLight)
{
    const scenes::Panel floor{{0, 0, 0}, {0, 0, 2}, {2, 0, 0}};
    const scenes::Panel plate{{0.95f, 1.8f, 0.95f}, {0.1f, 0, 0}, {0, 0, 0.1f}};
    const auto litBy = [](const std::vector<scenes::Panel>& panels, float height, glm::vec2 size) {
        NewLight panel;
        panel.type = LightType::rectangle;
        panel.position = {1, height, 1};
        panel.along = {1, 0, 0};
        panel.size = size;
        panel.emission = glm::vec3(9.0f);
        Relighting lighting;
        lighting.lights.push_back(panel);
        const DelitRoom room = painted(scenes::panels(panels, 256, [](glm::vec3, glm::vec3 n) {
            return glm::vec3(n.y > 0.5f ? 0.5f : 0.0f);
        }));
        std::vector<float> radiance(256 * 256); // rows of z
        forEachTexel(room, lit(room, lighting), [&](const TexelSite& site, glm::vec3 rgb) {
            const glm::uvec3 at(128.0f * site.position);
            if (site.normal.y > 0.5f) radiance[256 * at.z + at.x] = rgb.g;
        });
        return radiance;
    };
    const std::vector<float> hidden = litBy({floor, plate}, 2.0f, glm::vec2(0.4f));
    const std::vector<float> open = litBy({floor}, 2.0f, glm::vec2(0.4f));
    const std::vector<float> byPlate = litBy({floor}, 1.8f, {0.1f, 0.1f});
    ASSERT_EQ(hidden.size(), open.size());
    for (size_t i = 0; i < hidden.size(); ++i) ASSERT_LT(hidden[i], open[i] - 0.3f * byPlate[i]);
}

// A tenth as large, with texels of 1.6 mm that look at the light four by four: its edge is as sharp
// as the texels all the same.
TEST(Relighter, ShadowOfFineTexelsIsAsSharpAsTheyAre)
{
    const std::vector<scenes::Panel> panels{{{0, 0, 0}, {0, 0, 0.4f}, {0.4f, 0, 0}},
                                            {{0.15f, 0.1f, 0.15f}, {0.1f, 0, 0}, {0, 0, 0.1f}}};
    const DelitRoom room = painted(scenes::panels(
        panels, 256, [](glm::vec3, glm::vec3 n) { return glm::vec3(n.y > 0.5f ? 0.5f : 0.0f); }));
    const auto expectShadow = [&](const Image& image, float half, float dark, const auto& exactAt) {
        forEachTexel(room, image, [&](const TexelSite& site, glm::vec3 radiance) {
            if (site.normal.y < 0.5f) return;
            const glm::vec3 off = glm::abs(site.position - glm::vec3(0.2f, 0.0f, 0.2f));
            const float from = std::max(off.x, off.z);
            const float exact = exactAt(site.position);
            if (from < half - 0.004f) {
                EXPECT_LT(radiance.g, dark);
            } else if (from > half + 0.004f) {
                EXPECT_NEAR(radiance.g, exact, 0.02f * exact);
            }
        });
    };
    expectShadow(lit(room, bulb(glm::vec3(0.2f), glm::vec3(0.04f))), 0.1f, 0.003f,
                 [](glm::vec3 place) {
                     const glm::vec3 way = glm::vec3(0.2f) - place;
                     const float distance = glm::length(way);
                     return 0.5f / kPi * 0.04f * way.y / (distance * distance * distance);
                 });
    Relighting day;
    NewLight sun; // its penumbra is 0.9 mm
    sun.type = LightType::sun;
    sun.emission = glm::vec3(1.0f);
    day.lights.push_back(sun);
    // Of few rays that agree one is not sure.
    expectShadow(lit(room, day), 0.05f, 0.04f * 0.5f / kPi, [](glm::vec3) { return 0.5f / kPi; });
}

// The same room ten times as large, where every texel casts rays, many of them, has the same light.
TEST(Relighter, PenumbraOfFineTexelsIsThatOfCoarseOnes)
{
    const auto litAt = [](float metre, float width, int rays) {
        const std::vector<scenes::Panel> panels{
            {{0, 0, 0}, {0, 0, 8 * metre}, {8 * metre, 0, 0}},
            {metre * glm::vec3(3, 1, 3), {2 * metre, 0, 0}, {0, 0, 2 * metre}}};
        NewLight panel;
        panel.type = LightType::rectangle;
        panel.position = metre * glm::vec3(4);
        panel.size = {width * metre, width * metre};
        panel.emission = glm::vec3(9.0f / (width * width));
        Relighting lighting;
        lighting.lights.push_back(panel);
        const DelitRoom room = painted(scenes::panels(panels, 512, [](glm::vec3, glm::vec3 n) {
            return glm::vec3(n.y > 0.5f ? 0.5f : 0.0f);
        }));
        return lit(room, lighting, {.shadowRays = rays});
    };
    EXPECT_LT(rmsBetween(litAt(0.1f, 3.0f, 16), litAt(1.0f, 3.0f, 256)), 0.001); // wide
    EXPECT_LT(rmsBetween(litAt(0.1f, 0.2f, 16), litAt(1.0f, 0.2f, 256)),
              0.0007); // as wide as a cell: 7 mm
}

TEST(Relighter, SunComesThroughAWindowAndNoWall)
{
    DelitRoom room = litRoom();
    Relighting lighting = darkened(room.captured);
    NewLight sun;
    sun.type = LightType::sun;
    sun.emission = glm::vec3(10.0f);
    lighting.lights.push_back(sun);
    EXPECT_EQ(rmsBetween(lit(room, lighting), lit(room, darkened(room.captured))), 0.0);
    setFixture(lighting, room.captured, "0=window"); // a skylight
    const Image image = lit(room, lighting);
    float under = 0.0f;
    float beside = 0.0f;
    forEachTexel(room, image, [&](const TexelSite& site, glm::vec3 radiance) {
        if (site.normal.y < 0.5f) return;
        const glm::vec3 off = glm::abs(site.position - scenes::LitRoom::kLampCentre);
        if (off.x < 0.3f && off.z < 0.2f) under = std::max(under, radiance.r);
        if (off.x > 1.0f) beside = std::max(beside, radiance.r);
    });
    EXPECT_NEAR(under, 0.5f * 10.0f / kPi, 0.1f);
    EXPECT_LT(beside, 0.3f);
}

TEST(Relighter, LightAddsUpAndScales)
{
    const DelitRoom room = painted(scenes::room({3, 2.5f, 4}, 48, scenes::plain(glm::vec3(0.5f))));
    Progress progress;
    Relighter relighter(room, {}, progress);
    const auto under = [&](const Relighting& lighting) {
        relighter.light(lighting, progress);
        return relighter.radiance(0, progress);
    };
    const Relighting a = bulb({1, 1.5f, 1}, {2, 1, 0});
    const Relighting b = bulb({2, 1, 3}, {0, 1, 3});
    Relighting both = a;
    both.lights.push_back(b.lights[0]);
    const Image shownA = under(a);
    const Image shownB = under(b);
    const Image shown = under(both);
    for (size_t i = 0; i < shown.half().size(); ++i) {
        const float sum = floatFromHalf(shownA.half()[i]) + floatFromHalf(shownB.half()[i]);
        EXPECT_NEAR(floatFromHalf(shown.half()[i]), sum,
                    0.03f * sum + 1e-3f); // noise is judged for each
    }
    // What was kept of a light gives just what was found anew.
    Relighter fresh(room, {}, progress);
    fresh.light(a, progress);
    EXPECT_EQ(under(a).half(), fresh.radiance(0, progress).half());
}

TEST(Relighter, PathsSayTheSame)
{
    const DelitRoom room = painted(scenes::room({3, 2.5f, 4}, 12, scenes::plain(glm::vec3(0.6f))));
    Relighting lighting = bulb({1, 1.5f, 1}, glm::vec3(2.0f));
    lighting.sky.radiance = glm::vec3(0.5f); // nothing comes in
    const Image ours = lit(room, lighting);
    const Image paths =
        lit(room, lighting, {.solver = Solver::pathtrace, .pathtrace = {.samples = 256}});
    double sumOurs = 0.0;
    double sumPaths = 0.0;
    for (size_t i = 0; i < ours.half().size(); ++i) {
        sumOurs += static_cast<double>(floatFromHalf(ours.half()[i]));
        sumPaths += static_cast<double>(floatFromHalf(paths.half()[i]));
    }
    EXPECT_NEAR(sumOurs / sumPaths, 1.0, 0.02);
}

TEST(Relighter, ThesisHasNoShadowsAndSaysThatItHasNoSun)
{
    const DelitRoom room = painted(scenes::room({3, 2.5f, 4}, 24, scenes::plain(glm::vec3(0.6f))));
    Relighting lighting = bulb({1, 1.5f, 1}, glm::vec3(2.0f));
    NewLight sun;
    sun.type = LightType::sun;
    sun.emission = glm::vec3(5.0f);
    lighting.lights.push_back(sun);
    Progress progress;
    Relighter relighter(room, {.solver = Solver::thesis}, progress);
    relighter.light(lighting, progress);
    EXPECT_THAT(relighter.warnings(), testing::ElementsAre(testing::HasSubstr("no sun")));
    const Image thesis = relighter.radiance(0, progress);
    const Image ours = lit(room, bulb({1, 1.5f, 1}, glm::vec3(2.0f)));
    EXPECT_LT(rmsBetween(thesis, ours), 0.1);
    EXPECT_GT(rmsBetween(thesis, ours), 1e-4);
}

TEST(Relighter, IsTheSameOnAnyNumberOfThreads)
{
    const DelitRoom room = painted(scenes::room({3, 2.5f, 4}, 32, scenes::plain(glm::vec3(0.5f))));
    const Relighting lighting = bulb({1, 1.5f, 1}, {2, 1, 0.5f});
    const Image many = lit(room, lighting);
    const ThreadLimit one(1);
    EXPECT_EQ(lit(room, lighting).half(), many.half());
}

TEST(Relighter, KeepsItsTransportAndMakesAStaleOneAnew)
{
    const scenes::TemporaryFolder folder;
    const DelitRoom room = painted(scenes::room({3, 2.5f, 4}, 24, scenes::plain(glm::vec3(0.5f))));
    const Relighting lighting = bulb({1, 1.5f, 1}, {2, 1, 0.5f});
    const RelightOptions options{.transport = folder / "transport.bin"};
    const Image first = lit(room, lighting, options);
    ASSERT_TRUE(std::filesystem::exists(options.transport));
    EXPECT_EQ(lit(room, lighting, options).half(), first.half());

    const DelitRoom other = painted(scenes::room({3, 2, 4}, 24, scenes::plain(glm::vec3(0.5f))));
    EXPECT_EQ(lit(other, lighting, options).half(), lit(other, lighting).half());
    folder.write("transport.bin", std::string("no transport"));
    EXPECT_EQ(lit(room, lighting, options).half(), first.half());

    Progress progress;
    const Relighter nowhere(room, {.transport = folder / "not/there.bin"}, progress);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(Relighter, AlbedoOfAnotherSizeIsRefused)
{
    DelitRoom room = painted(scenes::room({3, 2.5f, 4}, 24, scenes::plain(glm::vec3(0.5f))));
    room.albedo[0].width /= 2;
    Progress progress;
    EXPECT_THROW(Relighter(room, {}, progress), Error);
}

TEST(Relighter, GpuIsRefusedBySolversThatDoNotUseIt)
{
    const DelitRoom room = painted(scenes::room({3, 2.5f, 4}, 24, scenes::plain(glm::vec3(0.5f))));
    Progress progress;
    const RelightOptions byGpu{.solver = Solver::thesis, .engine = {.engine = Engine::gpu}};
    const RelightOptions byName{.solver = Solver::pathtrace, .engine = {.gpu = "0"}};
    for (const RelightOptions& options : {byGpu, byName})
        EXPECT_THROW(Relighter(room, options, progress), Error);
}

} // namespace relamp
