#include "relight/room_albedo.h"

#include "albedo/fill.h"

#include <glm/common.hpp>

namespace relamp
{
namespace
{

constexpr float kEnough = 0.1f; // share of a surfel's area that tells its albedo

} // namespace

/// Albedo of texels of one surfel.
struct RoomAlbedo::Sum
{
    glm::vec3 albedo{0.0f}; // times area
    float area = 0.0f;

    void add(glm::vec3 ofTexel, float areaOfTexel)
    {
        albedo += areaOfTexel * ofTexel;
        area += areaOfTexel;
    }
    [[nodiscard]] glm::vec3 mean() const { return area > 0.0f ? albedo / area : glm::vec3(0.0f); }
};

RoomAlbedo::RoomAlbedo(const Texels& texels, std::span<const Image> albedo,
                       std::span<const Image> confidence,
                       std::span<const std::vector<bool>> isBurntOut)
    : isBurntOut_(isBurntOut)
{
    for (const Image& page : confidence) confidence_.emplace_back(page);
    for (const Image& page : albedo) albedo_.emplace_back(page);
    std::vector<Sum> known(texels.surfels.count());
    std::vector<Sum> burntOut(texels.surfels.count());
    for (size_t p = 0; p < texels.pages.size(); ++p) {
        const PageTexels& page = texels.pages[p];
        const TexelLoader loader(texels, p);
        forEachRun(page, [&](size_t run, TexelBlock& block) {
            const uint32_t surfel = page.runs[run].surfel; // one run a surfel and page
            forEachBlockOfRun(page, run, [&](size_t begin, size_t count) {
                loader.loadArea(begin, count, block);
                for (size_t i = 0; i < count; ++i) {
                    const uint32_t pixel = page.pixel[begin + i];
                    if (isKnown(p, pixel))
                        known[surfel].add(ownOf(p, pixel), block.area[i]);
                    else if (isBurntOut_[p][pixel])
                        burntOut[surfel].add(ownOf(p, pixel), block.area[i]);
                }
            });
        });
    }
    join(texels.surfels, known, burntOut);
}

void RoomAlbedo::join(const Surfels& surfels, std::span<const Sum> known,
                      std::span<const Sum> burntOut)
{
    around_.resize(known.size());
    for (size_t s = 0; s < known.size(); ++s) around_[s] = known[s].mean();
    if (!confidence_.empty()) {
        std::vector<uint8_t> isTold(known.size());
        for (size_t s = 0; s < known.size(); ++s)
            isTold[s] = known[s].area > kEnough * surfels.area[s] ? 1 : 0;
        around_ = fillFromAround(surfels, around_, isTold);
    }
    ofSurfels_ = around_;
    for (size_t s = 0; s < known.size(); ++s) {
        if (burntOut[s].area <= 0.0f) continue;
        Sum both = known[s];
        both.add(glm::max(burntOut[s].mean(), around_[s]), burntOut[s].area);
        ofSurfels_[s] = both.mean();
    }
}

bool RoomAlbedo::isKnown(size_t page, uint32_t pixel) const
{
    return confidence_.empty() || confidence_[page][pixel].r > 0.0f;
}

glm::vec3 RoomAlbedo::ownOf(size_t page, uint32_t pixel) const
{
    return glm::min(albedo_[page][pixel], 1.0f);
}

glm::vec3 RoomAlbedo::ofTexel(size_t page, uint32_t pixel, uint32_t surfel) const
{
    if (isKnown(page, pixel)) return ownOf(page, pixel);
    // What is burnt out was at least as bright as white: its albedo is the least that it can be.
    if (isBurntOut_[page][pixel]) return glm::max(ownOf(page, pixel), around_[surfel]);
    return around_[surfel];
}

} // namespace relamp
