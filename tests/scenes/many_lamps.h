#pragma once

#include "scenes/radiosity.h"

namespace relamp::scenes
{

/// A hall under a grid of ceiling panels, which send out as much together whatever their number.
struct ManyLamps
{
    static constexpr glm::vec3 kSize{20.0f, 4.0f, 15.0f};
    static constexpr glm::vec2 kLampSize{0.5f, 0.45f}; // m along x and z
    static constexpr glm::vec3 kRadianceOf300{6.0f, 5.4f, 4.5f};

    glm::vec3 lampRadiance;
    LitBox box;
    Scan scan; // a photo of it

    ManyLamps(int alongX, int alongZ);

    /// Area times radiance of one.
    [[nodiscard]] glm::vec3 lampPower() const { return kLampSize.x * kLampSize.y * lampRadiance; }
};

} // namespace relamp::scenes
