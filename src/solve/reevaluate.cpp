#include "solve/reevaluate.h"

#include "base/call_all.h"
#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "fit/lamp_groups.h"
#include "fit/light_correction.h"
#include "solve/albedo_scale.h"
#include "solve/cross_validation.h"
#include "solve/proof.h"

#include <algorithm>
#include <utility>

namespace relamp
{
namespace
{

constexpr float kHardlyLit = 1e-3f; // irradiance

std::vector<glm::vec3> indirectOf(const Texels& texels, const SolvedRoom& room)
{
    const FoundRoom& found = room.found;
    return indirectOfFronts(texels.surfels, found.hits, found.sides);
}

/// What a lamp would bring to every surfel's front with nothing in the way, of all the light there.
std::vector<float> openShares(const FoundRoom& room, std::span<const glm::vec3> indirect,
                              size_t lamp)
{
    const LampSight& onSides = onSidesOf(room, lamp);
    const float brightness = luminance(room.found.powers.lamps[lamp]);
    std::vector<float> shares(indirect.size());
    forEach(shares.size(), [&](size_t s) {
        const Side side = Side::front(static_cast<uint32_t>(s));
        const auto front = static_cast<size_t>(room.hits.listOfSide[side.index]);
        const float all = luminance(room.sides.direct[front] + indirect[s]);
        shares[s] = onSides[front].open * brightness / std::max(all, kHardlyLit);
    });
    return shares;
}

std::shared_ptr<const GatheredLight> lightOf(const Texels& texels, const RayScene& scene,
                                             const FoundRoom& room, std::vector<glm::vec3> indirect)
{
    std::vector<LampPatches> lamps;
    const auto rays = static_cast<size_t>(room.options.shadowRays);
    Visibility visibility(texels, scene, {}, {}, {});
    for (size_t l = 0; l < room.found.lamps.size(); ++l) {
        const FoundLamp& lamp = room.found.lamps[l];
        const AreaLight area(lamp.patches);
        const size_t singles = singlesOf(lamp).size();
        lamps.emplace_back(area);
        visibility.add(scene, area, lamp.onSides, rays * raysToGroup(singles),
                       openShares(room, indirect, l));
    }
    if (const auto& sun = room.found.sun) {
        const AreaLight disc(sunDisc(sun->sun, *texels.scan));
        lamps.emplace_back(disc);
        visibility.add(sun->outside, disc, sun->onSides, rays,
                       openShares(room, indirect, room.found.lamps.size()), sun->inShade);
    }
    return std::make_shared<const GatheredLight>(GatheredLight{
        std::make_shared<const CastLamps>(std::move(lamps), std::move(visibility), texels.surfels),
        room.found.powers.lamps, std::move(indirect)});
}

/// Lets all follow that the light between surfels leads to.
void shine(const Texels& texels, SolvedRoom& room, std::vector<glm::vec3> indirect)
{
    room.light = std::make_shared<const GatheredLight>(
        GatheredLight{room.light->lamps, room.found.found.powers.lamps, std::move(indirect)});
    room.lighting = lightOnSurfels(texels.surfels, *room.light);
}

} // namespace

SolvedRoom solvedRoom(const Texels& texels, const RayScene& scene, FoundRoom found,
                      const std::function<void(const SolvedRoom&)>& meanwhile)
{
    SolvedRoom room{.found = std::move(found)};
    room.light = lightOf(texels, scene, room.found, indirectOf(texels, room));
    room.lighting = lightOnSurfels(texels.surfels, *room.light);
    room.witnesses = witnessesOf(texels, scene, room.found);
    temper(texels, room.witnesses, room.lighting.irradiance, room.found);
    const SurfelLighting light = foundLight(texels, room.found.radiance,
                                            shadingOf(texels, room.light), room.lighting.spread);
    // By a draft's few rays the noise of its light would be taken for leaks.
    const bool isDraft = room.found.options.quality == Quality::draft;
    const float gaps = isDraft ? 0.0f : room.found.found.gaps;
    std::vector<float> lit; // mostly on one core
    callAll(
        [&] {
            lit = correctionOf(texels.surfels, room.found.radiance, room.found.hits, light, gaps);
        },
        [&] { meanwhile(room); });
    room.lit = std::move(lit);
    scaleAlbedo(irradianceOf(room),
                crossValidate(room.witnesses, room.lighting.irradiance, room.found.tempering),
                room.found);
    return room;
}

std::vector<glm::vec3> irradianceOf(const SolvedRoom& room)
{
    return corrected(room.lighting.irradiance, room.lit);
}

void reevaluate(const Texels& texels, SolvedRoom& room, const LampPowers& powers)
{
    room.found.found.powers = powers;
    room.found.sides = sidesOf(texels, room.found);
    shine(texels, room, indirectOf(texels, room));
}

void reevaluate(const Texels& texels, SolvedRoom& room, const LampPowers& powers,
                SettledLight light)
{
    FoundRoom& found = room.found;
    found.found.powers = powers;
    Gathered gathered{.irradiance = std::move(light.gathered),
                      .missed = std::move(found.sides.gathered.missed)}; // of the mesh alone
    found.sides = sidesOf(texels, found, std::move(gathered));
    shine(texels, room, std::move(light.indirect));
}

TexelShading shadingOf(const Texels& texels, const SolvedRoom& room)
{
    return corrected(texels, shadingOf(texels, room.light), room.lit);
}

} // namespace relamp
