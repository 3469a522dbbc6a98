// The gather solver, stage by stage, on 2^20 texels of the sample room; rays beside Embree's own
// rate on the same rays.

#include "sample_room.h"

#include "base/parallel.h"
#include "base/sampling.shared.h"
#include "fit/lamps.h"
#include "shading/gathered_light.h"

#include <benchmark/benchmark.h>

namespace relamp::bench
{
namespace
{

constexpr size_t kTexels = size_t{1} << 20;
constexpr size_t kRays = 16;

/// The room, and everything that the stages hand on.
struct LampRoom
{
    LampRoom()
        : scan(sampleRoom(kTexels)), scene(scan),
          texels(rasterizeAtlas(scan, progress, {.texelsAcross = 2.0})),
          radiance(collectRadiance(texels, progress)),
          hits(castHitLists(texels, scene, radiance, kRays, progress)),
          found(findLamps(texels, scene, hits, radiance, {}, 1.0, progress))
    {
        for (const FoundLamp& lamp : found.lamps) {
            areas.emplace_back(lamp.patches);
            coarse.push_back(lamp.onSides);
        }
    }

    Progress progress;
    Scan scan;
    RayScene scene;
    Texels texels;
    SurfelRadiance radiance;
    HitLists hits;
    FoundLamps found;
    std::vector<AreaLight> areas;
    std::vector<LampSight> coarse;
};

LampRoom& room()
{
    static LampRoom room;
    return room;
}

void countRays(benchmark::State& state, size_t rays)
{
    const double all = static_cast<double>(rays) * static_cast<double>(state.iterations());
    state.counters["rays/s"] = benchmark::Counter(all, benchmark::Counter::kIsRate);
}

void hitLists(benchmark::State& state)
{
    LampRoom& r = room();
    for (auto _ : state)
        benchmark::DoNotOptimize(castHitLists(r.texels, r.scene, r.radiance, kRays, r.progress));
    countRays(state, r.hits.targets.size());
}

/// The first rays of every front's list, and nothing done with what they meet.
void embreeAlone(benchmark::State& state)
{
    const LampRoom& r = room();
    const SurfelSites sites(r.texels);
    const auto surfels = static_cast<uint32_t>(r.texels.surfels.count());
    std::vector<Ray> rays;
    for (uint32_t s = 0; s < surfels; ++s) {
        const RaysOfSide ofFront(sites, Side::front(s));
        for (size_t i = 0; i < kRays; ++i) rays.push_back(ofFront[i]);
    }
    for (auto _ : state)
        forEachChunk(rays.size(), 1024, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i)
                benchmark::DoNotOptimize(r.scene.intersect(rays[i]));
        });
    countRays(state, rays.size());
}

void lamps(benchmark::State& state)
{
    LampRoom& r = room();
    for (auto _ : state)
        benchmark::DoNotOptimize(
            findLamps(r.texels, r.scene, r.hits, r.radiance, {}, 1.0, r.progress));
}

void visibility(benchmark::State& state)
{
    const LampRoom& r = room();
    for (auto _ : state)
        benchmark::DoNotOptimize(
            Visibility(r.texels, r.scene, r.areas, r.coarse, {.raysPerProbe = 8}));
}

void shade(benchmark::State& state)
{
    const LampRoom& r = room();
    std::vector<LampPatches> patches(r.areas.begin(), r.areas.end());
    const TexelShading shading = shadingOf(
        r.texels, std::make_shared<GatheredLight>(GatheredLight{
                      std::make_shared<const CastLamps>(
                          std::move(patches),
                          Visibility(r.texels, r.scene, r.areas, r.coarse, {.raysPerProbe = 8}),
                          r.texels.surfels),
                      r.found.powers.lamps,
                      std::vector<glm::vec3>(r.texels.surfels.count(), glm::vec3(1.0f))}));
    const TexelLoader loader(r.texels, 0);
    for (auto _ : state)
        forEachBlock(r.texels.pages[0], [&](size_t begin, size_t count) {
            TexelBlock block;
            ShadingBlock out;
            loader.load(begin, count, block);
            loader.loadSurfel(begin, count, block);
            shading(0, begin, block, out);
            benchmark::DoNotOptimize(out);
        });
}

BENCHMARK(hitLists)->Name("gather/hit_lists")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(embreeAlone)->Name("gather/embree_alone")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(lamps)->Name("gather/lamps")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(visibility)->Name("gather/visibility")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(shade)->Name("gather/shade")->Unit(benchmark::kMillisecond)->UseRealTime();

} // namespace
} // namespace relamp::bench
