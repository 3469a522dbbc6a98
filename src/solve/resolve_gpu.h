#pragma once

#include "albedo/divide_gpu.h"
#include "scan/texels_gpu.h"
#include "shading/lamp_terms_gpu.h"
#include "shading/lit_sides_gpu.h"
#include "solve/page_irradiance.h"
#include "solve/resident_pages.h"
#include "solve/resolve.h"
#include "solve/stage_inputs.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relamp
{

/// resolve() on a GPU, from powers to albedo. Between its stages nothing leaves the device, and a
/// stage runs again only where something that it depends on is not as it was. What lamps do to
/// texels at radiance 1 is computed once and kept.
///
/// Pages stay on the device where `budget` lets them; else they take turns.
class ResolveGpu
{
public:
    /// `texels` and the device must outlive this. `budget` as ResidentPages.
    ResolveGpu(const gpu::Device& device, const Texels& texels, const SolvedRoom& room,
               uint64_t budget = 0);
    ~ResolveGpu();

    /// The light of the room's surfels. `shines` as FoundRoom under these powers.
    std::vector<gpu::Timing> gather(const LampPowers& powers, std::span<const uint8_t> shines);
    /// Shading of one page under the powers of gather(), which came before. What is read below is
    /// this page's.
    std::vector<gpu::Timing> shade(size_t page);
    /// And its albedo. `darkest` as AlbedoOptions.
    std::vector<gpu::Timing> divide(size_t page, float darkest);

    /// Of surfels: irradiance that came from no lamp; w: share of the light that is there.
    [[nodiscard]] std::vector<glm::vec4> indirectOnSurfels() const;
    /// Irradiance from surfaces that do not shine, one a hit list.
    [[nodiscard]] std::vector<glm::vec4> gathered() const { return sides_.gathered().download(); }
    /// Of the last page: irradiance by texel.
    [[nodiscard]] PageIrradiance irradiance() const;
    /// Of the last page that was divided, by pixel: RGB as halves in two numbers; the last half is
    /// 1 where a texel is.
    [[nodiscard]] std::vector<glm::uvec2> albedo() const;

private:
    struct Page;

    const gpu::Device& device_;
    gpu::Program shade_;
    GpuSurfels surfels_;
    LitSidesGpu sides_;
    LampTermsGpu lamps_;
    DivideGpu divide_;
    gpu::Array<uint32_t> termsOfLists_;
    gpu::Array<glm::uvec2> directOfLists_;
    gpu::Array<float> stray_;
    ResidentPages<Page> pages_;
    size_t last_ = 0; // shade()

    StageInputs powers_, gathered_;
    std::vector<uint8_t> shines_; // of the last gather()
    double shining_ = 0.0;        // their version
};

} // namespace relamp
