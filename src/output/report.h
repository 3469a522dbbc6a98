#pragma once

#include "relamp/delight.h"
#include "relamp/progress.h"
#include "relamp/scan.h"

#include <filesystem>
#include <string>
#include <vector>

namespace relamp
{

/// The text of report.json: what was read, the options in force, the seconds of every stage, the
/// lights, how well the loop closes, warnings, and `files`, the names of all that was written.
std::string reportAsJson(const Scan& scan, const Decomposition& decomposition,
                         const std::filesystem::path& scanFile,
                         const std::vector<std::string>& files, const Progress& progress);

/// Names of the files that a former report in `folder` lists; none where there is no report.
std::vector<std::string> filesOfFormerReport(const std::filesystem::path& folder);

} // namespace relamp
