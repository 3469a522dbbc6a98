#pragma once

#include "relamp/camera.h"
#include "relamp/scan.h"
#include "scan/rays.h"

#include <vector>

namespace relamp
{

/// Up to `count` cameras at eye height inside rooms, the large ones of a house first, each looking
/// where much of a room is seen and the others do not look. Always at least one; the same for the
/// same scan.
std::vector<Camera> chooseViewpoints(const Scan& scan, const RayScene& scene, int count);

/// A camera where one sees most of the room while turning around.
Camera chooseTurningPlace(const Scan& scan, const RayScene& scene);

} // namespace relamp
