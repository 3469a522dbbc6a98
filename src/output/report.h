#pragma once

#include "output/folder_record.h"
#include "relamp/delight.h"
#include "relamp/progress.h"

#include <array>
#include <filesystem>
#include <string>

namespace relamp
{

/// What only the writer of a result knows.
struct Written
{
    std::filesystem::path scanFile;
    std::filesystem::path folder;       // where the result will be
    FolderRecord files;                 // all that was written
    std::array<double, kDoubts> area{}; // m^2 of surface by Doubt
};

/// The text of report.json: what was read, the options in force, the seconds of every stage, the
/// lights, how well the loop closes, how even places of one paint are, how much can be believed,
/// warnings, what was written.
std::string reportAsJson(const Decomposition& decomposition, const Written& written,
                         const Progress& progress);

} // namespace relamp
