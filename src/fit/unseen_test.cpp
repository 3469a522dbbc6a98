#include "fit/unseen.h"

#include "base/radiometry.shared.h"
#include "scan/held_out.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

constexpr uint32_t kSeed = 1;

/// A floor of one paint under a lamp above its middle, and another that a part of one fold alone
/// gets light of.
struct FoldedFloor
{
    static constexpr int kAcross = 50; // places, 0.1 m apart

    LightModel model{.pieces = 2};
    std::vector<MaterialPair> pairs;
    std::vector<glm::vec3> texture;
    std::vector<glm::vec3> positions;
    std::vector<uint8_t> isLitAlone; // of places, by the second lamp
    std::vector<double> truth{3.0, 3.0, -1.0};

    FoldedFloor();

    [[nodiscard]] std::vector<float> change(std::span<const double> log,
                                            const CameraModel& camera = {}) const
    {
        const std::vector<uint8_t> emits{1, 1};
        return changeUnseen({model, pairs, {}, 0.05, emits, log, camera, {texture, positions}},
                            kSeed);
    }
};

FoldedFloor::FoldedFloor()
{
    const float radiance = std::exp(3.0f);
    for (int i = 0; i < kAcross * kAcross; ++i) {
        const glm::vec3 place(0.1f * static_cast<float>(i % kAcross), 0.0f,
                              0.1f * static_cast<float>(i / kAcross));
        const float d2 =
            4.0f + (place.x - 2.5f) * (place.x - 2.5f) + (place.z - 2.5f) * (place.z - 2.5f);
        const bool isAlone = foldOf(place, kSeed) == 2 && place.x < 2.0f;
        const float direct = 0.2f / (d2 * d2);
        const float alone = isAlone ? 0.02f : 0.0f;
        const float irradiance =
            0.3f + std::exp(-1.0f) * 0.2f + radiance * (direct + alone) + 1e-3f;
        positions.push_back(place);
        isLitAlone.push_back(isAlone ? 1 : 0);
        model.gathered.emplace_back(0.3f);
        model.missed.push_back({{0, 0.2f}});
        model.direct.push_back({{0, direct}, {1, alone}});
        model.shown.emplace_back(0.5f / kPi * irradiance);
    }
    texture = model.shown;
    model.shown.insert(model.shown.end(), 2, glm::vec3(1.0f)); // of the lamps nothing is known
    model.gathered.insert(model.gathered.end(), 2, glm::vec3(0.0f));
    model.missed.resize(model.shown.size());
    model.direct.resize(model.shown.size());
    model.area.assign(2, 0.0f);
    std::mt19937 random(3);
    const auto any = [&] { return static_cast<uint32_t>(random() % positions.size()); };
    for (int k = 0; k < 6000; ++k) pairs.push_back({any(), any()});
    std::erase_if(pairs, [](MaterialPair pair) { return pair.p == pair.q; });
}

} // namespace

// A lamp that no other place tells of is not known where its own do not count; all else is.
TEST(Unseen, PlacesDoNotTellOfThemselves)
{
    const FoldedFloor floor;
    const std::vector<float> change = floor.change(floor.truth);
    ASSERT_EQ(change.size(), floor.positions.size());
    for (size_t i = 0; i < change.size(); ++i)
        ASSERT_EQ(std::abs(change[i]) > 0.1f, floor.isLitAlone[i] != 0) << change[i];
}

// What the search of a fit still gains by going on is no change: the fit of all goes on as well.
TEST(Unseen, WhereTheFitBeganDoesNotMatter)
{
    const FoldedFloor floor;
    const std::vector<float> one = floor.change(floor.truth);
    const std::vector<float> other = floor.change(std::vector{3.1, 2.9, -1.2});
    for (size_t i = 0; i < one.size(); ++i) ASSERT_NEAR(one[i], other[i], 0.03f);
}

// The last places are no part of the texture, as those of a sun's rim.
TEST(Unseen, PlacesThatAreNotOfTheTextureHaveNoCamera)
{
    FoldedFloor floor;
    constexpr size_t kOfTexture = 2000;
    floor.texture.resize(kOfTexture);
    floor.positions.resize(kOfTexture);
    CameraModel curved;
    curved.response.slope.fill(0.9f);
    const std::vector<float> change = floor.change(floor.truth, curved);
    ASSERT_EQ(change.size(), kOfTexture);
    for (const float log : change) EXPECT_LT(std::abs(log), 1.0f);
}

} // namespace relamp
