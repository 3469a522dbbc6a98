#pragma once

#include <string>

namespace relamp::golden
{

inline const std::string kSampleScan = RELAMP_SAMPLES "/bedroom/scan.glb";

} // namespace relamp::golden
