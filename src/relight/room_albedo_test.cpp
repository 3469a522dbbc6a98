#include "relight/room_albedo.h"

#include "base/half.h"
#include "scenes/axes.h"
#include "scenes/scenes.h"
#include "scenes/surfaces.h"

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

using scenes::kUp;

constexpr glm::vec3 kWall(0.5f, 0.6f, 0.7f);
constexpr float kHalfWay = 1.0f; // m; from there on nothing is known

glm::vec3 white(glm::vec3 place, glm::vec3)
{
    return glm::vec3(place.x < kHalfWay ? 0.3f : 1.0f);
}

/// A floor whose right half has confidence 0 and the albedo `guessed`.
struct HalfKnown
{
    scenes::Surfaces floor;
    std::vector<Image> albedo;
    std::vector<Image> confidence;

    HalfKnown(const scenes::Paint& texture, glm::vec3 guessed)
        : floor(scenes::square(2.0f, 64, texture))
    {
        const auto paint = [=](glm::vec3 place, glm::vec3) {
            return place.x < kHalfWay ? kWall : guessed;
        };
        albedo.push_back(scenes::square(2.0f, 64, paint).pages[0].image);
        Image& known = confidence.emplace_back();
        known.width = known.height = 64;
        known.rgb = std::vector<uint8_t>(size_t{3} * 64 * 64);
        for (size_t pixel = 0; pixel < known.pixels(); ++pixel)
            if (pixel % 64 < 32) known.encoded()[3 * pixel] = 255;
    }

    [[nodiscard]] RoomAlbedo room() const
    {
        return {floor.texels, albedo, confidence, floor.radiance.isClipped};
    }
    [[nodiscard]] glm::vec3 ofSurfel(float x) const
    {
        return room().ofSurfels()[floor.at({x, 0, 1}, kUp)];
    }
    [[nodiscard]] glm::vec3 ofTexel(float x) const
    {
        const auto pixel = static_cast<uint32_t>(32 * 64 + static_cast<int>(32.0f * x));
        return room().ofTexel(0, pixel, floor.at({x, 0, 1}, kUp));
    }
};

void expectNear(glm::vec3 value, glm::vec3 expected)
{
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], expected[c], 2e-3f);
}

} // namespace

// A file of confidence may have 16 bits, which an Image has as half floats.
TEST(RoomAlbedo, ConfidenceIsReadOfAnyKindOfPicture)
{
    const HalfKnown bytes(scenes::plain(kWall), glm::vec3(0.1f));
    HalfKnown halves(scenes::plain(kWall), glm::vec3(0.1f));
    for (Image& image : halves.confidence) {
        std::vector<uint16_t> rgb;
        for (const uint8_t byte : image.encoded())
            rgb.push_back(halfFromFloat(static_cast<float>(byte) / 255.0f));
        image.rgb = std::move(rgb);
    }
    EXPECT_EQ(halves.room().ofSurfels(), bytes.room().ofSurfels());
}

TEST(RoomAlbedo, WhatIsAGuessGetsThatOfTheSurfaceAround)
{
    const HalfKnown half(scenes::plain(glm::vec3(0.3f)), {0.01f, 0.9f, 0.01f});
    expectNear(half.ofTexel(0.5f), kWall);
    expectNear(half.ofTexel(1.7f), kWall);
    expectNear(half.ofSurfel(1.7f), kWall);
}

// The texture stops at white, the wall did not: what white needs is the least that it can have.
TEST(RoomAlbedo, BurntOutWallIsAsBrightAsWhiteNeedsAndAsTheSurfaceAround)
{
    const HalfKnown half(white, {0.9f, 0.5f, 1.7f});
    const glm::vec3 least(0.9f, kWall.g, 1.0f);
    expectNear(half.ofTexel(0.5f), kWall);
    expectNear(half.ofTexel(1.7f), least);
    expectNear(half.ofSurfel(1.7f), least);
    expectNear(half.ofSurfel(0.5f), kWall);
}

} // namespace relamp
