#include "relight/light_emission.h"

#include "base/radiometry.shared.h"
#include "relight/ies.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace relamp
{
namespace
{

constexpr glm::vec3 kWhite(1.0f);

/// The units of emission of a type of light: RGB, photometric, and whether lumens are one.
struct Units
{
    const char* rgb;
    const char* photometric;
    bool lumens;
};

Units unitsOf(LightType type)
{
    switch (type) {
    case LightType::point:
    case LightType::spot:
        return {"intensity", "candela", true};
    case LightType::sun:
        return {"irradiance", "lux", false};
    case LightType::rectangle:
    case LightType::disc:
    case LightType::sphere:
        break;
    }
    return {"radiance", "nits", true};
}

float areaOf(const NewLight& light)
{
    const float squared = light.radius * light.radius;
    if (light.type == LightType::sphere) return 4.0f * kPi * squared;
    return light.type == LightType::disc ? kPi * squared : light.size.x * light.size.y;
}

} // namespace

glm::vec3 EmissionWish::colourOr(glm::vec3 otherwise, const PhotometricWhite& white) const
{
    if (colour) return *colour;
    return kelvin ? blackbodyColour(*kelvin, white) : otherwise;
}

EmissionWish emissionWishOf(const JsonItem& item)
{
    EmissionWish wish;
    if (item.has("kelvin")) {
        wish.kelvin = item.numberAt("kelvin");
        if (*wish.kelvin < kColdestKelvin || *wish.kelvin > kHottestKelvin)
            item.refuse(fmt::format("\"kelvin\" must lie between {} and {}", kColdestKelvin,
                                    kHottestKelvin),
                        "kelvin");
    }
    if (item.has("colour")) {
        const glm::vec3 colour = item.lightAt("colour");
        const float brightness = luminance(colour);
        if (brightness <= 0.0f) item.refuse("\"colour\" is black", "colour");
        if (wish.kelvin) item.refuse("\"colour\" and \"kelvin\" say the same; name one", "colour");
        wish.colour = colour / brightness;
    }
    if (item.has("lumens")) wish.lumens = item.size("lumens");
    if (item.has("watts")) {
        if (wish.lumens) item.refuse("\"watts\" and \"lumens\" say the same; name one", "watts");
        wish.lumens = kLumensPerWatt * item.size("watts");
    }
    return wish;
}

float solidAngleOfSpot(float cone, float blend)
{
    constexpr int kSteps = 256;
    const float outer = std::cos(cone);
    const float inner = std::cos(cone * (1.0f - blend));
    float fading = 0.0f; // mean of the smooth step
    for (int i = 0; i < kSteps; ++i) {
        const float t = (static_cast<float>(i) + 0.5f) / kSteps;
        fading += t * t * (3.0f - 2.0f * t) / kSteps;
    }
    return 2.0f * kPi * ((1.0f - inner) + fading * (inner - outer));
}

glm::vec3 emissionOf(const JsonItem& item, const NewLight& light, const PhotometricWhite& white)
{
    const Units units = unitsOf(light.type);
    const bool isPhotometric = item.has(units.photometric);
    const int given = static_cast<int>(item.has(units.rgb)) + static_cast<int>(isPhotometric) +
                      static_cast<int>(units.lumens && (item.has("lumens") || item.has("watts")));
    const std::string choices =
        units.lumens
            ? fmt::format("\"{}\", \"{}\", \"lumens\" or \"watts\"", units.rgb, units.photometric)
            : fmt::format("\"{}\" or \"{}\"", units.rgb, units.photometric);
    if (given > 1) item.refuse(fmt::format("has more than one of {}", choices));
    if (given == 0 && !light.profile) item.refuse(fmt::format("needs {}", choices));
    if (item.has(units.rgb)) return item.lightAt(units.rgb);

    const EmissionWish wish = emissionWishOf(item);
    const glm::vec3 colour = wish.colourOr(kWhite, white);
    if (isPhotometric) return radiometric(item.size(units.photometric), colour, white);
    if (units.photometric == std::string("nits"))
        return radianceFromLumens(*wish.lumens, std::max(areaOf(light), 1e-6f), colour, white);
    const float solidAngle =
        light.type == LightType::spot ? solidAngleOfSpot(light.cone, light.blend) : 4.0f * kPi;
    return intensityFromLumens(*wish.lumens, solidAngle, colour, white);
}

glm::vec3 radianceUnder(const EmissionWish& wish, const Fixture& captured,
                        const PhotometricWhite& white)
{
    const float brightness = luminance(captured.radiance);
    const glm::vec3 own = brightness > 0.0f ? captured.radiance / brightness : kWhite;
    const glm::vec3 colour = wish.colourOr(own, white);
    if (!wish.lumens) return brightness * colour;
    return radianceFromLumens(*wish.lumens, std::max(captured.area, 1e-6f), colour, white);
}

NewLight asNewLight(const Sun& sun)
{
    return {.type = LightType::sun, .emission = sun.irradiance, .direction = -sun.direction};
}

} // namespace relamp
