#pragma once

#include "output/folder_record.h"
#include "relamp/gather.h"
#include "relamp/image.h"
#include "relamp/lights.h"
#include "relamp/progress.h"
#include "relamp/result.h"
#include "relamp/scan.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace relamp
{

inline constexpr const char* kReport = "report.json";

/// "albedo.exr", or "albedo.2.exr" where there are several pages.
std::string nameOfLayer(const char* layer, size_t page, size_t pages, const char* ending);

/// Whether writeResult may write a file of that name, of a scan called `scan` with any number of
/// pages.
bool isOfResult(const std::string& name, const std::string& scan,
                const ResultOptions& options = {});

/// What report.json says of how a result was made.
struct FormerRun
{
    std::filesystem::path scanFile; // from here; where it lay when the result was made
    FileMark scanMark;
    ScanOptions scan;
    bool isGltf = false;  // whether the scan was a glTF, whose frame its GLB has
    GatherOptions gather; // as far as the solver had any
    size_t triangles = 0;
};

/// Throws Error(cannotRead | malformed) where `folder` holds no report.json that writeResult wrote.
FormerRun readFormerRun(const std::filesystem::path& folder);

/// Where the scan of a result is: `now`, or where it was where that is empty. Throws Error with a
/// sentence where it is not there or is another file than it was; the files that a glTF or OBJ
/// names are not looked at.
std::filesystem::path findScan(const std::filesystem::path& folder, const FormerRun& run,
                               const std::filesystem::path& now);

/// The scan that a result was made from, read from `file` as it was read then. Throws Error with a
/// sentence where it is another one.
Scan scanOf(const std::filesystem::path& folder, const FormerRun& run,
            const std::filesystem::path& file, Progress& progress);

/// The room of a result, geometry and layout of the textures as the scan had them, from its own
/// GLB. Throws Error with a sentence where that is gone or changed.
Scan roomOf(const std::filesystem::path& folder, const FormerRun& run, Progress& progress);

/// The albedo of a result, one image a page of the scan that it was made from. Throws
/// Error(cannotRead | malformed), and Error(sizeMismatch) where a page has another size.
std::vector<Image> readAlbedo(const std::filesystem::path& folder, const Scan& scan);

} // namespace relamp
