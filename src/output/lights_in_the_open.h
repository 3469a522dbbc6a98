#pragma once

#include "relamp/lights.h"
#include "scan/rays.h"

#include <vector>

namespace relamp
{

/// The lights for programs that let surfaces cast shadows. A point stands in the middle of its
/// lamp: behind the lamp's own shade, or in the wall that a reconstruction laid over it. Each goes
/// along its normal past what is nearer than that can be, and stays where nothing is. Those that
/// shine all around stay, for no way leads out of a globe.
std::vector<PointLight> inTheOpen(std::vector<PointLight> lights, const RayScene& scene);

} // namespace relamp
