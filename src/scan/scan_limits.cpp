#include "scan/scan_limits.h"

#include "base/fail.h"

#include <algorithm>

#include <fmt/format.h>

namespace relamp
{
namespace
{

constexpr uint64_t kMostPagePixels = uint64_t{1} << 32; // 64 pages of 8192 x 8192
// Two textures of 4096 x 4096 in one colour are no burden, however few their bytes. Of photos a
// byte holds some ten pixels, of a rendered room's flat colours thirty.
constexpr uint64_t kAnyPagesMayHave = uint64_t{1} << 25;
constexpr uint64_t kMostPixelsOfByte = 64;

} // namespace

PagePixels::PagePixels(size_t pages, uint64_t bytes, const std::string& file)
    : file_(file), most_(std::min(kMostPagePixels, kAnyPagesMayHave + kMostPixelsOfByte * bytes))
{
    if (pages > kMostPages)
        malformed(file, fmt::format("has {} textures, and relamp works on {} at most; put them "
                                    "together in an atlas",
                                    pages, kMostPages));
    if (pages == 1) most_ = kMostPagePixels; // readImage() has an eye on each
}

uint64_t PagePixels::add(size_t pixels)
{
    const uint64_t sum = sum_ += pixels;
    if (sum > most_)
        malformed(file_, fmt::format("its textures have more than {} million pixels together, "
                                     "more than relamp works on in files of their size; scale "
                                     "them down",
                                     most_ / 1'000'000));
    return sum;
}

void checkCounts(const Scan& scan, const std::string& file)
{
    if (scan.triangleCount() > kMostTriangles)
        malformed(file, fmt::format("has more than {} triangles, more than relamp works on; "
                                    "simplify it",
                                    kMostTriangles));
    if (scan.meshes.size() > kMostMeshes)
        malformed(file, fmt::format("has more than {} meshes, more than relamp works on; join them",
                                    kMostMeshes));
}

void shortenWarnings(std::vector<std::string>& warnings)
{
    if (warnings.size() <= kMostWarnings) return;
    const size_t more = warnings.size() - kMostWarnings;
    warnings.resize(kMostWarnings);
    warnings.push_back(fmt::format("and {} more such notes on the scan", more));
}

} // namespace relamp
