#pragma once

#include "scan/texels_gpu.h"
#include "shading/gather_gpu.h"
#include "shading/lit_sides.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relamp
{

/// What of a room's surfels light has no part in.
struct SurfelTraits
{
    std::span<const uint8_t> shines; // not 0: its burnt-out texels are a lamp's
    std::span<const float> lit;      // share of the light found that is there; empty: all
};

/// lightSides() and indirectOfFronts() on a GPU.
class LitSidesGpu
{
public:
    /// `device` must outlive this.
    LitSidesGpu(const gpu::Device& device, const HitLists& hits, const SurfelRadiance& radiance,
                const SurfelTraits& traits);

    /// As SurfelTraits::shines, from now on.
    void setShining(std::span<const uint8_t> shines);
    void setOutside(const OutsideLight& outside);

    /// Settles the light of all sides and finds indirect(). `direct` is irradiance from all lamps,
    /// one a list, as halves.
    void light(gpu::Commands& commands, const GpuSurfels& surfels,
               const gpu::Array<glm::uvec2>& direct) const;

    /// Irradiance at surfels' fronts that did not come from a lamp; w: `lit`.
    [[nodiscard]] const gpu::Array<glm::vec4>& indirect() const { return indirect_; }
    /// Irradiance from surfaces that do not shine at all sides, one entry a list.
    [[nodiscard]] const gpu::Array<glm::vec4>& gathered() const { return gathered_; }
    [[nodiscard]] size_t lists() const { return lists_.count; }

private:
    void settle(gpu::Commands& commands, const GpuSurfels& surfels,
                const gpu::Array<glm::uvec2>& direct) const;

    size_t surfels_;
    std::vector<uint32_t> knows_;   // traits of surfels where none shines,
    std::vector<glm::uvec2> shown_; // and what they send then
    std::vector<glm::uvec2> begin_; // the field before anything is known
    GatherGpu gather_;
    gpu::Program litSides_;
    gpu::Program excess_;
    gpu::Program mean_;
    gpu::Program indirectOf_;

    GpuSightLists lists_;
    gpu::Array<int32_t> backOf_;
    gpu::Array<glm::uvec2> burntOut_;
    gpu::Array<glm::uvec2> white_;
    gpu::Array<uint32_t> traits_;
    gpu::Array<float> lit_;
    gpu::Array<glm::uvec2> start_; // begin_
    gpu::Array<glm::uvec2> field_;
    gpu::Array<glm::uvec2> evenField_; // nothing in it sends more than white
    SettlingGatherGpu settling_;
    gpu::Array<glm::vec4> gathered_;
    GpuGathered even_; // of fronts
    gpu::Array<glm::vec4> work_[2];
    gpu::Array<glm::vec4> indirect_;
};

} // namespace relamp
