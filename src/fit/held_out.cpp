#include "fit/held_out.h"

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

bool HeldOut::has(glm::vec3 place) const
{
    constexpr uint kSalt = 42;
    const glm::ivec3 cube = cubeOf(place, kSide, seed_);
    const float ofLayer = seededShift(seed_, static_cast<uint>(cube.z), kSalt);
    const int at = cube.x + 2 * cube.y + static_cast<int>(ofLayer * kOneOf);
    return at % kOneOf == 0;
}

std::vector<uint8_t> heldOutOf(const Surfels& surfels)
{
    const HeldOut heldOut(surfels.seed);
    std::vector<uint8_t> flags;
    flags.reserve(surfels.count());
    for (const glm::vec3 place : surfels.position) flags.push_back(heldOut.has(place) ? 1 : 0);
    return flags;
}

} // namespace relamp
