#pragma once

#include "scan/rays.h"
#include "scan/surfels.h"

#include <optional>
#include <string>

namespace relamp
{

/// Whether surfaces face away from the space that they enclose: their backs see backs, and their
/// fronts see few fronts. So do those of a room whose triangles are turned round, which many
/// programs show as if nothing were wrong, and of an object that is seen from outside.
///
/// A room that is partly scanned has backs that see nothing, and the walls of a house have fronts
/// that see fronts, whatever lies between them.
bool isInsideOut(const Surfels& surfels, const RayScene& scene);

/// What a person can do about that.
std::optional<std::string> noteOnFacing(const Surfels& surfels, const RayScene& scene);

} // namespace relamp
