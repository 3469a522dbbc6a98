#include "shading/hit_lists.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "base/sampling.shared.h"
#include "scan/large_scan.h"
#include "scan/surface_point.h"
#include "shading/front_map.h"
#include "shading/openings.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

namespace relamp
{
namespace
{

constexpr uint32_t kMostTimes = 8;  // the mean
constexpr float kWhitePaper = 0.8f; // albedo of what is seen bright in little gathered light
constexpr float kBlackPaper = 0.05f;
constexpr float kBlack = 0.01f;        // radiance
constexpr size_t kFewerOfBacks = 5;    // few rays meet a back, and their mean is all that matters
constexpr int kGenerationsOfBacks = 2; // backs seen by backs seen by fronts; beyond is dark anyway

// Numerics.
constexpr size_t kBatch = 64;               // rays, of as many sides as it takes
constexpr double kSquaresOfPages = 1 << 26; // 256 MB; 32 pages of 8192 x 8192 have 6 x 6

/// Luminance that the rays of a side met.
struct Met
{
    float mean = 0.0f;
    float variance = 0.0f; // of a ray
};

/// Pixels of a square of the maps of all pages; 1 but for a large scan.
uint32_t sideOfSquares(const Texels& texels)
{
    if (!texels.isLarge) return 1;
    const auto pixels = static_cast<double>(pixelsOf(*texels.scan));
    return static_cast<uint32_t>(std::max(1.0, std::ceil(std::sqrt(pixels / kSquaresOfPages))));
}

class Caster
{
public:
    Caster(const Texels& texels, const RayScene& scene, const SurfelRadiance& radiance);

    /// Rays of sides, traced together and looked up together, so that waits for memory overlap.
    class Batch;
    [[nodiscard]] Met metBy(std::span<const HitTarget> targets) const;
    /// Rays that each front gets, `mean` in the mean, by what the first `rays` of them met.
    [[nodiscard]] std::vector<uint32_t> raysOf(std::span<const Met> fronts, size_t rays,
                                               size_t mean) const;

private:
    [[nodiscard]] HitTarget targetNear(const Hit& hit) const;
    [[nodiscard]] HitTarget targetOf(const Ray& ray, const Hit& hit) const;

    const Texels& texels_;
    const RayScene& scene_;
    const SurfelRadiance& radiance_;
    SurfelSites sites_;
    NearestPixels pixels_;
    std::vector<FrontMap> frontOf_; // of pages
};

Caster::Caster(const Texels& texels, const RayScene& scene, const SurfelRadiance& radiance)
    : texels_(texels), scene_(scene), radiance_(radiance), sites_(texels), pixels_(texels)
{
    const uint32_t side = sideOfSquares(texels);
    for (size_t p = 0; p < texels.pages.size(); ++p) {
        const PageTexels& page = texels.pages[p];
        const std::vector<bool>& isClipped = radiance.isClipped[p];
        const Page& picture = texels.scan->pages[p];
        FrontMap& fronts = frontOf_.emplace_back(static_cast<uint32_t>(picture.image.width),
                                                 static_cast<uint32_t>(picture.image.height),
                                                 picture.ofVertices ? 1 : side);
        forEachChunk(page.runs.size() - 1, 256, [&](size_t begin, size_t end) {
            for (size_t run = begin; run < end; ++run)
                for (size_t i = page.runs[run].begin; i < page.runs[run + 1].begin; ++i)
                    fronts.put(page.pixel[i], HitTarget::of(Side::front(page.runs[run].surfel),
                                                            isClipped[page.pixel[i]]));
        });
        texels.letGo(p);
    }
}

/// The front at the nearest texel; beyond a chart's rim, at the nearest of those that a texture
/// lookup would mix.
HitTarget Caster::targetNear(const Hit& hit) const
{
    const PixelAt nearest = pixels_.at(hit);
    HitTarget target = frontOf_[nearest.page].at(nearest.pixel);
    if (!target.isNothing()) return target;
    const PixelMix mix = pixelsAt(texels_, hit);
    float most = 0.0f;
    for (size_t i = 0; i < mix.pixel.size(); ++i) {
        const HitTarget mixed = frontOf_[mix.page].at(mix.pixel[i]);
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
        target = HitTarget::of(Side::front(surfel), radiance_.isClipped[at.page][at.pixel]);
    }
    return hit.front ? target : HitTarget::of(Side::back(target.side().surfel()), false);
}

class Caster::Batch
{
public:
    explicit Batch(const Caster& caster) : caster_(caster) {}

    /// Rays from `first` on of a side's sequence. `out` must stay where it is until finish().
    void add(Side side, size_t first, std::span<HitTarget> out)
    {
        const RaysOfSide raysOfSide(caster_.sites_, side);
        for (size_t i = 0; i < out.size(); ++i) {
            rays_[count_] = raysOfSide[first + i];
            out_[count_] = &out[i];
            if (++count_ == kBatch) finish();
        }
    }

