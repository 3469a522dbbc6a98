#include "scan/site.shared.h"

#include <cmath>

#include <glm/packing.hpp>
#include <gtest/gtest.h>

namespace relamp
{

// On the way there is a pair of 16-bit numbers, whose steps are 3e-5.
TEST(Site, NormalComesBackFromItsSquare)
{
    for (int i = 0; i < 2000; ++i) {
        const float z = 1.0f - 2.0f * (static_cast<float>(i) + 0.5f) / 2000.0f;
        const float angle = 2.39996323f * static_cast<float>(i); // golden: even over the sphere
        const float r = std::sqrt(1.0f - z * z);
        const glm::vec3 normal(r * std::cos(angle), r * std::sin(angle), z);
        const uint32_t packed = glm::packSnorm2x16(octahedral(normal));
        EXPECT_LT(glm::length(fromOctahedral(glm::unpackSnorm2x16(packed)) - normal), 1e-4f);
    }
}

TEST(Site, NormalsAlongTheAxesComeBackExactly)
{
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {1.0f, -1.0f}) {
            glm::vec3 normal(0.0f);
            normal[axis] = side;
            const uint32_t packed = glm::packSnorm2x16(octahedral(normal));
            EXPECT_EQ(fromOctahedral(glm::unpackSnorm2x16(packed)), normal);
        }
}

} // namespace relamp
