#include "relight/photometry.h"

#include "base/radiometry.shared.h"
#include "relamp/error.h"
#include "relight/light_emission.h"

#include <glm/gtc/constants.hpp>
#include <glm/vec2.hpp>
#include <gmock/gmock.h>

namespace relamp
{
namespace
{

constexpr float kSphere = 4.0f * glm::pi<float>();
const PhotometricWhite kNits{.luminance = 1.0f}; // so that radiance is in cd/m^2

/// CIE 1931 chromaticity of linear Rec. 709.
glm::vec2 chromaticityOf(glm::vec3 rgb)
{
    const glm::vec3 xyz(0.4124f * rgb.r + 0.3576f * rgb.g + 0.1805f * rgb.b, luminance(rgb),
                        0.0193f * rgb.r + 0.1192f * rgb.g + 0.9505f * rgb.b);
    return glm::vec2(xyz) / (xyz.x + xyz.y + xyz.z);
}

} // namespace

// 800 lm all around, which is what a 60 W bulb gives, are 800 / 4 pi = 63.7 cd.
TEST(Photometry, LumensOfAKnownLamp)
{
    const glm::vec3 intensity = intensityFromLumens(800.0f, kSphere, glm::vec3(1.0f), kNits);
    EXPECT_NEAR(luminance(intensity), 63.66f, 0.01f);
    // Two metres under it: 63.66 / 4 = 15.9 lux, and a white sheet there shows E / pi.
    EXPECT_NEAR(luminance(intensity) / 4.0f, 15.92f, 0.01f);
}

TEST(Photometry, LumensDoNotDependOnTheColour)
{
    for (const float kelvin : {1500.0f, 2700.0f, 6504.0f, 20000.0f}) {
        const glm::vec3 intensity =
            intensityFromLumens(800.0f, kSphere, blackbodyColour(kelvin), kNits);
        EXPECT_NEAR(luminance(intensity), 63.66f, 0.01f) << kelvin;
    }
}

// A lights file says the same in every unit: 683 lm are a watt of light, and 4 pi of them a
// candela.
TEST(Photometry, UnitsOfALightsFileAgree)
{
    const JsonLines lines("{}");
    const auto photometric = [&](const nlohmann::json& light) {
        const JsonItem item{light, "lamp.json: light 0", lines, ""};
        return luminance(emissionOf(item, NewLight{}, kNits));
    };
    EXPECT_NEAR(photometric({{"watts", 10}}), 6830.0f / kSphere, 0.01f);
    EXPECT_NEAR(photometric({{"lumens", 6830}, {"kelvin", 2700}}), 6830.0f / kSphere, 0.01f);
    EXPECT_NEAR(photometric({{"candela", 543.5}}), 543.5f, 0.01f);
    EXPECT_NEAR(photometric({{"intensity", {2, 2, 2}}}), 2.0f, 1e-5f);
    EXPECT_THROW(photometric({{"watts", 1}, {"lumens", 1}}), Error);
}

// A matte panel of A m^2 and luminance L sends pi L A lumens.
TEST(Photometry, PanelOfKnownLumensHasItsLuminance)
{
    const glm::vec3 radiance =
        radianceFromLumens(4000.0f, 0.36f, glm::vec3(1.0f), PhotometricWhite{});
    EXPECT_NEAR(100.0f * radiance.g, 4000.0f / (glm::pi<float>() * 0.36f), 0.5f);
}

// CIE 15: the Planckian locus at 2856 K (illuminant A) is at (0.4476, 0.4074); at 4000 K at
// (0.3805, 0.3768); at 6500 K at (0.3135, 0.3237); at 10000 K at (0.2807, 0.2884).
TEST(Photometry, BlackbodiesLieOnThePlanckianLocus)
{
    const auto expectAt = [](float kelvin, glm::vec2 chromaticity) {
        const glm::vec2 found = chromaticityOf(blackbodyColour(kelvin));
        EXPECT_NEAR(found.x, chromaticity.x, 0.004f) << kelvin;
        EXPECT_NEAR(found.y, chromaticity.y, 0.004f) << kelvin;
    };
    expectAt(2856.0f, {0.4476f, 0.4074f});
    expectAt(4000.0f, {0.3805f, 0.3768f});
    expectAt(6500.0f, {0.3135f, 0.3237f});
    expectAt(10000.0f, {0.2807f, 0.2884f});
}

TEST(Photometry, ColoursHaveLuminanceOneAndNoNegativeChannel)
{
    for (float kelvin = kColdestKelvin; kelvin <= kHottestKelvin; kelvin *= 1.1f) {
        const glm::vec3 colour = blackbodyColour(kelvin);
        EXPECT_NEAR(luminance(colour), 1.0f, 1e-5f);
        EXPECT_GE(std::min({colour.r, colour.g, colour.b}), 0.0f);
    }
}

// A camera that is balanced for a lamp shows it grey, and a bluer one bluish.
TEST(Photometry, WhiteIsWhatTheCameraWasBalancedFor)
{
    const PhotometricWhite tungsten{.kelvin = 2900.0f};
    const glm::vec3 same = blackbodyColour(2900.0f, tungsten);
    EXPECT_NEAR(same.r, 1.0f, 1e-4f);
    EXPECT_NEAR(same.b, 1.0f, 1e-4f);
    EXPECT_GT(blackbodyColour(4000.0f, tungsten).b, 1.2f);
}

} // namespace relamp
