#include "scan/large_scan.h"

#include "base/spill.h"

#include <cstdlib>
#include <variant>

namespace relamp
{

uint64_t pixelsInMemory()
{
    constexpr uint64_t kUsual = uint64_t{1} << 26;
    const char* wish = std::getenv("RELAMP_PIXELS_IN_MEMORY");
    if (wish == nullptr) return kUsual;
    char* end = nullptr;
    const uint64_t wished = std::strtoull(wish, &end, 10);
    return end != wish && *end == '\0' ? wished : kUsual;
}

uint64_t pixelsOf(const Scan& scan)
{
    uint64_t pixels = 0;
    for (const Page& page : scan.pages) pixels += page.image.pixels();
    return pixels;
}

bool isLarge(const Scan& scan)
{
    return pixelsOf(scan) > pixelsInMemory();
}

bool spillPage(const Page& page)
{
    return std::visit([](const auto& rgb) { return spill(rgb); }, page.image.rgb);
}

void willNeed(const Page& page)
{
    std::visit([](const auto& rgb) { willNeed(rgb); }, page.image.rgb);
}

void letGo(const Page& page)
{
    std::visit([](const auto& rgb) { letGo(rgb); }, page.image.rgb);
}

} // namespace relamp
