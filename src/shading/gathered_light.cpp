#include "shading/gathered_light.h"

#include "base/instruction_set.h"
#include "base/lanes.h"
#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "shading/direct_sum.h"
#include "shading/gathered_light.shared.h"

#include <algorithm>
#include <cmath>

namespace relamp
{
namespace
{

/// Surfels around a run of texels, as structure of arrays.
struct Taps
{
    static constexpr size_t kMost = kMostTaps;

    float x[kMost], y[kMost], z[kMost];
    float nx[kMost], ny[kMost], nz[kMost];
    float r[kMost], g[kMost], b[kMost];
    size_t count = 0;

    void add(const Surfels& surfels, uint32_t s, glm::vec3 light)
    {
        if (count == kMost) return;
        x[count] = surfels.position[s].x;
        y[count] = surfels.position[s].y;
        z[count] = surfels.position[s].z;
        nx[count] = surfels.normal[s].x;
        ny[count] = surfels.normal[s].y;
        nz[count] = surfels.normal[s].z;
        r[count] = light.r;
        g[count] = light.g;
        b[count++] = light.b;
    }
};

struct InterpolateArgs
{
    const TexelBlock* block;
    const Taps* taps;
    size_t first;
    size_t end;
    float perReachSquared;
    RgbBlock* out; // shading, not irradiance
};

/// Mean of the taps around each texel: near in space and facing alike.
void interpolateKernel(const InterpolateArgs& args)
{
    const TexelBlock& block = *args.block;
    const Taps& taps = *args.taps;
    for (size_t first = args.first; first < args.end; first += kLanes) {
        float r[kLanes] = {};
        float g[kLanes] = {};
        float b[kLanes] = {};
        float sum[kLanes] = {};
        for (size_t t = 0; t < taps.count; ++t)
            for (size_t lane = 0; lane < kLanes; ++lane) {
                const size_t i = first + lane;
                const glm::vec3 way = glm::vec3(taps.x[t], taps.y[t], taps.z[t]) -
                                      glm::vec3(block.x[i], block.y[i], block.z[i]);
                const glm::vec3 normal(block.nx[i], block.ny[i], block.nz[i]);
                const float w =
                    tapWeight(way, normal, glm::vec3(taps.nx[t], taps.ny[t], taps.nz[t]),
                              args.perReachSquared);
                r[lane] += w * taps.r[t];
                g[lane] += w * taps.g[t];
                b[lane] += w * taps.b[t];
                sum[lane] += w;
            }
        for (size_t lane = 0; lane < kLanes; ++lane) {
            const float scale = 1.0f / (kPi * sum[lane]);
            args.out->r[first + lane] = r[lane] * scale;
            args.out->g[first + lane] = g[lane] * scale;
            args.out->b[first + lane] = b[lane] * scale;
        }
    }
}

/// Visits the runs of a page that a block is made of: visit(surfel, first, end), in its texels.
template<class Visit>
void forEachRunOf(const PageTexels& page, size_t begin, const TexelBlock& block, const Visit& visit)
{
    size_t run = page.runOf(begin);
    for (size_t at = begin; at < begin + block.count; ++run) {
        const size_t end = std::min<size_t>(begin + block.count, page.runs[run + 1].begin);
        visit(page.runs[run].surfel, at - begin, end - begin);
        at = end;
    }
}

void shadeDirect(const GatheredLight& light, const PageTexels& page, size_t begin,
                 const TexelBlock& block, RgbBlock& out)
{
    darken(out, block.count);
    LampOnBlock on;
    const CastLamps& lamps = *light.lamps;
    for (size_t l = 0; l < lamps.count(); ++l) {
        bool isSeen = false;
        forEachRunOf(page, begin, block, [&](uint32_t surfel, size_t, size_t) {
            isSeen |= lamps.visibility.seen(l, surfel) != Seen::none;
        });
        if (!isSeen) continue; // as of most lamps of a house
        forEachRunOf(page, begin, block, [&](uint32_t surfel, size_t first, size_t end) {
            lamps.visibility.at(l, surfel, block, first, end, on.share);
        });
        openIrradiance(block, lamps.patches[l], Geometry::scanned, on.open);
        addDirect(on, light.radiance[l], block.count, out);
    }
}

} // namespace

void interpolate(const Texels& texels, std::span<const glm::vec3> irradiance, size_t page,
                 size_t begin, const TexelBlock& block, RgbBlock& out)
{
    const Surfels& surfels = texels.surfels;
    const float reach = kInterpolationReach * surfels.size;
    forEachRunOf(texels.pages[page], begin, block, [&](uint32_t surfel, size_t first, size_t end) {
        Taps taps;
        for (const uint32_t s : surfels.neighborsOf(surfel)) taps.add(surfels, s, irradiance[s]);
        const InterpolateArgs args{&block, &taps, first, end, 1.0f / (reach * reach), &out};
        runKernel<interpolateKernel>(bestInstructionSet(), args);
    });
}

namespace
{

/// Variance of the values of a surfel and of those in the ring around it.
float varianceAround(const Surfels& surfels, size_t s, std::span<const float> values)
{
    float sum = 0.0f;
    float squares = 0.0f;
    float count = 0.0f;
    for (const uint32_t n : surfels.neighborsOf(s)) {
        if (!surfels.areBeside(s, n)) continue;
        sum += values[n];
        squares += values[n] * values[n];
        count += 1.0f;
    }
    const float mean = sum / count;
    return std::max(squares / count - mean * mean, 0.0f);
}

LampOnSurfels lampOnSurfels(const Surfels& surfels, const CastLamps& lamps, size_t lamp)
{
    std::vector<float> shares(surfels.count(), 0.0f);
    std::vector<float> open(surfels.count(), 0.0f); // where a share of it is seen
    forEachChunk(surfels.count(), TexelBlock::kCapacity, [&](size_t begin, size_t end) {
        if (!lamps.visibility.isSeen(lamp, begin, end)) return;
        TexelBlock block;
        loadSurfels(surfels, begin, end, block);
        float share[TexelBlock::kPadded];
        float ofBlock[TexelBlock::kPadded];
        openIrradiance(block, lamps.patches[lamp], Geometry::scanned, ofBlock);
        for (size_t i = 0; i < block.count; ++i) {
            lamps.visibility.at(lamp, static_cast<uint32_t>(begin + i), block, i, i + 1, share);
            shares[begin + i] = share[i];
            open[begin + i] = ofBlock[i];
        }
    });
    LampOnSurfels on(surfels.count());
    std::vector<LampOnSurfels::Kept> blocks(on.blocks());
    forEachChunk(surfels.count(), LampOnSurfels::kBlock, [&](size_t begin, size_t end) {
        if (!lamps.visibility.isSeen(lamp, begin, end)) return;
        LampOnSurfel block[LampOnSurfels::kBlock];
        for (size_t s = begin; s < end; ++s) {
            const bool isPartial =
                lamps.visibility.seen(lamp, static_cast<uint32_t>(s)) == Seen::some;
            block[s - begin] = {open[s] * shares[s],
                                isPartial ? open[s] * std::sqrt(varianceAround(surfels, s, shares))
                                          : 0.0f};
        }
        blocks[begin / LampOnSurfels::kBlock] =
            LampOnSurfels::kept(std::span(block).first(end - begin));
    });
    for (size_t b = 0; b < blocks.size(); ++b) on.put(b, std::move(blocks[b]));
    return on;
}

} // namespace

CastLamps::CastLamps(std::vector<LampPatches> lamps, Visibility seen, const Surfels& surfels)
    : patches(std::move(lamps)), visibility(std::move(seen))
{
    for (size_t l = 0; l < count(); ++l) onSurfels.push_back(lampOnSurfels(surfels, *this, l));
}

SurfelLighting lightOnSurfels(const Surfels& surfels, const GatheredLight& light)
{
    SurfelLighting result{light.indirect, std::vector<float>(surfels.count(), 0.0f)};
    for (size_t l = 0; l < light.lamps->count(); ++l) {
        const LampOnSurfels& on = light.lamps->onSurfels[l];
        const glm::vec3 radiance = light.radiance[l];
        forEach(on.blocks(), [&](size_t block) {
            on.forEachOf(block, [&](size_t s, LampOnSurfel lamp) {
                const float deviation = lamp.deviation * luminance(radiance);
                result.irradiance[s] += lamp.visible * radiance;
                result.spread[s] += deviation * deviation;
            });
        });
    }
    for (float& spread : result.spread) spread = std::sqrt(spread);
    return result;
}

TexelShading shadingOf(const Texels& texels, std::shared_ptr<const GatheredLight> light)
{
    return [&texels, light = std::move(light)](size_t p, size_t begin, const TexelBlock& block,
                                               ShadingBlock& out) {
        const PageTexels& page = texels.pages[p];
        interpolate(texels, light->indirect, p, begin, block, out.indirect);
        shadeDirect(*light, page, begin, block, out.direct);
    };
}

} // namespace relamp
