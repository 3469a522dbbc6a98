#pragma once

#include "gpu/commands.h"
#include "scan/texels_gpu.h"
#include "shading/gathered_light.h"
#include "shading/lamp_terms.gpu.h"

#include <span>
#include <vector>

namespace relamp
{

/// What every lamp brings to places at radiance 1, kept: where only powers change, the light of all
/// lamps is a sum of products.
class LampTermsGpu
{
public:
    /// `scales` are of the lamps: their terms are kept times this, as halves.
    LampTermsGpu(const gpu::Device& device, const Surfels& surfels, const CastLamps& lamps,
                 std::vector<float> scales);

    /// From these commands on lamps shine like this; one call before the commands run.
    void setPowers(gpu::Commands& commands, std::span<const glm::vec3> radiance);

    /// Terms of places that are known already: onPlaces[lamp][place].
    [[nodiscard]] gpu::Array<uint32_t> keep(const std::vector<std::vector<float>>& onPlaces,
                                            size_t places) const;
    /// Terms of the texels of a page: open irradiance of the lamp's patches, as much of it as is
    /// seen. `terms` has termsOf(lamps, texels) elements.
    void keep(gpu::Commands& commands, const GpuTexels& page, const GpuSurfels& surfels,
              const gpu::Array<uint32_t>& terms) const;
    static size_t termsOf(size_t lamps, size_t places) { return (lamps + 1) / 2 * places; }

    /// For programs: kept terms under the powers that were set.
    [[nodiscard]] LampTerms lit(const gpu::Array<uint32_t>& terms, size_t places) const;
    /// Irradiance on places, as halves.
    void sum(gpu::Commands& commands, const gpu::Array<uint32_t>& terms,
             const gpu::Array<glm::uvec2>& irradiance) const;

private:
    /// A lamp, and who sees how much of it.
    struct Lamp
    {
        gpu::Array<glm::uvec4> patches;
        gpu::Array<uint32_t> seen;
        gpu::Array<uint32_t> shares;
    };

    const gpu::Device& device_;
    gpu::Program keep_;
    gpu::Program sum_;
    std::vector<float> scales_;
    std::vector<Lamp> lamps_;
    gpu::Array<glm::vec4> probes_;
    gpu::Array<glm::uvec2> probesOf_;
    gpu::Array<glm::vec4> radiance_; // over the scales
    gpu::Buffer written_;            // likewise, on its way there
};

} // namespace relamp
