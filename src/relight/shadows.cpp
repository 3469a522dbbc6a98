#include "relight/shadows.h"

#include "base/parallel.h"
#include "base/sampling.shared.h"
#include "relight/shadow_cells.h"
#include "relight/shadow_looks.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr size_t kRaysOfSides = 256; // rays

/// Where a thing stands on a part of a surfel, its edge crosses texels that the surfel's rays,
/// which start beside it, know nothing of.
void doubtPartlyEnclosed(const Surfels& surfels, std::span<Seen> states)
{
    for (size_t s = 0; s < states.size(); ++s)
        if (states[s] == Seen::all && surfels.isPartlyEnclosed(s)) states[s] = Seen::some;
}

/// Where 7 % of a light are hidden, all 36 rays of a ring miss what hides them in one place of
/// fourteen: there the ring's neighbours know better.
void doubtBeside(const Surfels& surfels, std::span<Seen> states)
{
    const std::vector<Seen> own(states.begin(), states.end());
    forEachChunk(own.size(), 1024, [&](size_t begin, size_t end) {
        for (size_t s = begin; s < end; ++s)
            for (const uint32_t n : surfels.neighborsOf(s))
                if (own[n] == Seen::some && surfels.areBeside(s, n)) states[s] = Seen::some;
    });
}

/// Rays say which share of a light is seen; how much all of it is, they know from a point or two,
/// and beside the light not even nearly. `block` is of all places that they start from.
void scaleToOpen(const LightSource& light, const TexelBlock& block, size_t origins,
                 std::span<AreaSample> direct)
{
    float open[TexelBlock::kPadded];
    light.open(block, open);
    for (size_t i = 0; i < direct.size(); ++i) {
        if (direct[i].open <= 0.0f) continue;
        const float* own = open + i * origins;
        const float mean = std::accumulate(own, own + origins, 0.0f) / static_cast<float>(origins);
        direct[i].visible *= mean / direct[i].open;
        direct[i].open = mean;
    }
}

/// Of a share that `rays` rays told; 0 and 1 are not sure either.
float varianceOf(float share, float n)
{
    const float likely = (n * share + 0.5f) / (n + 1.0f);
    return likely * (1.0f - likely) / n;
}

uint8_t toByte(float share)
{
    return static_cast<uint8_t>(std::lround(255.0f * share));
}

} // namespace

LampSight directOfSides(const Texels& texels, const Obstacles& obstacles, const LightSource& light,
                        std::span<const Side> sides, size_t origins)
{
    const SurfelSites sites(texels);
    const auto perSide = static_cast<float>(origins);
    std::vector<AreaSample> direct(sides.size());
    forEachChunk(sides.size(), kRaysOfSides / origins, [&](size_t begin, size_t end) {
        Ray rays[kRaysOfSides];
        float gains[kRaysOfSides];
        size_t owner[kRaysOfSides];
        size_t count = 0;
        TexelBlock block; // of all origins
        for (size_t i = begin; i < end; ++i)
            for (size_t k = 0; k < origins; ++k) {
                const uint32_t index = sides[i].index;
                const TexelSite site = sites.at(sides[i].surfel(), k);
                const glm::vec3 normal = sides[i].isBack() ? -site.normal : site.normal;
                block.add(site.position, normal);
                const float share = (static_cast<float>(k) + hashedShift(index, 0)) / perSide;
                const glm::vec2 u = evenPoint(
                    static_cast<float>(k), glm::vec2(hashedShift(index, 1), hashedShift(index, 2)));
                const glm::vec3 origin = site.position + kOffSurface * normal;
                const Look look = light.look(origin, normal, share, u);
                if (look.irradiance <= 0.0f) continue;
                direct[i].open += look.irradiance / perSide;
                rays[count] = {
                    .origin = origin, .direction = look.direction, .farthest = look.distance};
                gains[count] = look.irradiance / perSide;
                owner[count++] = i;
            }
        uint8_t blocked[kRaysOfSides];
        obstacles.blocked({rays, count}, {blocked, count});
        for (size_t i = 0; i < count; ++i)
            if (blocked[i] == 0) direct[owner[i]].visible += gains[i];
        scaleToOpen(light, block, origins, std::span(direct).subspan(begin, end - begin));
    });
    return LampSight(direct);
}

Shadows::Shadows(const Texels& texels, const Obstacles& obstacles, const LightSource& light,
                 const LampSight& coarse, size_t rays)
    : texels_(texels)
{
    std::vector<Seen> states = seenBySurfels(texels_.surfels, coarse);
    doubtPartlyEnclosed(texels_.surfels, states);
    if (!light.isPoint()) doubtBeside(texels_.surfels, states);
    for (size_t p = 0; p < texels.pages.size(); ++p)
        pages_.push_back(look(p, states, obstacles, light, rays));
    // The shadow of a point has no penumbra: what varies in it is where its edge lies.
    if (!light.isPoint()) smooth(states);
    for (OfPage& page : pages_) page.moments = std::vector<Moments>(); // = {} would keep its memory
}

void Shadows::Moments::add(float share, float varianceOfIt)
{
    sum += share;
    squares += share * share;
    variance += varianceOfIt;
    count += 1.0f;
}

void Shadows::Moments::add(const Moments& other)
{
    sum += other.sum;
    squares += other.squares;
    variance += other.variance;
    count += other.count;
}

