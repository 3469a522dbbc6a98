#include "relight/shadow_looks.h"

#include "base/parallel.h"
#include "base/sampling.shared.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include <glm/common.hpp>

namespace relamp
{
namespace
{

constexpr size_t kFirstRays = 4; // of a cell, and of a texel that looks for itself
constexpr size_t kBatch = 256;   // rays
constexpr size_t kChunk = 1024;  // cells
// Between shares of cells: a penumbra of three cells, 2 cm, or narrower.
constexpr float kEdge = 0.3f;

constexpr uint8_t kMetLight = 1;
constexpr uint8_t kMetThing = 2;
constexpr uint8_t kMetBoth = kMetLight | kMetThing;

uint8_t metBy(const AreaSample& sum)
{
    if (sum.open <= 0.0f) return 0;
    return static_cast<uint8_t>((sum.visible > 0.0f ? kMetLight : 0) |
                                (seesAll(sum) ? 0 : kMetThing));
}

float shareOf(const AreaSample& sum)
{
    return sum.open > 0.0f ? std::min(sum.visible / sum.open, 1.0f) : 0.0f;
}

} // namespace

/// Rays of several cells, or texels, that are traced together.
class ShadowLooks::Batch
{
public:
    explicit Batch(const ShadowLooks& looks) : looks_(looks) {}
    ~Batch() { trace(); }
    Batch(const Batch&) = delete;
    Batch& operator=(const Batch&) = delete;

    /// Adds rays [first, end) of the sequence of a cell, from all over its texels.
    void add(std::span<const ShadowCells::Texel> cell, size_t first, size_t end, AreaSample& sum)
    {
        const uint32_t salt = cell.front().index;
        const glm::vec2 shift(hashedShift(salt, 3), hashedShift(salt, 4));
        const glm::vec2 turn(hashedShift(salt, 5), hashedShift(salt, 6));
        const float turned = hashedShift(salt, 7);
        const float begin = hashedShift(salt, 8);
        for (size_t i = first; i < end; ++i) {
            if (count_ == kBatch) trace();
            const auto at = static_cast<float>(i);
            // The square roots of three and two and the golden ratio fill a cell and the light
            // evenly at any number of rays, and apart from each other.
            const float ofCell = glm::fract(begin + 0.73205081f * at);
            const auto texel = static_cast<size_t>(ofCell * static_cast<float>(cell.size()));
            const TexelSite site = looks_.prints_.at(cell[std::min(texel, cell.size() - 1)].index,
                                                     evenPoint(at, shift));
            const glm::vec3 origin = site.position + kOffSurface * site.normal;
            const float share = glm::fract(turned + 0.61803399f * at);
            const Look look = looks_.light_.look(
                origin, site.normal, share, glm::fract(turn + glm::vec2(share, 0.41421356f * at)));
            if (look.irradiance <= 0.0f) continue;
            sum.open += look.irradiance;
            rays_[count_] = {
                .origin = origin, .direction = look.direction, .farthest = look.distance};
            gains_[count_] = look.irradiance;
            sums_[count_++] = &sum;
        }
    }

