#include "solve/proof.h"

#include <string>
#include <vector>

namespace relamp
{
namespace
{

constexpr float kUnproven = 0.4f; // of confidence; so that all of it is low, below one half

} // namespace

Witnesses witnessesOf(const Texels& texels, const FoundRoom& room)
{
    const auto& texture = room.texture.empty() ? room.radiance.plain : room.texture;
    return witnessesOf(texels.surfels, texture, room.radiance, room.found.changeUnseen,
                       room.options.quality);
}

Tempering provenIn(const Texels& texels, const Witnesses& witnesses,
                   std::span<const glm::vec3> irradiance, FoundRoom& room)
{
    if (room.isGiven) return {};
    const Tempering tempering = temperingFor(witnesses, irradiance);
    if (tempering.isOfScan() && !room.linearization.isNeutral()) {
        room.found.camera = {};
        room.linearization = {};
        room.radiance = collectRadiance(texels, unwatched());
    }
    return tempering;
}

void prove(const Witnesses& witnesses, std::span<const glm::vec3> irradiance,
           const Tempering& tempering, Solution& solution)
{
    solution.texels.tempering = tempering;
    solution.crossValidation = crossValidate(witnesses, irradiance, tempering);
    const std::vector<std::string> warnings = warningsOf(solution.crossValidation);
    if (warnings.empty()) return;
    solution.warnings.insert(solution.warnings.end(), warnings.begin(), warnings.end());
    for (SurfelTrust& trust : solution.texels.trust) trust.proven = kUnproven;
}

} // namespace relamp
