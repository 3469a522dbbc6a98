#include "lights/area_light.h"

#include "scenes/axes.h"

#include <gtest/gtest.h>

namespace relamp
{

TEST(AreaLight, PatchesStandForEqualAreas)
{
    const AreaLight light({{{0, 0, 0}, scenes::kUp, 3.0f, 0}, {{1, 0, 0}, scenes::kUp, 1.0f, 1}});
    EXPECT_EQ(light.area(), 4.0f);
    EXPECT_EQ(light.at(0.7f).surfel, 0u);
    EXPECT_EQ(light.at(0.8f).surfel, 1u);
    EXPECT_EQ(light.at(1.0f).surfel, 1u);
    EXPECT_NEAR(light.centre().x, 0.25f, 1e-6f);
}

} // namespace relamp
