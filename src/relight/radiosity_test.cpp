#include "relight/radiosity.h"

#include "base/radiometry.shared.h"
#include "relight/sky_bins.h"
#include "scenes/form_factors.h"
#include "scenes/radiosity.h"
#include "scenes/scenes.h"
#include "scenes/surfaces.h"

#include <array>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

struct BouncingRoom
{
    explicit BouncingRoom(Scan scan)
        : surfaces(std::move(scan)),
          transport(transportOf(surfaces.texels, scenes::hitListsOf(surfaces, 256)))
    {}

    [[nodiscard]] size_t surfels() const { return surfaces.texels.surfels.count(); }
    [[nodiscard]] std::vector<glm::vec3> everywhere(float value) const
    {
        return std::vector<glm::vec3>(transport.sides.size(), glm::vec3(value));
    }

    scenes::Surfaces surfaces;
    Transport transport;
};

} // namespace

// A closed box that receives pi everywhere, of albedo rho, receives pi rho / (1 - rho) more by
// bounces: every bounce adds a power.
TEST(Radiosity, FurnaceReachesTheGeometricSeries)
{
    const BouncingRoom room(scenes::room({4.0f, 2.5f, 5.0f}, 64, scenes::plain(glm::vec3(0.5f))));
    for (const float rho : {0.3f, 0.5f, 0.8f}) {
        const std::vector<glm::vec3> albedo(room.surfels(), glm::vec3(rho));
        const Bounced bounced = bounce(room.transport, albedo, room.everywhere(kPi), {});
        const float exact = kPi * rho / (1.0f - rho);
        double sum = 0.0;
        for (const glm::vec3 irradiance : bounced.irradiance)
            sum += static_cast<double>(irradiance.g);
        EXPECT_NEAR(sum / static_cast<double>(room.surfels()), exact, 0.005f * exact) << rho;
    }
}

// A lit red wall throws its colour on the black one that faces it: radiance times Lambert's
// formula.
TEST(Radiosity, ColourBleedsByTheFormFactorOfTheWalls)
{
    const std::array<scenes::Panel, 2> walls{
        scenes::Panel{{0, 0, 0}, {0, 0, 2}, {2, 0, 0}},  // faces up
        scenes::Panel{{0, 1, 0}, {2, 0, 0}, {0, 0, 2}}}; // faces down
    const BouncingRoom room(scenes::panels(walls, 64, scenes::plain(glm::vec3(0.5f))));
    const Surfels& surfels = room.surfaces.texels.surfels;
    std::vector<glm::vec3> albedo(room.surfels(), glm::vec3(0.0f));
    std::vector<glm::vec3> direct = room.everywhere(0.0f);
    for (const uint32_t s : room.surfaces.facing({0, 1, 0})) {
        albedo[s] = {0.8f, 0.2f, 0.1f};
        direct[s] = glm::vec3(kPi);
    }
    const Bounced bounced = bounce(room.transport, albedo, direct, {});
    for (const glm::vec3 place : {glm::vec3(1, 1, 1), glm::vec3(0.3f, 1, 0.5f)}) {
        const uint32_t at = room.surfaces.at(place, {0, -1, 0});
        glm::vec3 mean(0.0f); // over the neighbours, as texels get it
        glm::vec3 middle(0.0f);
        for (const uint32_t n : surfels.neighborsOf(at)) {
            mean += bounced.irradiance[n];
            middle += surfels.position[n];
        }
        const auto count = static_cast<float>(surfels.neighborsOf(at).size());
        const float factor = scenes::irradianceFrom(walls[0], middle / count, {0.0f, -1.0f, 0.0f});
        EXPECT_NEAR(mean.r / count, 0.8f * factor, 0.02f * factor);
        EXPECT_NEAR(mean.b / count, 0.1f * factor, 0.005f * factor);
    }
}

// A lit ceiling throws its light on a black floor and on black walls by their configuration
// factors.
TEST(Radiosity, CeilingLightsFloorAndWallsByTheTextbook)
{
    const BouncingRoom room(scenes::room({4.0f, 2.5f, 5.0f}, 64, scenes::plain(glm::vec3(0.5f))));
    const Surfels& surfels = room.surfaces.texels.surfels;
    std::vector<glm::vec3> albedo(room.surfels(), glm::vec3(0.0f));
    std::vector<glm::vec3> direct = room.everywhere(0.0f);
    for (const uint32_t s : room.surfaces.facing({0, -1, 0})) {
        albedo[s] = glm::vec3(0.8f);
        direct[s] = glm::vec3(kPi / 0.8f);
    }
    const Bounced bounced = bounce(room.transport, albedo, direct, {});
    const auto meanOf = [&](glm::vec3 normal) {
        double sum = 0.0;
        double area = 0.0;
        for (const uint32_t s : room.surfaces.facing(normal)) {
            sum += static_cast<double>(surfels.area[s] * bounced.irradiance[s].g / kPi);
            area += static_cast<double>(surfels.area[s]);
        }
        return sum / area;
    };
    const double onFloor = scenes::opposite(4.0, 5.0, 2.5);
    EXPECT_NEAR(meanOf({0, 1, 0}), onFloor, 0.005 * onFloor);
    const double onWall = scenes::adjacent(5.0, 2.5, 4.0); // x = 0
    EXPECT_NEAR(meanOf({1, 0, 0}), onWall, 0.005 * onWall);
}

TEST(Radiosity, OpenGroundReceivesTheWholeSky)
{
    const BouncingRoom room(scenes::square(2.0f, 32, scenes::plain(glm::vec3(0.5f))));
    const std::vector<glm::vec3> sky(SkyBins::kCount, glm::vec3(0.1f, 0.2f, 0.3f));
    const std::vector<glm::vec3> albedo(room.surfels(), glm::vec3(0.5f));
    const Bounced bounced = bounce(room.transport, albedo, room.everywhere(0.0f), sky);
    for (const glm::vec3 irradiance : bounced.irradiance) {
        EXPECT_NEAR(irradiance.r, 0.1f * kPi, 1e-4f);
        EXPECT_NEAR(irradiance.b, 0.3f * kPi, 1e-4f);
    }
}

TEST(Radiosity, DarknessStaysDark)
{
    const BouncingRoom room(scenes::square(2.0f, 32, scenes::plain(glm::vec3(0.5f))));
    const std::vector<glm::vec3> albedo(room.surfels(), glm::vec3(0.5f));
    for (const glm::vec3 irradiance :
         bounce(room.transport, albedo, room.everywhere(0.0f), {}).irradiance)
        EXPECT_EQ(irradiance, glm::vec3(0.0f));
}

} // namespace relamp
