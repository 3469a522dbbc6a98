#pragma once

#include "relamp/gather.h"
#include "relamp/image.h"
#include "relamp/lights.h"
#include "relamp/progress.h"
#include "relamp/scan.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace relamp
{

/// "albedo.exr", or "albedo.2.exr" where there are several pages.
std::string nameOfLayer(const char* layer, size_t page, size_t pages, const char* ending);

/// What report.json says of how a result was made.
struct FormerRun
{
    std::filesystem::path scanFile; // as it was given
    ScanOptions scan;
    GatherOptions gather; // as far as the solver had any
    size_t triangles = 0;
};

/// Throws Error(cannotRead | malformed) where `folder` holds no report.json that writeResult wrote.
FormerRun readFormerRun(const std::filesystem::path& folder);

/// The scan that a result was made from, read from `file` as it was read then. Throws Error with a
/// sentence where it is not there or is another one.
Scan scanOf(const std::filesystem::path& folder, const FormerRun& run,
            const std::filesystem::path& file, Progress& progress);

/// The albedo of a result, one image a page of the scan that it was made from. Throws
/// Error(cannotRead | malformed), and Error(sizeMismatch) where a page has another size.
std::vector<Image> readAlbedo(const std::filesystem::path& folder, const Scan& scan);

} // namespace relamp
