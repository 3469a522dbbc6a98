#pragma once

#include "scan/surfels.h"

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// Cubes of `side` metres that space is cut into. Where their sides lie follows from `seed`.
glm::ivec3 cubeOf(glm::vec3 place, float side, uint32_t seed);

/// Places that no fit of light looks at, so that what comes of it can be measured there: a fifth of
/// space, in cubes of a quarter of a metre. What is wrong with the light at a place is wrong around
/// it too, so that single places between others would tell nothing that these do not.
///
/// Every fifth cube along x, two further in the next row, by `seed` anywhere in the next layer:
/// cubes drawn at random lie side by side often enough to hide a whole side of a small lamp, and so
/// do larger ones.
class HeldOut
{
public:
    explicit HeldOut(uint32_t seed) : seed_(seed) {}

    [[nodiscard]] bool has(glm::vec3 place) const;

    static constexpr float kSide = 0.25f; // m
    static constexpr int kOneOf = 5;      // cubes

private:
    uint32_t seed_;
};

/// The same for all surfels: not 0 where one is held out.
std::vector<uint8_t> heldOutOf(const Surfels& surfels);

} // namespace relamp
