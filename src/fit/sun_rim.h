#pragma once

#include "fit/light_model.h"
#include "lights/surfel_radiance.h"
#include "scan/texels.h"
#include "shading/lamp_sight.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relamp
{

/// Where the light of a sun must end: surfels that it reaches, each with one of the same plane and
/// colour close by that it does not. All that lights a room else is much the same at both.
class SunRim
{
public:
    /// `onSides`: what each hit list sees of the sun, those of fronts first.
    SunRim(const Texels& texels, const SurfelRadiance& radiance, const LampSight& onSides);

    /// Surfels of the rim, each once.
    [[nodiscard]] std::span<const uint32_t> surfels() const { return surfels_; }
    /// `perCell` pairs, lit and dark, from each cell of the rim: what lies closer errs alike. They
    /// are indices into surfels(), plus `first`.
    [[nodiscard]] std::vector<MaterialPair> pairs(size_t perCell, uint32_t first) const;
    /// All pairs of surfels, lit and dark.
    [[nodiscard]] std::vector<MaterialPair> all() const;

private:
    std::vector<uint32_t> surfels_;
    std::vector<std::vector<MaterialPair>> cells_; // of surfels
};

} // namespace relamp
