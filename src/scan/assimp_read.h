#pragma once

#include "relamp/scan.h"

#include <cstddef>
#include <span>

namespace relamp
{

/// Reads OBJ and the other formats that Assimp knows. `bytes` is the content of `file`.
Scan readWithAssimp(std::span<const std::byte> bytes, const std::filesystem::path& file,
                    const ScanOptions& options, Progress& progress);

} // namespace relamp
