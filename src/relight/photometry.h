#pragma once

#include <glm/vec3.hpp>

namespace relamp
{

/// Lumens of a watt of light (683, the definition of the candela), as KHR_lights_punctual and those
/// who write it take it. Of light, not of the electricity that a lamp draws.
constexpr float kLumensPerWatt = 683.0f;

/// Colour temperatures that blackbodyColour takes, kelvin.
constexpr float kColdestKelvin = 1000.0f;
constexpr float kHottestKelvin = 40000.0f;

/// What the white of a scan's texture stands for in the world. A scan does not tell: its camera's
/// exposure and white balance are unknown unless a person knows them.
struct PhotometricWhite
{
    float luminance = 100.0f; // cd/m^2 of radiance 1, > 0; a white sheet under 314 lux
    float kelvin = 6504.0f;   // of the blackbody that the texture shows as grey; D65 by default
};

/// Linear Rec. 709 of a blackbody, of luminance 1, none negative: what is redder than Rec. 709 can
/// show (below 1900 K) is its reddest. `kelvin` is kColdestKelvin..kHottestKelvin.
glm::vec3 blackbodyColour(float kelvin);

/// The same as a camera sees it that is balanced for `white.kelvin`: r = g = b there.
glm::vec3 blackbodyColour(float kelvin, const PhotometricWhite& white);

/// Radiance of a surface of `nits` cd/m^2; also irradiance from lux, radiant intensity (radiance
/// m^2) from candela and flux (radiance m^2 sr) from lumens. `colour` has luminance 1.
glm::vec3 radiometric(float photometric, glm::vec3 colour, const PhotometricWhite& white);

/// Radiant intensity, radiance m^2, of a lamp that spreads `lumens` evenly over `solidAngle` sr:
/// 4 pi for a point, 2 pi (1 - cos) for a cone.
glm::vec3 intensityFromLumens(float lumens, float solidAngle, glm::vec3 colour,
                              const PhotometricWhite& white);

/// Radiance of a matte surface of `area` m^2 that sends `lumens` from one side.
glm::vec3 radianceFromLumens(float lumens, float area, glm::vec3 colour,
                             const PhotometricWhite& white);

} // namespace relamp
