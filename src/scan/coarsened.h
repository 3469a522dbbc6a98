#pragma once

#include "relamp/scan.h"

namespace relamp
{

/// What coarsened() makes of a scan that is needed as it is, too; large pictures are not held
/// twice. Meshes and pages alone: it cannot be written again.
Scan coarseCopyOf(const Scan& scan, int longestSide);

} // namespace relamp
