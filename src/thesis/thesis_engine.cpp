#include "thesis/thesis_engine.h"

namespace relamp
{
namespace
{

ThesisFrame frameOf(const ThesisShading& shading, const Lights& lights)
{
    return {.lights = lights, .parameters = shading.parameters, .ambient = shading.ambient};
}

} // namespace

ThesisEngine::ThesisEngine(const Texels& texels, const EngineOptions& options)
    : texels_(texels), gpu_(gpu::Choice::of(options), [&texels](const gpu::Device& device) {
          return std::make_unique<ThesisGpu>(device, texels);
      })
{}

ThesisShading ThesisEngine::solve(ThesisStages& stages, const Lights& lights,
                                  const ThesisOptions& parameters, Progress& progress)
{
    const std::unique_lock lock(mutex_);
    irradiance_ = nullptr;
    ThesisShading shading{.parameters =
                              deriveParameters(parameters, lights, boundsOf(*texels_.scan)),
                          .lights = LightArrays(lights.points)};
    const bool isDone = gpu_.compute([&](ThesisGpu& gpu) {
        const Progress::Stage stage(progress, "bounce");
        gpu.bounce(frameOf(shading, lights));
        if (parameters.useLpv && !lights.points.empty()) shading.bounce = gpu.volume();
    });
    return isDone ? shading : stages.solve(lights, parameters, progress);
}

void ThesisEngine::shadeTexels(const ThesisShading& shading, const Lights& lights,
                               const TexelsAt& at, const TexelBlock& block, ShadingBlock& out)
{
    const auto irradiance = irradianceOf(shading, lights, at.page);
    if (!irradiance) return shade(shading, block, out);
    irradiance->copy(at.begin, block.count, out);
    const float power = shading.parameters.power.value_or(1.0f);
    toShading(out.direct, block.count, power, glm::vec3(0.0f));
    toShading(out.indirect, block.count, power, shading.ambient);
}

/// Null where the CPU has to do it.
std::shared_ptr<const PageIrradiance> ThesisEngine::irradianceOf(const ThesisShading& shading,
                                                                 const Lights& lights, size_t page)
{
    const std::unique_lock lock(mutex_);
    if (irradiance_ && lit_ == &shading && page_ == page) return irradiance_;
    const bool isLit = irradiance_ && lit_ == &shading;
    irradiance_ = nullptr;
    gpu_.compute([&](ThesisGpu& gpu) {
        if (!isLit) gpu.bounce(frameOf(shading, lights));
        gpu.page(frameOf(shading, lights), page);
        irradiance_ =
            std::make_shared<const PageIrradiance>(PageIrradiance{gpu.direct(), gpu.indirect()});
        lit_ = &shading;
        page_ = page;
    });
    return irradiance_;
}

gpu::InForce ThesisEngine::inForce() const
{
    const std::unique_lock lock(mutex_);
    return gpu_.inForce();
}

} // namespace relamp
