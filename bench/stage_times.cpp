#include "stage_times.h"

#include "albedo/divide.h"
#include "albedo/page_layers.h"
#include "gpu/peak.h"
#include "relamp/error.h"
#include "scan/overlap.h"
#include "scan/rays.h"
#include "shading/enclosed_texels.h"
#include "shading/gathered_light.shared.h"
#include "solve/find_room.h"
#include "solve/reevaluate_gpu.h"
#include "solve/room_solution.h"
#include "thesis/emitters.h"
#include "thesis/fixtures.h"
#include "thesis/flatten.h"
#include "thesis/thesis_gpu.h"
#include "thesis/thesis_shading.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <numeric>
#include <span>
#include <utility>

namespace relamp
{
namespace
{

/// The rows, in their order; the GPU's classes mark their stages with the same names.
constexpr const char* kFrameRows[] = {"flatten", "direct", "RSM", "LPV", "divide", "padding"};
constexpr const char* kReevaluateRows[] = {"gather", "shading", "divide", "padding"};
constexpr const char* kKept[] = {"lamps"};

/// All that stands before the first frame.
struct Room
{
    Room(const Scan& scan, Progress& progress) : scene(scan), texels(rasterizeAtlas(scan, progress))
    {
        checkOverlap(texels);
        SurfelLight light = collectLight(texels, {}, progress);
        joinFixtures(light, texels, {});
        frame.lights.points = pointLightsFrom(light.emitters, ThesisOptions{}.lightLevels);
        frame.parameters = deriveParameters({}, frame.lights, boundsOf(scan));
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
    const ThesisOptions& parameters = room.frame.parameters;
    std::vector<BounceLight> lit;
    std::shared_ptr<const Lpv> volume;
    const LightArrays lights(room.frame.lights.points);
    Flattened surface;
    const double flattening = secondsOf([&] {
        surface =
            flatten(room.texels, {parameters.flattenReach, parameters.flattenRange}, progress);
    });
    const double direct = secondsOf([&] {
        overBlocks(room.texels, [&](const TexelBlock& block) {
            RgbBlock out;
            directIrradiance(block, lights, *parameters.attenuation, out);
        });
    });
    const double rsm = secondsOf([&] {
        lit = reflectiveShadowMaps(room.texels, room.scene,
                                   lightsOfShadowMaps(room.frame.lights, parameters),
                                   parameters.rsmSize);
        for (BounceLight& light : lit) light.flux *= surface.at(light.page, light.pixel);
    });
    const double lpv = secondsOf([&] {
        volume = spread(room.texels, lit, parameters);
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

std::vector<double> inRows(std::span<const gpu::Timing> timings, std::span<const char* const> rows)
{
    std::vector<double> seconds(rows.size(), 0.0);
    for (const gpu::Timing& timing : timings)
        for (size_t row = 0; row < rows.size(); ++row)
            if (timing.name == rows[row]) seconds[row] += timing.seconds;
    return seconds;
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
    return inRows(timings, kFrameRows);
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

/// Neighbours of the texels' surfels, a texel each, `most` at most.
double tapsOf(const Texels& texels, size_t most)
{
    double taps = 0.0;
    for (const PageTexels& page : texels.pages)
        for (size_t run = 0; run + 1 < page.runs.size(); ++run)
            taps += static_cast<double>(
                std::min(texels.surfels.neighborsOf(page.runs[run].surfel).size(), most) *
                (page.runs[run + 1].begin - page.runs[run].begin));
    return taps;
}

double pixelsOf(const Scan& scan)
{
    double pixels = 0.0;
    for (const Page& page : scan.pages) pixels += static_cast<double>(page.image.pixels());
    return pixels;
}

/// What the stages have to move and to compute on a GPU, counted by hand from the shaders.
std::vector<double> floorsOf(const Room& room, const gpu::Peak& peak)
{
    const ThesisOptions& parameters = room.frame.parameters;
    const auto n = static_cast<double>(room.texels.count());
    const auto lights = static_cast<double>(room.frame.lights.points.size());
    const auto cells =
        static_cast<double>(LpvGrid(boundsOf(*room.texels.scan), parameters.lpvSize).count());
    const double taps = 2.0 * tapsOf(room.texels, ~size_t{0}); // about two colours a neighbour
    const double steps = parameters.lpvSteps;
    return {peak.floorSeconds(n * (8 + 16 + 8 + 4 + 4 + 4), 26.0 * taps),
            peak.floorSeconds(n * (16 + 8), n * lights * 24.0),
            0.0,
            peak.floorSeconds(steps * cells * 48 * 4, steps * cells * 3 * 30 * 20) +
                peak.floorSeconds(n * (16 + 8), n * 250.0),
            peak.floorSeconds(n * (8 + 8 + 8 + 4 + 8), n * 20.0),
            peak.floorSeconds(3 * 8 * pixelsOf(*room.texels.scan), 0.0)};
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

std::vector<StageTime> tableOf(std::span<const char* const> rows, std::span<const double> ofGpu,
                               std::span<const double> floors, std::span<const double> ofCpu)
{
    std::vector<StageTime> stages;
    for (size_t row = 0; row < rows.size(); ++row)
        stages.push_back({rows[row], ofGpu.empty() ? 0.0 : ofGpu[row],
                          floors.empty() ? 0.0 : floors[row], ofCpu[row]});
    return stages;
}

/// What both measurements need.
struct Bench
{
    const Scan& scan;
    const gpu::Device* device; // null: none
    gpu::Peak peak;
    int rounds;
};

FrameTimes measureFrame(const Bench& bench, Progress& progress)
{
    const Room room(bench.scan, progress);
    FrameTimes times;
    times.texels = room.texels.count();
    times.lights = room.frame.lights.points.size();
    times.shadowMaps = lightsOfShadowMaps(room.frame.lights, room.frame.parameters).size();
    std::vector<double> ofGpu;
    std::vector<double> floors;
    if (bench.device != nullptr) {
        const Progress::Stage stage(progress, "gpu");
        floors = floorsOf(room, bench.peak);
        ThesisGpu gpu(*bench.device, room.texels);
        ofGpu = best(bench.rounds, [&] { return frameOfGpu(gpu, room); });
    }
    const Progress::Stage stage(progress, "cpu");
    const std::vector<double> ofCpu = best(bench.rounds, [&] { return frameOfCpu(room); });
    times.stages = tableOf(kFrameRows, ofGpu, floors, ofCpu);
    return times;
}

/// All that stands before a lamp's power is changed.
struct LampRoom
{
    LampRoom(const Scan& scan, Progress& progress)
        : scene(scan), texels(rasterizeAtlas(scan, progress, surfelsOf(GatherOptions{})))
    {
        separateEnclosed(texels, scene, progress);
        solved = solvedRoom(texels, scene, findRoom(texels, scene, {}, progress));
        powers = solved.found.found.powers;
        said = solutionOf(texels, solved, {}, closureOf(solved)).texels;
    }

    /// Makes the first lamp brighter, or as it was; without any, what lies around.
    void changePower()
    {
        isBrighter = !isBrighter;
        const float change = isBrighter ? 1.25f : 1.0f / 1.25f;
        if (powers.lamps.empty())
            powers.outside = change * powers.outside[0];
        else
            powers.lamps.front() *= change;
    }

    RayScene scene;
    Texels texels;
    SolvedRoom solved;
    LampPowers powers;
    SolvedTexels said; // of the room as it was found
    bool isBrighter = false;
};

std::vector<double> reevaluateOfCpu(LampRoom& room)
{
    room.changePower();
    const double gathering = secondsOf([&] { reevaluate(room.texels, room.solved, room.powers); });
    const TexelShading shade = shadingOf(room.texels, room.solved);
    double shading = 0.0;
    double division = 0.0;
    Progress progress;
    SolvedTexels unlit = room.said;
    unlit.shade = [](size_t, size_t, const TexelBlock&, ShadingBlock& out) { out = {}; };
    for (size_t p = 0; p < room.texels.pages.size(); ++p) {
        const TexelLoader loader(room.texels, p);
        shading += secondsOf([&] {
            forEachBlock(room.texels.pages[p], [&](size_t begin, size_t count) {
                TexelBlock block;
                ShadingBlock out;
                loader.loadGeometry(begin, count, block);
                loader.loadSurfel(begin, count, block);
                shade(p, begin, block, out);
            });
        });
        division += secondsOf([&] { makeLayers(room.texels, p, unlit, {}, progress); });
    }
    return {gathering, shading, division, 0.0};
}

std::vector<gpu::Timing> reevaluateOfGpu(ReevaluateGpu& gpu, const LampRoom& room)
{
    std::vector<gpu::Timing> timings =
        gpu.gather(room.powers, room.solved.found.sides.field.shines);
    for (size_t p = 0; p < room.texels.pages.size(); ++p)
        for (gpu::Timing& timing : gpu.divide(p, {})) timings.push_back(std::move(timing));
    return timings;
}

/// As floorsOf(), of a re-evaluation.
std::vector<double> reevaluateFloorsOf(const LampRoom& room, const gpu::Peak& peak)
{
    const HitLists& hits = room.solved.found.hits;
    const double n = static_cast<double>(room.texels.count());
    const double surfels = static_cast<double>(room.texels.surfels.count());
    const double neighbors = static_cast<double>(room.texels.surfels.neighbor.size());
    const double lists = static_cast<double>(hits.sideOfList.size());
    const auto others = static_cast<double>(
        std::count_if(hits.targets.begin(), hits.targets.end(), [](HitTarget target) {
            return !target.isNothing() && (target.side().isBack() || target.isClipped());
        }));
    const double raysOfFronts = static_cast<double>(hits.firstTarget[room.texels.surfels.count()]);
    const double pairs = static_cast<double>((room.powers.lamps.size() + 1) / 2);
    const double round =
        others * 4 + lists * (16 + 8 + 16 + 16 + 4 + 8) + surfels * (2 * 8 + 3 * 8 + 16);
    const double rest = raysOfFronts * 4 + surfels * (4 + 3 * 8 + 20) + // gathered without excess
                        surfels * (48 + 3 * 32 + 52 + 40) + neighbors * 4 * 4;
    return {peak.floorSeconds(lists * (4 * pairs + 8) + 4 * round + rest,
                              (4 * others * 3 + raysOfFronts * 10) + neighbors * (3 * 4 + 9)),
            peak.floorSeconds(n * (16 + 4 + 4 * pairs + 16),
                              tapsOf(room.texels, kMostTaps) * 32 + n * pairs * 12),
            peak.floorSeconds(n * (3 * 8 + 4 + 4 + 3 * 8 + 4), n * 80.0),
            peak.floorSeconds(3 * 3 * 8 * pixelsOf(*room.texels.scan), 0.0)};
}

ReevaluateTimes measureReevaluate(const Bench& bench, Progress& progress)
{
    LampRoom room(bench.scan, progress);
    ReevaluateTimes times;
    times.texels = room.texels.count();
    times.lamps = room.powers.lamps.size();
    times.surfels = room.texels.surfels.count();
    times.rays = room.solved.found.hits.targets.size();
    std::vector<double> ofGpu;
    std::vector<double> floors;
    if (bench.device != nullptr) {
        const Progress::Stage stage(progress, "gpu");
        floors = reevaluateFloorsOf(room, bench.peak);
        ReevaluateGpu gpu(*bench.device, room.texels, room.solved);
        gpu.setSurfels(room.said);
        times.once = inRows(reevaluateOfGpu(gpu, room), kKept)[0];
        ofGpu = best(bench.rounds, [&] {
            room.changePower();
            const std::vector<gpu::Timing> timings = reevaluateOfGpu(gpu, room);
            std::vector<double> seconds = inRows(timings, kReevaluateRows);
            seconds[1] += inRows(timings, kKept)[0]; // of pages that take turns
            return seconds;
        });
    }
    const Progress::Stage stage(progress, "cpu");
    const std::vector<double> ofCpu = best(bench.rounds, [&] { return reevaluateOfCpu(room); });
    times.stages = tableOf(kReevaluateRows, ofGpu, floors, ofCpu);
    return times;
}

} // namespace

StageTime StageTimes::total() const
{
    StageTime sum{.stage = "total"};
    for (const StageTime& stage : stages) {
        sum.gpu += stage.gpu;
        sum.floor += stage.floor;
        sum.cpu += stage.cpu;
    }
    return sum;
}

BenchReport measureStages(const Scan& scan, const BenchOptions& options, Progress& progress)
{
    const std::unique_ptr<gpu::Device> device = deviceOf(options.engine);
    BenchReport report{.cpu = cpuDevice()};
    gpu::Peak peak;
    if (device) {
        peak = gpu::measurePeak(*device);
        report.gpu = device->description().name;
        report.bytesPerSecond = peak.bytesPerSecond;
        report.flopsPerSecond = peak.flopsPerSecond;
    }
    const Bench bench{scan, device.get(), peak, options.rounds};
    report.frame = measureFrame(bench, progress);
    report.reevaluate = measureReevaluate(bench, progress);
    return report;
}

} // namespace relamp
