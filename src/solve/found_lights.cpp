#include "solve/found_lights.h"

#include "fit/lamp_groups.h"
#include "lights/fixture_map.h"
#include "lights/point_light.h"
#include "relamp/error.h"

#include <algorithm>
#include <span>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace relamp
{
namespace
{

Fixture fixtureOf(const FoundLamp& lamp, glm::vec3 radiance, std::span<const ClippedPatch> patches)
{
    Fixture fixture;
    glm::vec3 normal(0.0f);
    for (const ClippedPatch& patch : patches) {
        fixture.centre += patch.area * patch.position;
        normal += patch.area * patch.normal;
        fixture.area += patch.area;
        if (patch.surfel == Surfels::kNone) fixture.unseen += patch.area;
    }
    fixture.centre /= fixture.area;
    const float length = glm::length(normal);
    if (length > kNoFacing * fixture.area) fixture.normal = normal / length;
    fixture.radiance = radiance;
    fixture.error = lamp.logError;
    fixture.determined = lamp.isDetermined;
    return fixture;
}

} // namespace

Lights beforeScale(Lights lights)
{
    const glm::vec3 scale = lights.tempering.scale;
    if (!glm::all(glm::greaterThan(scale, glm::vec3(0.0f))))
        throw Error(ErrorCode::malformed, "the scale of the lights' tempering must be above 0");
    lights.ambient /= scale;
    for (Fixture& fixture : lights.fixtures) fixture.radiance /= scale;
    for (PointLight& point : lights.points) point.intensity /= scale;
    if (lights.sun) lights.sun->irradiance /= scale;
    return lights;
}

Lights lightsOf(const FoundRoom& room)
{
    Lights lights;
    const glm::vec3 scale = room.tempering.scale;
    lights.ambient = scale * room.found.powers.outside.even();
    lights.openings = room.found.powers.outside.ratios();
    lights.camera = room.found.camera;
    lights.gaps = room.found.gaps;
    lights.tempering = room.tempering;
    if (room.found.sun) {
        lights.sun = room.found.sun->sun;
        lights.sun->irradiance *= scale;
    }
    for (size_t l = 0; l < room.found.lamps.size(); ++l) {
        const FoundLamp& lamp = room.found.lamps[l];
        if (lamp.isSunlit) continue;
        const auto singles = singlesOf(lamp);
        for (size_t i = 0; i < singles.size(); ++i) {
            Fixture fixture = fixtureOf(lamp, scale * room.found.powers.lamps[l], singles[i]);
            putLabel(lamp.labels[i], fixture);
            if (singles.size() > 1) fixture.group = lamp.labels.front().id;
            lights.points.push_back(
                pointLightOf(fixture, static_cast<int>(lights.fixtures.size())));
            lights.fixtures.push_back(std::move(fixture));
        }
    }
    return lights;
}

std::vector<Opening> openingsOf(const FoundRoom& room)
{
    std::vector<Opening> openings;
    for (const Hole& hole : room.hits.holes) {
        glm::vec3 flux(0.0f);
        for (uint32_t part = hole.part; part < hole.part + hole.parts; ++part)
            flux += room.hits.shareOfPart[part] * room.found.powers.outside[part];
        flux *= room.tempering.scale;
        openings.push_back(
            {hole.centre, hole.normal, hole.area, flux / std::max(hole.area, 1e-9f)});
    }
    return openings;
}

std::vector<int32_t> fixturesOfSurfels(const FoundRoom& room)
{
    std::vector<int32_t> fixtureOf(room.radiance.plain.size(), FixtureMap::kWall);
    for (const FoundLamp& lamp : room.found.lamps) {
        if (lamp.isSunlit) continue;
        const auto singles = singlesOf(lamp);
        for (size_t i = 0; i < singles.size(); ++i)
            for (const ClippedPatch& patch : singles[i])
                if (patch.surfel != Surfels::kNone) fixtureOf[patch.surfel] = lamp.labels[i].id;
    }
    return fixtureOf;
}

} // namespace relamp
