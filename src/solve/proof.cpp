#include "solve/proof.h"

#include <string>
#include <vector>

namespace relamp
{
namespace
{

constexpr float kUnproven = 0.4f; // of confidence; so that all of it is low, below one half

} // namespace

Witnesses witnessesOf(const Texels& texels, const RayScene& scene, const FoundRoom& room)
{
    const auto& texture = room.texture.empty() ? room.radiance.plain : room.texture;
    return witnessesOf(texels.surfels, scene, texture, room.radiance, room.found.changeUnseen,
                       room.options.quality, room.rooms);
}

void temper(const Texels& texels, const Witnesses& witnesses, std::span<const glm::vec3> irradiance,
            FoundRoom& room)
{
    if (room.isGiven) return;
    room.tempering = temperingFor(witnesses, irradiance);
    if (!isOfScan(room.tempering) || room.linearization.isNeutral()) return;
    room.found.camera = {};
    room.linearization = {};
    room.radiance = collectRadiance(texels, unwatched());
}

void prove(const Witnesses& witnesses, std::span<const glm::vec3> irradiance, Solution& solution)
{
    solution.crossValidation = crossValidate(witnesses, irradiance, solution.lights.tempering);
    const std::vector<std::string> warnings = warningsOf(solution.crossValidation);
    if (warnings.empty()) return;
    solution.warnings.insert(solution.warnings.end(), warnings.begin(), warnings.end());
    for (SurfelTrust& trust : solution.texels.trust) trust.proven = kUnproven;
}

} // namespace relamp
