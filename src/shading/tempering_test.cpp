#include "shading/tempering.h"

#include "base/radiometry.shared.h"
#include "shading/tempering.shared.h"

#include <gtest/gtest.h>

namespace relamp
{
namespace
{

const glm::vec3 kKept(0.5f, 0.4f, 0.3f);

glm::vec3 by(glm::vec3 shading, float power)
{
    return temperedBy(shading, factorOf({.kept = kKept, .power = power}), power);
}

} // namespace

// A geometric mean between what was found and what is kept.
TEST(Tempering, OfOneHalfTakesTheRoot)
{
    for (const float light : {0.01f, 0.3f, 2.0f}) {
        const glm::vec3 shading(light, 2.0f * light, 3.0f * light);
        const glm::vec3 tempered = shading * by(shading, 0.5f);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(tempered[c], std::sqrt(shading[c] * kKept[c]), 1e-5f);
    }
}

TEST(Tempering, LeavesAllOfAShadingThatIsBelievedAndNothingOfOneThatIsNot)
{
    const glm::vec3 shading(0.07f, 0.9f, 3.0f);
    EXPECT_EQ(by(shading, 1.0f), glm::vec3(1.0f)); // to the bit
    const glm::vec3 none = shading * by(shading, 0.0f);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(none[c], kKept[c], 1e-6f);
}

TEST(Tempering, OfWhatIsBlackIsBlack)
{
    const glm::vec3 black = glm::vec3(0.0f) * by(glm::vec3(0.0f), 0.3f);
    EXPECT_EQ(black, glm::vec3(0.0f));
}

TEST(Tempering, ScalesWhatIsBelievedAsWell)
{
    ShadingBlock shading;
    for (float* light : {shading.direct.r, shading.direct.g, shading.direct.b}) light[0] = 0.5f;
    for (float* light : {shading.indirect.r, shading.indirect.g, shading.indirect.b})
        light[0] = 0.25f;
    const glm::vec3 scale(0.5f, 0.8f, 2.0f);
    temper({.scale = scale}, 1, shading);
    EXPECT_FLOAT_EQ(shading.direct.r[0], 0.25f);
    EXPECT_FLOAT_EQ(shading.indirect.b[0], 0.5f);
    EXPECT_EQ(tempered({.scale = scale}, {glm::vec3(1.0f)})[0], scale);
}

// How much of the light comes straight is another matter.
TEST(Tempering, KeepsTheSharesOfDirectAndIndirectLight)
{
    ShadingBlock shading;
    for (size_t i = 0; i < 2; ++i) {
        const float light = i == 0 ? 0.1f : 2.0f;
        shading.direct.r[i] = shading.direct.g[i] = shading.direct.b[i] = 3.0f * light;
        shading.indirect.r[i] = shading.indirect.g[i] = shading.indirect.b[i] = light;
    }
    temper({kKept, 0.6f}, 2, shading);
    for (size_t i = 0; i < 2; ++i) {
        EXPECT_NEAR(shading.direct.g[i], 3.0f * shading.indirect.g[i], 1e-5f);
        const float found = i == 0 ? 0.4f : 8.0f;
        EXPECT_NEAR(shading.direct.g[i] + shading.indirect.g[i],
                    kKept.g * std::pow(found / kKept.g, 0.6f), 1e-4f);
    }
}

TEST(Tempering, IsTheSameOfIrradiance)
{
    const glm::vec3 shading(0.07f, 0.9f, 3.0f);
    const std::vector<glm::vec3> irradiance = tempered({kKept, 0.6f}, {kPi * shading});
    const glm::vec3 expected = kPi * shading * by(shading, 0.6f);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(irradiance[0][c], expected[c], 1e-4f);
}

} // namespace relamp
