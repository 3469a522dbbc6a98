#include "lights/lamp_surface.h"

#include "base/radiometry.shared.h"

#include <algorithm>
#include <utility>

namespace relamp
{
namespace
{

constexpr int32_t kNoLamp = -1;

std::vector<int32_t> lampOfSurfels(std::span<const Shiner> lamps, size_t surfels)
{
    std::vector<int32_t> lampOf(surfels, kNoLamp);
    for (size_t l = 0; l < lamps.size(); ++l)
        for (const ClippedPatch& patch : lamps[l].patches)
            if (patch.surfel != Surfels::kNone) lampOf[patch.surfel] = static_cast<int32_t>(l);
    return lampOf;
}

/// Burnt-out texels of one run of a page.
void addRun(const Texels& texels, size_t p, size_t run, const std::vector<bool>& isClipped,
            glm::vec3 radiance, std::vector<LampTexel>& out)
{
    const PageTexels& page = texels.pages[p];
    const TexelLoader loader(texels, p);
    TexelBlock block;
    forEachBlockOfRun(page, run, [&](size_t begin, size_t count) {
        loader.loadGeometry(begin, count, block);
        loader.loadArea(begin, count, block);
        for (size_t i = 0; i < count; ++i)
            if (isClipped[page.pixel[begin + i]])
                out.push_back({{block.x[i], block.y[i], block.z[i]},
                               {block.nx[i], block.ny[i], block.nz[i]},
                               block.area[i],
                               radiance});
    });
}

} // namespace

std::vector<LampTexel> lampTexels(const Texels& texels, const SurfelRadiance& radiance,
                                  std::span<const Shiner> lamps)
{
    const std::vector<int32_t> lampOf = lampOfSurfels(lamps, texels.surfels.count());
    std::vector<LampTexel> found;
    for (size_t p = 0; p < texels.pages.size(); ++p)
        for (size_t run = 0; run + 1 < texels.pages[p].runs.size(); ++run) {
            const int32_t lamp = lampOf[texels.pages[p].runs[run].surfel];
            if (lamp == kNoLamp) continue;
            addRun(texels, p, run, radiance.isClipped[p], lamps[static_cast<size_t>(lamp)].radiance,
                   found);
        }
    for (const Shiner& lamp : lamps)
        for (const ClippedPatch& patch : lamp.patches)
            if (patch.surfel == Surfels::kNone)
                found.push_back({patch.position, patch.normal, patch.area, lamp.radiance, false});
    return found;
}

LampSurface::LampSurface(std::vector<LampTexel> texels) : texels_(std::move(texels))
{
    double power = 0.0; // a float would stop growing at the hundred thousandth texel
    for (const LampTexel& texel : texels_) {
        power += static_cast<double>(texel.area * luminance(texel.radiance));
        powerUpTo_.push_back(static_cast<float>(power));
    }
}

LampSurface::Choice LampSurface::at(float share) const
{
    const float power = powerUpTo_.back();
    // A dark texel adds no power: the first to go beyond a share is never one.
    const auto found = std::upper_bound(powerUpTo_.begin(), powerUpTo_.end(), share * power);
    const auto index =
        std::min(static_cast<size_t>(found - powerUpTo_.begin()), texels_.size() - 1);
    return {texels_[index], 1.0f / density(texels_[index].radiance)};
}

float LampSurface::density(glm::vec3 radiance) const
{
    return luminance(radiance) / powerUpTo_.back();
}

} // namespace relamp
