#include "shading/seen.h"

#include "base/parallel.h"

#include <glm/geometric.hpp>

namespace relamp
{

bool seesAll(const AreaSample& sample)
{
    constexpr float kAllOfIt = 0.999f; // but for rounding
    return sample.visible >= kAllOfIt * sample.open;
}

std::vector<Seen> seenBySurfels(const Surfels& surfels, const LampSight& coarse)
{
    std::vector<Seen> own(surfels.count(), Seen::none);
    for (size_t s = 0; s < own.size(); ++s)
        if (const AreaSample seen = coarse[s]; seen.visible > 0.0f)
            own[s] = seesAll(seen) ? Seen::all : Seen::some;
    std::vector<Seen> seen = own;
    forEachChunk(own.size(), 1024, [&](size_t begin, size_t end) {
        for (size_t s = begin; s < end; ++s)
            for (const uint32_t n : surfels.neighborsOf(s))
                if (own[n] != own[s] && surfels.areBeside(s, n)) seen[s] = Seen::some;
    });
    return seen;
}

} // namespace relamp
