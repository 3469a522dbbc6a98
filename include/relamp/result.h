#pragma once

#include "relamp/api.h"
#include "relamp/delight.h"
#include "relamp/progress.h"
#include "relamp/replacing.h"

#include <filesystem>
#include <string>

namespace relamp
{

/// What writeResult writes besides.
struct ResultOptions
{
    bool usd = false; // `<scan>.usda`, the room for programs that read USD, and of what shines
                      // emission EXR
};

/// Throws Error(cannotWrite) where writeResult could not write into `folder`, or would overwrite
/// `scanFile` with its `<scan>.glb`, or what it may not replace. Worth asking before work that
/// takes long.
RELAMP_API void checkOutput(const std::filesystem::path& scanFile,
                            const std::filesystem::path& folder,
                            Replacing replacing = Replacing::unchanged,
                            const ResultOptions& options = {});

/// Writes all that delight found into `folder`, whole or not at all: `<scan>.glb`, albedo, shading,
/// direct and indirect EXR, albedo, confidence, reasons and fixtures PNG, lights.json, preview.png
/// and report.json, as docs/guide/results.md describes them. What a former run wrote there is
/// replaced, file by file once all are complete and report.json last; other files stay.
///
/// `scanFile` is named in the report, by the way from `folder` and a checksum. Returns the report's
/// text. Throws Error(cannotWrite | cancelled).
RELAMP_API std::string
writeResult(const Decomposition& decomposition, const std::filesystem::path& scanFile,
            const std::filesystem::path& folder, Progress& progress = unwatched(),
            Replacing replacing = Replacing::unchanged, const ResultOptions& options = {});

/// Whose the texels of a scan are by the fixtures.png beside a lights file, one map a page, for
/// DelightOptions::fixtures. Empty where `lights` does not lie in the folder of a result of this
/// very scan. Throws Error(malformed) where a map is not as it must be.
RELAMP_API std::vector<FixtureMap> readFixturesBeside(const std::filesystem::path& lights,
                                                      const std::filesystem::path& scanFile,
                                                      const Scan& scan);

} // namespace relamp
