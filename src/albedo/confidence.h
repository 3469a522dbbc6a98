#pragma once

#include "fit/reliability.h"
#include "relamp/delight.h"

#include <cstdint>

#include <glm/vec3.hpp>

namespace relamp
{

/// How far an albedo can be believed, 0..1, and what speaks most against it.
struct Confidence
{
    float value = 1.0f;
    Doubt doubt = Doubt::none; // none from one half on

    [[nodiscard]] uint8_t byte() const;
};

/// 0 where the texture is burnt out or the shading did not reach `darkest`, rising to 1 where all
/// channels are below nine tenths of white and the shading is four times `darkest`; times what
/// `trust` leaves, and less where light lacks: 0 from twice the shading on. White means nothing in
/// a texture that does not clip there. `hidden`: how far noise of the texture hides the brightest
/// channel, 0..1.
Confidence confidenceOf(glm::vec3 radiance, bool clips, glm::vec3 shading, float darkest,
                        SurfelTrust trust = {}, float hidden = 0.0f);

} // namespace relamp
