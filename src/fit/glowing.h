#pragma once

#include "fit/lamps.h"
#include "fit/light_fit.h"
#include "lights/candidates.h"
#include "scan/texels.h"
#include "shading/lit_sides.h"

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace relamp
{

/// The light on a place may be off by this factor; what is more than its square off is not by
/// error.
inline const float kUnsureLight = std::exp(static_cast<float>(kBoundNoise));

/// A piece of surface that glows, and is not burnt out.
struct Glowing
{
    std::vector<uint32_t> surfels;
    float from = 0.0f; // luminance: what shows less, at its rim, is something else
};

/// Pieces that send clearly more than white paper could, in the light that falls on them and in the
/// mean light of the room. Largest first.
///
/// `sides` is the light with all lamps and the sun that are known; `shines` marks the surfels of
/// these. What lies beside one of them, or beside anything burnt out, is left out: the light there
/// is not known well enough. What faces up is, too, unless it is a small part of a lamp: a patch of
/// sun lies there.
std::vector<Glowing> findGlowing(const Surfels& surfels, const SurfelRadiance& radiance,
                                 const LitSides& sides, std::span<const uint8_t> shines);

/// Lets all of these shine among `found`, once they count as burnt out in `radiance`: as they show.
/// Where the light of the room asked for clearly more, a camera has mapped tones, and it is that.
void addGlowing(std::span<const Glowing> glowing, const SurfelRadiance& radiance,
                FoundLamps& found);

} // namespace relamp