    void trace()
    {
        uint8_t blocked[kBatch];
        looks_.obstacles_.blocked({rays_, count_}, {blocked, count_});
        for (size_t i = 0; i < count_; ++i)
            if (blocked[i] == 0) sums_[i]->visible += gains_[i];
        count_ = 0;
    }

private:
    const ShadowLooks& looks_;
    Ray rays_[kBatch];
    float gains_[kBatch];
    AreaSample* sums_[kBatch];
    size_t count_ = 0;
};

ShadowLooks::ShadowLooks(const Texels& texels, size_t page, const ShadowCells& cells,
                         const Obstacles& obstacles, const LightSource& light, size_t rays)
    : prints_(texels, page), cells_(cells), obstacles_(obstacles), light_(light),
      few_(std::min(kFirstRays, rays)), rays_(rays), sums_(cells.count()),
      met_(texels.pages[page].runs.size(), 0), isEdge_(cells.count())
{
    forEachChunk(cells_.count(), kChunk, [&](size_t begin, size_t end) {
        Batch batch(*this);
        for (size_t cell = begin; cell < end; ++cell)
            batch.add(cells_.texelsOf(cell), 0, few_, sums_[cell]);
    });
    forEachChunk(cells_.count(), kChunk, [&](size_t begin, size_t end) {
        for (size_t cell = begin; cell < end; ++cell)
            std::atomic_ref(met_[cells_.runOf(cell)])
                .fetch_or(metBy(sums_[cell]), std::memory_order_relaxed);
    });
    forEachChunk(cells_.count(), kChunk, [&](size_t begin, size_t end) {
        Batch batch(*this);
        for (size_t cell = begin; cell < end; ++cell)
            batch.add(cells_.texelsOf(cell), few_, raysOf(cell), sums_[cell]);
    });
    forEachChunk(cells_.count(), kChunk, [&](size_t begin, size_t end) {
        for (size_t cell = begin; cell < end; ++cell) isEdge_[cell] = findEdge(cell) ? 1 : 0;
    });
}

/// The shadow of a point has no penumbra, so there a texel's own rays say whether it needs more,
/// and the texels of a cell whose rays do not agree look for themselves.
size_t ShadowLooks::raysOf(size_t cell) const
{
    if (!light_.isPoint()) return met_[cells_.runOf(cell)] == kMetBoth ? rays_ : few_;
    return cells_.texelsOf(cell).size() == 1 && metBy(sums_[cell]) == kMetBoth ? rays_ : few_;
}

TexelShare ShadowLooks::ownShare(size_t cell) const
{
    const AreaSample& sum = sums_[cell];
    return {shareOf(sum), sum.open > 0.0f ? static_cast<float>(raysOf(cell)) : 0.0f};
}

void ShadowLooks::sharesOf(size_t cell, std::vector<TexelShare>& shares) const
{
    const auto texels = cells_.texelsOf(cell);
    shares.assign(texels.size(), ownShare(cell));
    if (isEdge_[cell] == 0)
        for (size_t i = 0; i < texels.size(); ++i) shares[i] = interpolated(cell, texels[i]);
    else if (texels.size() > 1)
        lookThemselves(cell, shares);
}

/// A cell without any beside it that its rays could be compared with is one as soon as they differ.
bool ShadowLooks::findEdge(size_t cell) const
{
    if (sums_[cell].open <= 0.0f) return false;
    std::array<uint32_t, ShadowCells::kAround> around;
    const size_t count = cells_.around(cell, around.data());
    const bool isPoint = light_.isPoint();
    if ((isPoint || count == 0) && metBy(sums_[cell]) == kMetBoth) return true;
    const float share = shareOf(sums_[cell]);
    return std::any_of(around.begin(), around.begin() + count, [&](uint32_t other) {
        return sums_[other].open > 0.0f &&
               std::abs(shareOf(sums_[other]) - share) > (isPoint ? 0.0f : kEdge);
    });
}

void ShadowLooks::lookThemselves(size_t cell, std::span<TexelShare> shares) const
{
    const auto texels = cells_.texelsOf(cell);
    std::vector<AreaSample> sums(texels.size());
    {
        Batch batch(*this);
        for (size_t i = 0; i < texels.size(); ++i)
            batch.add(texels.subspan(i, 1), 0, few_, sums[i]);
    }
    uint8_t met = metBy(sums_[cell]);
    for (const AreaSample& sum : sums) met |= metBy(sum);
    std::vector<size_t> rays(texels.size());
    {
        Batch batch(*this);
        for (size_t i = 0; i < texels.size(); ++i) {
            rays[i] = (light_.isPoint() ? metBy(sums[i]) : met) == kMetBoth ? rays_ : few_;
            batch.add(texels.subspan(i, 1), few_, rays[i], sums[i]);
        }
    }
    for (size_t i = 0; i < texels.size(); ++i)
        shares[i] = {shareOf(sums[i]), sums[i].open > 0.0f ? static_cast<float>(rays[i]) : 0.0f};
}

/// The mean of a cell that an edge goes through is none of the texels beside it, where all rays met
/// the same.
TexelShare ShadowLooks::interpolated(size_t cell, const ShadowCells::Texel& texel) const
{
    std::array<uint32_t, ShadowCells::kBetween> between;
    std::array<float, ShadowCells::kBetween> weight;
    const size_t count = cells_.between(cell, texel, between.data(), weight.data());
    const bool isClear = metBy(sums_[cell]) != kMetBoth;
    float sum = 0.0f;
    float all = 0.0f;
    float squares = 0.0f;
    for (size_t i = 0; i < count; ++i) {
        if (sums_[between[i]].open <= 0.0f || (isClear && isEdge_[between[i]] != 0)) continue;
        sum += weight[i] * shareOf(sums_[between[i]]);
        all += weight[i];
        squares += weight[i] * weight[i];
    }
    if (all <= 0.0f) return ownShare(cell);
    // The variance of a weighted mean is that of so many more rays.
    return {sum / all, static_cast<float>(raysOf(cell)) * all * all / squares};
}

} // namespace relamp
