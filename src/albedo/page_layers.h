#pragma once

#include "fit/reliability.h"
#include "lights/shining.h"
#include "relamp/delight.h"
#include "scan/texels.h"
#include "shading/enclosed_texels.h"
#include "shading/tempering.h"
#include "shading/texel_shading.h"

#include <functional>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// What a solver says of the texels.
struct SolvedTexels
{
    TexelShading shade;    // refers to the texels and the scene that were solved
    std::vector<Rim> rims; // of surfels, for the enclosed ones; or none
    Tempering tempering;   // of the shading, rims included
    Shining shining;
    std::vector<SurfelTrust> trust; // in the shading of surfels; empty: full
    std::vector<glm::vec3> fill;    // albedo of surfels, for what is burnt out or in doubt; or none
    std::vector<float> doubt;       // variance of the logarithm of their light; empty: none
    Linearization linearization;    // of the texture, which `shade` explains
};

/// The layers of a page as a device makes them of what a solver says; none where it gave up and the
/// CPU has to.
using DeviceLayers = std::function<std::optional<PageLayers>(
    size_t page, const SolvedTexels& solved, const AlbedoOptions& options, Progress& progress)>;

/// Shades, divides and rates all texels of a page; those that shine go to `emission`.
PageLayers makeLayers(const Texels& texels, size_t page, const SolvedTexels& solved,
                      const AlbedoOptions& options, Progress& progress);

} // namespace relamp
