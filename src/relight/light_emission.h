#pragma once

#include "lights/json_item.h"
#include "relamp/relight.h"
#include "relight/photometry.h"

#include <optional>

#include <glm/vec3.hpp>

namespace relamp
{

/// What a person said of a light's colour and strength, in either kind of unit.
struct EmissionWish
{
    std::optional<float> kelvin;
    std::optional<glm::vec3> colour; // of luminance 1
    std::optional<float> lumens;

    /// Colour of luminance 1: as wished, else `otherwise`.
    [[nodiscard]] glm::vec3 colourOr(glm::vec3 otherwise, const PhotometricWhite& white) const;
};

/// Reads "kelvin", "colour", and "lumens" or "watts" (of light, not of electricity).
EmissionWish emissionWishOf(const JsonItem& item);

/// Emission of a light whose shape is known, from the one of "intensity", "radiance", "irradiance",
/// "lumens", "watts", "candela", "nits" and "lux" that fits its type and stands there.
glm::vec3 emissionOf(const JsonItem& item, const NewLight& light, const PhotometricWhite& white);

/// Solid angle, sr, over which a spot of these angles sends as much as if it did not fade out.
float solidAngleOfSpot(float cone, float blend);

/// A fixture's radiance under a wish; what it leaves open stays as it was captured.
glm::vec3 radianceUnder(const EmissionWish& wish, const Fixture& captured,
                        const PhotometricWhite& white);

/// The sun that delight found, as a light that somebody puts up.
NewLight asNewLight(const Sun& sun);

} // namespace relamp
