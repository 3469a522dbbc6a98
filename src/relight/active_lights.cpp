#include "relight/active_lights.h"

#include "fit/given_lamps.h"
#include "lights/shining.h"
#include "relight/sky_bins.h"

#include <algorithm>
#include <utility>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

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
    if (a.fixture.id >= 0 || b.fixture.id >= 0) return a.fixture.id == b.fixture.id;
    return a.fixture.centre == b.fixture.centre && a.fixture.normal == b.fixture.normal &&
           a.fixture.area == b.fixture.area;
}

ActiveLights activate(const Texels& texels, const RoomFixtures& room, const Relighting& lighting)
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
        if (lit.isWindow) radiance += skyThroughOpening(active.sky, -lit.fixture.normal);
        if (isDark(radiance) && !lit.isWindow) continue;
        const size_t place = room.captured.placeOf(lit.fixture.id);
        const bool isOfRoom = place < room.surfaces.size();
        const std::vector<ClippedPatch> patches =
            isOfRoom ? room.surfaces[place] : bodyOf(lit.fixture);
        if (lit.isWindow) {
            active.windowOpenings.resize(surfels, 0);
            mark(patches, active.windowOpenings);
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
        if (!isOfRoom) active.lights.back().fixture.id = -1;
    }
    return active;
}

} // namespace relamp