Shadows::OfPage Shadows::look(size_t p, std::span<const Seen> states, const Obstacles& obstacles,
                              const LightSource& light, size_t rays) const
{
    const PageTexels& page = texels_.pages[p];
    OfPage found;
    std::vector<uint32_t> doubtful; // runs
    uint32_t count = 0;
    for (uint32_t run = 0; run + 1 < page.runs.size(); ++run) {
        const Seen state = states[page.runs[run].surfel];
        found.firstShare.push_back(state == Seen::some ? count : state == Seen::all ? kAll : kNone);
        if (state != Seen::some) continue;
        doubtful.push_back(run);
        count += page.runs[run + 1].begin - page.runs[run].begin;
    }
    if (std::ranges::all_of(found.firstShare, [](uint32_t first) { return first == kNone; }))
        return {}; // as most pages of a house
    found.shares.resize(count);
    found.moments.resize(found.firstShare.size());
    const ShadowCells cells(texels_, p, doubtful);
    const ShadowLooks looks(texels_, p, cells, obstacles, light, rays);
    std::vector<float> raysOf(count); // of shares
    forEachChunk(cells.count(), 256, [&](size_t begin, size_t end) {
        std::vector<TexelShare> shares;
        for (size_t cell = begin; cell < end; ++cell) {
            looks.sharesOf(cell, shares);
            const auto texels = cells.texelsOf(cell);
            for (size_t i = 0; i < texels.size(); ++i) {
                const uint32_t run = texels[i].run;
                const uint32_t at = found.firstShare[run] + texels[i].index - page.runs[run].begin;
                found.shares[at] = toByte(shares[i].share);
                raysOf[at] = shares[i].rays;
            }
        }
    });
    forEachChunk(doubtful.size(), 256, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const uint32_t run = doubtful[i];
            const uint32_t first = found.firstShare[run];
            const uint32_t texels = page.runs[run + 1].begin - page.runs[run].begin;
            for (uint32_t at = first; at < first + texels; ++at) {
                if (raysOf[at] <= 0.0f) continue;
                const float share = static_cast<float>(found.shares[at]) / 255.0f;
                found.moments[run].add(share, varianceOf(share, raysOf[at]));
            }
        }
    });
    return found;
}

/// Shares are drawn towards their mean, over the ring of surfels around theirs, as far as chance
/// alone would spread them: a wide penumbra becomes smooth, an edge stays (Lee's filter).
void Shadows::smooth(std::span<const Seen> states)
{
    std::vector<Moments> ofSurfels(states.size());
    for (size_t s = 0; s < states.size(); ++s)
        if (states[s] != Seen::some) ofSurfels[s].add(states[s] == Seen::all ? 1.0f : 0.0f, 0.0f);
    for (size_t p = 0; p < pages_.size(); ++p)
        for (size_t run = 0; run < pages_[p].moments.size(); ++run)
            ofSurfels[texels_.pages[p].runs[run].surfel].add(pages_[p].moments[run]);
    for (size_t p = 0; p < pages_.size(); ++p) smoothPage(p, ofSurfels);
}

void Shadows::smoothPage(size_t p, std::span<const Moments> ofSurfels)
{
    const PageTexels& page = texels_.pages[p];
    const Surfels& surfels = texels_.surfels;
    OfPage& found = pages_[p];
    forEachChunk(found.firstShare.size(), 256, [&](size_t begin, size_t end) {
        for (size_t run = begin; run < end; ++run) {
            const uint32_t first = found.firstShare[run];
            if (first == kNone || first == kAll) continue;
            const uint32_t surfel = page.runs[run].surfel;
            Moments around;
            for (const uint32_t n : surfels.neighborsOf(surfel)) // with itself
                if (surfels.areBeside(surfel, n)) around.add(ofSurfels[n]);
            if (around.count <= 0.0f) continue;
            const float mean = around.sum / around.count;
            const float spread = around.squares / around.count - mean * mean;
            const float byChance = around.variance / around.count;
            const float kept = std::max(1.0f - byChance / std::max(spread, 1e-9f), 0.0f);
            const uint32_t count = page.runs[run + 1].begin - page.runs[run].begin;
            for (uint32_t i = first; i < first + count; ++i) {
                const float share = static_cast<float>(found.shares[i]) / 255.0f;
                found.shares[i] = toByte(mean + kept * (share - mean));
            }
        }
    });
}

bool Shadows::at(size_t p, size_t begin, size_t count, float* share) const
{
    const PageTexels& page = texels_.pages[p];
    const OfPage& found = pages_[p];
    if (found.firstShare.empty()) {
        std::fill_n(share, count, 0.0f);
        return false;
    }
    bool isSeen = false;
    size_t run = page.runOf(begin);
    for (size_t at = begin; at < begin + count; ++run) {
        const size_t end = std::min<size_t>(begin + count, page.runs[run + 1].begin);
        const uint32_t first = found.firstShare[run];
        for (; at < end; ++at) {
            float value = first == kAll ? 1.0f : 0.0f;
            if (first != kAll && first != kNone)
                value =
                    static_cast<float>(found.shares[first + at - page.runs[run].begin]) / 255.0f;
            share[at - begin] = value;
            isSeen |= value > 0.0f;
        }
    }
    return isSeen;
}

} // namespace relamp
