#include "scan/held_out.h"

#include "base/sampling.shared.h"

#include <glm/common.hpp>

namespace relamp
{

/// Walls often lie at whole metres, and noise would scatter them over cubes whose sides do too.
glm::ivec3 cubeOf(glm::vec3 place, float side, uint32_t seed)
{
    constexpr uint kSalt = 41;
    glm::vec3 shift;
    for (int axis = 0; axis < 3; ++axis)
        shift[axis] = seededShift(seed, static_cast<uint>(axis), kSalt);
    return glm::floor(place / side + shift);
}

int foldOf(glm::vec3 place, uint32_t seed)
{
    constexpr float kSide = 0.25f; // m
    constexpr uint kSalt = 42;
    const glm::ivec3 cube = cubeOf(place, kSide, seed);
    const float ofLayer = seededShift(seed, static_cast<uint>(cube.z), kSalt);
    const int at = (cube.x + 2 * cube.y + static_cast<int>(ofLayer * kFolds)) % kFolds;
    return at < 0 ? at + kFolds : at;
}

} // namespace relamp
