#pragma once

#include "relight/transport.h"
#include "scan/surfels.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace relamp
{

/// The sides of a transport, some dozen of one place and orientation together.
struct WebClusters
{
    float size = 0.0f; // m, of the cells that they are joined in
    size_t count = 0;
    size_t fronts = 0;             // of them; the first
    std::vector<uint32_t> ofSide;  // a side of the transport each
    std::vector<float> weight;     // the same: its share of its cluster as others see it; sums to 1
    std::vector<uint32_t> first;   // of clusters, and one more: where in `members` theirs begin
    std::vector<uint32_t> members; // sides
};

/// As many as a page can take, or fewer: 2048.
WebClusters webClusters(const Transport& transport, const Surfels& surfels);

} // namespace relamp
