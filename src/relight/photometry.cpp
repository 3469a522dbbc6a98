#include "relight/photometry.h"

#include "base/radiometry.shared.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/common.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/mat3x3.hpp>

namespace relamp
{
namespace
{

/// A bell with a width of its own on either side of its peak; nanometres.
double bell(double wavelength, double peak, double perNmBelow, double perNmAbove)
{
    const double t = (wavelength - peak) * (wavelength < peak ? perNmBelow : perNmAbove);
    return std::exp(-0.5 * t * t);
}

/// CIE 1931 colour matching functions as sums of bells: Wyman, Sloan, Shirley, Simple Analytic
/// Approximations to the CIE XYZ Color Matching Functions, JCGT 2013, section 2.2.
glm::dvec3 colourMatching(double nm)
{
    return {1.056 * bell(nm, 599.8, 0.0264, 0.0323) + 0.362 * bell(nm, 442.0, 0.0624, 0.0374) -
                0.065 * bell(nm, 501.1, 0.0490, 0.0382),
            0.821 * bell(nm, 568.8, 0.0213, 0.0247) + 0.286 * bell(nm, 530.9, 0.0613, 0.0322),
            1.217 * bell(nm, 437.0, 0.0845, 0.0278) + 0.681 * bell(nm, 459.0, 0.0385, 0.0725)};
}

/// Planck's law up to a factor.
double planck(double nm, double kelvin)
{
    constexpr double kSecondConstant = 1.438776877e7; // hc/k, nm K
    return std::pow(nm / 560.0, -5.0) / std::expm1(kSecondConstant / (nm * kelvin));
}

/// Linear Rec. 709 from CIE XYZ (ITU-R BT.709 primaries, D65).
glm::dvec3 rec709FromXyz(glm::dvec3 xyz)
{
    return {3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
            -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
            0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z};
}

glm::vec3 withLuminanceOne(glm::vec3 rgb)
{
    rgb = glm::max(rgb, glm::vec3(0.0f));
    return rgb / luminance(rgb);
}

} // namespace

glm::vec3 blackbodyColour(float kelvin)
{
    assert(kelvin >= kColdestKelvin && kelvin <= kHottestKelvin);
    glm::dvec3 xyz(0.0);
    for (double nm = 360.0; nm <= 830.0; nm += 5.0) xyz += planck(nm, kelvin) * colourMatching(nm);
    return withLuminanceOne(rec709FromXyz(xyz / xyz.y));
}

glm::vec3 blackbodyColour(float kelvin, const PhotometricWhite& white)
{
    // A channel that the white does not have cannot be balanced; that is a candle's blue.
    const glm::vec3 balance = glm::max(blackbodyColour(white.kelvin), glm::vec3(0.01f));
    return withLuminanceOne(blackbodyColour(kelvin) / balance);
}

glm::vec3 radiometric(float photometric, glm::vec3 colour, const PhotometricWhite& white)
{
    return photometric / white.luminance * colour;
}

glm::vec3 intensityFromLumens(float lumens, float solidAngle, glm::vec3 colour,
                              const PhotometricWhite& white)
{
    return radiometric(lumens / solidAngle, colour, white);
}

glm::vec3 radianceFromLumens(float lumens, float area, glm::vec3 colour,
                             const PhotometricWhite& white)
{
    return radiometric(lumens / (glm::pi<float>() * area), colour, white);
}

} // namespace relamp