    /// Fills in all that is left.
    void finish()
    {
        caster_.scene_.intersect({rays_, count_}, {hits_, count_}, RayOrder::scattered);
        for (size_t i = 0; i < count_; ++i) *out_[i] = caster_.targetOf(rays_[i], hits_[i]);
        count_ = 0;
    }

private:
    const Caster& caster_;
    Ray rays_[kBatch];
    Hit hits_[kBatch];
    HitTarget* out_[kBatch];
    size_t count_ = 0;
};

Met Caster::metBy(std::span<const HitTarget> targets) const
{
    Met met;
    float squares = 0.0f;
    for (const HitTarget target : targets) {
        if (target.isNothing() || target.side().isBack()) continue;
        const float value =
            target.isClipped() ? 1.0f : luminance(radiance_.plain[target.side().surfel()]);
        met.mean += value;
        squares += value * value;
    }
    const auto count = static_cast<float>(targets.size());
    met.mean /= count;
    met.variance = std::max(squares / count - met.mean * met.mean, 0.0f);
    return met;
}

/// The noise of albedo rho = pi L / E is rho sigma / (E sqrt(rays)). Its sum of squares is least
/// for a number of rays where these go by rho sigma / E. Light from lamps is not known yet: what is
/// brighter than white paper would be in the light gathered gets as much light as that takes.
std::vector<uint32_t> Caster::raysOf(std::span<const Met> fronts, size_t rays, size_t mean) const
{
    const Surfels& surfels = texels_.surfels;
    std::vector<float> weight(fronts.size());
    forEach(fronts.size(), [&](size_t s) {
        Met around; // few rays miss what is small and bright
        for (const uint32_t n : surfels.neighborsOf(s)) {
            around.mean += fronts[n].mean;
            around.variance += fronts[n].variance;
        }
        const auto count = static_cast<float>(surfels.neighborsOf(s).size());
        const float seen = luminance(radiance_.plain[s]);
        const float light = std::max({around.mean / count, seen / kWhitePaper, kBlack});
        const float albedo = std::max(seen / light, kBlackPaper);
        weight[s] = albedo * std::sqrt(around.variance / count) / light;
    });
    const double sum = std::accumulate(weight.begin(), weight.end(), 0.0);
    const double each = static_cast<double>((mean - rays) * fronts.size()) / std::max(sum, 1e-9);
    std::vector<uint32_t> counts;
    for (const float w : weight)
        counts.push_back(static_cast<uint32_t>(rays) +
                         static_cast<uint32_t>(std::min(each * static_cast<double>(w),
                                                        static_cast<double>(kMostTimes * mean))));
    return counts;
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

/// Moves lists of `rays` targets each, which lie one behind the other, to where each begins from
/// now on: the last first, for none moves towards the front.
void spreadApart(std::span<const uint32_t> begins, size_t rays, std::vector<HitTarget>& targets)
{
    for (size_t i = begins.size(); i-- > 0 && begins[i] > i * rays;) {
        const auto begin = targets.begin() + static_cast<ptrdiff_t>(i * rays);
        const auto to = targets.begin() + static_cast<ptrdiff_t>(begins[i] + rays);
        std::copy_backward(begin, begin + static_cast<ptrdiff_t>(rays), to);
    }
}

/// Casts `rays` rays of each of `sides`, whose lists come last.
void castEvenly(const Caster& caster, std::span<const Side> sides, size_t rays, HitLists& lists,
                Progress::Stage& stage)
{
    for (const Side side : sides) {
        lists.listOfSide[side.index] = static_cast<int32_t>(lists.sideOfList.size());
        lists.sideOfList.push_back(side);
        lists.firstTarget.push_back(lists.firstTarget.back() + static_cast<uint32_t>(rays));
    }
    const size_t first = lists.targets.size();
    lists.targets.resize(lists.firstTarget.back(), HitTarget::nothing());
    forEachChunk(sides.size(), 64, [&](size_t begin, size_t end) {
        Caster::Batch batch(caster);
        for (size_t i = begin; i < end; ++i)
            batch.add(sides[i], 0, std::span(lists.targets).subspan(first + i * rays, rays));
        batch.finish();
        stage.advance(end - begin);
    });
}

/// Casts the lists of all fronts: a first half of the rays, then the others where these do not
/// agree.
void castFronts(const Caster& caster, std::span<const Side> fronts, size_t raysOfFront,
                HitLists& lists, Progress::Stage& stage)
{
    const size_t rays = (raysOfFront + 1) / 2;
    castEvenly(caster, fronts, rays, lists, stage);
    std::vector<Met> met(fronts.size());
    forEach(met.size(), [&](size_t i) { met[i] = caster.metBy(lists.targetsOf(i)); });
    const std::vector<uint32_t> counts = caster.raysOf(met, rays, raysOfFront);
    std::partial_sum(counts.begin(), counts.end(), lists.firstTarget.begin() + 1);
    lists.targets.resize(lists.firstTarget.back(), HitTarget::nothing());
    spreadApart(std::span(lists.firstTarget).first(fronts.size()), rays, lists.targets);
    forEachChunk(fronts.size(), 64, [&](size_t begin, size_t end) {
        Caster::Batch batch(caster);
        for (size_t i = begin; i < end; ++i)
            batch.add(
                fronts[i], rays,
                std::span(lists.targets).subspan(lists.firstTarget[i] + rays, counts[i] - rays));
        batch.finish();
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
    const size_t raysOfBack = std::max<size_t>(rays / kFewerOfBacks, 1);
    lists.targets.reserve(surfels * (rays + raysOfBack)); // what stays empty takes hardly any
    std::vector<Side> sides(surfels, Side{0});
    for (uint32_t s = 0; s < surfels; ++s) sides[s] = Side::front(s);
    Progress::Stage stage(progress, "rays", 5 * size_t{surfels} / 2); // half of all backs are met
    castFronts(caster, sides, rays, lists, stage);
    size_t first = 0;
    for (int generation = 0; generation < kGenerationsOfBacks; ++generation) {
        const std::vector<Side> backs = newBacks(lists, first);
        first = lists.sideOfList.size();
        castEvenly(caster, backs, raysOfBack, lists, stage);
    }
    tellPartsApart(texels, lists);
    return lists;
}

} // namespace relamp
