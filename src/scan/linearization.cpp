#include "scan/linearization.h"

#include "image/burnt_out.shared.h"

#include <glm/common.hpp>

namespace relamp
{

Linearization linearizationOf(const CameraModel& camera, const Surfels& surfels)
{
    Linearization linearization{.response = camera.response};
    if (camera.gain.isOne() && camera.tone.gain.isOne()) return linearization;
    linearization.perGain.reserve(surfels.count());
    for (const glm::vec3 place : surfels.position)
        linearization.perGain.push_back(1.0f /
                                        (camera.tone.gain.at(place) * camera.gain.at(place)));
    return linearization;
}

glm::vec3 withoutGain(glm::vec3 radiance, glm::vec3 perGain)
{
    constexpr float kBrightest = 0.999f * kBurntOut;
    if (brightestChannel(radiance) >= kBurntOut) return radiance;
    return glm::min(perGain * radiance, glm::vec3(kBrightest));
}

} // namespace relamp
