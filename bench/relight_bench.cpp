// Relighting, once rays have found the room: what a change of light costs, on 2^20 texels of the
// sample room.

#include "sample_room.h"

#include "relamp/picture.h"
#include "relamp/relight.h"
#include "relight/relighter_state.h"
#include "relight/relit_page.h"
#include "shading/direct_sum.h"

#include <benchmark/benchmark.h>

namespace relamp::bench
{
namespace
{

constexpr size_t kTexels = size_t{1} << 20;

DelitRoom sampleWithAlbedo()
{
    DelitRoom room;
    room.scan = std::make_shared<const Scan>(sampleRoom(kTexels));
    room.albedo.push_back(room.scan->pages[0].image);
    room.isLit = false;
    return room;
}

struct Relit
{
    Relit() : room(sampleWithAlbedo()), relighter(room, {}, progress) {}

    Progress progress;
    DelitRoom room;
    Relighter relighter;
};

Relit& relit()
{
    static Relit relit;
    return relit;
}

/// A bulb above the bed; `at` moves it a little, so that its shadows are new.
Relighting lamp(int at, float power = 3.0f)
{
    Relighting lighting;
    NewLight light;
    light.position = {1.2f + 0.01f * static_cast<float>(at % 32), 2.0f, -1.2f};
    light.emission = glm::vec3(power);
    lighting.lights.push_back(light);
    return lighting;
}

Relighting bulb(int at)
{
    return lamp(at);
}

/// A panel of 0.6 x 0.6 m there, which has wide penumbrae.
Relighting panel(int at)
{
    Relighting lighting = lamp(at);
    lighting.lights[0].type = LightType::rectangle;
    lighting.lights[0].size = {0.6f, 0.6f};
    return lighting;
}

/// A narrow spot there: its bounces start from the little that it lights.
Relighting spot(int at)
{
    Relighting lighting = lamp(at, 30.0f);
    lighting.lights[0].type = LightType::spot;
    lighting.lights[0].cone = 0.3f;
    return lighting;
}

/// A light in a new place, to a new texture.
template<Relighting (*lightingAt)(int)>
void newPlace(benchmark::State& state)
{
    Relit& r = relit();
    static int at = 0; // never where it was, from one run of this to the next either
    for (auto _ : state) {
        r.relighter.light(lightingAt(++at), r.progress);
        benchmark::DoNotOptimize(r.relighter.radiance(0, r.progress));
    }
}

/// A light as it was but brighter, to a new texture.
void newPower(benchmark::State& state)
{
    Relit& r = relit();
    float power = 1.0f;
    for (auto _ : state) {
        r.relighter.light(lamp(0, power += 0.1f), r.progress);
        benchmark::DoNotOptimize(r.relighter.radiance(0, r.progress));
    }
}

void shadows(benchmark::State& state)
{
    const Relighter::State& s = relit().relighter.state();
    const NewLight light = lamp(0).lights[0];
    const LightSource source(light);
    const Obstacles walls(s.texels, s.scene, {}, s.radiance.isClipped);
    for (auto _ : state) {
        const auto onSides = directOfSides(s.texels, walls, source, s.transport.sides);
        benchmark::DoNotOptimize(Shadows(s.texels, walls, source, onSides, 16));
    }
}

void bounces(benchmark::State& state)
{
    const Relighter::State& s = relit().relighter.state();
    const Obstacles walls(s.texels, s.scene, {}, s.radiance.isClipped);
    std::vector<glm::vec3> direct(s.transport.sides.size(), glm::vec3(0.0f));
    addDirect(directOfSides(s.texels, walls, LightSource(lamp(0).lights[0]), s.transport.sides),
              glm::vec3(3.0f), direct);
    size_t count = 0;
    for (auto _ : state) {
        const Bounced bounced = bounce(s.transport, s.albedo.ofSurfels(), direct, {});
        count = bounced.bounces;
        benchmark::DoNotOptimize(bounced);
    }
    state.counters["bounces"] = static_cast<double>(count);
    state.counters["surfels"] = static_cast<double>(s.transport.ofFronts.count());
    state.counters["clusters"] = static_cast<double>(s.transport.clusters());
    state.counters["rays"] = static_cast<double>(s.transport.ofFronts.target.size() +
                                                 s.transport.ofClusters.target.size());
}

void bake(benchmark::State& state)
{
    Relit& r = relit();
    r.relighter.light(lamp(0), r.progress);
    for (auto _ : state) benchmark::DoNotOptimize(r.relighter.radiance(0, r.progress));
}

/// 1280 x 720 in AgX, the light already on the walls.
void picture(benchmark::State& state)
{
    Relit& r = relit();
    r.relighter.light(lamp(0), r.progress);
    const std::vector<Image> pages = radianceOfPages(r.relighter, r.progress);
    const Photographer photographer(r.relighter);
    const Camera camera = photographer.goodView();
    const PictureOptions options{.view = {.view = View::agx}};
    for (auto _ : state)
        benchmark::DoNotOptimize(photographer.develop(pages, camera, options, r.progress));
}

BENCHMARK(newPlace<bulb>)->Name("relight/new_place")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(newPlace<panel>)
    ->Name("relight/new_place_of_panel")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(newPlace<spot>)
    ->Name("relight/new_place_of_spot")
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(newPower)->Name("relight/new_power")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(shadows)->Name("relight/shadows")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(bounces)->Name("relight/bounces")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(picture)->Name("relight/picture")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(bake)->Name("relight/bake")->Unit(benchmark::kMillisecond)->UseRealTime();

} // namespace
} // namespace relamp::bench
