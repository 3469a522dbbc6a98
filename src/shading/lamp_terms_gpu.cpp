#include "shading/lamp_terms_gpu.h"

#include "relamp/error.h"
#include "shading/lamp_terms.comp.h"
#include "shading/lamp_terms_sum.comp.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace relamp
{
namespace
{

/// Three a patch, as patchOf() in the program reads them.
std::vector<glm::uvec4> entriesOf(const LampPatches& patches)
{
    const auto bits = [](float number) { return std::bit_cast<uint32_t>(number); };
    std::vector<glm::uvec4> entries;
    for (size_t i = 0; i < patches.count(); ++i) {
        entries.emplace_back(bits(patches.x[i]), bits(patches.y[i]), bits(patches.z[i]),
                             bits(patches.farSquared[i]));
        entries.emplace_back(bits(patches.nx[i]), bits(patches.ny[i]), bits(patches.nz[i]),
                             bits(patches.perRamp[i]));
        entries.emplace_back(bits(patches.area[i]), bits(patches.spread[i]), patches.after[i],
                             patches.depth[i]);
    }
    return entries;
}

/// Four bytes in a number, as byteAt() reads them.
std::vector<uint32_t> inFours(std::span<const uint8_t> bytes)
{
    std::vector<uint32_t> fours((bytes.size() + 3) / 4, 0);
    for (size_t i = 0; i < bytes.size(); ++i) fours[i / 4] |= uint32_t{bytes[i]} << 8 * (i % 4);
    return fours;
}

static_assert(static_cast<int>(Seen::none) == kSeesNothing &&
              static_cast<int>(Seen::all) == kSeesAll && static_cast<int>(Seen::some) == kSeesSome);

std::vector<uint32_t> seenBy(const Visibility& visibility, size_t lamp, size_t surfels)
{
    std::vector<uint8_t> seen;
    for (uint32_t s = 0; s < surfels; ++s)
        seen.push_back(static_cast<uint8_t>(visibility.seen(lamp, s)));
    return inFours(seen);
}

std::vector<glm::vec4> placesOf(const Visibility::Probes& probes)
{
    std::vector<glm::vec4> places;
    for (size_t i = 0; i < probes.x.size(); ++i)
        places.emplace_back(probes.x[i], probes.y[i], probes.z[i], 0.0f);
    return places;
}

std::vector<glm::uvec2> probesOfSurfels(const Visibility::Probes& probes)
{
    std::vector<glm::uvec2> entries;
    for (size_t s = 0; s < probes.reach.size(); ++s)
        entries.emplace_back(probes.first[s], std::bit_cast<uint32_t>(probes.reach[s]));
    entries.emplace_back(probes.first.back(), 0u);
    return entries;
}

} // namespace

LampTermsGpu::LampTermsGpu(const gpu::Device& device, const Surfels& surfels,
                           const CastLamps& lamps, std::vector<float> scales)
    : device_(device), keep_(device, kLampTermsSpirv), sum_(device, kLampTermsSumSpirv),
      scales_(std::move(scales)), probes_(device, placesOf(lamps.visibility.probes())),
      probesOf_(device, probesOfSurfels(lamps.visibility.probes())),
      radiance_(device, termsOf(lamps.count(), 2)),
      written_(device, radiance_.buffer().size(), gpu::Buffer::Place::host)
{
    for (size_t l = 0; l < lamps.count(); ++l)
        lamps_.push_back({{device, entriesOf(lamps.patches[l])},
                          {device, seenBy(lamps.visibility, l, surfels.count())},
                          {device, inFours(lamps.visibility.sharesOf(l))}});
}

void LampTermsGpu::setPowers(gpu::Commands& commands, std::span<const glm::vec3> radiance)
{
    std::vector<glm::vec4> entries(radiance_.count(), glm::vec4(0.0f));
    for (size_t l = 0; l < radiance.size(); ++l)
        entries[l] = glm::vec4(radiance[l] / scales_[l], 0.0f);
    const std::span bytes = std::as_bytes(std::span(entries));
    std::copy(bytes.begin(), bytes.end(), written_.bytes().begin());
    commands.copy(written_, 0, radiance_.buffer(), 0, written_.size());
    commands.barrier();
}

gpu::Array<uint32_t> LampTermsGpu::keep(const std::vector<std::vector<float>>& onPlaces,
                                        size_t places) const
{
    std::vector<uint32_t> terms(termsOf(onPlaces.size(), places), 0);
    for (size_t l = 0; l < onPlaces.size(); ++l)
        for (size_t i = 0; i < places; ++i)
            terms[l / 2 * places + i] |= uint32_t{halfFromFloat(scales_[l] * onPlaces[l][i])}
                                         << 16 * (l % 2);
    return {device_, terms};
}

void LampTermsGpu::keep(gpu::Commands& commands, const GpuTexels& page, const GpuSurfels& surfels,
                        const gpu::Array<uint32_t>& terms) const
{
    for (size_t l = 0; l < lamps_.size(); ++l) {
        const Lamp& lamp = lamps_[l];
        commands.dispatch(
            keep_, page.count,
            LampTermsArguments{.site = page.site.ref(),
                               .surfel = page.surfel.ref(),
                               .position = surfels.position.ref(),
                               .firstNeighbor = surfels.firstNeighbor.ref(),
                               .neighbor = surfels.neighbor.ref(),
                               .patches = lamp.patches.ref(),
                               .seen = lamp.seen.ref(),
                               .shares = lamp.shares.ref(),
                               .probes = probes_.ref(),
                               .probesOf = probesOf_.ref(),
                               .terms = terms.ref(),
                               .patchCount = static_cast<uint32_t>(lamp.patches.count() / 3),
                               .surfelSize = surfels.size,
                               .scale = scales_[l],
                               .lamp = static_cast<uint32_t>(l),
                               .count = static_cast<uint32_t>(page.count)});
        commands.barrier(); // the next may write to the same numbers
    }
}

LampTerms LampTermsGpu::lit(const gpu::Array<uint32_t>& terms, size_t places) const
{
    if (terms.count() > std::numeric_limits<int32_t>::max())
        throw Error(ErrorCode::device,
                    fmt::format("{} lamps on {} texels of one page are more than a GPU's programs "
                                "count; --engine cpu does without",
                                lamps_.size(), places));
    return {terms.ref(), radiance_.ref(), static_cast<uint32_t>(radiance_.count() / 2),
            static_cast<uint32_t>(places)};
}

void LampTermsGpu::sum(gpu::Commands& commands, const gpu::Array<uint32_t>& terms,
                       const gpu::Array<glm::uvec2>& irradiance) const
{
    commands.dispatch(sum_, irradiance.count(),
                      LampTermsSumArguments{lit(terms, irradiance.count()), irradiance.ref()});
    commands.barrier();
}

} // namespace relamp
