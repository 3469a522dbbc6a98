#pragma once

#include "lights/surfel_radiance.h"
#include "relamp/relight.h"
#include "relight/transport.h"
#include "scan/rays.h"
#include "scan/texels.h"

#include <string>
#include <vector>

namespace relamp
{

/// Rays of a surfel where a person leaves their number open.
size_t raysOf(const RelightOptions& options, size_t surfels);

/// A scan as rays and texels know it.
struct SurfaceOfRoom
{
    const Texels& texels;
    const RayScene& scene;
    const SurfelRadiance& radiance;
};

/// The surface of each captured fixture, in their order: surfacesOf() by what the room knows of its
/// texels.
std::vector<std::vector<ClippedPatch>> surfacesOfRoom(const DelitRoom& room,
                                                      const SurfaceOfRoom& surface,
                                                      std::vector<std::string>& warnings);

/// The room's transport: read from the options' file where that is of this room and these options,
/// else found by rays, and kept there if the place lets it; `warnings` says if not.
Transport transportOfRoom(const SurfaceOfRoom& surface, const RelightOptions& options,
                          std::vector<std::string>& warnings, Progress& progress);

} // namespace relamp
