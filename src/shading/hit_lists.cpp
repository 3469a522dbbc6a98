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

/// Casts the lists of `sides`: of fronts a first half of the rays, then the others where these
/// do not agree.
void castSides(const Caster& caster, std::span<const Side> sides, size_t raysOfSide,
               HitLists& lists, Progress::Stage& stage)
{
    const size_t first = lists.sideOfList.size();
    const bool areFronts = first == 0;
    for (size_t i = 0; i < sides.size(); ++i)
        lists.listOfSide[sides[i].index] = static_cast<int32_t>(first + i);
    lists.sideOfList.insert(lists.sideOfList.end(), sides.begin(), sides.end());

    const size_t rays = areFronts ? (raysOfSide + 1) / 2 : raysOfSide;
    std::vector<HitTarget> few(sides.size() * rays, HitTarget::nothing());
    std::vector<Met> met(sides.size());
    const auto ofList = [&](size_t i) { return std::span(few).subspan(i * rays, rays); };
    forEachChunk(sides.size(), 64, [&](size_t begin, size_t end) {
        Caster::Batch batch(caster);
        for (size_t i = begin; i < end; ++i) batch.add(sides[i], 0, ofList(i));
        batch.finish();
        for (size_t i = begin; i < end; ++i) met[i] = caster.metBy(ofList(i));
        stage.advance(end - begin);
    });
    const std::vector<uint32_t> counts =
        areFronts ? caster.raysOf(met, rays, raysOfSide)
                  : std::vector<uint32_t>(sides.size(), static_cast<uint32_t>(rays));
    for (const uint32_t count : counts)
        lists.firstTarget.push_back(lists.firstTarget.back() + count);
    lists.targets.resize(lists.firstTarget.back(), HitTarget::nothing());
    forEachChunk(sides.size(), 64, [&](size_t begin, size_t end) {
        Caster::Batch batch(caster);
        for (size_t i = begin; i < end; ++i) {
            const std::span out(lists.targets.data() + lists.firstTarget[first + i], counts[i]);
            std::copy_n(ofList(i).begin(), rays, out.begin());
            batch.add(sides[i], rays, out.subspan(rays));
        }
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
    std::vector<Side> sides(surfels, Side{0});
    for (uint32_t s = 0; s < surfels; ++s) sides[s] = Side::front(s);
    Progress::Stage stage(progress, "rays", 3 * size_t{surfels}); // backs are about half as many
    for (int generation = 0; generation <= kGenerationsOfBacks && !sides.empty(); ++generation) {
        const size_t first = lists.sideOfList.size();
        const size_t ofSide = generation == 0 ? rays : std::max<size_t>(rays / kFewerOfBacks, 1);
        castSides(caster, sides, ofSide, lists, stage);
        sides = newBacks(lists, first);
    }
    tellPartsApart(texels, lists);
    return lists;
}

} // namespace relamp
