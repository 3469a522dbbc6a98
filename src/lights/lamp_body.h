#pragma once

#include "lights/candidates.h"
#include "scan/rays.h"
#include "scan/texels.h"

namespace relamp
{

/// Patches that belong to no surfel: of a ball, and of a disc that shines to where `normal` points.
std::vector<ClippedPatch> patchedBall(glm::vec3 centre, float radius);
std::vector<ClippedPatch> patchedDisc(glm::vec3 centre, glm::vec3 normal, float radius);

/// The side of a lamp that no camera saw, guessed from the side that was scanned.
///
/// Cameras see lampshades and sconces from the room; the half towards the wall is missing from many
/// a scan, and yet it is what lights that wall. A body is taken to be as wide behind as before: its
/// patches are mirrored at the plane through the middle of its curvature. What the scan has a
/// surface at stays as it was scanned, and what does not face into the room is left out.
///
/// Its patches belong to no surfel. It has none for a flat lamp, whose far side is anywhere, for a
/// whole one, and for a few specks of noise.
Candidate unseenSideOf(const Candidate& candidate, const Texels& texels, const RayScene& scene);

} // namespace relamp
