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

/// 1 - `burntOut`, how likely any channel is; 0 where the shading did not reach `darkest`, rising
/// to 1 where it is four times as much; times what `trust` leaves, and less where light lacks: 0
/// from twice the shading on. `hidden`: how far noise of the texture hides the brightest channel,
/// 0..1.
Confidence confidenceOf(glm::vec3 radiance, float burntOut, glm::vec3 shading, float darkest,
                        SurfelTrust trust = {}, float hidden = 0.0f);

} // namespace relamp
