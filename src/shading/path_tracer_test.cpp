#include "shading/path_tracer.h"

#include "base/radiometry.shared.h"
#include "base/sampling.shared.h"
#include "scenes/form_factors.h"
#include "scenes/radiosity.h"
#include "scenes/scenes.h"

#include <cmath>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

constexpr glm::vec3 kTracedRoom(4.0f, 2.5f, 5.0f);

/// A scan with surfaces of one albedo and no lamps yet.
struct Stage
{
    explicit Stage(Scan of, float albedo)
        : scan(std::move(of)), scene(scan), texels(rasterizeAtlas(scan, progress))
    {
        const size_t surfels = texels.surfels.count();
        room.albedo.assign(surfels, glm::vec3(albedo));
        room.shines.assign(surfels, 0);
        room.emission.assign(surfels, glm::vec3(0.0f));
        room.isClipped.emplace_back(scan.pages[0].image.pixels());
    }

    [[nodiscard]] TracedShading shade(glm::vec3 position, glm::vec3 normal, size_t paths) const
    {
        const PathTracer tracer(texels, scene, room);
        return tracer.shade({position, normal}, paths, Random(1, 2, 3));
    }

    Progress progress;
    Scan scan;
    RayScene scene;
    Texels texels;
    TracedRoom room;
};

/// All texels that `isLamp(site)` chooses, at `radiance`; met by rays as a found lamp's are.
template<class IsLamp>
std::vector<LampTexel> lightUp(Stage& stage, glm::vec3 radiance, const IsLamp& isLamp)
{
    std::vector<LampTexel> lamps;
    const PageTexels& page = stage.texels.pages[0];
    const TexelLoader loader(stage.texels, 0);
    TexelBlock block;
    for (size_t run = 0; run + 1 < page.runs.size(); ++run)
        for (size_t i = page.runs[run].begin; i < page.runs[run + 1].begin; ++i) {
            const TexelSite site = stage.texels.siteOf(0, i);
            if (!isLamp(site)) continue;
            loader.loadArea(i, 1, block);
            lamps.push_back({site.position, site.normal, block.area[0], radiance});
            stage.room.isClipped[0][page.pixel[i]] = true;
            stage.room.shines[page.runs[run].surfel] = 1;
            stage.room.emission[page.runs[run].surfel] = radiance;
        }
    return lamps;
}

/// Form factor of a rectangle a x b in a plane at distance 1 over its corner (Howell, B-4).
float cornerFormFactor(float a, float b)
{
    const float x = std::sqrt(1.0f + a * a);
    const float y = std::sqrt(1.0f + b * b);
    return (a / x * std::atan(b / x) + b / y * std::atan(a / y)) / (2.0f * kPi);
}

/// Rings of a disc that faces down.
std::vector<LampTexel> disc(glm::vec3 centre, float radius, glm::vec3 radiance)
{
    constexpr int kRings = 20;
    constexpr int kSpokes = 24;
    std::vector<LampTexel> lamps;
    for (int ring = 0; ring < kRings; ++ring)
        for (int spoke = 0; spoke < kSpokes; ++spoke) {
            const float r = radius * std::sqrt((static_cast<float>(ring) + 0.5f) / kRings);
            const float angle = 2.0f * kPi * static_cast<float>(spoke) / kSpokes;
            lamps.push_back({centre + r * glm::vec3(std::cos(angle), 0.0f, std::sin(angle)),
                             {0.0f, -1.0f, 0.0f},
                             kPi * radius * radius / (kRings * kSpokes),
                             radiance,
                             false});
        }
    return lamps;
}

/// Mean of what white patches all over a panel show, of one path each and more.
double meanOver(const Stage& stage, const scenes::Panel& panel, size_t places, size_t paths)
{
    const PathTracer tracer(stage.texels, stage.scene, stage.room);
    double sum = 0.0;
    for (size_t i = 0; i < places; ++i) {
        const glm::vec2 at = evenPoint(static_cast<float>(i), glm::vec2(0.5f));
        sum += static_cast<double>(
            tracer.shade({panel.at(at.x, at.y), panel.normal()}, paths, Random(4, 5, i)).total().g);
    }
    return sum / static_cast<double>(places);
}

} // namespace

