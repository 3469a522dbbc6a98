#include "solve/found_room.h"

#include "shading/direct_sum.h"

#include <cstddef>
#include <utility>

namespace relamp
{
namespace
{

/// Marks the surfels of the lamps that shine.
std::vector<uint8_t> marked(const FoundRoom& room, const LampPowers& powers, bool withSunlit)
{
    std::vector<uint8_t> shines(room.radiance.plain.size(), 0);
    for (size_t l = 0; l < room.found.lamps.size(); ++l) {
        const FoundLamp& lamp = room.found.lamps[l];
        if (powers.lamps[l] == glm::vec3(0.0f) || (lamp.isSunlit && !withSunlit)) continue;
        for (const ClippedPatch& patch : lamp.patches)
            if (patch.surfel != Surfels::kNone) shines[patch.surfel] = 1;
    }
    return shines;
}

} // namespace

const LampSight& onSidesOf(const FoundRoom& room, size_t lamp)
{
    const std::vector<FoundLamp>& lamps = room.found.lamps;
    return lamp < lamps.size() ? lamps[lamp].onSides : room.found.sun->onSides;
}

std::vector<glm::vec3> directOf(const FoundRoom& room)
{
    const std::vector<glm::vec3>& radiance = room.found.powers.lamps;
    std::vector<glm::vec3> direct(room.hits.sideOfList.size(), glm::vec3(0.0f));
    for (size_t l = 0; l < radiance.size(); ++l) addDirect(onSidesOf(room, l), radiance[l], direct);
    return direct;
}

LitSides sidesOf(const Texels& texels, const FoundRoom& room, std::optional<Gathered> settled)
{
    const LampPowers& powers = room.found.powers;
    return lightSides(texels, room.hits, room.radiance, directOf(room), shinesOf(room, powers),
                      powers.outside, std::move(settled));
}

std::vector<uint8_t> shinesOf(const FoundRoom& room, const LampPowers& powers)
{
    return marked(room, powers, true);
}

Shining shiningOf(const FoundRoom& room)
{
    return {marked(room, room.found.powers, false), 0.0f, room.glowsFrom};
}

std::vector<float> varianceOfCamera(const FoundRoom& room)
{
    const std::vector<glm::vec3>& texture =
        room.texture.empty() ? room.radiance.plain : room.texture;
    return varianceOfResponse(texture, room.radiance.plainArea, room.found.doubtOfResponse);
}

} // namespace relamp
