#include "relight/room_albedo.h"

#include "albedo/fill.h"
#include "shading/buried.h"

#include <glm/common.hpp>

namespace relamp
{
namespace
{

constexpr float kEnough = 0.1f; // share of a surfel's area that tells its albedo

struct Sum
{
    glm::vec3 albedo{0.0f};
    float area = 0.0f;
};

} // namespace

RoomAlbedo::RoomAlbedo(const Texels& texels, std::span<const Image> albedo,
                       std::span<const Image> confidence)
    : confidence_(confidence)
{
    for (const Image& page : albedo) albedo_.emplace_back(page);
    std::vector<Sum> sums(texels.surfels.count());
    const std::vector<uint8_t> isBuried = buriedSurfels(texels);
    for (size_t p = 0; p < texels.pages.size(); ++p) {
        const PageTexels& page = texels.pages[p];
        const TexelLoader loader(texels, p);
        const std::span<const uint8_t> buried =
            texels.buried.empty() ? std::span<const uint8_t>() : texels.buried[p];
        forEachRun(page, [&](size_t run, TexelBlock& block) {
            const uint32_t surfel = page.runs[run].surfel;
            Sum& sum = sums[surfel]; // one run a surfel and page
            const bool isMixed = !texels.buried.empty() && isBuried[surfel] == 0;
            forEachBlockOfRun(page, run, [&](size_t begin, size_t count) {
                loader.loadArea(begin, count, block);
                for (size_t i = 0; i < count; ++i) {
                    const uint32_t pixel = page.pixel[begin + i];
                    if (!isKnown(p, pixel) || (isMixed && buried[begin + i] != 0)) continue;
                    sum.albedo += block.area[i] * glm::min(albedo_[p][pixel], 1.0f);
                    sum.area += block.area[i];
                }
            });
        });
    }
    std::vector<uint8_t> isTold(sums.size());
    ofSurfels_.resize(sums.size());
    for (size_t s = 0; s < sums.size(); ++s) {
        if (sums[s].area > 0.0f) ofSurfels_[s] = sums[s].albedo / sums[s].area;
        isTold[s] = sums[s].area > kEnough * texels.surfels.area[s] ? 1 : 0;
    }
    if (!confidence.empty()) ofSurfels_ = fillFromAround(texels.surfels, ofSurfels_, isTold);
}

bool RoomAlbedo::isKnown(size_t page, uint32_t pixel) const
{
    return confidence_.empty() || confidence_[page].encoded[3 * size_t{pixel}] > 0;
}

glm::vec3 RoomAlbedo::ofTexel(size_t page, uint32_t pixel, uint32_t surfel) const
{
    return isKnown(page, pixel) ? glm::min(albedo_[page][pixel], 1.0f) : ofSurfels_[surfel];
}

} // namespace relamp