// A closed box whose walls emit e and reflect rho shows e / (1 - rho): every bounce adds a power.
// White surfaces see walls alone, so the light straight from those is e at every place.
TEST(PathTracer, FurnaceReachesTheGeometricSeries)
{
    for (const float rho : {0.3f, 0.5f, 0.8f}) {
        Stage stage(scenes::room(kTracedRoom, 32, scenes::plain(glm::vec3(0.5f))), rho);
        stage.room.unseenLights = [](const TexelSite&, Random&) { return glm::vec3(0.7f); };
        const double exact = 0.7 / (1.0 - static_cast<double>(rho));
        for (const scenes::Panel& wall : scenes::wallsOf(kTracedRoom))
            EXPECT_NEAR(meanOver(stage, wall, 2000, 16), exact, 0.005 * exact) << rho;
    }
}

// In a box of lamps of radiance 1 every place sees 1. The weights of both ways to find a point of
// them add up to one, beside it as well as far away.
TEST(PathTracer, BoxOfLampsShowsTheirRadiance)
{
    Stage stage(scenes::room(kTracedRoom, 128, scenes::plain(glm::vec3(0.5f))), 0.5f);
    stage.room.lamps =
        LampSurface(lightUp(stage, glm::vec3(1.0f), [](const TexelSite&) { return true; }));
    for (const scenes::Panel& wall : scenes::wallsOf(kTracedRoom))
        EXPECT_NEAR(meanOver(stage, wall, 4000, 64), 1.0, 0.005);
}

// What a white surface shows of a ceiling of radiance 1 is the share of its view that it fills.
TEST(PathTracer, CeilingLightsTheFloorByItsFormFactor)
{
    Stage stage(scenes::room(kTracedRoom, 64, scenes::plain(glm::vec3(0.5f))), 0.0f);
    stage.room.lamps = LampSurface(lightUp(
        stage, glm::vec3(1.0f), [](const TexelSite& site) { return site.normal.y < -0.5f; }));
    const glm::vec3 half = 0.5f * kTracedRoom / kTracedRoom.y;
    const TracedShading middle = stage.shade({2.0f, 0.0f, 2.5f}, {0, 1, 0}, 20000);
    EXPECT_NEAR(middle.direct.g, 4.0f * cornerFormFactor(half.x, half.z), 0.005f);
    EXPECT_EQ(middle.indirect.g, 0.0f);
    // At the foot of a wall a quarter of this is left of each half, of a ceiling twice as wide.
    const TracedShading edge = stage.shade({1e-3f, 0.0f, 2.5f}, {0, 1, 0}, 20000);
    EXPECT_NEAR(edge.direct.g, 2.0f * cornerFormFactor(2.0f * half.x, half.z), 0.005f);
}

// All over a floor and over a wall, a ceiling of radiance 1 shows by their configuration factors.
TEST(PathTracer, CeilingLightsFloorAndWallsByTheTextbook)
{
    Stage stage(scenes::room(kTracedRoom, 128, scenes::plain(glm::vec3(0.5f))), 0.0f);
    stage.room.lamps = LampSurface(lightUp(
        stage, glm::vec3(1.0f), [](const TexelSite& site) { return site.normal.y < -0.5f; }));
    const std::vector<scenes::Panel> walls = scenes::wallsOf(kTracedRoom);
    const double onFloor = scenes::opposite(4.0, 5.0, 2.5);
    EXPECT_NEAR(meanOver(stage, walls[0], 20000, 16), onFloor, 0.005 * onFloor);
    const double onWall = scenes::adjacent(5.0, 2.5, 4.0); // x = 0
    EXPECT_NEAR(meanOver(stage, walls[2], 20000, 16), onWall, 0.005 * onWall);
}

