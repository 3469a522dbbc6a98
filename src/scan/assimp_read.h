#pragma once

#include "relamp/scan.h"

namespace relamp
{

/// Reads OBJ, PLY and the other formats that Assimp knows.
Scan readWithAssimp(const std::filesystem::path& file, const ScanOptions& options,
                    Progress& progress);

} // namespace relamp
