#pragma once

#include "relamp/delight.h"
#include "relamp/progress.h"
#include "relamp/scan.h"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace relamp
{

/// What only the writer of a result knows.
struct Written
{
    std::filesystem::path scanFile;
    std::vector<std::string> files;     // names of all that was written
    std::array<double, kDoubts> area{}; // m^2 of surface by Doubt
};

/// The text of report.json: what was read, the options in force, the seconds of every stage, the
/// lights, how well the loop closes, how much can be believed, warnings, what was written.
std::string reportAsJson(const Scan& scan, const Decomposition& decomposition,
                         const Written& written, const Progress& progress);

/// Names of the files that a former report in `folder` lists; none where there is no report.
std::vector<std::string> filesOfFormerReport(const std::filesystem::path& folder);

} // namespace relamp
