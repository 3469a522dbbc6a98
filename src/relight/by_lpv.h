#pragma once

#include "relight/relighter_state.h"
#include "shading/texel_shading.h"

#include <string>
#include <vector>

namespace relamp
{

/// Relights as the thesis does: lights without shadows, one bounce by reflective shadow maps and a
/// light propagation volume, the sky as ambient light. A sun needs shadows and is left out, which
/// `warnings` says.
TexelShading shadingByLpv(const Relighter::State& state, std::vector<std::string>& warnings,
                          Progress& progress);

} // namespace relamp
