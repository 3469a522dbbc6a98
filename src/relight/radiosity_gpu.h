#pragma once

#include "gpu/commands.h"
#include "relight/radiosity.h"
#include "shading/gather_gpu.h"

#include <span>

#include <glm/vec3.hpp>

namespace relamp
{

/// bounce() on a GPU, for one transport and any light. Nothing leaves the device between bounces
/// but how much is still on its way.
class RadiosityGpu
{
public:
    /// `device` must outlive this.
    RadiosityGpu(const gpu::Device& device, const Transport& transport);

    /// As the function of that name.
    Bounced bounce(std::span<const glm::vec3> albedo, std::span<const glm::vec3> direct,
                   std::span<const glm::vec3> sky, const KnownLight& known = {});

private:
    void setLight(std::span<const glm::vec3> direct, std::span<const glm::vec3> sky,
                  const KnownLight& known);
    float start();
    float bounceOnce(size_t step, float weight);
    void arrive();
    float meanSent(gpu::Commands& commands);
    void send(gpu::Commands& commands, const gpu::Array<glm::vec4>& irradiance, bool ofClusters,
              size_t count);

    const gpu::Device& device_;
    GatherGpu gather_;
    gpu::Program start_;
    gpu::Program bounce_;
    gpu::Program sides_;

    size_t clusters_;
    size_t beyond_; // radiances that are no surface's
    GpuSightLists ofClusters_;
    GpuSightLists ofFronts_;
    gpu::Array<uint32_t> firstMember_; // of clusters
    gpu::Array<uint32_t> member_;
    gpu::Array<uint32_t> clusterOf_; // of sides
    gpu::Array<uint32_t> surfel_;
    gpu::Array<float> weight_;

    float scale_ = 1.0f;           // of all light on the device, so that it suits halves
    gpu::Array<glm::vec4> albedo_; // of surfels
    gpu::Array<glm::vec4> direct_; // on sides
    gpu::Array<glm::vec4> met_;    // of that, what is not known
    gpu::Array<glm::vec4> known_;  // irradiance on fronts by what is
    gpu::Array<glm::uvec2> sky_;   // what lies beyond
    gpu::Array<glm::vec4> albedoOfClusters_;
    gpu::Array<glm::vec4> irradiance_; // on clusters, by all bounces
    gpu::Array<glm::uvec2> sent_;      // by clusters and what lies beyond
    gpu::Array<glm::uvec2> sentBySides_;
    GpuGathered arriving_; // on clusters
    GpuGathered onFronts_;
    gpu::Array<float> sums_;
    gpu::Buffer readSums_;
};

} // namespace relamp
