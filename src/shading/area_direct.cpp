#include "shading/area_direct.h"

#include "shading/area_direct.shared.h"
#include "shading/mesh_noise.shared.h"

#include <algorithm>
#include <cmath>

namespace relamp
{

void AreaSampler::add(std::span<const TexelSite> sites, size_t samples, float shift,
                      AreaSample& sum)
{
    const auto count = static_cast<float>(sites.size());
    const float perSample = light_.area() / (static_cast<float>(samples) * count);
    for (size_t k = 0; k < sites.size(); ++k) {
        const glm::vec3 normal = sites[k].normal;
        const glm::vec3 origin = sites[k].position + kOffSurface * normal;
        const float shifted = (static_cast<float>(k) + shift) / count;
        for (size_t i = 0; i < samples; ++i) {
            const ClippedPatch& patch =
                light_.at((static_cast<float>(i) + shifted) / static_cast<float>(samples));
            const size_t n = looking_;
            looks_.fromX[n] = origin.x;
            looks_.fromY[n] = origin.y;
            looks_.fromZ[n] = origin.z;
            looks_.nx[n] = normal.x;
            looks_.ny[n] = normal.y;
            looks_.nz[n] = normal.z;
            looks_.toX[n] = patch.position.x;
            looks_.toY[n] = patch.position.y;
            looks_.toZ[n] = patch.position.z;
            looks_.fx[n] = patch.normal.x;
            looks_.fy[n] = patch.normal.y;
            looks_.fz[n] = patch.normal.z;
            looks_.patch[n] = patch.area;
            looks_.area[n] = perSample;
            looks_.sum[n] = &sum;
            if (++looking_ == kBatch) look();
        }
    }
}

/// Always by the same instructions: whether a ray just passes an edge must not depend on the
/// machine.
void AreaSampler::look()
{
    float received[kBatch];
    float wayX[kBatch], wayY[kBatch], wayZ[kBatch], distance[kBatch];
    for (size_t i = 0; i < looking_; ++i) {
        const glm::vec3 way(looks_.toX[i] - looks_.fromX[i], looks_.toY[i] - looks_.fromY[i],
                            looks_.toZ[i] - looks_.fromZ[i]);
        const glm::vec3 normal(looks_.nx[i], looks_.ny[i], looks_.nz[i]);
        const glm::vec3 facing(looks_.fx[i], looks_.fy[i], looks_.fz[i]);
        received[i] = looks_.area[i] * patchFormFactor(way, normal, facing, looks_.patch[i]);
        if (geometry_ == Geometry::scanned)
            received[i] *= shareBeyondMeshNoise(way, normal, facing);
        distance[i] = glm::length(way);
        wayX[i] = way.x / distance[i];
        wayY[i] = way.y / distance[i];
        wayZ[i] = way.z / distance[i];
    }
    for (size_t i = 0; i < looking_; ++i) {
        looks_.sum[i]->open += received[i];
        // No branch, which would be guessed wrong too often: the next takes the place of what
        // receives nothing.
        Ray& ray = rays_[count_];
        ray.origin = {looks_.fromX[i], looks_.fromY[i], looks_.fromZ[i]};
        ray.direction = {wayX[i], wayY[i], wayZ[i]};
        ray.farthest = std::max(distance[i] - kOffLamp, 0.0f);
        gain_[count_] = received[i];
        sum_[count_] = looks_.sum[i];
        count_ += received[i] > 0.0f ? size_t{1} : size_t{0};
        if (count_ == kBatch) trace();
    }
    looking_ = 0;
}

void AreaSampler::trace()
{
    uint8_t blocked[kBatch];
    scene_.occluded({rays_, count_}, {blocked, count_});
    for (size_t i = 0; i < count_; ++i) sum_[i]->visible += blocked[i] != 0 ? 0.0f : gain_[i];
    count_ = 0;
}

void AreaSampler::finish()
{
    look();
    trace();
}

AreaSample sampleAreaLight(const RayScene& scene, const AreaLight& light, glm::vec3 position,
                           glm::vec3 normal, size_t samples, float shift)
{
    const TexelSite site{position, normal};
    AreaSample sum;
    AreaSampler sampler(scene, light, Geometry::exact);
    sampler.add({&site, 1}, samples, shift, sum);
    sampler.finish();
    return sum;
}

} // namespace relamp
