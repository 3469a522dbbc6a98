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
};

/// `roomOfSurfel`: from 0 on; empty: there is one room. A room has the gain whose lattice lies
/// around its middle.
Linearization linearizationOf(const CameraModel& camera, const Surfels& surfels,
                              std::span<const uint8_t> roomOfSurfel = {});

/// Radiance, 1 = white, of a linear value of a texture where the factor is `perGain`. What is burnt
/// out stays as it is, and nothing else becomes that.
glm::vec3 withoutGain(glm::vec3 radiance, glm::vec3 perGain);

} // namespace relamp
