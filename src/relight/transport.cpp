#include "relight/transport.h"

#include "base/parallel.h"
#include "relight/sky_bins.h"

#include <algorithm>

#include <glm/vec4.hpp>

namespace relamp
{
namespace
{

constexpr float kPi = 3.14159265f;
constexpr size_t kFewest = 32; // of an even choice

} // namespace

size_t Transport::radiances() const
{
    return lists() + SkyBins::kCount + 1;
}

Transport transportOf(const Texels& texels, const HitLists& hits, size_t rays)
{
    const SurfelSites sites(texels);
    Transport transport;
    transport.sides = hits.sideOfList;
    transport.first = hits.firstTarget;
    transport.target.resize(hits.targets.size());
    transport.few.resize(transport.lists());
    const auto sky = static_cast<uint32_t>(transport.lists());
    const auto dark = static_cast<uint32_t>(transport.radiances() - 1);
    const auto few = static_cast<uint32_t>(std::max(kFewest, rays / 4));
    forEachChunk(transport.lists(), 256, [&](size_t begin, size_t end) {
        for (size_t list = begin; list < end; ++list) {
            const std::span targets = hits.targetsOf(list);
            uint32_t* out = &transport.target[transport.first[list]];
            for (size_t i = 0; i < targets.size(); ++i) {
                if (targets[i].isNothing()) {
                    const Ray ray = rayOfList(sites, transport.sides[list], i);
                    out[i] = sky + static_cast<uint32_t>(SkyBins::of(ray.direction));
                    continue;
                }
                const int32_t met = hits.listOfSide[targets[i].side().index];
                out[i] = met == HitLists::kNoList ? dark : static_cast<uint32_t>(met);
            }
            transport.few[list] = std::min(few, static_cast<uint32_t>(targets.size()));
            std::sort(out, out + transport.few[list]); // neighbours in memory, one after the other
            std::sort(out + transport.few[list], out + targets.size());
        }
    });
    return transport;
}

void gatherRadiance(const Transport& transport, std::span<const glm::vec4> radiance, bool isFew,
                    std::span<glm::vec4> irradiance)
{
    forEachChunk(transport.lists(), 512, [&](size_t begin, size_t end) {
        for (size_t list = begin; list < end; ++list) {
            const uint32_t* target = &transport.target[transport.first[list]];
            const size_t count =
                isFew ? transport.few[list] : transport.first[list + 1] - transport.first[list];
            glm::vec4 sum[4] = {glm::vec4(0.0f), glm::vec4(0.0f), glm::vec4(0.0f), glm::vec4(0.0f)};
            size_t i = 0;
            for (; i + 4 <= count; i += 4) // four sums, for an addition takes four cycles
                for (size_t k = 0; k < 4; ++k) sum[k] += radiance[target[i + k]];
            for (; i < count; ++i) sum[0] += radiance[target[i]];
            irradiance[list] =
                (kPi / static_cast<float>(count)) * ((sum[0] + sum[1]) + (sum[2] + sum[3]));
        }
    });
}

} // namespace relamp
