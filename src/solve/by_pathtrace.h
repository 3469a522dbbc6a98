#pragma once

#include "scan/rays.h"
#include "scan/texels.h"
#include "shading/path_tracer.h"
#include "solve/found_room.h"
#include "solve/solution.h"

#include <memory>
#include <vector>

namespace relamp
{

/// The slow reference: the lamps of the gather solver, and every bounce of their light simulated by
/// path tracing off the albedo that is being recovered. The texture is not asked what the light is.
Solution solveByPathtrace(const Texels& texels, const RayScene& scene,
                          const DelightOptions& options, Progress& progress);

/// Shades every texel by paths through a room.
TexelShading shadingOf(const Texels& texels, const RayScene& scene,
                       std::shared_ptr<const TracedRoom> room, const PathtraceOptions& options);

/// A found room as paths see it, with its sun; stays valid without it.
TracedRoom tracedRoomOf(const Texels& texels, const FoundRoom& room, std::vector<glm::vec3> albedo);

} // namespace relamp
