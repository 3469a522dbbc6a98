#pragma once

#include "relamp/delight.h"

#include <cstddef>
#include <filesystem>
#include <vector>

namespace relamp
{

/// The correction PNGs of a result's folder, one map a page of its scan; empty where it has none.
/// Throws Error(cannotRead | malformed).
std::vector<CorrectionMap> readCorrection(const std::filesystem::path& folder, size_t pages);

} // namespace relamp
