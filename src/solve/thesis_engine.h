#pragma once

#include "gpu/device.h"
#include "relamp/devices.h"
#include "relamp/error.h"
#include "scan/texels.h"
#include "shading/texel_shading.h"
#include "shading/thesis.h"
#include "solve/thesis_gpu.h"

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace relamp
{

/// What computes the thesis's stages: the CPU or a GPU, as the options say. Both give the same,
/// within what thesis_gpu_test.cpp says.
///
/// An engine that nobody asked for and that fails hands over to the CPU.
class ThesisEngine
{
public:
    /// `texels` must outlive this. Throws Error(device) where a GPU is asked for and
    /// there is none.
    ThesisEngine(const Texels& texels, const EngineOptions& options);
    ~ThesisEngine();

    /// As `stages` do it, which are the CPU's of the same texels.
    ThesisShading solve(ThesisStages& stages, const Lights& lights, const ThesisOptions& dials,
                        Progress& progress);
    /// As shade(), of the texels of a page. Thread safe; `shading` and `lights` are those of any
    /// solve().
    struct TexelsAt
    {
        size_t page;
        size_t begin; // first texel
    };
    void shadeTexels(const ThesisShading& shading, const Lights& lights, const TexelsAt& at,
                     const TexelBlock& block, ShadingBlock& out);

    /// "cpu", or the name of the GPU.
    [[nodiscard]] std::string name() const;
    /// A sentence where the CPU had to take over; else empty.
    [[nodiscard]] const std::string& note() const { return note_; }

private:
    struct Gpu;

    void giveUp(const Error& error);
    bool irradianceOnGpu(const ThesisShading& shading, const Lights& lights, const TexelsAt& at,
                         size_t count, ShadingBlock& out);

    const Texels& texels_;
    bool isFree_; // nobody asked for this engine
    std::mutex mutex_;
    std::unique_ptr<Gpu> gpu_; // null: the CPU
    std::string note_;
};

} // namespace relamp
