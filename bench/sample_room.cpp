#include "sample_room.h"

#include "scan/texels.h"

#include <algorithm>
#include <cmath>

namespace relamp::bench
{
namespace
{

Image scaled(const Image& image, double factor)
{
    Image result = image;
    result.width = static_cast<int>(std::lround(factor * image.width));
    result.height = static_cast<int>(std::lround(factor * image.height));
    std::vector<uint8_t> rgb(3 * result.pixels());
    const std::vector<uint8_t>& before = image.encoded();
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x) {
            const int fromX = std::min(static_cast<int>(x / factor), image.width - 1);
            const int fromY = std::min(static_cast<int>(y / factor), image.height - 1);
            const auto from = static_cast<size_t>(fromY * image.width + fromX);
            const auto to = static_cast<size_t>(y * result.width + x);
            std::copy_n(&before[3 * from], 3, &rgb[3 * to]);
        }
    result.rgb = std::move(rgb);
    return result;
}

} // namespace

Scan sampleRoom(size_t texels)
{
    Progress progress;
    Scan scan = readScan(RELAMP_SAMPLES "/bedroom/scan.glb", {}, progress);
    const auto covered = static_cast<double>(rasterizeAtlas(scan, progress).count());
    Image& image = scan.pages.at(0).image;
    image = scaled(image, std::sqrt(static_cast<double>(texels) / covered));
    return scan;
}

} // namespace relamp::bench
