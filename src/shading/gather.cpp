#include "shading/gather.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "shading/gather.shared.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace relamp
{
namespace
{

constexpr size_t kChunk = 256; // lists

/// Radiance that a ray meets; nothing from lamps, whose light is direct.
glm::vec3 radianceAt(const RadianceField& field, HitTarget target)
{
    if (target.isNothing()) return field.outside[target.part()];
    const uint32_t surfel = target.side().surfel();
    if (target.side().isBack()) return field.back[surfel];
    if (!target.isClipped()) return field.plain[surfel];
    return field.shines[surfel] != 0 ? glm::vec3(0.0f) : field.clipped[surfel];
}

bool isPlain(HitTarget target)
{
    return !target.isNothing() && !target.side().isBack() && !target.isClipped();
}

void addPart(MissedLight more, std::vector<MissedLight>& sum)
{
    const auto at = std::ranges::lower_bound(sum, more.part, {}, &MissedLight::part);
    if (at != sum.end() && at->part == more.part)
        at->irradiance += more.irradiance;
    else
        sum.insert(at, more);
}

} // namespace

RadianceField fieldOf(const SurfelRadiance& radiance)
{
    const size_t surfels = radiance.plain.size();
    RadianceField field{.plain = radiance.plain,
                        .clipped = std::vector<glm::vec3>(surfels, glm::vec3(1.0f)),
                        .back = std::vector<glm::vec3>(surfels, glm::vec3(0.0f)),
                        .shines = std::vector<uint8_t>(surfels, 0)};
    for (const ClippedPatch& patch : radiance.clipped) field.clipped[patch.surfel] = patch.radiance;
    for (size_t s = 0; s < surfels; ++s)
        for (glm::vec3* shown : {&field.plain[s], &field.clipped[s]})
            *shown = radiance.sent(s, *shown);
    return field;
}

Gathered gather(const HitLists& hits, const RadianceField& field, std::span<const uint32_t> lists)
{
    const size_t count = lists.empty() ? hits.sideOfList.size() : lists.size();
    Gathered result;
    result.irradiance.resize(count);
    result.noise.resize(count);
    result.missed.resize(count);
    forEachChunk(count, kChunk, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            glm::vec3 sum(0.0f);
            float squares = 0.0f;
            float missed = 0.0f;
            const std::span targets = hits.targetsOf(lists.empty() ? i : lists[i]);
            for (const HitTarget target : targets) {
                if (target.isNothing()) missed += 1.0f;
                const glm::vec3 radiance = radianceAt(field, target);
                sum += radiance;
                squares += luminance(radiance) * luminance(radiance);
            }
            const auto rays = static_cast<float>(targets.size());
            result.noise[i] = noiseOfRays(luminance(sum), squares, rays);
            result.irradiance[i] = irradiancePerRay(rays) * sum;
            result.missed[i] = irradiancePerRay(rays) * missed;
        }
    });
    return result;
}

std::vector<MissedLight> missedOf(const HitLists& hits, uint32_t list)
{
    std::vector<MissedLight> missed;
    const std::span targets = hits.targetsOf(list);
    const float perRay = irradiancePerRay(static_cast<float>(targets.size()));
    for (const HitTarget target : targets)
        if (target.isNothing()) addPart({target.part(), perRay}, missed);
    return missed;
}

void addMissed(std::span<const MissedLight> more, float weight, std::vector<MissedLight>& sum)
{
    for (const auto [part, irradiance] : more) addPart({part, weight * irradiance}, sum);
}

SettlingGather::SettlingGather(const HitLists& hits, const RadianceField& field,
                               std::span<const uint32_t> lists)
{
    const size_t count = lists.empty() ? hits.sideOfList.size() : lists.size();
    const auto targetsOf = [&](size_t i) { return hits.targetsOf(lists.empty() ? i : lists[i]); };
    plain_.irradiance.resize(count);
    plain_.missed.resize(count);
    perRay_.resize(count);
    firstOther_.resize(count + 1);
    forEachChunk(count, kChunk, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const std::span targets = targetsOf(i);
            const auto plain = std::ranges::count_if(targets, isPlain);
            const auto missed = std::ranges::count_if(targets, &HitTarget::isNothing);
            firstOther_[i + 1] = static_cast<uint32_t>(targets.size() - static_cast<size_t>(plain));
            perRay_[i] = irradiancePerRay(static_cast<float>(targets.size()));
            plain_.missed[i] = perRay_[i] * static_cast<float>(missed);
        }
    });
    std::partial_sum(firstOther_.begin(), firstOther_.end(), firstOther_.begin());
    others_.resize(firstOther_.back(), HitTarget::nothing());
    forEachChunk(count, kChunk, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            std::ranges::remove_copy_if(targetsOf(i), others_.begin() + firstOther_[i], isPlain);
    });
    takePlain(hits, field, lists);
}

void SettlingGather::takePlain(const HitLists& hits, const RadianceField& field,
                               std::span<const uint32_t> lists)
{
    assert(perRay_.size() == (lists.empty() ? hits.sideOfList.size() : lists.size()));
    forEachChunk(perRay_.size(), kChunk, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            glm::vec3 sum(0.0f);
            for (const HitTarget target : hits.targetsOf(lists.empty() ? i : lists[i]))
                if (isPlain(target)) sum += field.plain[target.side().surfel()];
            plain_.irradiance[i] = perRay_[i] * sum;
        }
    });
}

Gathered SettlingGather::gather(const RadianceField& field) const
{
    Gathered result = plain_;
    forEachChunk(result.irradiance.size(), 1024, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            glm::vec3 sum(0.0f);
            for (uint32_t k = firstOther_[i]; k < firstOther_[i + 1]; ++k)
                sum += radianceAt(field, others_[k]);
            result.irradiance[i] += perRay_[i] * sum;
        }
    });
    return result;
}

} // namespace relamp
