#include "solve/thesis_engine.h"

#include "gpu/compute.h"
#include "shading/thesis.shared.h"

#include <fmt/format.h>

namespace relamp
{
namespace
{

ThesisFrame frameOf(const ThesisShading& shading, const Lights& lights)
{
    return {.lights = lights, .dials = shading.dials, .ambient = shading.ambient};
}

void store(glm::vec3 rgb, RgbBlock& block, size_t i)
{
    block.r[i] = rgb.r;
    block.g[i] = rgb.g;
    block.b[i] = rgb.b;
}

} // namespace

/// A device, what it works with, and the irradiance of the page that was asked for last, under the
/// shading that it was asked of.
struct ThesisEngine::Gpu
{
    Gpu(std::unique_ptr<gpu::Device> theDevice, const Texels& texels)
        : device(std::move(theDevice)), thesis(*device, texels)
    {}

    std::unique_ptr<gpu::Device> device;
    ThesisGpu thesis;
    const ThesisShading* lit = nullptr;
    size_t page = 0;
    std::vector<glm::uvec2> direct;
    std::vector<glm::uvec2> indirect;
};

ThesisEngine::ThesisEngine(const Texels& texels, const EngineOptions& options)
    : texels_(texels), isFree_(options.engine == Engine::automatic && options.gpu.empty())
{
    try {
        if (auto device = gpu::deviceFor(options))
            gpu_ = std::make_unique<Gpu>(std::move(device), texels);
    } catch (const Error& error) {
        giveUp(error);
    }
}

ThesisEngine::~ThesisEngine() = default;

void ThesisEngine::giveUp(const Error& error)
{
    if (!isFree_ || error.code() != ErrorCode::device) throw error;
    gpu_.reset();
    note_ = fmt::format("{}; the CPU took over", error.what());
}

ThesisShading ThesisEngine::solve(ThesisStages& stages, const Lights& lights,
                                  const ThesisOptions& dials, Progress& progress)
{
    const std::unique_lock lock(mutex_);
    if (!gpu_) return stages.solve(lights, dials, progress);
    ThesisShading shading{.dials = deriveDials(dials, lights, boundsOf(*texels_.scan)),
                          .lights = LightArrays(lights.points)};
    try {
        Progress::Stage stage(progress, "bounce");
        gpu_->lit = nullptr;
        gpu_->thesis.bounce(frameOf(shading, lights));
        if (dials.useLpv && !lights.points.empty()) shading.bounce = gpu_->thesis.volume();
        return shading;
    } catch (const Error& error) {
        giveUp(error);
    }
    return stages.solve(lights, dials, progress);
}

void ThesisEngine::shadeTexels(const ThesisShading& shading, const Lights& lights,
                               const TexelsAt& at, const TexelBlock& block, ShadingBlock& out)
{
    if (!irradianceOnGpu(shading, lights, at, block.count, out)) return shade(shading, block, out);
    const float power = shading.dials.power.value_or(1.0f);
    toShading(out.direct, block.count, power, glm::vec3(0.0f));
    toShading(out.indirect, block.count, power, shading.ambient);
}

/// False where the CPU has to do it.
bool ThesisEngine::irradianceOnGpu(const ThesisShading& shading, const Lights& lights,
                                   const TexelsAt& at, size_t count, ShadingBlock& out)
{
    const std::unique_lock lock(mutex_);
    if (!gpu_) return false;
    try {
        if (gpu_->lit != &shading) gpu_->thesis.bounce(frameOf(shading, lights));
        if (gpu_->lit != &shading || gpu_->page != at.page) {
            gpu_->lit = nullptr;
            gpu_->thesis.page(frameOf(shading, lights), at.page);
            gpu_->direct = gpu_->thesis.direct();
            gpu_->indirect = gpu_->thesis.indirect();
            gpu_->page = at.page;
            gpu_->lit = &shading;
        }
    } catch (const Error& error) {
        giveUp(error);
        return false;
    }
    for (size_t i = 0; i < count; ++i) {
        store(glm::vec3(halves(gpu_->direct[at.begin + i])), out.direct, i);
        store(glm::vec3(halves(gpu_->indirect[at.begin + i])), out.indirect, i);
    }
    return true;
}

std::string ThesisEngine::name() const
{
    return gpu_ ? gpu_->device->description().name : "cpu";
}

} // namespace relamp
