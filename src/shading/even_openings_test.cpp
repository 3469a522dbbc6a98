#include "shading/even_openings.h"

#include "scenes/axes.h"
#include "scenes/surfaces.h"
#include "shading/gather.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

constexpr size_t kRays = 64;

/// A room whose wall at x = 0 has a window, 1 m wide and 0.8 m high, that was not scanned.
scenes::Surfaces roomWithWindow()
{
    std::vector<scenes::Panel> walls = scenes::wallsOf({4.0f, 2.4f, 3.0f});
    walls.erase(walls.begin() + 2);
    for (const scenes::Panel& part : std::vector<scenes::Panel>{
             {{0, 0, 0}, {0, 2.4f, 0}, {0, 0, 1}},
             {{0, 0, 2}, {0, 2.4f, 0}, {0, 0, 1}},
             {{0, 0, 1}, {0, 0.9f, 0}, {0, 0, 1}},
             {{0, 1.7f, 1}, {0, 0.7f, 0}, {0, 0, 1}},
         })
        walls.push_back(part);
    return scenes::Surfaces(scenes::panels(walls, 96, scenes::plain(glm::vec3(0.4f))));
}

/// What fronts see of all that lies outside, in the mean over those beside them.
std::vector<float> missedByFronts(const scenes::Surfaces& room, const HitLists& hits)
{
    const Surfels& surfels = room.texels.surfels;
    std::vector<float> missed;
    for (uint32_t s = 0; s < surfels.count(); ++s) {
        float sum = 0.0f;
        float rays = 0.0f;
        for (const uint32_t beside : surfels.neighborsOf(s)) {
            for (const HitTarget target : hits.targetsOf(beside))
                sum += target.isNothing() ? 1.0f : 0.0f;
            rays += static_cast<float>(hits.targetsOf(beside).size());
        }
        missed.push_back(sum / rays);
    }
    return missed;
}

} // namespace

// Against twenty times the rays: two thirds of the error, and as much light in the whole.
TEST(EvenOpenings, AreSeenAsByFarMoreRays)
{
    const scenes::Surfaces room = roomWithWindow();
    const std::vector<float> truth = missedByFronts(room, scenes::hitListsOf(room, 20 * kRays));
    HitLists hits = scenes::hitListsOf(room, kRays);
    const auto apart = [&](const std::vector<float>& found) {
        double squares = 0.0;
        double count = 0.0;
        for (size_t s = 0; s < found.size(); ++s) {
            if (room.texels.surfels.position[s].x < 1.0f) continue; // beside it, rays of lists do
            squares += std::pow(static_cast<double>(found[s] - truth[s]), 2.0);
            count += 1.0;
        }
        return std::sqrt(squares / count);
    };
    const auto all = [&](const std::vector<float>& found) {
        double sum = 0.0;
        for (size_t s = 0; s < found.size(); ++s)
            sum += static_cast<double>(found[s] * room.texels.surfels.area[s]);
        return sum;
    };
    const double before = apart(missedByFronts(room, hits));
    const std::vector<uint32_t> lengths = hits.firstTarget;
    evenOpenings(room.texels, room.rays, hits, unwatched());
    const std::vector<float> after = missedByFronts(room, hits);
    EXPECT_LT(apart(after), 0.75 * before);
    EXPECT_NEAR(all(after), all(truth), 0.02 * all(truth));
    EXPECT_EQ(hits.firstTarget, lengths);
}

TEST(EvenOpenings, LeaveAWholeRoomAsItIs)
{
    const scenes::Surfaces room(
        scenes::room({3.0f, 2.0f, 2.5f}, 32, scenes::plain(glm::vec3(0.4f))));
    HitLists hits = scenes::hitListsOf(room, kRays);
    const std::vector<float> before = missedByFronts(room, hits);
    evenOpenings(room.texels, room.rays, hits, unwatched());
    EXPECT_EQ(missedByFronts(room, hits), before);
}

} // namespace relamp
