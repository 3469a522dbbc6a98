#pragma once

#include "base/sparse_blocks.h"
#include "shading/area_direct.h"

namespace relamp
{

/// What numbered places see of one lamp.
using LampSight = SparseBlocks<AreaSample>;

} // namespace relamp
