#include "solve/reevaluate.h"

#include "base/call_all.h"
#include "base/parallel.h"
#include "base/radiometry.shared.h"
#include "fit/lamp_groups.h"
#include "fit/light_correction.h"
#include "solve/proof.h"
#include "solve/white_scale.h"

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
                              std::span<const AreaSample> onSides, glm::vec3 radiance)
{
    std::vector<float> shares(indirect.size());
    forEach(shares.size(), [&](size_t s) {
        const Side side = Side::front(static_cast<uint32_t>(s));
        const auto front = static_cast<size_t>(room.hits.listOfSide[side.index]);
        const float all = luminance(room.sides.direct[front] + indirect[s]);
        shares[s] = onSides[front].open * luminance(radiance) / std::max(all, kHardlyLit);
    });
    return shares;
}

std::shared_ptr<const GatheredLight> lightOf(const Texels& texels, const RayScene& scene,
                                             const FoundRoom& room, std::vector<glm::vec3> indirect)
{
    std::vector<LitLamp> lamps;
    const auto rays = static_cast<size_t>(room.options.shadowRays);
    const auto visibility = std::make_shared<Visibility>(
        texels, scene, std::span<const AreaLight>(), std::span<const std::vector<AreaSample>>(),
        VisibilityOptions{});
    for (const FoundLamp& lamp : room.found.lamps) {
        const AreaLight area(lamp.patches);
        const size_t singles = singlesOf(lamp).size();
        lamps.push_back({LampPatches(area), lamp.radiance});
        visibility->add(scene, area, lamp.onSides, rays * raysToGroup(singles),
                        openShares(room, indirect, lamp.onSides, lamp.radiance));
    }
    if (const auto& sun = room.sun) {
        const glm::vec3 radiance = sunRadiance(sun->sun);
        lamps.push_back({LampPatches(sun->disc), radiance});
        visibility->add(*sun->outside, sun->disc, sun->onSides, rays,
                        openShares(room, indirect, sun->onSides, radiance), sun->inShade);
    }
    return std::make_shared<const GatheredLight>(
        GatheredLight{std::move(lamps), visibility, std::move(indirect)});
}

/// Irradiance of all lists by lamps alone.
std::vector<glm::vec3> directUnder(const SolvedRoom& room, const LampPowers& powers)
{
    std::vector<glm::vec3> direct(room.found.hits.sideOfList.size(), glm::vec3(0.0f));
    for (size_t l = 0; l < powers.lamps.size(); ++l)
        addDirect(onSidesOf(room, l), powers.lamps[l], direct);
    return direct;
}

/// Lets the room's lamps shine like this.
void shine(const Texels& texels, SolvedRoom& room, const LampPowers& powers,
           std::vector<glm::vec3> indirect)
{
    const auto light = std::make_shared<GatheredLight>(*room.light);
    for (size_t l = 0; l < powers.lamps.size(); ++l) light->lamps[l].radiance = powers.lamps[l];
    light->indirect = std::move(indirect);
    room.lighting = lightOnSurfels(texels.surfels, *light);
    room.light = light;
}

} // namespace

SolvedRoom solvedRoom(const Texels& texels, const RayScene& scene, FoundRoom found,
                      const std::function<void(const SolvedRoom&)>& meanwhile)
{
    SolvedRoom room{.found = std::move(found)};
    room.light = lightOf(texels, scene, room.found, indirectOf(texels, room));
    room.lighting = lightOnSurfels(texels.surfels, *room.light);
    room.witnesses = witnessesOf(texels, room.found);
    temper(texels, room.witnesses, room.lighting.irradiance, room.found);
    std::vector<float> lit;
    callAll(
        [&] {
            lit = correctionOf(texels.surfels, room.found.radiance, room.found.hits,
                               foundLight(texels, room.found.radiance,
                                          shadingOf(texels, room.light), room.lighting.spread));
        },
        [&] { meanwhile(room); });
    room.lit = std::move(lit);
    scaleToWhite(irradianceOf(room), room.found);
    return room;
}

std::vector<glm::vec3> irradianceOf(const SolvedRoom& room)
{
    std::vector<glm::vec3> irradiance = room.lighting.irradiance;
    for (size_t s = 0; s < irradiance.size(); ++s) irradiance[s] *= room.lit[s];
    return irradiance;
}

std::span<const AreaSample> onSidesOf(const SolvedRoom& room, size_t lamp)
{
    const std::vector<FoundLamp>& lamps = room.found.found.lamps;
    return lamp < lamps.size() ? lamps[lamp].onSides : room.found.sun->onSides;
}

LampPowers powersOf(const SolvedRoom& room)
{
    LampPowers powers{.outside = room.found.found.outside};
    for (const LitLamp& lamp : room.light->lamps) powers.lamps.push_back(lamp.radiance);
    return powers;
}

void reevaluate(const Texels& texels, SolvedRoom& room, const LampPowers& powers)
{
    FoundRoom& found = room.found;
    found.sides = lightSides(texels, found.hits, found.radiance, directUnder(room, powers),
                             found.shines, powers.outside);
    found.found.outside = powers.outside;
    shine(texels, room, powers, indirectOf(texels, room));
}

void reevaluate(const Texels& texels, SolvedRoom& room, const LampPowers& powers,
                SettledLight light)
{
    FoundRoom& found = room.found;
    Gathered gathered{.irradiance = std::move(light.gathered),
                      .missed = std::move(found.sides.gathered.missed)}; // of the mesh alone
    found.sides =
        sidesFrom(texels, found.hits, found.radiance,
                  {directUnder(room, powers), std::move(gathered)}, found.shines, powers.outside);
    found.found.outside = powers.outside;
    shine(texels, room, powers, std::move(light.indirect));
}

TexelShading shadingOf(const Texels& texels, const SolvedRoom& room)
{
    return corrected(texels, shadingOf(texels, room.light), room.lit);
}

} // namespace relamp
