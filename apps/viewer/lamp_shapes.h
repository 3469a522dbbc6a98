#pragma once

#include "room_drawing.h"

#include "relamp/relight.h"

#include <span>
#include <vector>

/// Triangles of what is seen of lights: bulbs, globes, discs and panels, as bright as they shine.
/// Points without a bulb and suns are not seen.
std::vector<LampVertex> lampShapes(std::span<const relamp::NewLight> lights);
