#pragma once

#include <glm/vec2.hpp>

#include "studio.h"

class Viewer;

/// Draws marks of lights, the gizmo of the selected one, and the slider between before and after.
void drawOverlay(const Viewer& viewer);

/// The light whose mark lies under a pixel of the view.
Selection lightUnder(const Viewer& viewer, glm::vec2 pixel);

/// The fixture that a place on the surface belongs to.
Selection fixtureAt(const Viewer& viewer, glm::vec3 place);
