#pragma once

#include "shading/gathered_light.h"
#include "solve/cross_validation.h"
#include "solve/found_room.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// A room that the gather solver has solved, with everything that does not change with the power
/// of its lamps: who sees whom, shadows, and what the mesh does not tell of.
struct SolvedRoom
{
    FoundRoom found;
    std::shared_ptr<const GatheredLight> light; // its lamps are those of `found`, then the sun
    SurfelLighting lighting;                    // what it brings to surfels
    std::vector<float> lit; // of surfels, as correctionOf(); of the first solution
    Witnesses witnesses;
};

/// Shadows, indirect light, how far it is believed, and its correction in a room whose lamps are
/// known. The last takes one thread: `meanwhile` is called beside it, with the room as it is but
/// for `lit`.
SolvedRoom solvedRoom(
    const Texels& texels, const RayScene& scene, FoundRoom found,
    const std::function<void(const SolvedRoom&)>& meanwhile = [](const auto&) {});

/// Changes the powers and all light that follows from them; casts no ray and fits nothing again.
/// The same powers give the same light, to the bit. What shades by the light before goes on to.
void reevaluate(const Texels& texels, SolvedRoom& room, const LampPowers& powers);

/// Light between the surfels of a room.
struct SettledLight
{
    std::vector<glm::vec3> gathered; // irradiance from surfaces that do not shine, one a hit list
    std::vector<glm::vec3> indirect; // as GatheredLight
};

/// The same where somebody else has settled the light under these powers.
void reevaluate(const Texels& texels, SolvedRoom& room, const LampPowers& powers,
                SettledLight light);

/// On surfels, corrected.
std::vector<glm::vec3> irradianceOf(const SolvedRoom& room);

/// Shading of the room's texels, but for the light that the texture shows at the rims of what is
/// enclosed; it follows reevaluate().
TexelShading shadingOf(const Texels& texels, const SolvedRoom& room);

} // namespace relamp
