#pragma once

#include "gpu/twin.h"
#include "relamp/devices.h"
#include "scan/texels.h"
#include "shading/texel_shading.h"
#include "solve/page_irradiance.h"
#include "thesis/thesis_gpu.h"
#include "thesis/thesis_shading.h"

#include <memory>
#include <mutex>
#include <string>

namespace relamp
{

/// What computes the thesis's stages: the CPU or a GPU, as the options say. Both give the same,
/// within what thesis_gpu_test.cpp says. It hands over as gpu::Twin does.
class ThesisEngine
{
public:
    /// `texels` must outlive this. Throws Error(device) where a GPU is asked for and
    /// there is none.
    ThesisEngine(const Texels& texels, const EngineOptions& options);

    /// As `stages` do it, which are the CPU's of the same texels.
    ThesisShading solve(ThesisStages& stages, const Lights& lights, const ThesisOptions& parameters,
                        Progress& progress);
    /// As shade(), of the texels of a page. Thread safe; `shading` and `lights` are those of any
    /// solve().
    void shadeTexels(const ThesisShading& shading, const Lights& lights, const TexelsAt& at,
                     const TexelBlock& block, ShadingBlock& out);

    /// As gpu::Twin.
    [[nodiscard]] gpu::InForce inForce() const;

private:
    std::shared_ptr<const PageIrradiance> irradianceOf(const ThesisShading& shading,
                                                       const Lights& lights, size_t page);

    const Texels& texels_;
    mutable std::mutex mutex_;
    gpu::Twin<ThesisGpu> gpu_;
    // The page that was asked for last, and the shading that it was asked of; none: null.
    std::shared_ptr<const PageIrradiance> irradiance_;
    const ThesisShading* lit_ = nullptr;
    size_t page_ = 0;
};

} // namespace relamp
