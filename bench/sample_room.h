#pragma once

#include "relamp/scan.h"

#include <cstddef>

namespace relamp::bench
{

/// The sample bedroom with its texture scaled so that about `texels` of it are covered.
Scan sampleRoom(size_t texels);

} // namespace relamp::bench
