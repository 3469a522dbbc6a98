#pragma once

#include "relamp/delight.h"
#include "scenes/apart.h"

#include <cstdint>
#include <vector>

namespace relamp::scenes
{

/// Of two layers in halves.
Apart apart(const std::vector<uint16_t>& ofGpu, const std::vector<uint16_t>& ofCpu);

/// Fails where the engines are further apart than Delighter::reevaluate() says, where another texel
/// shines, or where confidence is more than 3 of 255 apart for more than two texels in a thousand.
void expectAlike(const PageLayers& ofGpu, const PageLayers& ofCpu);

} // namespace relamp::scenes
