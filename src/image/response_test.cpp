#include "image/response.h"

#include "relamp/image.h"

#include <cmath>

#include <gmock/gmock.h>

namespace relamp
{

TEST(Response, StraightIsTheTexture)
{
    for (const float texture : {0.0f, 1e-7f, 0.02f, 0.5f, 0.97f, 1.0f})
        EXPECT_EQ(Response{}(texture), texture);
}

// Slopes that are all 2 are a square, which leaves white where it is.
TEST(Response, OfOneSlopeIsAPower)
{
    Response response;
    response.slope.fill(2.0f);
    for (const float texture : {1e-3f, 0.01f, 0.18f, 0.7f, 0.9f})
        EXPECT_NEAR(response(texture) / (texture * texture), 1.0f, 1e-4f) << texture;
    EXPECT_FLOAT_EQ(response.contrast(), 0.5f);
}

TEST(Response, RisesAndMeetsWhatIsBurntOut)
{
    Response response;
    response.slope = {0.5f, 0.7f, 1.4f, 2.0f, 3.0f};
    float last = 0.0f;
    for (int byte = 1; byte < 256; ++byte) {
        const float texture = std::pow(static_cast<float>(byte) / 255.0f, 2.2f);
        const float radiance = response(texture);
        EXPECT_GE(radiance, last);
        EXPECT_LE(radiance, 1.0f);
        last = radiance;
    }
    EXPECT_EQ(response(1.0f), 1.0f);
    EXPECT_EQ(response(0.98f), 0.98f);
}

// The logarithm is linear in the slopes, and its slope is what slopeAt says.
TEST(Response, ItsPartsAreItsDerivatives)
{
    Response response;
    response.slope = {0.6f, 0.8f, 1.1f, 1.5f, 2.0f};
    const float texture = 0.11f;
    const auto bend = bendAt(texture);
    const auto slope = slopeAt(texture);
    float log = 0.0f;
    float here = 0.0f;
    for (size_t k = 0; k < Response::kKnots; ++k) {
        log += response.slope[k] * bend[k];
        here += response.slope[k] * slope[k];
    }
    EXPECT_NEAR(std::log(response(texture)), log, 1e-5f);
    const float step = 1.01f;
    EXPECT_NEAR(std::log(response(texture * step) / response(texture)) / std::log(step), here,
                0.01f);
}

TEST(Response, IsUndoneInBytesAndNotInLight)
{
    Response response;
    response.slope.fill(2.0f);
    Image bytes{.width = 1, .height = 1, .rgb = std::vector<uint8_t>{128, 255, 0}};
    const glm::vec3 straight = Radiance(bytes)[0];
    EXPECT_NEAR(Radiance(bytes, response)[0].r, straight.r * straight.r, 1e-4f);
    EXPECT_EQ(Radiance(bytes, response)[0].g, 1.0f);
    EXPECT_EQ(Radiance(bytes, response)[0].b, 0.0f);
    Image light{.width = 1,
                .height = 1,
                .clipsAtWhite = false,
                .rgb = std::vector<uint16_t>{0x3800, 0x3800, 0x3800}}; // 0.5
    EXPECT_EQ(Radiance(light, response)[0], glm::vec3(0.5f));
}

} // namespace relamp
