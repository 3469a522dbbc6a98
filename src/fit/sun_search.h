#pragma once

#include "fit/light_fit.h"
#include "fit/sun_trial.h"
#include "scan/rays.h"
#include "shading/hit_lists.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace relamp
{

/// The estimate of a room's light once a sun is in it.
struct SunFit
{
    SunTrial trial;
    std::vector<uint8_t> emits; // of pieces, and of the sun
    LightEstimate estimate;
    double evidence = 0.0; // nats against the same room without one, tries paid for
};

/// The likeliest sun; none where the rim of the patch that it would throw does not tell.
/// `outside` comes from sceneWithoutPanes.
std::optional<SunFit> findSun(const Texels& texels, const RayScene& outside, const HitLists& hits,
                              const SurfelRadiance& radiance, const LightSoFar& light);

} // namespace relamp
