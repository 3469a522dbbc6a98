#pragma once

#include "relamp/scan.h"

#include <cstddef>
#include <functional>

namespace relamp
{

/// By how much the sides of a page are divided so that none is longer than `longestSide`, >= 1: a
/// power of two; 1 of a page of vertices.
int coarseFactor(const Page& page, int longestSide);

/// What coarsened() makes of a scan that is needed as it is, too; large pictures are not held
/// twice. Meshes and pages alone: it cannot be written again. `seen`, if there is one, is told when
/// a page was read.
Scan coarseCopyOf(const Scan& scan, int longestSide,
                  const std::function<void(size_t page)>& seen = {});

} // namespace relamp
