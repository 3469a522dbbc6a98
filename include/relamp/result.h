#pragma once

#include "relamp/api.h"
#include "relamp/delight.h"
#include "relamp/progress.h"
#include "relamp/replacing.h"

#include <filesystem>
#include <string>

namespace relamp
{

/// Throws Error(cannotWrite) where writeResult could not write into `folder`, or would overwrite
/// `scanFile` with its `<scan>.glb`, or what it may not replace. Worth asking before work that
/// takes long.
RELAMP_API void checkOutput(const std::filesystem::path& scanFile,
                            const std::filesystem::path& folder,
                            Replacing replacing = Replacing::unchanged);

/// Writes all that delight found into `folder`, whole or not at all: `<scan>.glb`, albedo, shading,
/// direct and indirect EXR, albedo, confidence and reasons PNG, lights.json, preview.png and
/// report.json, as docs/guide/results.md describes them. What a former run wrote there is replaced,
/// file by file once all are complete and report.json last; other files stay.
///
/// `scanFile` is named in the report, by the way from `folder` and a checksum. Returns the report's
/// text. Throws Error(cannotWrite | cancelled).
RELAMP_API std::string writeResult(const Decomposition& decomposition,
                                   const std::filesystem::path& scanFile,
                                   const std::filesystem::path& folder,
                                   Progress& progress = unwatched(),
                                   Replacing replacing = Replacing::unchanged);

} // namespace relamp
