#include "shading/visibility.h"

#include "base/lanes.h"
#include "base/parallel.h"
#include "base/sampling.shared.h"

#include <algorithm>
#include <cmath>

namespace relamp
{
namespace
{

constexpr size_t kProbes = 16;      // of a surfel, at most
constexpr float kProbeReach = 1.4f; // steps between probes
constexpr float kUsualError =
    0.1f; // of a ray, of all light there: such a place gets the usual rays
constexpr float kFewestRays = 0.25f; // of these
constexpr float kMostRays = 2.0f;

// Numerics.
constexpr size_t kSurfelsOfBlock = 64; // that look together

constexpr auto kAll = static_cast<uint8_t>(kShareOfAll);
constexpr auto kUnknown = static_cast<uint8_t>(kShareUnknown);

/// Probes around a run of texels.
struct ShareTaps
{
    static constexpr size_t kMost = kMostProbes;

    float x[kMost], y[kMost], z[kMost];
    float share[kMost];
    size_t count = 0;
};

struct ShareArgs
{
    const TexelBlock* block;
    const ShareTaps* taps;
    size_t first;
    size_t end;
    float perReachSquared;
    float* share;
};

void shareKernel(const ShareArgs& args)
{
    const TexelBlock& block = *args.block;
    const ShareTaps& taps = *args.taps;
    for (size_t first = args.first; first < args.end; first += kLanes) {
        float sum[kLanes] = {};
        float weight[kLanes] = {};
        for (size_t t = 0; t < taps.count; ++t)
            for (size_t lane = 0; lane < kLanes; ++lane) {
                const size_t i = first + lane;
                const glm::vec3 way = glm::vec3(taps.x[t], taps.y[t], taps.z[t]) -
                                      glm::vec3(block.x[i], block.y[i], block.z[i]);
                const float w = probeWeight(way, args.perReachSquared);
                sum[lane] += w * taps.share[t];
                weight[lane] += w;
            }
        for (size_t lane = 0; lane < kLanes; ++lane)
            args.share[first + lane] = sum[lane] / weight[lane];
    }
}

/// Standard deviation of whether a ray from a surfel or from those around it reaches a lamp.
float deviationAround(const Surfels& surfels, size_t s, const LampSight& coarse)
{
    float open = 0.0f;
    float visible = 0.0f;
    for (const uint32_t n : surfels.neighborsOf(s)) {
        if (!surfels.areBeside(s, n)) continue;
        open += coarse[n].open;
        visible += coarse[n].visible;
    }
    if (open <= 0.0f) return 0.0f;
    const float share = std::min(visible / open, 1.0f);
    return std::sqrt(share * (1.0f - share));
}

/// Rays to a lamp from each probe of every surfel: by what one of them errs by beside all light
/// there, so that the sum of squared errors is least for so many.
std::vector<uint32_t> raysOfSurfels(const Surfels& surfels, std::span<const Seen> states,
                                    size_t raysPerProbe, const LampSight& coarse,
                                    std::span<const float> openShare)
{
    std::vector<uint32_t> rays(surfels.count(), static_cast<uint32_t>(raysPerProbe));
    forEach(openShare.size(), [&](size_t s) {
        if (states[s] != Seen::some) return; // none is needed
        const float error = openShare[s] * deviationAround(surfels, s, coarse);
        const float factor = std::clamp(error / kUsualError, kFewestRays, kMostRays);
        rays[s] = static_cast<uint32_t>(std::ceil(factor * static_cast<float>(raysPerProbe)));
    });
    return rays;
}

} // namespace

Visibility::Visibility(const Texels& texels, const RayScene& scene,
                       std::span<const AreaLight> lamps, std::span<const LampSight> coarse,
                       const VisibilityOptions& options)
    : texels_(texels), sites_(texels), set_(options.set)
{
    placeProbes();
    for (size_t lamp = 0; lamp < lamps.size(); ++lamp)
        add(scene, lamps[lamp], coarse[lamp], options.raysPerProbe);
}

void Visibility::add(const RayScene& scene, const AreaLight& lamp, const LampSight& coarse,
                     size_t raysPerProbe, std::span<const float> openShare,
                     const TexelMarks& inShade)
{
    const std::vector<Seen> states = seenBySurfels(texels_.surfels, coarse);
    const std::vector<uint32_t> rays =
        raysOfSurfels(texels_.surfels, states, raysPerProbe, coarse, openShare);
    states_.emplace_back(states);
    shares_.push_back(look(lamp, states, scene, rays));
    if (!inShade.empty()) darken(inShade, shares_.back());
    drawTogether(states, rays, shares_.back());
}

void Visibility::placeProbes()
{
    const Surfels& surfels = texels_.surfels;
    firstProbe_.assign(surfels.count() + 1, 0);
    for (uint32_t s = 0; s < surfels.count(); ++s)
        firstProbe_[s + 1] =
            firstProbe_[s] + static_cast<uint32_t>(std::min(kProbes, sites_.countOf(s)));
    for (auto* axis : {&x_, &y_, &z_}) axis->resize(firstProbe_.back());
    reach_.resize(surfels.count());
    forEachChunk(surfels.count(), 256, [&](size_t begin, size_t end) {
        for (auto s = static_cast<uint32_t>(begin); s < end; ++s) {
            const uint32_t count = firstProbe_[s + 1] - firstProbe_[s];
            reach_[s] = kProbeReach * std::sqrt(surfels.area[s] / static_cast<float>(count));
            for (uint32_t i = 0; i < count; ++i) {
                const glm::vec3 position = sites_.at(s, i).position;
                x_[firstProbe_[s] + i] = position.x;
                y_[firstProbe_[s] + i] = position.y;
                z_[firstProbe_[s] + i] = position.z;
            }
        }
    });
}

template<class AnyShares>
auto Visibility::ofSurfel(AnyShares& shares, uint32_t surfel) const
{
    const size_t block = surfel / kSurfelsOfBlock;
    const std::span ofBlock(shares[block]);
    if (ofBlock.empty()) return ofBlock;
    return ofBlock.subspan(firstProbe_[surfel] - firstProbe_[block * kSurfelsOfBlock],
                           firstProbe_[surfel + 1] - firstProbe_[surfel]);
}

std::vector<uint8_t> Visibility::sharesOf(size_t lamp) const
{
    std::vector<uint8_t> all(x_.size(), kUnknown);
    for (uint32_t s = 0; s + 1 < firstProbe_.size(); ++s)
        std::ranges::copy(ofSurfel(shares_[lamp], s), all.begin() + firstProbe_[s]);
    return all;
}

bool Visibility::isSeen(size_t lamp, size_t begin, size_t end) const
{
    for (size_t s = begin; s < end; ++s)
        if (states_[lamp][s] != Seen::none) return true;
    return false;
}

Visibility::Shares Visibility::look(const AreaLight& lamp, std::span<const Seen> states,
                                    const RayScene& scene, std::span<const uint32_t> rays) const
{
    Shares all((states.size() + kSurfelsOfBlock - 1) / kSurfelsOfBlock);
    forEachChunk(states.size(), kSurfelsOfBlock, [&](size_t begin, size_t end) {
        if (std::none_of(states.begin() + static_cast<ptrdiff_t>(begin),
                         states.begin() + static_cast<ptrdiff_t>(end),
                         [](Seen state) { return state == Seen::some; }))
            return;
        const uint32_t firstProbe = firstProbe_[begin];
        std::vector<AreaSample> samples(firstProbe_[end] - firstProbe);
        std::vector<uint8_t>& shares = all[begin / kSurfelsOfBlock];
        shares.assign(samples.size(), kUnknown);
        AreaSampler sampler(scene, lamp, Geometry::scanned);
        for (auto s = static_cast<uint32_t>(begin); s < end; ++s) {
            if (states[s] != Seen::some) continue;
            const float first = seededShift(sites_.seed(), s, 0); // its probes are even together
            const uint32_t count = firstProbe_[s + 1] - firstProbe_[s];
            for (uint32_t i = 0; i < count; ++i) {
                const TexelSite site = sites_.at(s, i);
                const float shift = (static_cast<float>(i) + first) / static_cast<float>(count);
                sampler.add({&site, 1}, rays[s], shift, samples[firstProbe_[s] + i - firstProbe]);
            }
        }
        sampler.finish();
        for (size_t i = 0; i < samples.size(); ++i)
            if (samples[i].open > 0.0f)
                shares[i] =
                    static_cast<uint8_t>(std::lround(kAll * samples[i].visible / samples[i].open));
    });
    return all;
}

void Visibility::darken(const TexelMarks& inShade, Shares& shares) const
{
    for (uint32_t s = 0; s + 1 < firstProbe_.size(); ++s) {
        uint32_t probe = 0;
        for (uint8_t& share : ofSurfel(shares, s)) {
            const TexelIndex at = sites_.texelOf(s, probe++);
            if (share != kUnknown && inShade[at.page][at.texel] != 0) share = 0;
        }
    }
}

/// Draws every probe towards the mean around it, all the way where their difference may be the
/// noise of few rays: a wide penumbra becomes smooth, an edge stays.
void Visibility::drawTogether(std::span<const Seen> states, std::span<const uint32_t> rays,
                              Shares& shares) const
{
    const Surfels& surfels = texels_.surfels;
    std::vector<float> mean(states.size(), -1.0f);
    for (uint32_t s = 0; s < states.size(); ++s) {
        if (states[s] != Seen::some) { // and none of its probes looked
            mean[s] = states[s] == Seen::all ? 1.0f : 0.0f;
            continue;
        }
        float sum = 0.0f;
        float count = 0.0f;
        for (const uint8_t share : ofSurfel(shares, s)) {
            if (share == kUnknown) continue;
            sum += static_cast<float>(share) / kAll;
            count += 1.0f;
        }
        if (count > 0.0f) mean[s] = sum / count;
    }
    forEachChunk(states.size(), 256, [&](size_t begin, size_t end) {
        for (auto s = static_cast<uint32_t>(begin); s < end; ++s) {
            if (states[s] != Seen::some) continue;
            const auto n = static_cast<float>(rays[s]);
            float around = 0.0f;
            float count = 0.0f;
            for (const uint32_t other : surfels.neighborsOf(s)) {
                if (mean[other] < 0.0f || !surfels.areBeside(s, other)) continue;
                around += mean[other];
                count += 1.0f;
            }
            for (uint8_t& ofProbe : ofSurfel(shares, s)) {
                if (ofProbe == kUnknown || count == 0.0f) continue;
                const float share = static_cast<float>(ofProbe) / kAll;
                const float likely = (n * share + 0.5f) / (n + 1.0f); // 0 and 1 are not sure either
                const float variance = likely * (1.0f - likely) / n;
                const float step = around / count - share;
                const float drawn = share + step * variance / std::max(step * step, variance);
                ofProbe = static_cast<uint8_t>(std::lround(kAll * drawn));
            }
        }
    });
}

void Visibility::at(size_t lamp, uint32_t surfel, const TexelBlock& block, size_t first, size_t end,
                    float* share) const
{
    const Seen state = states_[lamp][surfel];
    std::fill(share + first, share + end, state == Seen::all ? 1.0f : 0.0f);
    if (state != Seen::some) return;
    const Surfels& surfels = texels_.surfels;
    ShareTaps taps;
    const float far = surfels.size + reach_[surfel];
    for (const uint32_t n : surfels.neighborsOf(surfel)) {
        if (states_[lamp][n] != Seen::some) continue;
        const std::span<const uint8_t> shares = ofSurfel(shares_[lamp], n);
        for (size_t k = 0; k < shares.size(); ++k) {
            if (shares[k] == kUnknown || taps.count == ShareTaps::kMost) continue;
            const size_t probe = firstProbe_[n] + k;
            const glm::vec3 position(x_[probe], y_[probe], z_[probe]);
            const glm::vec3 way = position - surfels.position[surfel];
            if (n != surfel && glm::dot(way, way) > far * far) continue;
            taps.x[taps.count] = position.x;
            taps.y[taps.count] = position.y;
            taps.z[taps.count] = position.z;
            taps.share[taps.count++] = static_cast<float>(shares[k]) / kAll;
        }
    }
    if (taps.count == 0) return;
    const float reach = reach_[surfel];
    const ShareArgs args{&block, &taps, first, end, 1.0f / (reach * reach), share};
    runKernel<shareKernel>(set_, args);
}

} // namespace relamp
