#include "shading/area_direct.h"

#include "shading/area_direct.shared.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace relamp
{
namespace
{

constexpr float kOffSurface = 2e-3f; // m, at the lit end
constexpr float kOffLamp = 0.015f;   // m, at the lamp's: its surface is as uneven as any of a scan

} // namespace

AreaLight::AreaLight(std::vector<ClippedPatch> patches) : patches_(std::move(patches))
{
    float area = 0.0f;
    for (const ClippedPatch& patch : patches_) {
        area += patch.area;
        areaUpTo_.push_back(area);
        centre_ += patch.area * patch.position;
    }
    centre_ /= area;
    firstOfShare_.resize(patches_.size());
    for (size_t step = 0, first = 0; step < patches_.size(); ++step) {
        const float share = static_cast<float>(step) / static_cast<float>(patches_.size());
        while (first + 1 < patches_.size() && areaUpTo_[first] < share * area) ++first;
        firstOfShare_[step] = static_cast<uint32_t>(first);
    }
    for (const ClippedPatch& patch : patches_)
        radius_ = std::max(radius_, glm::distance(patch.position, centre_) + std::sqrt(patch.area));
}

const ClippedPatch& AreaLight::at(float share) const
{
    const auto steps = static_cast<float>(firstOfShare_.size());
    const auto step = std::min(static_cast<size_t>(share * steps), firstOfShare_.size() - 1);
    size_t index = firstOfShare_[step];
    const float wanted = share * area();
    while (index + 1 < patches_.size() && areaUpTo_[index] < wanted) ++index;
    return patches_[index];
}

void AreaSampler::add(std::span<const TexelSite> sites, size_t samples, float shift,
                      AreaSample& sum)
{
    const auto count = static_cast<float>(sites.size());
    const float perSample = light_.area() / (static_cast<float>(samples) * count);
    for (size_t k = 0; k < sites.size(); ++k) {
        const glm::vec3 origin = sites[k].position + kOffSurface * sites[k].normal;
        const float shifted = (static_cast<float>(k) + shift) / count;
        for (size_t i = 0; i < samples; ++i) {
            const ClippedPatch& patch =
                light_.at((static_cast<float>(i) + shifted) / static_cast<float>(samples));
            const glm::vec3 way = patch.position - origin;
            const float received =
                perSample * patchFormFactor(way, sites[k].normal, patch.normal, patch.area);
            if (received <= 0.0f) continue;
            sum.open += received;
            const float distance = glm::length(way);
            rays_[count_] = {.origin = origin,
                             .direction = way / distance,
                             .farthest = std::max(distance - kOffLamp, 0.0f)};
            gain_[count_] = received;
            sum_[count_] = &sum;
            if (++count_ == kBatch) finish();
        }
    }
}

void AreaSampler::finish()
{
    uint8_t blocked[kBatch];
    scene_.occluded({rays_, count_}, {blocked, count_});
    for (size_t i = 0; i < count_; ++i) sum_[i]->visible += blocked[i] != 0 ? 0.0f : gain_[i];
    count_ = 0;
}

AreaSample sampleAreaLight(const RayScene& scene, const AreaLight& light, glm::vec3 position,
                           glm::vec3 normal, size_t samples, float shift)
{
    const TexelSite site{position, normal};
    AreaSample sum;
    AreaSampler sampler(scene, light);
    sampler.add({&site, 1}, samples, shift, sum);
    sampler.finish();
    return sum;
}

} // namespace relamp
