#include "output/room_view.h"

#include "base/half.h"
#include "relamp/threads.h"
#include "scenes/scenes.h"

#include <cmath>
#include <utility>

#include <glm/common.hpp>
#include <glm/gtc/constants.hpp>
#include <gmock/gmock.h>

namespace relamp
{
namespace
{

const Surroundings kDark{.beyond = [](glm::vec3) { return glm::vec3(0.0f); }};

/// A scan with its own texture for light on it.
struct SeenRoom
{
    explicit SeenRoom(Scan s)
        : scan(std::move(s)), texels(rasterizeAtlas(scan, progress)), scene(scan),
          view(texels, scene)
    {
        for (const Page& page : scan.pages) pages.push_back(page.image);
    }

    [[nodiscard]] std::vector<glm::vec3> look(const Camera& camera, Size size, int samples = 1,
                                              const Surroundings& around = kDark)
    {
        return view.look(CameraRays(camera, size), samples, pages, around, progress);
    }

    Progress progress;
    Scan scan;
    Texels texels;
    RayScene scene;
    RoomView view;
    std::vector<Image> pages;
};

const Camera kDown{.position = {1.0f, 1.0f, 1.0f},
                   .forward = {0.0f, -1.0f, 0.0f},
                   .up = {0.0f, 0.0f, -1.0f},
                   .fieldOfView = glm::half_pi<float>()};

} // namespace

// Straight down on a floor that is as red as it is far to the right, and as green as far to the
// front: from a metre up, 90 degrees show a metre to either side.
TEST(RoomView, ShowsEveryPlaceWhereItIs)
{
    SeenRoom floor(scenes::square(2.0f, 256, [](glm::vec3 p, glm::vec3) {
        return glm::vec3(0.4f * p.x + 0.1f, 0.4f * p.z + 0.1f, 0.5f);
    }));
    const auto picture = floor.look(kDown, {20, 20});
    for (size_t y = 2; y < 18; ++y)
        for (size_t x = 2; x < 18; ++x) {
            const glm::vec3 seen = picture[20 * y + x];
            EXPECT_NEAR(seen.r, 0.04f * (static_cast<float>(x) + 0.5f) + 0.1f, 2e-3f);
            EXPECT_NEAR(seen.g, 0.04f * (static_cast<float>(y) + 0.5f) + 0.1f, 2e-3f);
        }
}

// The angle across the height of a picture twice as wide as high.
TEST(RoomView, FieldOfViewIsAcrossWhatItSays)
{
    const Scan room = scenes::room({8.0f, 2.0f, 8.0f}, 16, scenes::plain(glm::vec3(0.5f)));
    Camera camera{.position = {4.0f, 1.0f, 4.0f}, .fieldOfView = glm::half_pi<float>()};
    const CameraRays wide(camera, {200, 100});
    camera.across = Across::height;
    const CameraRays high(camera, {200, 100});
    const auto slope = [](const CameraRays& rays, float x, float y) {
        const glm::vec3 d = rays.through(x, y).direction;
        return glm::vec2(d.x, d.y) / -d.z;
    };
    EXPECT_NEAR(slope(wide, 0.0f, 50.0f).x, -1.0f, 1e-5f);
    EXPECT_NEAR(slope(wide, 100.0f, 0.0f).y, 0.5f, 1e-5f);
    EXPECT_NEAR(slope(high, 200.0f, 50.0f).x, 2.0f, 1e-5f);
    EXPECT_NEAR(slope(high, 100.0f, 100.0f).y, -1.0f, 1e-5f);
}

// Inside a furnace every pixel is the furnace, at edges and corners too: what lies beside a chart
// on its page is not seen. Here it is white hot.
TEST(RoomView, NothingBesideAChartLeaksIn)
{
    SeenRoom furnace(scenes::room({3.0f, 2.5f, 4.0f}, 24, scenes::plain(glm::vec3(0.5f))));
    const PageTexels& covered = furnace.texels.pages[0];
    std::vector<uint16_t> leaky(furnace.pages[0].half().size(), halfFromFloat(1000.0f));
    for (const uint32_t pixel : covered.pixel)
        for (size_t c = 0; c < 3; ++c) leaky[3 * pixel + c] = halfFromFloat(0.5f);
    furnace.pages[0].rgb = leaky;
    for (const float yaw : {0.0f, 0.9f, 2.5f, 4.0f}) {
        const Camera camera{.position = {1.2f, 1.4f, 2.3f},
                            .forward = {std::sin(yaw), 0.0f, std::cos(yaw)},
                            .fieldOfView = 2.0f};
        for (const glm::vec3& seen : furnace.look(camera, {160, 120}, 2))
            ASSERT_NEAR(seen.g, 0.5f, 1e-4f);
    }
}

// Two charts that lie against each other on the page and far from each other in the room.
TEST(RoomView, NeighboursOnThePageDoNotMix)
{
    Scan scan = scenes::splitSquare(2.0f, 64, [](glm::vec3 p, glm::vec3) {
        return p.x < 1.0f ? glm::vec3(1.0f, 0.0f, 0.0f) : glm::vec3(0.0f, 1.0f, 0.0f);
    });
    SeenRoom split(std::move(scan));
    for (const glm::vec3& seen : split.look(kDown, {64, 64}))
        EXPECT_NEAR(seen.r + seen.g, 1.0f, 1e-3f); // nothing black from between the charts
}

TEST(RoomView, HolesShowWhatIsBeyond)
{
    SeenRoom floor(scenes::square(2.0f, 16, scenes::plain(glm::vec3(0.5f))));
    const Surroundings sky{.beyond = [](glm::vec3 d) { return glm::vec3(0.0f, 0.0f, d.y); }};
    Camera up = kDown;
    up.forward = {0.0f, 1.0f, 0.0f};
    EXPECT_NEAR(floor.look(up, {1, 1}, 1, sky)[0].b, 1.0f, 1e-5f);
}

// Between a floor and a shelf that both face up, the shelf's back is seen; from under the floor,
// outside of it all, backs are passed, and there is nothing but backs.
TEST(RoomView, BacksAreBlackFromInsideAndPassedFromOutside)
{
    const scenes::Panel floor{{0, 0, 0}, {0, 0, 2}, {2, 0, 0}};
    const scenes::Panel shelf{{0, 1, 0}, {0, 0, 2}, {2, 0, 0}};
    const std::vector<scenes::Panel> both{floor, shelf};
    SeenRoom shelves(scenes::panels(both, 16, scenes::plain(glm::vec3(0.5f))));
    const Surroundings around{.beyond = [](glm::vec3) { return glm::vec3(0.75f); }};
    Camera up = kDown;
    up.forward = {0.0f, 1.0f, 0.0f};
    up.position.y = 0.5f;
    EXPECT_EQ(shelves.look(up, {1, 1}, 1, around)[0].g, 0.0f);
    up.position.y = -0.5f;
    EXPECT_EQ(shelves.look(up, {1, 1}, 1, around)[0].g, 0.75f);
    // And from outside, a closed room shows the far wall's front through the near one's back.
    SeenRoom room(scenes::room({3.0f, 2.5f, 4.0f}, 24, scenes::plain(glm::vec3(0.5f))));
    const Camera outside{.position = {1.5f, 1.0f, 9.0f}};
    EXPECT_NEAR(room.look(outside, {1, 1}, 1, around)[0].g, 0.5f, 1e-3f);
}

// A lamp is seen before what lies behind it, and not through what stands before it.
TEST(RoomView, LampsAreSeenWhereTheyAre)
{
    SeenRoom floor(scenes::square(2.0f, 16, scenes::plain(glm::vec3(0.5f))));
    NewLight sphere{.type = LightType::sphere,
                    .emission = glm::vec3(7.0f),
                    .position = {1.0f, 0.5f, 1.0f},
                    .radius = 0.1f};
    Surroundings around = kDark;
    around.lamps = seenLamps(std::span(&sphere, 1));
    const auto picture = floor.look(kDown, {3, 3}, 1, around);
    EXPECT_NEAR(picture[4].g, 7.0f, 1e-4f);
    EXPECT_NEAR(picture[0].g, 0.5f, 1e-3f);
    sphere.position.y = -0.5f;
    around.lamps = seenLamps(std::span(&sphere, 1));
    EXPECT_NEAR(floor.look(kDown, {3, 3}, 1, around)[4].g, 0.5f, 1e-3f);
}

TEST(RoomView, IsTheSameOnAnyNumberOfThreads)
{
    SeenRoom room(scenes::room({3.0f, 2.5f, 4.0f}, 24,
                               [](glm::vec3 p, glm::vec3) { return 0.1f + 0.2f * glm::abs(p); }));
    const Camera camera{.position = {1.2f, 1.4f, 2.3f}};
    const auto many = room.look(camera, {64, 48}, 2);
    const ThreadLimit one(1);
    EXPECT_EQ(room.look(camera, {64, 48}, 2), many);
}

} // namespace relamp
