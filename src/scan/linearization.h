#pragma once

#include "relamp/camera_model.h"
#include "scan/surfels.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relamp
{

/// What makes radiance of the linear values of a scan's textures: a camera's model undone.
struct Linearization
{
    Response response; // first this
    std::vector<glm::vec3>
        perGain; // then this factor, one a surfel: gain changes over metres. Empty: 1

    [[nodiscard]] bool isNeutral() const { return response.isStraight() && perGain.empty(); }

    /// Radiance that white of the texture stands for: what is burnt out was at least this.
    [[nodiscard]] glm::vec3 whiteOf(size_t surfel) const
    {
        return perGain.empty() ? glm::vec3(1.0f) : perGain[surfel];
    }
};

/// `roomOfSurfel`: from 0 on; empty: there is one room. A room has the gain whose lattice lies
/// around its middle.
Linearization linearizationOf(const CameraModel& camera, const Surfels& surfels,
                              std::span<const uint8_t> roomOfSurfel = {});

} // namespace relamp
