#pragma once

#include "relamp/api.h"
#include "relamp/progress.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

struct VerifyOptions
{
    int samples = 64;           // paths from every place, 2..65536
    int places = 20000;         // texels that are looked at, >= 1; evenly over the scan
    uint32_t seed = 1;          // of the random numbers
    std::filesystem::path scan; // where the scan is now; empty: as far from the result as it was
    bool allowOutside = false;  // as ScanOptions has it; no report can say it
};

/// Places of about the same shading, by what the result says it is.
struct VerifiedBin
{
    float shading = 0.0f;  // mean luminance of radiance / albedo
    float ratio = 0.0f;    // luminance of what was rendered over that of the scan
    float rmsError = 0.0f; // radiance
};

/// How well albedo and lights of a result give the scan again.
struct Verification
{
    std::filesystem::path scanFile;
    std::vector<std::string> fixtures; // names of those that shone
    size_t places = 0;                 // that were compared: texels that are not burnt out
    float rmsError = 0.0f;       // radiance, 1 = the texture's white; the paths' noise taken off,
                                 // and no less than that could hide
    float standardError = 0.0f;  // of rmsError, by the scatter of the places
    float rmsOfScan = 0.0f;      // of the texture there, to compare with
    float asWhiteAsPaper = 0.0f; // share of the area whose albedo is 0.87: there light may lack
    float rmsErrorElsewhere = 0.0f; // rmsError without these places
    float psnr = 0.0f;              // dB, peak 1; 120 where the error is nothing
    glm::vec3 ratio{0.0f};          // of what was rendered over the scan, means of each channel
    std::vector<VerifiedBin> bins;  // five, of equal area, from dark to bright
    std::vector<std::string> warnings;
};

/// Renders what writeResult left in `folder`, the albedo under the lights of lights.json, with
/// every bounce simulated, and compares it with the scan.
///
/// Nothing is searched, and nothing of the scan's light is used for that but which texels are burnt
/// out; where the lamps' surface is, the folder's fixtures.png says, and correction.png how much of
/// the light is there. All figures are weighted by area. The same seed gives the same figures on
/// any number of threads.
///
/// Throws Error with a sentence where the folder or the scan is missing, or the scan is another
/// file than it was.
RELAMP_API Verification verify(const std::filesystem::path& folder,
                               const VerifyOptions& options = {}, Progress& progress = unwatched());

} // namespace relamp
