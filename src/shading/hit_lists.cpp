#include "shading/hit_lists.h"

#include "base/parallel.h"
#include "scan/surface_point.h"
#include "shading/sampling.shared.h"

#include <algorithm>

namespace relamp
{
namespace
{

constexpr float kOffSurface = 2e-3f;   // m; less than things that lie on each other are apart
constexpr int kGenerationsOfBacks = 2; // backs seen by backs seen by fronts; beyond is dark anyway

class Caster
{
public:
    Caster(const Texels& texels, const RayScene& scene,
           std::span<const std::vector<uint8_t>> clipped, size_t raysPerList)
        : texels_(texels), scene_(scene), clipped_(clipped), rays_(raysPerList), sites_(texels)
    {}

    void cast(Side side, std::span<HitTarget> out) const;

private:
    [[nodiscard]] Ray rayOf(Side side, size_t i) const;
    [[nodiscard]] HitTarget targetOf(const Ray& ray, const Hit& hit) const;

    const Texels& texels_;
    const RayScene& scene_;
    std::span<const std::vector<uint8_t>> clipped_;
    size_t rays_;
    SurfelSites sites_;
};

Ray Caster::rayOf(Side side, size_t i) const
{
    const TexelSite site = sites_.at(side.surfel(), i);
    const glm::vec3 normal = side.isBack() ? -site.normal : site.normal;
    const glm::vec2 shift(hashedShift(side.index, 1), hashedShift(side.index, 2));
    return {.origin = site.position + kOffSurface * normal,
            .direction = cosineDirection(normal, evenPoint(static_cast<float>(i), shift))};
}

HitTarget Caster::targetOf(const Ray& ray, const Hit& hit) const
{
    if (hit.missed()) return HitTarget::nothing();
    const uint32_t surfel =
        texels_.surfels.find(ray.origin + hit.distance * ray.direction, normalAt(texels_, hit));
    if (surfel == Surfels::kNone) return HitTarget::nothing();
    if (!hit.front) return HitTarget::of(Side::back(surfel), false);
    const auto [page, pixel] = nearestPixelAt(texels_, hit);
    return HitTarget::of(Side::front(surfel), clipped_[page][pixel] != 0);
}

void Caster::cast(Side side, std::span<HitTarget> out) const
{
    for (size_t i = 0; i < rays_; ++i) { // one by one: they go everywhere
        const Ray ray = rayOf(side, i);
        out[i] = targetOf(ray, scene_.intersect(ray));
    }
}

/// Backs that lists from `firstList` on have met and that have no list yet, ascending.
std::vector<Side> newBacks(const HitLists& lists, size_t firstList)
{
    std::vector<uint8_t> seen(lists.listOfSide.size(), 0);
    for (size_t i = firstList * lists.raysPerList; i < lists.targets.size(); ++i) {
        const HitTarget target = lists.targets[i];
        if (!target.isNothing() && target.side().isBack()) seen[target.side().index] = 1;
    }
    std::vector<Side> backs;
    for (uint32_t side = 1; side < seen.size(); side += 2)
        if (seen[side] != 0 && lists.listOfSide[side] == HitLists::kNoList) backs.push_back({side});
    return backs;
}

} // namespace

HitLists castHitLists(const Texels& texels, const RayScene& scene,
                      std::span<const std::vector<uint8_t>> clipped, size_t raysPerList,
                      Progress& progress)
{
    const auto surfels = static_cast<uint32_t>(texels.surfels.count());
    const Caster caster(texels, scene, clipped, raysPerList);
    HitLists lists;
    lists.raysPerList = raysPerList;
    lists.listOfSide.assign(2 * size_t{surfels}, HitLists::kNoList);

    std::vector<Side> sides(surfels, Side{0});
    for (uint32_t s = 0; s < surfels; ++s) sides[s] = Side::front(s);
    Progress::Stage stage(progress, "rays", surfels);
    for (int generation = 0; generation <= kGenerationsOfBacks && !sides.empty(); ++generation) {
        const size_t first = lists.sideOfList.size();
        lists.sideOfList.insert(lists.sideOfList.end(), sides.begin(), sides.end());
        lists.targets.resize(lists.sideOfList.size() * raysPerList, HitTarget::nothing());
        for (size_t i = 0; i < sides.size(); ++i)
            lists.listOfSide[sides[i].index] = static_cast<int32_t>(first + i);
        forEachChunk(sides.size(), 64, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i)
                caster.cast(sides[i],
                            {lists.targets.data() + (first + i) * raysPerList, raysPerList});
            if (generation == 0) stage.advance(end - begin);
        });
        sides = newBacks(lists, first);
    }
    return lists;
}

} // namespace relamp
