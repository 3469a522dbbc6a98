#pragma once

#include "shading/enclosed_texels.h"
#include "shading/gathered_light.h"
#include "solve/cross_validation.h"
#include "solve/found_room.h"
#include "solve/reevaluate.h"
#include "solve/solution.h"

#include <vector>

namespace relamp
{

/// How well its light explains the scan.
Closure closureOf(const SolvedRoom& room);

/// A room whose light is found, and how a solver shades it by that.
struct ShadedRoom
{
    const FoundRoom& found;
    const Witnesses& witnesses;
    const SurfelLighting& lighting;
    TexelShading shade;
    std::vector<float> lit{}; // correctionOf() surfels, which `shade` has; empty: none was made
    std::vector<Rim> rims{};  // of surfels; empty: none has one
};

/// What such a room comes to. `asked`: the options that it was solved with.
Solution solutionOf(const Texels& texels, ShadedRoom room, const DelightOptions& asked,
                    const Closure& closure);
/// The same of the gather solver's.
Solution solutionOf(const Texels& texels, const SolvedRoom& room, const DelightOptions& asked,
                    const Closure& closure);

} // namespace relamp
