#include "relamp/bench.h"

#include "albedo/divide.h"
#include "flatten/flatten.h"
#include "gpu/peak.h"
#include "lights/emitters.h"
#include "lights/fixtures.h"
#include "relamp/error.h"
#include "scan/rays.h"
#include "shading/thesis.h"
#include "solve/thesis_gpu.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <numeric>

namespace relamp
{
namespace
{

/// The rows, in their order; ThesisGpu marks its stages with the same names.
constexpr const char* kRows[] = {"flatten", "direct", "RSM", "LPV", "divide", "dilate"};

/// All that stands before the first frame.
struct Room
{
    Room(const Scan& scan, Progress& progress) : scene(scan), texels(rasterizeAtlas(scan, progress))
    {
        checkOverlap(texels);
        SurfelLight light = collectLight(texels, {}, progress);
        joinFixtures(light, texels, {});
        frame.lights.points = pointLightsFrom(light.emitters, ThesisOptions{}.lightLevels);
        frame.dials = deriveDials({}, frame.lights, boundsOf(scan));
    }

    RayScene scene;
    Texels texels;
    ThesisFrame frame;
};

double secondsOf(const std::function<void()>& work)
{
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Calls `work(block)` for all texels of all pages.
template<class Work>
void overBlocks(const Texels& texels, const Work& work)
{
    for (size_t p = 0; p < texels.pages.size(); ++p) {
        const TexelLoader loader(texels, p);
        forEachBlock(texels.pages[p], [&](size_t begin, size_t count) {
            TexelBlock block;
            loader.load(begin, count, block);
            work(block);
        });
    }
}

/// One frame of the CPU, stage by stage; loading of texels counts for each that needs it.
std::vector<double> frameOfCpu(const Room& room)
{
    Progress progress;
    const ThesisOptions& dials = room.frame.dials;
    std::vector<BounceLight> lit;
    std::shared_ptr<const Lpv> volume;
    const LightArrays lights(room.frame.lights.points);
    Flattened surface;
    const double flattening = secondsOf([&] {
        surface = flatten(room.texels, {dials.flattenReach, dials.flattenRange}, progress);
    });
    const double direct = secondsOf([&] {
        overBlocks(room.texels, [&](const TexelBlock& block) {
            RgbBlock out;
            directIrradiance(block, lights, *dials.attenuation, out);
        });
    });
    const double rsm = secondsOf([&] {
        lit = reflectiveShadowMaps(room.texels, room.scene,
                                   lightsOfShadowMaps(room.frame.lights, dials), dials.rsmSize);
        for (BounceLight& light : lit) light.flux *= surface.at(light.page, light.pixel);
    });
    const double lpv = secondsOf([&] {
        volume = spread(room.texels, lit, dials);
        overBlocks(room.texels, [&](const TexelBlock& block) {
            RgbBlock out;
            volume->irradiance(block, out);
        });
    });
    const double division = secondsOf([&] {
        overBlocks(room.texels, [&](const TexelBlock& block) {
            const ShadingBlock shading{};
            AlbedoBlock albedo;
            divide(block, shading, room.frame.darkest, albedo);
        });
    });
    return {flattening, direct, rsm, lpv, division, 0.0};
}

/// One frame of a GPU, everything computed anew.
std::vector<double> frameOfGpu(ThesisGpu& gpu, const Room& room)
{
    gpu.forget();
    std::vector<gpu::Timing> timings = gpu.bounce(room.frame);
    for (size_t p = 0; p < room.texels.pages.size(); ++p) {
        const std::vector<gpu::Timing> ofPage = gpu.page(room.frame, p);
        timings.insert(timings.end(), ofPage.begin(), ofPage.end());
    }
    std::vector<double> seconds(std::size(kRows), 0.0);
    for (const gpu::Timing& timing : timings)
        for (size_t row = 0; row < seconds.size(); ++row)
            if (timing.name == kRows[row]) seconds[row] += timing.seconds;
    return seconds;
}

/// The best of some rounds: that whose stages together are the fastest.
template<class Frame>
std::vector<double> best(int rounds, const Frame& frame)
{
    std::vector<double> least;
    const auto sum = [](const std::vector<double>& v) {
        return std::accumulate(v.begin(), v.end(), 0.0);
    };
    for (int round = 0; round < rounds; ++round) {
        std::vector<double> seconds = frame();
        if (least.empty() || sum(seconds) < sum(least)) least = std::move(seconds);
    }
    return least;
}

/// What the stages have to move and to compute on a GPU, counted by hand from the shaders.
std::vector<double> floorsOf(const Room& room, const gpu::Peak& peak)
{
    const ThesisOptions& dials = room.frame.dials;
    const auto n = static_cast<double>(room.texels.count());
    const auto lights = static_cast<double>(room.frame.lights.points.size());
    const auto cells =
        static_cast<double>(LpvGrid(boundsOf(*room.texels.scan), dials.lpvSize).count());
    double pixels = 0.0;
    double taps = 0.0; // of the filter: neighbours times about two colours each
    for (size_t p = 0; p < room.texels.pages.size(); ++p) {
        pixels += static_cast<double>(room.texels.scan->pages[p].image.pixels());
        const auto& runs = room.texels.pages[p].runs;
        for (size_t run = 0; run + 1 < runs.size(); ++run)
            taps +=
                2.0 * static_cast<double>(room.texels.surfels.neighborsOf(runs[run].surfel).size() *
                                          (runs[run + 1].begin - runs[run].begin));
    }
    const double steps = dials.lpvSteps;
    return {peak.floorSeconds(n * (8 + 16 + 8 + 4 + 4 + 4), 26.0 * taps),
            peak.floorSeconds(n * (16 + 8), n * lights * 24.0),
            0.0,
            peak.floorSeconds(steps * cells * 48 * 4, steps * cells * 3 * 30 * 20) +
                peak.floorSeconds(n * (16 + 8), n * 250.0),
            peak.floorSeconds(n * (8 + 8 + 8 + 4 + 8), n * 20.0),
            peak.floorSeconds(pixels * 8 * 3, 0.0)};
}

std::unique_ptr<gpu::Device> deviceOf(const EngineOptions& options)
{
    if (options.engine == Engine::cpu) return nullptr;
    try {
        return std::make_unique<gpu::Device>(options.gpu);
    } catch (const Error&) {
        if (options.engine == Engine::gpu || !options.gpu.empty()) throw;
        return nullptr;
    }
}

} // namespace

StageTime BenchReport::total() const
{
    StageTime sum{.stage = "total"};
    for (const StageTime& stage : stages) {
        sum.gpu += stage.gpu;
        sum.floor += stage.floor;
        sum.cpu += stage.cpu;
    }
    return sum;
}

BenchReport measureFrame(const Scan& scan, const BenchOptions& options, Progress& progress)
{
    const std::unique_ptr<gpu::Device> device = deviceOf(options.engine);
    const Room room(scan, progress);
    BenchReport report{.texels = room.texels.count(),
                       .lights = room.frame.lights.points.size(),
                       .shadowMaps = lightsOfShadowMaps(room.frame.lights, room.frame.dials).size(),
                       .cpu = cpuDevice()};
    std::vector<double> ofGpu(std::size(kRows), 0.0);
    std::vector<double> floors = ofGpu;
    if (device) {
        const Progress::Stage stage(progress, "gpu");
        const gpu::Peak peak = gpu::measurePeak(*device);
        report.gpu = device->description().name;
        report.bytesPerSecond = peak.bytesPerSecond;
        report.flopsPerSecond = peak.flopsPerSecond;
        floors = floorsOf(room, peak);
        ThesisGpu gpu(*device, room.texels);
        ofGpu = best(options.rounds, [&] { return frameOfGpu(gpu, room); });
    }
    const Progress::Stage stage(progress, "cpu");
    const std::vector<double> ofCpu = best(options.rounds, [&] { return frameOfCpu(room); });
    for (size_t row = 0; row < std::size(kRows); ++row)
        report.stages.push_back({kRows[row], ofGpu[row], floors[row], ofCpu[row]});
    return report;
}

} // namespace relamp
