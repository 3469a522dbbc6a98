#include "albedo/confidence.h"

#include "lights/burnt_out.shared.h"

#include <algorithm>
#include <cmath>

namespace relamp
{
namespace
{

constexpr float kSafelyBelow = 0.9f;
constexpr float kWellLit = 4.0f; // times `darkest`

float ramp(float from, float to, float value)
{
    return std::clamp((value - from) / (to - from), 0.0f, 1.0f);
}

} // namespace

float confidence(glm::vec3 radiance, glm::vec3 shading, float darkest)
{
    const float brightest = brightestChannel(radiance);
    const float weakest = std::min({shading.r, shading.g, shading.b});
    return ramp(kBurntOut, kSafelyBelow, brightest) * ramp(darkest, kWellLit * darkest, weakest);
}

uint8_t confidenceByte(float confidence)
{
    return static_cast<uint8_t>(std::lround(255.0f * confidence));
}

} // namespace relamp
