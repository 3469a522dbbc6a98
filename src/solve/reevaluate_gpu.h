#pragma once

#include "albedo/page_layers_gpu.h"
#include "image/padding_gpu.h"
#include "scan/texels_gpu.h"
#include "shading/lamp_terms_gpu.h"
#include "shading/lit_sides_gpu.h"
#include "solve/page_irradiance.h"
#include "solve/reevaluate.h"
#include "solve/resident_pages.h"
#include "solve/stage_inputs.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace relamp
{

/// reevaluate() on a GPU, from powers to layers. Of texels nothing leaves the device before these,
/// and a stage runs again only where something that it depends on is not as it was. What lamps do
/// to texels at radiance 1 is computed once and kept.
///
/// Pages stay on the device where `budget` lets them; else they take turns.
class ReevaluateGpu
{
public:
    /// `texels` and the device must outlive this. `budget` as ResidentPages.
    ReevaluateGpu(const gpu::Device& device, const Texels& texels, const SolvedRoom& room,
                  uint64_t budget = 0);
    ~ReevaluateGpu();

    /// The light of the room's surfels. `shines` as shinesOf() these powers.
    std::vector<gpu::Timing> gather(const LampPowers& powers, std::span<const uint8_t> shines);
    /// Shading of one page under the powers of gather(), which came before. What is read below is
    /// this page's.
    std::vector<gpu::Timing> shade(size_t page);
    /// What is said of surfels under these powers; its shading is passed over.
    void setSurfels(const SolvedTexels& solved);
    /// Shading of a page and its layers, as makeLayers(); setSurfels() came before.
    std::vector<gpu::Timing> divide(size_t page, const AlbedoOptions& options);

    /// Of surfels: irradiance that came from no lamp; w: share of the light that is there.
    [[nodiscard]] std::vector<glm::vec4> indirectOnSurfels() const;
    /// Irradiance from surfaces that do not shine, one a hit list.
    [[nodiscard]] std::vector<glm::vec4> gathered() const { return sides_.gathered().download(); }
    /// Of the last page: irradiance by texel.
    [[nodiscard]] PageIrradiance irradiance() const;
    /// Of the last page that was divided.
    [[nodiscard]] PageLayers layers() const;

private:
    struct Page;

    void takeLayers(gpu::Commands& commands, size_t page);

    const gpu::Device& device_;
    const Texels& texels_;
    gpu::Program shade_;
    GpuSurfels surfels_;
    LitSidesGpu sides_;
    LampTermsGpu lamps_;
    PageLayersGpu layers_;
    PaddingGpu padding_;
    gpu::Array<uint32_t> termsOfLists_;
    gpu::Array<glm::uvec2> directOfLists_;
    ResidentPages<Page> pages_;
    std::optional<LayerPictures> pictures_; // of the page that was divided last
    size_t picturesOf_ = 0;
    size_t last_ = 0; // shade()

    StageInputs powers_, gathered_, divided_;
    std::vector<uint8_t> shines_; // of the last gather()
    double shining_ = 0.0;        // their version
    double said_ = 0.0;           // setSurfels()'s
};

} // namespace relamp