// A ceiling that bends a little to a panel in it is lit by that, however little.
TEST(PathTracer, PlaceThatFacesAPanelByItsTiltAloneGetsItsLight)
{
    const scenes::Panel panel{{1.5f, 2.5f, 2.0f}, {1, 0, 0}, {0, 0, 1}};
    Stage stage(scenes::room(kTracedRoom, 128, scenes::plain(glm::vec3(0.5f))), 0.0f);
    stage.room.lamps = LampSurface(lightUp(stage, glm::vec3(1.0f), [](const TexelSite& site) {
        return site.normal.y < -0.5f && std::abs(site.position.x - 2.0f) < 0.5f &&
               std::abs(site.position.z - 2.5f) < 0.5f;
    }));
    for (const float tilt : {0.1f, 0.3f}) { // rad, towards the panel
        const glm::vec3 normal(-std::sin(tilt), -std::cos(tilt), 0.0f);
        const glm::vec3 place(3.2f, 2.47f, 2.5f);
        const float exact = // from where rays start
            scenes::irradianceFrom(panel, place + kOffSurface * normal, normal) / kPi;
        EXPECT_NEAR(stage.shade(place, normal, 400000).direct.g, exact, 0.02f * exact) << tilt;
    }
}

// On the axis of a disc E = pi L r^2 / (r^2 + h^2), which far away is the inverse-square law.
TEST(PathTracer, DiscLightsByTheInverseSquare)
{
    Stage stage(scenes::square(4.0f, 64, scenes::plain(glm::vec3(0.5f))), 0.5f);
    constexpr float kRadius = 0.1f;
    for (const float height : {0.3f, 1.0f, 2.0f}) {
        stage.room.lamps = LampSurface(disc({2.0f, height, 2.0f}, kRadius, glm::vec3(100.0f)));
        const float wanted = 100.0f * kRadius * kRadius / (kRadius * kRadius + height * height);
        EXPECT_NEAR(stage.shade({2, 0, 2}, {0, 1, 0}, 2000).direct.g, wanted, 0.02f * wanted);
    }
}

// Between two ways of finding a lamp no light is lost or counted twice, however near it is.
TEST(PathTracer, FindsAPanelByPointsAndByChanceTheSame)
{
    const auto isPanel = [](const TexelSite& site) {
        return site.normal.y < -0.5f && std::abs(site.position.x - 2.0f) < 0.5f &&
               std::abs(site.position.z - 2.5f) < 0.5f;
    };
    Stage both(scenes::room(kTracedRoom, 128, scenes::plain(glm::vec3(0.5f))), 0.6f);
    std::vector<LampTexel> panel = lightUp(both, glm::vec3(9.0f), isPanel);
    Stage points(scenes::room(kTracedRoom, 128, scenes::plain(glm::vec3(0.5f))), 0.6f);
    lightUp(points, glm::vec3(9.0f), isPanel);
    both.room.lamps = LampSurface(panel);
    for (LampTexel& texel : panel) texel.isOfScan = false;
    points.room.lamps = LampSurface(panel);
    std::fill(points.room.emission.begin(), points.room.emission.end(), glm::vec3(0.0f));
    for (const glm::vec3 place : {glm::vec3(2.0f, 0.0f, 2.5f), glm::vec3(1.6f, 2.3f, 2.2f)}) {
        const TracedShading a = both.shade(place, {0, 1, 0}, 20000);
        const TracedShading b = points.shade(place, {0, 1, 0}, 20000);
        EXPECT_NEAR(a.direct.g, b.direct.g, 0.03f * b.direct.g);
        EXPECT_NEAR(a.indirect.g, b.indirect.g, 0.05f * b.indirect.g);
    }
}

TEST(PathTracer, OpenGroundUnderAnEvenSkyShowsTheSky)
{
    Stage stage(scenes::square(4.0f, 64, scenes::plain(glm::vec3(0.5f))), 0.5f);
    stage.room.ambient = {0.1f, 0.2f, 0.3f};
    const glm::vec3 shown = stage.shade({2, 0, 2}, {0, 1, 0}, 16).total();
    EXPECT_NEAR(shown.r, 0.1f, 1e-5f);
    EXPECT_NEAR(shown.b, 0.3f, 1e-5f);
}

} // namespace relamp
