// The thesis's frame on 2^20 covered texels: flatten, lights by 2^6 regions, RSM, LPV 32^3 x 8
// steps, division. Choi 2018, table 1: 36.06 ms on a GTX 1080 Ti. Every stage is shown beside its
// floor.

#include "albedo/divide.h"
#include "machine.h"
#include "sample_room.h"
#include "scan/rays.h"
#include "scan/texels.h"
#include "thesis/emitters.h"
#include "thesis/fixtures.h"
#include "thesis/flatten.h"
#include "thesis/rsm.h"
#include "thesis/thesis_shading.h"

#include <vector>

#include <malloc.h>

#include <benchmark/benchmark.h>

namespace relamp::bench
{
namespace
{

constexpr size_t kTexels = size_t{1} << 20;

/// Everything that stands before the first frame: geometry, BVH, lights.
struct Room
{
    Room() : scan(sampleRoom(kTexels)), scene(scan), texels(rasterizeAtlas(scan, progress))
    {
        // Frame after frame, memory is taken and given back; a program that shows frames keeps it.
        mallopt(M_MMAP_THRESHOLD, 1 << 30);
        mallopt(M_TRIM_THRESHOLD, -1);
        SurfelLight light = collectLight(texels, {}, progress);
        joinFixtures(light, texels, {});
        lights.points = pointLightsFrom(light.emitters, 6);
        parameters = deriveParameters({}, lights, boundsOf(scan));
        merged = lightsOfShadowMaps(lights, parameters);
        albedo.resize(3 * scan.pages[0].image.pixels());
    }

