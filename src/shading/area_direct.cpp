#include "shading/area_direct.h"

#include "base/lanes.h"
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

struct OpenArgs
{
    const TexelBlock* block;
    const LampPatches* lamp;
    float* irradiance;
};

void openKernel(const OpenArgs& args)
{
    const TexelBlock& block = *args.block;
    const LampPatches& lamp = *args.lamp;
    const size_t patches = lamp.x.size();
    for (size_t first = 0; first < block.count; first += kLanes) {
        float sum[kLanes] = {};
        for (size_t j = 0; j < patches; ++j) {
            const glm::vec3 patch(lamp.x[j], lamp.y[j], lamp.z[j]);
            const glm::vec3 facing(lamp.nx[j], lamp.ny[j], lamp.nz[j]);
            for (size_t lane = 0; lane < kLanes; ++lane) {
                const size_t i = first + lane;
                const glm::vec3 way = patch - glm::vec3(block.x[i], block.y[i], block.z[i]);
                const glm::vec3 normal(block.nx[i], block.ny[i], block.nz[i]);
                sum[lane] += patchFormFactor(way, normal, facing, lamp.area);
            }
        }
        for (size_t lane = 0; lane < kLanes; ++lane)
            args.irradiance[first + lane] = sum[lane] * lamp.area;
    }
}

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

LampPatches::LampPatches(const AreaLight& light, size_t count)
    : area(light.area() / static_cast<float>(count))
{
    for (size_t i = 0; i < count; ++i) {
        const ClippedPatch& patch =
            light.at((static_cast<float>(i) + 0.5f) / static_cast<float>(count));
        x.push_back(patch.position.x);
        y.push_back(patch.position.y);
        z.push_back(patch.position.z);
        nx.push_back(patch.normal.x);
        ny.push_back(patch.normal.y);
        nz.push_back(patch.normal.z);
    }
}

void openIrradiance(const TexelBlock& block, const LampPatches& lamp, float* irradiance,
                    InstructionSet set)
{
    const OpenArgs args{&block, &lamp, irradiance};
    runKernel<openKernel>(set, args);
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
