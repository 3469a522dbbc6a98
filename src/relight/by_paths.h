#pragma once

#include "relight/relighter_state.h"
#include "shading/texel_shading.h"

namespace relamp
{

/// Relights by path tracing, the slow reference. Refers to the state, and to the light that is set
/// in it.
TexelShading shadingByPaths(const Relighter::State& state);

} // namespace relamp
