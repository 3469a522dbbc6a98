#include "fit/correction_map.h"

#include "base/fail.h"

#include <algorithm>
#include <cmath>

namespace relamp
{
namespace
{

uint8_t byteOf(float share)
{
    const float byte = std::round(share * float{CorrectionMap::kAll});
    return static_cast<uint8_t>(std::clamp(byte, 0.0f, 255.0f));
}

bool isOfSize(const CorrectionMap& map, const Page& page)
{
    return map.width == page.image.width && map.height == page.image.height &&
           map.share.size() == page.image.pixels();
}

template<class Visit>
void forEachTexelOfRun(const PageTexels& page, size_t run, const Visit& visit)
{
    for (size_t i = page.runs[run].begin; i < page.runs[run + 1].begin; ++i) visit(page.pixel[i]);
}

} // namespace

CorrectionMap correctionMapOf(const Texels& texels, size_t page, std::span<const float> lit)
{
    if (lit.empty()) return {};
    const Image& image = texels.scan->pages[page].image;
    CorrectionMap map{image.width, image.height, std::vector<uint8_t>(image.pixels())};
    const PageTexels& covered = texels.pages[page];
    for (size_t run = 0; run + 1 < covered.runs.size(); ++run) {
        const uint8_t byte = byteOf(lit[covered.runs[run].surfel]);
        forEachTexelOfRun(covered, run, [&](uint32_t pixel) { map.share[pixel] = byte; });
    }
    return map;
}

std::vector<float> correctionBy(std::span<const CorrectionMap> maps, const Texels& texels,
                                const std::filesystem::path& folder)
{
    if (maps.empty() || std::ranges::any_of(maps, &CorrectionMap::isEmpty)) return {};
    if (!std::ranges::equal(maps, texels.scan->pages, isOfSize))
        fail(ErrorCode::sizeMismatch,
             folder.empty() ? "the room" : (folder / "correction*.png").string(),
             "the map of corrections has another size than the room's texture, so it belongs to "
             "another scan; let relamp delight write the folder anew, with --force");
    std::vector<float> sum(texels.surfels.count());
    std::vector<float> count(texels.surfels.count());
    for (size_t p = 0; p < maps.size(); ++p) {
        const PageTexels& page = texels.pages[p];
        for (size_t run = 0; run + 1 < page.runs.size(); ++run)
            forEachTexelOfRun(page, run, [&](uint32_t pixel) {
                sum[page.runs[run].surfel] += static_cast<float>(maps[p].share[pixel]);
                count[page.runs[run].surfel] += float{CorrectionMap::kAll};
            });
    }
    for (size_t s = 0; s < sum.size(); ++s) sum[s] = count[s] > 0.0f ? sum[s] / count[s] : 1.0f;
    return sum;
}

} // namespace relamp
