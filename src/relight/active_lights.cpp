#include "relight/active_lights.h"

#include "fit/given_lamps.h"
#include "lights/shining.h"
#include "relight/fixture_settings.h"
#include "relight/sky_bins.h"

#include <algorithm>
#include <utility>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

/// The burnt-out surface that a captured fixture is, or a disc or ball where it is none of them.
std::vector<ClippedPatch> surfaceOf(const Fixture& fixture, const Transport& transport,
                                    const Lights& captured)
{
    const size_t place = placeOfFixture(captured, fixture.centre);
    if (place < transport.fixtures.size()) return transport.fixtures[place];
    Lights one;
    one.fixtures.push_back(fixture);
    one.fixtures.back().radiance = glm::vec3(1.0f);
    return asGiven(one, {}, {}).lamps.at(0).patches;
}

void mark(std::span<const ClippedPatch> patches, std::vector<uint8_t>& surfels)
{
    for (const ClippedPatch& patch : patches)
        if (patch.surfel != Surfels::kNone) surfels[patch.surfel] = 1;
}

} // namespace

bool castSameShadows(const ActiveLight& a, const ActiveLight& b)
{
    if (a.isFixture != b.isFixture) return false;
    if (!a.isFixture) return sameShape(a.light, b.light);
    return a.fixture.centre == b.fixture.centre && a.fixture.normal == b.fixture.normal &&
           a.fixture.area == b.fixture.area;
}

ActiveLights activate(const Texels& texels, const Transport& transport, const Lights& captured,
                      const Relighting& lighting)
{
    const size_t surfels = texels.surfels.count();
    ActiveLights active;
    active.sky = skyInBins(lighting.sky);
    active.shines.assign(surfels, 0);
    active.emission.assign(surfels, glm::vec3(0.0f));
    for (const NewLight& light : lighting.lights) {
        if (isDark(light.emission)) continue;
        ActiveLight& added = active.lights.emplace_back();
        added.light = light;
        added.emission = light.emission;
        added.source = std::make_shared<const LightSource>(light);
    }
    for (const LitFixture& lit : lighting.fixtures) {
        glm::vec3 radiance = lit.fixture.radiance;
        if (lit.isWindow) radiance += skyThroughPane(active.sky, -lit.fixture.normal);
        if (isDark(radiance) && !lit.isWindow) continue;
        std::vector<ClippedPatch> patches = surfaceOf(lit.fixture, transport, captured);
        if (lit.isWindow) {
            active.panes.resize(surfels, 0);
            mark(patches, active.panes);
        }
        if (isDark(radiance)) continue;
        mark(patches, active.shines);
        for (const ClippedPatch& patch : patches)
            if (patch.surfel != Surfels::kNone) active.emission[patch.surfel] = radiance;
        active.lights.push_back({{},
                                 lit.fixture,
                                 patches,
                                 true,
                                 radiance,
                                 std::make_shared<const LightSource>(AreaLight(patches))});
    }
    return active;
}

} // namespace relamp
