#include "thesis/thesis_gpu.h"

#include "thesis/thesis_shading.h"

#include <algorithm>

namespace relamp
{
namespace
{

/// All numbers of lights that a stage may depend on.
std::vector<double> numbersOf(std::span<const PointLight> lights)
{
    std::vector<double> numbers;
    for (const PointLight& light : lights)
        for (const glm::vec3 v : {light.position, light.normal, light.intensity})
            for (int c = 0; c < 3; ++c) numbers.push_back(static_cast<double>(v[c]));
    return numbers;
}

std::vector<double> numbersOf(std::initializer_list<float> numbers)
{
    return {numbers.begin(), numbers.end()};
}

void runAndTime(gpu::Commands& commands, std::vector<gpu::Timing>& timings)
{
    commands.run();
    for (gpu::Timing& timing : commands.timings()) {
        const auto same = std::find_if(timings.begin(), timings.end(),
                                       [&](const gpu::Timing& t) { return t.name == timing.name; });
        if (same == timings.end())
            timings.push_back(std::move(timing));
        else
            same->seconds += timing.seconds;
    }
}

bool bounces(const ThesisFrame& frame)
{
    return frame.parameters.useLpv && !frame.lights.points.empty();
}

} // namespace

/// A page on the device, what was computed of it, and from what.
struct ThesisGpu::Page
{
    Page(const gpu::Device& device, const Texels& all, size_t page)
        : texels(device, all, page), flattened(device, texels.pixels()),
          direct(device, texels.count), indirect(device, texels.count),
          albedo(device, texels.width, texels.height)
    {
        gpu::Commands commands(device);
        commands.clear(flattened.buffer()); // a ray may meet a pixel that no texel covers
        commands.run();
    }

    static uint64_t bytesOf(const Texels& all, size_t page)
    {
        const size_t pixels = all.scan->pages[page].image.pixels();
        return GpuTexels::bytesOf(all, page) + sizeof(uint32_t) * pixels +
               2 * sizeof(glm::uvec2) * all.pages[page].count() + GpuPicture::bytesOf(pixels);
    }

