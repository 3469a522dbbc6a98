#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

namespace relamp
{

/// Cubes of `side` metres that space is cut into. Where their sides lie follows from `seed`.
glm::ivec3 cubeOf(glm::vec3 place, float side, uint32_t seed);

constexpr int kFolds = 5;

/// Which of five fits does not look at a place, 0..4, so that what comes of it can be measured
/// there: a fifth of space each, in cubes of a quarter of a metre. What is wrong with the light at
/// a place is wrong around it too, so that single places between others would tell nothing that
/// these do not.
///
/// Every fifth cube along x, two further in the next row, by `seed` anywhere in the next layer:
/// cubes drawn at random lie side by side often enough to hide a whole side of a small lamp, and so
/// do larger ones.
int foldOf(glm::vec3 place, uint32_t seed);

} // namespace relamp
