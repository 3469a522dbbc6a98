#include "shading/hit_lists.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "scan/surface_point.h"
#include "shading/sampling.shared.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace relamp
{
namespace
{

constexpr size_t kMoreRays = 4;
constexpr float kNoisy = 0.25f;        // of the mean; what neighbours average away again
constexpr float kBlack = 0.01f;        // radiance
constexpr size_t kFewerOfBacks = 2;    // few rays meet a back, and their mean is all that matters
constexpr int kGenerationsOfBacks = 2; // backs seen by backs seen by fronts; beyond is dark anyway

class Caster
{
public:
    Caster(const Texels& texels, const RayScene& scene, const SurfelRadiance& radiance);

    /// Rays from `first` on of a side's sequence.
    void cast(Side side, size_t first, std::span<HitTarget> out) const;
    /// Standard error of the mean of what was met, as a share of it.
    [[nodiscard]] float noiseOf(std::span<const HitTarget> targets) const;

private:
    [[nodiscard]] HitTarget targetNear(const Hit& hit) const;
    [[nodiscard]] HitTarget targetOf(const Ray& ray, const Hit& hit) const;

    const Texels& texels_;
    const RayScene& scene_;
    const SurfelRadiance& radiance_;
    SurfelSites sites_;
    NearestPixels pixels_;
    std::vector<std::vector<HitTarget>> frontAt_; // [page][pixel]; nothing where there is no texel
};

Caster::Caster(const Texels& texels, const RayScene& scene, const SurfelRadiance& radiance)
    : texels_(texels), scene_(scene), radiance_(radiance), sites_(texels), pixels_(texels)
{
    for (size_t p = 0; p < texels.pages.size(); ++p) {
        const PageTexels& page = texels.pages[p];
        const std::vector<uint8_t>& isClipped = radiance.isClipped[p];
        std::vector<HitTarget>& frontAt =
            frontAt_.emplace_back(texels.scan->pages[p].image.pixels(), HitTarget::nothing());
        forEachChunk(page.runs.size() - 1, 256, [&](size_t begin, size_t end) {
            for (size_t run = begin; run < end; ++run)
                for (size_t i = page.runs[run].begin; i < page.runs[run + 1].begin; ++i)
                    frontAt[page.pixel[i]] = HitTarget::of(Side::front(page.runs[run].surfel),
                                                           isClipped[page.pixel[i]] != 0);
        });
    }
}

/// The front at the nearest texel; beyond a chart's rim, at the nearest of those that a texture
/// lookup would mix.
HitTarget Caster::targetNear(const Hit& hit) const
{
    const PixelAt nearest = pixels_.at(hit);
    HitTarget target = frontAt_[nearest.page][nearest.pixel];
    if (!target.isNothing()) return target;
    const PixelMix mix = pixelsAt(texels_, hit);
    float most = 0.0f;
    for (size_t i = 0; i < mix.pixel.size(); ++i) {
        const HitTarget mixed = frontAt_[mix.page][mix.pixel[i]];
        if (mix.weight[i] <= most || mixed.isNothing()) continue;
        most = mix.weight[i];
        target = mixed;
    }
    return target;
}

HitTarget Caster::targetOf(const Ray& ray, const Hit& hit) const
{
    if (hit.missed()) return HitTarget::nothing();
    HitTarget target = targetNear(hit);
    if (target.isNothing()) {
        const uint32_t surfel =
            texels_.surfels.find(ray.origin + hit.distance * ray.direction, normalAt(texels_, hit));
        if (surfel == Surfels::kNone) return HitTarget::nothing();
        const PixelAt at = pixels_.at(hit);
        target = HitTarget::of(Side::front(surfel), radiance_.isClipped[at.page][at.pixel] != 0);
    }
    return hit.front ? target : HitTarget::of(Side::back(target.side().surfel()), false);
}

/// Rays are traced one by one, for they go everywhere; what they met is looked up for many, so that
/// the waits for memory overlap.
void Caster::cast(Side side, size_t first, std::span<HitTarget> out) const
{
    constexpr size_t kBatch = 32;
    Ray rays[kBatch];
    Hit hits[kBatch];
    const RaysOfSide raysOfSide(sites_, side);
    for (size_t begin = 0; begin < out.size(); begin += kBatch) {
        const size_t count = std::min(kBatch, out.size() - begin);
        for (size_t i = 0; i < count; ++i) {
            rays[i] = raysOfSide[first + begin + i];
            hits[i] = scene_.intersect(rays[i]);
        }
        for (size_t i = 0; i < count; ++i) out[begin + i] = targetOf(rays[i], hits[i]);
    }
}

float Caster::noiseOf(std::span<const HitTarget> targets) const
{
    float sum = 0.0f;
    float squares = 0.0f;
    for (const HitTarget target : targets) {
        if (target.isNothing() || target.side().isBack()) continue;
        const float value =
            target.isClipped() ? 1.0f : luminance(radiance_.plain[target.side().surfel()]);
        sum += value;
        squares += value * value;
    }
    const auto count = static_cast<float>(targets.size());
    const float mean = sum / count;
    const float variance = std::max(squares / count - mean * mean, 0.0f);
    return std::sqrt(variance / count) / std::max(mean, kBlack);
}

/// Backs that lists from `firstList` on have met and that have no list yet, ascending.
std::vector<Side> newBacks(const HitLists& lists, size_t firstList)
{
    std::vector<uint8_t> seen(lists.listOfSide.size(), 0);
    const auto targets = std::span(lists.targets).subspan(lists.firstTarget[firstList]);
    forEachChunk(targets.size(), size_t{1} << 16, [&](size_t begin, size_t end) {
        for (const HitTarget target : targets.subspan(begin, end - begin))
            if (!target.isNothing() && target.side().isBack())
                std::atomic_ref(seen[target.side().index]).store(1, std::memory_order_relaxed);
    });
    std::vector<Side> backs;
    for (uint32_t side = 1; side < seen.size(); side += 2)
        if (seen[side] != 0 && lists.listOfSide[side] == HitLists::kNoList) backs.push_back({side});
    return backs;
}

/// Casts the lists of `sides`: a few rays each, then more where these do not agree.
void castSides(const Caster& caster, std::span<const Side> sides, size_t rays, HitLists& lists,
               Progress::Stage& stage)
{
    const size_t first = lists.sideOfList.size();
    for (size_t i = 0; i < sides.size(); ++i)
        lists.listOfSide[sides[i].index] = static_cast<int32_t>(first + i);
    lists.sideOfList.insert(lists.sideOfList.end(), sides.begin(), sides.end());

    std::vector<HitTarget> few(sides.size() * rays, HitTarget::nothing());
    std::vector<uint32_t> counts(sides.size());
    const auto ofList = [&](size_t i) { return std::span(few).subspan(i * rays, rays); };
    forEachChunk(sides.size(), 64, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            caster.cast(sides[i], 0, ofList(i));
            const bool isNoisy = caster.noiseOf(ofList(i)) > kNoisy && !sides[i].isBack();
            counts[i] = static_cast<uint32_t>(isNoisy ? kMoreRays * rays : rays);
        }
        stage.advance(end - begin);
    });
    for (const uint32_t count : counts)
        lists.firstTarget.push_back(lists.firstTarget.back() + count);
    lists.targets.resize(lists.firstTarget.back(), HitTarget::nothing());
    forEachChunk(sides.size(), 64, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const std::span out(lists.targets.data() + lists.firstTarget[first + i], counts[i]);
            std::copy_n(ofList(i).begin(), rays, out.begin());
            if (counts[i] > rays) caster.cast(sides[i], rays, out.subspan(rays));
        }
        stage.advance(end - begin);
    });
}

} // namespace