    Progress progress;
    Scan scan;
    RayScene scene;
    Texels texels;
    Lights lights;
    ThesisOptions parameters;
    std::vector<PointLight> merged;
    std::vector<uint16_t> albedo;
};

Room& room()
{
    static Room room;
    return room;
}

/// Counters beside the time: the floor, and the share of the time that it is.
void report(benchmark::State& state, double bytes, double flops)
{
    const double floor = floorSeconds(bytes, flops);
    state.counters["floor_ms"] = 1e3 * floor;
    state.counters["of_floor"] = benchmark::Counter(static_cast<double>(state.iterations()) * floor,
                                                    benchmark::Counter::kIsRate);
}

void flattenStage(benchmark::State& state)
{
    Room& r = room();
    for (auto _ : state) benchmark::DoNotOptimize(flatten(r.texels, {}, r.progress));
    double taps = 0.0; // neighbours times about two colours each
    for (size_t run = 0; run + 1 < r.texels.pages[0].runs.size(); ++run) {
        const auto& runs = r.texels.pages[0].runs;
        taps += 2.0 * static_cast<double>(r.texels.surfels.neighborsOf(runs[run].surfel).size() *
                                          (runs[run + 1].begin - runs[run].begin));
    }
    const auto n = static_cast<double>(r.texels.count());
    report(state, n * (8 + 3 + 3 + 8 + 3), 26.0 * taps);
}

template<class Work>
void overBlocks(const Room& r, const Work& work)
{
    const TexelLoader loader(r.texels, 0);
    forEachBlock(r.texels.pages[0],
                 [&](size_t begin, size_t count) { work(loader, begin, count); });
}

void loadStage(benchmark::State& state)
{
    const Room& r = room();
    for (auto _ : state)
        overBlocks(r, [](const TexelLoader& loader, size_t begin, size_t count) {
            TexelBlock block;
            loader.load(begin, count, block);
            benchmark::DoNotOptimize(block);
        });
    const auto n = static_cast<double>(r.texels.count());
    report(state, n * (8 + 3), 30.0 * n);
}

void directStage(benchmark::State& state)
{
    const Room& r = room();
    const LightArrays lights(r.lights.points);
    TexelBlock block;
    TexelLoader(r.texels, 0).load(0, TexelBlock::kCapacity, block);
    for (auto _ : state)
        overBlocks(r, [&](const TexelLoader&, size_t, size_t) {
            RgbBlock out;
            directIrradiance(block, lights, *r.parameters.attenuation, out);
            benchmark::DoNotOptimize(out);
        });
    const auto n = static_cast<double>(r.texels.count());
    report(state, n * (6 * 4 + 3 * 4), n * static_cast<double>(lights.count()) * 24.0);
}

void rsmStage(benchmark::State& state)
{
    const Room& r = room();
    size_t rays = 0;
    for (auto _ : state)
        rays = reflectiveShadowMaps(r.texels, r.scene, r.merged, r.parameters.rsmSize).size();
    state.counters["lights"] = static_cast<double>(r.merged.size());
    state.counters["rays"] =
        benchmark::Counter(static_cast<double>(state.iterations()) * static_cast<double>(rays),
                           benchmark::Counter::kIsRate);
}

void lpvStage(benchmark::State& state)
{
    const Room& r = room();
    const auto lit = reflectiveShadowMaps(r.texels, r.scene, r.merged, r.parameters.rsmSize);
    for (auto _ : state) benchmark::DoNotOptimize(spread(r.texels, lit, r.parameters));
    const auto cells = static_cast<double>(LpvGrid(boundsOf(r.scan), r.parameters.lpvSize).count());
    const double faces = 30.0 * r.parameters.lpvSteps * cells;
    report(state, r.parameters.lpvSteps * cells * 12 * 4 * 5, faces * (3.0 * 20.0 + 10.0));
}

void readOutStage(benchmark::State& state)
{
    const Room& r = room();
    Progress progress;
    const ThesisShading shading = solveThesis(r.texels, r.scene, r.lights, r.parameters, progress);
    for (auto _ : state)
        overBlocks(r, [&](const TexelLoader& loader, size_t begin, size_t count) {
            TexelBlock block;
            loader.loadGeometry(begin, count, block);
            RgbBlock out;
            shading.bounce->irradiance(block, out);
            benchmark::DoNotOptimize(out);
        });
    const auto n = static_cast<double>(r.texels.count());
    report(state, n * (8 + 12), n * (8 * 2 * 16 + 40));
}

void shadeAndDivide(Room& r, const ThesisShading& shading)
{
    overBlocks(r, [&](const TexelLoader& loader, size_t begin, size_t count) {
        TexelBlock block;
        ShadingBlock shade;
        AlbedoBlock albedo;
        loader.load(begin, count, block);
        relamp::shade(shading, block, shade);
        divide(block, shade, 0.02f, albedo);
        const uint32_t* pixel = &r.texels.pages[0].pixel[begin];
        for (size_t i = 0; i < count; ++i) {
            uint16_t* rgb = &r.albedo[3 * size_t{pixel[i]}];
            rgb[0] = albedo.r[i];
            rgb[1] = albedo.g[i];
            rgb[2] = albedo.b[i];
        }
    });
}

void shadeAndDivideStage(benchmark::State& state)
{
    Room& r = room();
    const ThesisShading shading =
        solveThesis(r.texels, r.scene, r.lights, r.parameters, r.progress);
    for (auto _ : state) shadeAndDivide(r, shading);
    const auto n = static_cast<double>(r.texels.count());
    report(state, n * (8 + 3 + 6),
           n * (static_cast<double>(r.lights.points.size()) * 24.0 + 300.0));
}

void thesisFrame(benchmark::State& state)
{
    Room& r = room();
    for (auto _ : state) {
        const ThesisShading shading =
            solveThesis(r.texels, r.scene, r.lights, r.parameters, r.progress);
        shadeAndDivide(r, shading);
    }
    state.counters["texels"] = static_cast<double>(r.texels.count());
    state.counters["of_36.06ms"] = benchmark::Counter(
        static_cast<double>(state.iterations()) * 36.06e-3, benchmark::Counter::kIsRate);
}

void machineFloor(benchmark::State& state)
{
    for (auto _ : state) benchmark::DoNotOptimize(machine());
    state.counters["GB/s"] = machine().bytesPerSecond * 1e-9;
    state.counters["GFLOP/s"] = machine().flopsPerSecond * 1e-9;
}

} // namespace

BENCHMARK(machineFloor)->Name("machine")->Iterations(1);
BENCHMARK(thesisFrame)->Name("thesis_frame")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(flattenStage)->Name("thesis/flatten")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(rsmStage)->Name("thesis/rsm")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(lpvStage)->Name("thesis/lpv")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(shadeAndDivideStage)
    ->Name("thesis/shade_and_divide")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(loadStage)->Name("thesis/part/load")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(directStage)->Name("thesis/part/direct")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(readOutStage)
    ->Name("thesis/part/lpv_read_out")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

} // namespace relamp::bench
