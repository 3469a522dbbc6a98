#include "fit/told_lamp.h"

#include "scenes/lit_room.h"
#include "scenes/surfaces.h"

#include <algorithm>

#include <gmock/gmock.h>

namespace relamp
{
namespace
{

using scenes::LitBox;
using scenes::LitRoom;

// A curtain on the wall x = 0, folded: its light goes up and down by a fifth.
constexpr glm::vec3 kCurtain{0.0f, 1.2f, 2.5f}; // its middle
constexpr float kAcross = 1.0f;                 // m
constexpr float kTall = 1.6f;
constexpr float kBright = 0.7f; // luminance

bool isOnCurtain(glm::vec3 p, glm::vec3 n)
{
    return n.x > 0.5f && std::abs(p.z - kCurtain.z) < 0.5f * kAcross &&
           std::abs(p.y - kCurtain.y) < 0.5f * kTall;
}

/// Lit by a panel; `spot`: what is burnt out of the curtain, m across.
const scenes::Surfaces& room(float spot)
{
    const auto made = [](float across) {
        const LitBox box(LitRoom::kSize,
                         {{{{0.6f, 2.5f, 2.1f}, {0.8f, 0, 0}, {0, 0, 0.6f}}, glm::vec3(5.0f)}},
                         LitRoom::albedo);
        return scenes::room(LitRoom::kSize, 160, [&](glm::vec3 p, glm::vec3 n) {
            if (!isOnCurtain(p, n)) return box.photo(p, n);
            if (glm::distance(p, kCurtain) < 0.5f * across) return glm::vec3(1.0f);
            return glm::vec3(kBright * (1.0f + 0.2f * std::sin(40.0f * p.z)));
        });
    };
    static const scenes::Surfaces plain(made(0.0f));
    static const scenes::Surfaces withSpot(made(0.3f));
    return spot > 0.0f ? withSpot : plain;
}

std::vector<Glowing> toldIn(const scenes::Surfaces& surfaces, glm::vec3 place)
{
    return toldLamps({&place, 1}, surfaces.texels.surfels, surfaces.radiance);
}

float areaOf(const Glowing& piece, const Surfels& surfels)
{
    float area = 0.0f;
    for (const uint32_t s : piece.surfels) area += surfels.area[s];
    return area;
}

/// All of the curtain and nothing else, but for its rim.
void expectCurtain(const std::vector<Glowing>& told, const Surfels& surfels)
{
    ASSERT_EQ(told.size(), 1u);
    EXPECT_NEAR(areaOf(told[0], surfels), kAcross * kTall, 0.1f * kAcross * kTall);
    const auto isOfIt = [&](uint32_t s) {
        return isOnCurtain(surfels.position[s], surfels.normal[s]);
    };
    EXPECT_GT(std::ranges::count_if(told[0].surfels, isOfIt),
              static_cast<ptrdiff_t>(0.95 * static_cast<double>(told[0].surfels.size())));
}

} // namespace

TEST(ToldLamp, IsTheBrightPieceToItsRim)
{
    const scenes::Surfaces& surfaces = room(0.0f);
    const std::vector<Glowing> told = toldIn(surfaces, kCurtain + glm::vec3(0.0f, 0.4f, 0.3f));
    expectCurtain(told, surfaces.texels.surfels);
    EXPECT_LT(told[0].from, 0.8f * kBright); // its folds are of it
}

TEST(ToldLamp, GoesOnAroundWhatIsBurntOutOfIt)
{
    const scenes::Surfaces& surfaces = room(0.3f);
    expectCurtain(toldIn(surfaces, kCurtain + glm::vec3(0.0f, 0.3f, 0.0f)),
                  surfaces.texels.surfels);
}

// Who points beside a lamp means the lamp, and that is a candidate as it is.
TEST(ToldLamp, IsNoneWhereALampIsBurntOut)
{
    EXPECT_THAT(toldIn(room(0.0f), {1.0f, 2.5f, 1.9f}), testing::IsEmpty());
}

TEST(ToldLamp, IsNoneWhereAllIsBlack)
{
    const scenes::Surfaces black(
        scenes::room(LitRoom::kSize, 32, [](glm::vec3, glm::vec3) { return glm::vec3(0.0f); }));
    EXPECT_THAT(toldIn(black, kCurtain), testing::IsEmpty());
}

TEST(ToldLamp, IsNoneInTheAir)
{
    EXPECT_THAT(toldIn(room(0.0f), {2.0f, 1.2f, 2.5f}), testing::IsEmpty());
}

} // namespace relamp