RaysOfSide::RaysOfSide(const SurfelSites& sites, Side side)
    : sites_(sites), side_(side),
      shift_(seededShift(sites.seed(), side.index, 1), seededShift(sites.seed(), side.index, 2)),
      count_(sites.countOf(side.surfel()))
{
    for (size_t i = 0; i < count_ && count_ <= kMost; ++i) site_[i] = sites.at(side.surfel(), i);
}

Ray RaysOfSide::operator[](size_t i) const
{
    const TexelSite site = count_ <= kMost ? site_[i % count_] : sites_.at(side_.surfel(), i);
    const glm::vec3 normal = side_.isBack() ? -site.normal : site.normal;
    return {.origin = site.position + kOffSurface * normal,
            .direction = cosineDirection(normal, evenPoint(static_cast<float>(i), shift_))};
}

HitLists castHitLists(const Texels& texels, const RayScene& scene, const SurfelRadiance& radiance,
                      size_t rays, Progress& progress)
{
    const auto surfels = static_cast<uint32_t>(texels.surfels.count());
    const Caster caster(texels, scene, radiance);
    HitLists lists;
    lists.listOfSide.assign(2 * size_t{surfels}, HitLists::kNoList);
    std::vector<Side> sides(surfels, Side{0});
    for (uint32_t s = 0; s < surfels; ++s) sides[s] = Side::front(s);
    Progress::Stage stage(progress, "rays", 3 * size_t{surfels}); // backs are about half as many
    for (int generation = 0; generation <= kGenerationsOfBacks && !sides.empty(); ++generation) {
        const size_t first = lists.sideOfList.size();
        const size_t ofSide = generation == 0 ? rays : std::max<size_t>(rays / kFewerOfBacks, 1);
        castSides(caster, sides, ofSide, lists, stage);
        sides = newBacks(lists, first);
    }
    return lists;
}

} // namespace relamp
