#include "shading/lit_sides_gpu.h"

#include "shading/lit_sides.comp.h"
#include "shading/lit_sides.gpu.h"
#include "shading/lit_sides.shared.h"
#include "shading/lit_sides_excess.comp.h"
#include "shading/lit_sides_indirect.comp.h"
#include "shading/lit_sides_mean.comp.h"

#include <algorithm>

namespace relamp
{
namespace
{

std::vector<int32_t> backsOf(const HitLists& hits, size_t surfels)
{
    std::vector<int32_t> backs;
    for (size_t s = 0; s < surfels; ++s)
        backs.push_back(hits.listOfSide[2 * s + 1]); // HitLists::kNoList is -1 there, too
    return backs;
}

std::vector<glm::uvec2> burntOutOf(const SurfelRadiance& radiance)
{
    std::vector<glm::uvec2> burntOut;
    for (const glm::vec3 least : fieldOf(radiance).clipped)
        burntOut.push_back(packedHalves(glm::vec4(least, 0.0f)));
    return burntOut;
}

std::vector<glm::uvec2> whiteOf(const SurfelRadiance& radiance)
{
    std::vector<glm::uvec2> white;
    for (size_t s = 0; s < radiance.plain.size(); ++s)
        white.push_back(packedHalves(glm::vec4(radiance.whiteOf(s), 0.0f)));
    return white;
}

std::vector<uint32_t> traitsOf(const SurfelRadiance& radiance)
{
    std::vector<uint32_t> traits;
    for (size_t s = 0; s < radiance.plain.size(); ++s)
        traits.push_back(knowsItsAlbedo(radiance, s) ? kKnowsItsAlbedo : 0u);
    return traits;
}

/// Plain fronts alone.
std::vector<glm::uvec2> plainOf(const SurfelRadiance& radiance)
{
    RadianceField field = fieldOf(radiance);
    field.shines.assign(field.shines.size(), 1);
    return fieldOnGpu(field);
}

std::vector<float> litOf(std::span<const float> lit, size_t surfels)
{
    if (lit.empty()) return std::vector<float>(surfels, 1.0f);
    return {lit.begin(), lit.end()};
}

} // namespace

LitSidesGpu::LitSidesGpu(const gpu::Device& device, const HitLists& hits,
                         const SurfelRadiance& radiance, const SurfelTraits& traits)
    : surfels_(traits.shines.size()), knows_(traitsOf(radiance)),
      shown_(fieldOnGpu(fieldOf(radiance))), begin_(shown_), gather_(device),
      litSides_(device, kLitSidesSpirv), excess_(device, kLitSidesExcessSpirv),
      mean_(device, kLitSidesMeanSpirv), indirectOf_(device, kLitSidesIndirectSpirv),
      lists_(device, hits, surfels_), backOf_(device, backsOf(hits, surfels_)),
      burntOut_(device, burntOutOf(radiance)), white_(device, whiteOf(radiance)),
      traits_(device, surfels_), lit_(device, litOf(traits.lit, surfels_)),
      start_(device, shown_.size()), field_(device, shown_.size()), evenField_(device, shown_),
      settling_(device, hits, lists_, gather_, {device, plainOf(radiance)}),
      gathered_(device, lists_.count),
      even_(device, surfels_), work_{{device, surfels_}, {device, surfels_}},
      indirect_(device, surfels_)
{
    setShining(traits.shines);
}

void LitSidesGpu::setShining(std::span<const uint8_t> shines)
{
    std::vector<uint32_t> traits = knows_;
    std::copy_n(shown_.begin(), 3 * surfels_, begin_.begin());
    for (size_t s = 0; s < surfels_; ++s) {
        if (shines[s] == 0) continue;
        traits[s] |= kShines;
        begin_[surfels_ + s] = glm::uvec2(0); // of its burnt-out texels
    }
    traits_.upload(traits);
    start_.upload(begin_);
}

void LitSidesGpu::setOutside(const OutsideLight& outside)
{
    for (size_t part = 0; part < HitTarget::kMostParts; ++part)
        begin_[3 * surfels_ + part] = packedHalves(glm::vec4(outside[part], 0.0f));
    start_.upload(begin_);
    evenField_.upload(begin_); // what is not plain follows
}

void LitSidesGpu::settle(gpu::Commands& commands, const GpuSurfels& surfels,
                         const gpu::Array<glm::uvec2>& direct) const
{
    LitSidesArguments arguments{.gathered = gathered_.ref(),
                                .direct = direct.ref(),
                                .backOf = backOf_.ref(),
                                .burntOut = burntOut_.ref(),
                                .white = white_.ref(),
                                .traits = traits_.ref(),
                                .firstNeighbor = surfels.firstNeighbor.ref(),
                                .neighbor = surfels.neighbor.ref(),
                                .plain = field_.ref(),
                                .field = field_.ref(),
                                .mostBurntOut = kMostRadiance,
                                .count = static_cast<uint32_t>(surfels_)};
    for (int round = 0; round < kLitSidesRounds; ++round) {
        settling_.gather(commands, field_, gathered_);
        if (round + 1 == kLitSidesRounds) {
            arguments.field = evenField_.ref();
            arguments.mostBurntOut = 1.0f;
        }
        commands.dispatch(litSides_, surfels_, arguments);
        commands.barrier();
    }
}

void LitSidesGpu::light(gpu::Commands& commands, const GpuSurfels& surfels,
                        const gpu::Array<glm::uvec2>& direct) const
{
    const auto count = static_cast<uint32_t>(surfels_);
    const auto first = surfels.firstNeighbor.ref();
    const auto neighbor = surfels.neighbor.ref();
    // Every time from what the texture shows: the same light gives the same bits.
    commands.copy(start_.buffer(), 0, field_.buffer(), 0, start_.buffer().size());
    commands.barrier();
    settle(commands, surfels, direct);
    gather_.gather(commands, lists_, evenField_, even_, surfels_);
    commands.dispatch(
        excess_, surfels_,
        ExcessArguments{gathered_.ref(), even_.irradiance.ref(), work_[0].ref(), count});
    commands.barrier();
    for (int pass = 0; pass < kExcessSmoothings; ++pass) {
        commands.dispatch(mean_, surfels_,
                          LitSidesMeanArguments{work_[pass % 2].ref(), first, neighbor,
                                                work_[1 - pass % 2].ref(), count});
        commands.barrier();
    }
    const int last = kExcessSmoothings % 2;
    commands.dispatch(indirectOf_, surfels_,
                      IndirectArguments{even_.irradiance.ref(), work_[last].ref(), first, neighbor,
                                        lit_.ref(), indirect_.ref(), count});
    commands.barrier();
}

} // namespace relamp
