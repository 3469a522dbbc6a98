#pragma once

#include "relamp/relight.h"

#include <cstddef>

#include <glm/vec3.hpp>

namespace relamp
{

/// Which of the room's fixtures has its centre there, within 2 cm; their count where none has.
size_t placeOfFixture(const Lights& captured, glm::vec3 centre);

} // namespace relamp
