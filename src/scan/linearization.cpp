#include "scan/linearization.h"

#include "image/burnt_out.shared.h"
#include "scan/gain.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>

namespace relamp
{

Linearization linearizationOf(const CameraModel& camera, const Surfels& surfels)
{
    Linearization linearization{.response = camera.response};
    if (camera.gain.isOne() && camera.tone.gain.isOne()) return linearization;
    linearization.perGain.reserve(surfels.count());
    for (const glm::vec3 place : surfels.position)
        linearization.perGain.push_back(
            glm::exp(-logAt(camera.tone.gain, place) - logAt(camera.gain, place)));
    return linearization;
}

glm::vec3 withoutGain(glm::vec3 radiance, glm::vec3 perGain)
{
    constexpr float kBrightest = 0.999f * kBurntOut;
    if (brightestChannel(radiance) >= kBurntOut) return radiance;
    return glm::min(perGain * radiance, glm::vec3(kBrightest));
}

} // namespace relamp
