#pragma once

#include <filesystem>
#include <string>

namespace relamp::golden
{

inline const std::string kSampleScan = RELAMP_SAMPLES "/bedroom/scan.glb";
inline const std::filesystem::path kSampleRoom = RELAMP_SAMPLES "/bedroom"; // its truth

} // namespace relamp::golden
