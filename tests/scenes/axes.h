#pragma once

#include <glm/vec3.hpp>

namespace relamp::scenes
{

constexpr glm::vec3 kUp(0, 1, 0);
constexpr glm::vec3 kDown(0, -1, 0);

} // namespace relamp::scenes
