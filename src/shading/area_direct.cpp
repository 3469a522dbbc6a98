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
constexpr size_t kBatch = 32;

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
    for (const ClippedPatch& patch : patches_)
        radius_ = std::max(radius_, glm::distance(patch.position, centre_) + std::sqrt(patch.area));
}

const ClippedPatch& AreaLight::at(float share) const
{
    const auto found = std::lower_bound(areaUpTo_.begin(), areaUpTo_.end(), share * area());
    const auto index =
        std::min<size_t>(static_cast<size_t>(found - areaUpTo_.begin()), patches_.size() - 1);
    return patches_[index];
}

AreaSample sampleAreaLight(const RayScene& scene, const AreaLight& light, glm::vec3 position,
                           glm::vec3 normal, size_t samples, float shift)
{
    const glm::vec3 origin = position + kOffSurface * normal;
    const float perSample = light.area() / static_cast<float>(samples);
    AreaSample sum;
    for (size_t first = 0; first < samples; first += kBatch) {
        Ray rays[kBatch];
        float gain[kBatch];
        size_t count = 0;
        for (size_t i = first; i < std::min(first + kBatch, samples); ++i) {
            const float share = (static_cast<float>(i) + shift) / static_cast<float>(samples);
            const ClippedPatch& patch = light.at(share);
            const glm::vec3 way = patch.position - origin;
            const float received =
                perSample * patchFormFactor(way, normal, patch.normal, patch.area);
            if (received <= 0.0f) continue;
            sum.open += received;
            const float distance = glm::length(way);
            gain[count] = received;
            rays[count++] = {.origin = origin,
                             .direction = way / distance,
                             .farthest = std::max(distance - kOffLamp, 0.0f)};
        }
        uint8_t blocked[kBatch];
        scene.occluded({rays, count}, {blocked, count});
        for (size_t i = 0; i < count; ++i) sum.visible += blocked[i] ? 0.0f : gain[i];
    }
    return sum;
}

} // namespace relamp
