#include "solve/proof.h"

#include "base/radiometry.shared.h"

#include <string>
#include <vector>

namespace relamp
{
namespace
{

constexpr float kUnproven = 0.4f; // of confidence; so that all of it is low, below one half

} // namespace

void prove(const Witnesses& witnesses, std::span<const glm::vec3> irradiance, Solution& solution)
{
    std::vector<glm::vec3> shading;
    shading.reserve(witnesses.surfels.size());
    for (const uint32_t s : witnesses.surfels) shading.push_back(irradiance[s] / kPi);
    solution.texels.tempering = temperingFor(witnesses, shading);
    solution.crossValidation = crossValidate(witnesses, shading, solution.texels.tempering);
    const std::vector<std::string> warnings = warningsOf(solution.crossValidation);
    if (warnings.empty()) return;
    solution.warnings.insert(solution.warnings.end(), warnings.begin(), warnings.end());
    for (SurfelTrust& trust : solution.texels.trust) trust.proven = kUnproven;
}

} // namespace relamp
