#pragma once

#include <cstdint>

namespace relamp
{

/// How much the path tracing reference spends. Its lamps are found under GatherOptions.
struct PathtraceOptions
{
    int samples = 64;  // paths from every texel, 1..65536; noise falls with their square root
    uint32_t seed = 1; // of the random numbers; the same seed gives the same result

    bool operator==(const PathtraceOptions&) const = default;
};

} // namespace relamp
