#pragma once

#include "lights/candidates.h"
#include "shading/lit_sides.h"

#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// How bright walls would be that stood in the places of lamps to be, by the light of the others:
/// what each does to a few surfels of each is looked at once, for all powers.
class BrightWalls
{
public:
    /// `lamps` are their patches.
    BrightWalls(const Texels& texels, const RayScene& scene, const HitLists& hits,
                std::span<const std::span<const ClippedPatch>> lamps);

    /// Luminance of a bright wall in the place of one, where the others have these radiances; 0
    /// where none of it was scanned.
    [[nodiscard]] float insteadOf(size_t lamp, const RadianceField& field, glm::vec3 ambient,
                                  std::span<const glm::vec3> radiances) const;

private:
    const HitLists& hits_;
    std::vector<uint32_t> lists_;                // of the surfels that are looked at, by lamp
    std::vector<size_t> first_;                  // [lamp]: in lists_; and the end
    std::vector<std::vector<AreaSample>> light_; // [lamp][list], at radiance 1
};

} // namespace relamp
