#include "output/usd_lights.h"

#include "base/half.h"
#include "decomposition_state.h"
#include "scan/texels.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <glm/common.hpp>

namespace relamp
{
namespace
{

using PointsOfFixtures = std::map<int, std::vector<LampPoint>>;

/// Adds the texels of one page to those of the fixtures whose they are.
void addPoints(const Texels& texels, size_t page, const FixtureMap& map, PointsOfFixtures& points)
{
    const PageTexels& ofPage = texels.pages[page];
    const TexelLoader loader(texels, page);
    TexelBlock block;
    const auto idOf = [&](size_t texel) { return map.id[ofPage.pixel[texel]]; };
    for (size_t begin = 0; begin < ofPage.count(); begin += TexelBlock::kCapacity) {
        const size_t count = std::min(TexelBlock::kCapacity, ofPage.count() - begin);
        bool isLamp = false;
        for (size_t i = begin; i < begin + count; ++i) isLamp = isLamp || idOf(i) >= 0;
        if (!isLamp) continue;
        loader.loadGeometry(begin, count, block);
        loader.loadArea(begin, count, block);
        for (size_t i = 0; i < count; ++i)
            if (idOf(begin + i) >= 0 && block.area[i] > 0.0f)
                points[idOf(begin + i)].push_back({{block.x[i], block.y[i], block.z[i]},
                                                   {block.nx[i], block.ny[i], block.nz[i]},
                                                   block.area[i]});
    }
}

/// What shines through each large hole beyond what `lights.outside` sends through it as well.
void addOpenings(const Lights& found, const std::vector<Opening>& openings, UsdLights& lights)
{
    lights.outside = found.ambient;
    if (!found.openings.empty()) lights.outside *= found.openings.front();
    for (const Opening& opening : openings)
        lights.outside = glm::min(lights.outside, opening.radiance);
    for (size_t i = 0; i < openings.size(); ++i) {
        const Opening& opening = openings[i];
        const glm::vec3 more = opening.radiance - lights.outside;
        if (more == glm::vec3(0.0f) || opening.area <= 0.0f) continue;
        lights.openings.push_back(squareLamp(opening.centre, opening.normal, opening.area, more));
        lights.openings.back().name = fmt::format("opening {}", i + 1);
    }
}

} // namespace

UsdLights usdLightsOf(const Decomposition& room)
{
    const Lights& found = room.lights();
    PointsOfFixtures points;
    for (size_t page = 0; page < room.scan()->pages.size(); ++page)
        addPoints(*room.state().texels, page, room.fixtures(page), points);
    UsdLights lights;
    for (size_t i = 0; i < found.fixtures.size(); ++i) {
        const auto lamps = simpleLamps(found.fixtures[i], points[found.idOf(i)]);
        for (size_t part = 0; part < lamps.size(); ++part) {
            SimpleLamp& lamp = lights.lamps.emplace_back(lamps[part]);
            lamp.id = found.idOf(i);
            lamp.name = found.nameOf(i);
            if (lamps.size() > 1) lamp.name += fmt::format(", part {}", part + 1);
        }
    }
    for (const PointLight& point : found.points)
        if (point.fixture < 0) lights.lamps.push_back(simpleLamp(point));
    std::erase_if(lights.lamps,
                  [](const SimpleLamp& lamp) { return lamp.emission == glm::vec3(0.0f); });
    addOpenings(found, room.openings(), lights);
    if (found.sun && found.sun->irradiance != glm::vec3(0.0f)) lights.sun = found.sun;
    return lights;
}

std::vector<uint16_t> emissionBy(const FixtureMap& map, const Lights& lights)
{
    std::map<int32_t, glm::vec3> radianceOf;
    for (size_t place = 0; place < lights.fixtures.size(); ++place)
        if (lights.fixtures[place].radiance != glm::vec3(0.0f))
            radianceOf[lights.idOf(place)] = lights.fixtures[place].radiance;
    std::vector<uint16_t> emission;
    for (size_t pixel = 0; pixel < map.id.size(); ++pixel) {
        if (map.id[pixel] < 0) continue;
        const auto found = radianceOf.find(map.id[pixel]);
        if (found == radianceOf.end()) continue;
        emission.resize(3 * map.id.size());
        for (int c = 0; c < 3; ++c)
            emission[3 * pixel + static_cast<size_t>(c)] = halfFromFloat(found->second[c]);
    }
    return emission;
}

} // namespace relamp