    GpuTexels texels;
    gpu::Array<uint32_t> flattened;
    gpu::Array<glm::uvec2> direct;
    gpu::Array<glm::uvec2> indirect;
    GpuPicture albedo;
    StageInputs flattenedOf, directOf, indirectOf, albedoOf;
};

ThesisGpu::ThesisGpu(const gpu::Device& device, const Texels& texels, uint64_t budget)
    : device_(device), texels_(texels), flatten_(device, texels.surfels.count()), direct_(device),
      maps_(device), volume_(device), grid_(boundsOf(*texels.scan), ThesisOptions{}.lpvSize),
      divide_(device), padding_(device), surfels_(device, texels.surfels),
      surface_(device, *texels.scan),
      pages_(
          device, texels.pages.size(), budget,
          [&texels](size_t page) { return Page::bytesOf(texels, page); },
          [&](size_t page) { return std::make_unique<Page>(device, texels, page); })
{}

ThesisGpu::~ThesisGpu() = default;

void ThesisGpu::flattenPages(const ThesisOptions& parameters, bool colorsAgain,
                             std::vector<gpu::Timing>& timings)
{
    const bool gathers = cells_.change({});
    for (size_t p = 0; gathers && p < pages_.count(); ++p) {
        const Page& page = pages_[p];
        gpu::Commands commands(device_);
        commands.mark("flatten");
        if (p == 0) flatten_.begin(commands);
        flatten_.gather(commands, page.texels);
        if (p + 1 == pages_.count()) flatten_.finish(commands);
        runAndTime(commands, timings);
    }
    colorsAgain = colors_.change({cells_.version(), static_cast<double>(parameters.flattenReach),
                                  static_cast<double>(parameters.flattenRange)}) ||
                  colorsAgain;
    for (size_t p = 0; colorsAgain && p < pages_.count(); ++p) {
        Page& page = pages_[p];
        gpu::Commands commands(device_);
        if (page.flattenedOf.change({colors_.version()})) {
            commands.mark("flatten");
            flatten_.filter(commands, page.texels, surfels_,
                            {parameters.flattenReach, parameters.flattenRange}, page.flattened);
        }
        commands.mark("RSM");
        maps_.color(commands, static_cast<uint32_t>(p), page.flattened);
        runAndTime(commands, timings);
    }
}

std::vector<gpu::Timing> ThesisGpu::bounce(const ThesisFrame& frame)
{
    std::vector<gpu::Timing> timings;
    const ThesisOptions& parameters = frame.parameters;
    if (lights_.change(numbersOf(frame.lights.points))) direct_.setLights(frame.lights.points);
    if (!bounces(frame)) {
        spreading_.change({});
        return timings;
    }
    std::vector<double> views = numbersOf(frame.lights.points);
    views.push_back(static_cast<double>(parameters.mergeDistance.value_or(0.0f)));
    views.push_back(parameters.rsmSize);
    const bool looksAgain = views_.change(std::move(views));
    if (looksAgain) {
        maps_.setLights(lightsOfShadowMaps(frame.lights, parameters), parameters.rsmSize);
        gpu::Commands commands(device_);
        commands.mark("RSM");
        maps_.trace(commands, surface_);
        runAndTime(commands, timings);
    }
    flattenPages(parameters, looksAgain, timings);

    gpu::Commands commands(device_);
    commands.mark("LPV");
    if (blocking_.change({static_cast<double>(parameters.lpvSize)})) {
        grid_ = LpvGrid(boundsOf(*texels_.scan), parameters.lpvSize);
        volume_.setGrid(grid_);
        volume_.block(commands, surfels_);
    }
    if (spreading_.change({blocking_.version(), views_.version(), colors_.version(),
                           static_cast<double>(parameters.lpvSteps)})) {
        volume_.spread(commands, maps_, parameters.lpvSteps);
        runAndTime(commands, timings);
    }
    return timings;
}

std::vector<gpu::Timing> ThesisGpu::page(const ThesisFrame& frame, size_t index)
{
    Page& page = pages_[index];
    last_ = index;
    const glm::vec3 k = frame.parameters.attenuation.value_or(glm::vec3(0.0f, 0.0f, 1.0f));
    gpu::Commands commands(device_);
    std::vector<double> direct = numbersOf({k.x, k.y, k.z});
    direct.push_back(lights_.version());
    if (page.directOf.change(std::move(direct))) {
        commands.mark("direct");
        direct_.shade(commands, page.texels, k, page.direct);
    }
    if (page.indirectOf.change({spreading_.version()})) {
        commands.mark("LPV");
        if (bounces(frame))
            volume_.readOut(commands, page.texels, page.indirect);
        else
            commands.clear(page.indirect.buffer());
        commands.barrier();
    }
    const DivideGpu::Parameters parameters{frame.parameters.power.value_or(1.0f), frame.ambient,
                                           frame.darkest};
    std::vector<double> albedo =
        numbersOf({parameters.power, parameters.ambient.r, parameters.ambient.g,
                   parameters.ambient.b, parameters.darkest});
    albedo.push_back(page.directOf.version());
    albedo.push_back(page.indirectOf.version());
    if (page.albedoOf.change(std::move(albedo))) {
        commands.mark("divide");
        divide_.divide(commands, page.texels, page.direct, page.indirect, parameters, page.albedo);
        if (!texels_.scan->pages[index].ofVertices) { // its pixels have no neighbours
            commands.mark("padding");
            padding_.fill(commands, {page.albedo});
        }
    }
    std::vector<gpu::Timing> timings;
    runAndTime(commands, timings);
    return timings;
}

void ThesisGpu::forget()
{
    for (StageInputs* stage : {&cells_, &lights_, &views_, &colors_, &blocking_, &spreading_})
        stage->forget();
}

std::shared_ptr<const Lpv> ThesisGpu::volume() const
{
    return volume_.hasGrid() ? std::make_shared<Lpv>(grid_, volume_.accumulated()) : nullptr;
}

std::vector<glm::uvec2> ThesisGpu::direct() const
{
    return pages_[last_].direct.download();
}

std::vector<glm::uvec2> ThesisGpu::indirect() const
{
    return pages_[last_].indirect.download();
}

std::vector<glm::uvec2> ThesisGpu::albedo() const
{
    return pages_[last_].albedo.pixels().download();
}

std::vector<uint32_t> ThesisGpu::flattened() const
{
    return pages_[last_].flattened.download();
}

} // namespace relamp
