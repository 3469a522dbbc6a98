#pragma once

#include "image/padding_gpu.h"
#include "relamp/delight.h"
#include "relamp/lights.h"
#include "relamp/thesis.h"
#include "scan/texels_gpu.h"
#include "solve/resident_pages.h"
#include "solve/stage_inputs.h"
#include "thesis/direct_gpu.h"
#include "thesis/divide_gpu.h"
#include "thesis/flatten_gpu.h"
#include "thesis/lpv_gpu.h"
#include "thesis/rsm_gpu.h"

#include <memory>
#include <vector>

namespace relamp
{

/// What a frame of the thesis depends on beside the room.
struct ThesisFrame
{
    Lights lights;
    ThesisOptions parameters; // as deriveParameters() fills them in; power left open is 1
    glm::vec3 ambient{0.0f};
    float darkest = AlbedoOptions{}.darkest;
};

/// The thesis solver on a GPU, frame after frame. Between its stages nothing leaves the device, and
/// a stage runs again only where something that it depends on is not as it was.
///
/// Pages stay on the device where `budget` lets them; else they take turns.
class ThesisGpu
{
public:
    /// `texels` and the device must outlive this. `budget` is in bytes, 0: four fifths of the
    /// device's memory.
    ThesisGpu(const gpu::Device& device, const Texels& texels, uint64_t budget = 0);
    ~ThesisGpu();

    /// The bounce light of a frame, as solveThesis() finds it.
    std::vector<gpu::Timing> bounce(const ThesisFrame& frame);
    /// Light and albedo of one page; bounce() came before. What is read below is this page's.
    std::vector<gpu::Timing> page(const ThesisFrame& frame, size_t page);
    /// Makes the next frame compute everything.
    void forget();

    /// Bounce light, for the CPU to read out.
    [[nodiscard]] std::shared_ptr<const Lpv> volume() const;
    /// Of the last page: irradiance before power and ambient, by texel, and albedo by pixel. RGB as
    /// halves in two numbers; the last half of an albedo is 1 where a texel is.
    [[nodiscard]] std::vector<glm::uvec2> direct() const;
    [[nodiscard]] std::vector<glm::uvec2> indirect() const;
    [[nodiscard]] std::vector<glm::uvec2> albedo() const;
    [[nodiscard]] std::vector<uint32_t> flattened() const;
    [[nodiscard]] const RsmGpu& maps() const { return maps_; }

private:
    struct Page;

    void flattenPages(const ThesisOptions& parameters, bool colorsAgain,
                      std::vector<gpu::Timing>& timings);

    const gpu::Device& device_;
    const Texels& texels_;

    FlattenGpu flatten_;
    DirectGpu direct_;
    RsmGpu maps_;
    LpvGpu volume_;
    LpvGrid grid_;
    DivideGpu divide_;
    PaddingGpu padding_;

    GpuSurfels surfels_;
    GpuSurface surface_;
    ResidentPages<Page> pages_;
    size_t last_ = 0; // page()

    StageInputs cells_, lights_, views_, colors_, blocking_, spreading_;
};

} // namespace relamp
