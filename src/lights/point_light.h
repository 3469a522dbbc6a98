#pragma once

#include "relamp/lights.h"

namespace relamp
{

/// Intensity of one point that sends as much as the fixture: pi L A over the whole sphere.
glm::vec3 intensityOf(const Fixture& fixture);

/// A lamp that nobody took apart: it shines all around from its centre, with all its flux.
PointLight pointLightOf(const Fixture& fixture, int index);

} // namespace relamp
