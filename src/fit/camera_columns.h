#pragma once

#include "fit/light_model.h"
#include "relamp/gain.h"
#include "relamp/response.h"

#include <optional>
#include <span>

#include <glm/vec3.hpp>

namespace relamp
{

/// What a camera may have done to a texture, as far as it is sought or known.
struct CameraModel
{
    std::optional<Response> response; // none: it is straight
    std::optional<Gain> gain;         // none: it is 1 everywhere
};

/// A lattice over these places that nothing is known of; none where they lie too close together.
std::optional<Gain> latticeOver(std::span<const glm::vec3> positions);

/// The slopes of the response, less 1, and the logarithms of the gain's knots, one for all
/// channels, as unknowns beside the light. `texture` is what places at `positions` show in the
/// file.
CameraColumns columnsOf(const CameraModel& known, std::span<const glm::vec3> texture,
                        std::span<const glm::vec3> positions);

/// The model with these coefficients of the columns.
CameraModel withCoefficients(CameraModel model, std::span<const double> coefficients);

} // namespace relamp
