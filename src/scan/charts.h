#pragma once

#include "scan/surface_point.h"
#include "scan/texels.h"

#include <cstdint>
#include <vector>

namespace relamp
{

/// The chart of every triangle, in the order of the scan's meshes: triangles of one page that share
/// texture coordinates are of one chart. Charts are numbered from 0, page by page; triangles on a
/// page of vertices have none and get kNoChart.
constexpr uint32_t kNoChart = ~0u;
std::vector<uint32_t> chartsOfTriangles(const Scan& scan);

/// Which chart every texel belongs to, so that what is looked up between texels stays in its own.
class Charts
{
public:
    explicit Charts(const Texels& texels);

    /// Takes the weight of pixels off that do not belong to the chart of `triangle`, unless none
    /// does: a chart smaller than a texel.
    void keepToChart(uint32_t triangle, PixelMix& mix) const;

private:
    using Mark = uint16_t; // of a chart; two of 65535 may share one

    std::vector<Mark> ofTriangle_;
    std::vector<std::vector<Mark>> ofPixel_; // 0 where no surface is; a page each
};

} // namespace relamp
