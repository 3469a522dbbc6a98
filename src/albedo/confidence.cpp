#include "albedo/confidence.h"

#include "image/burnt_out.shared.h"

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

float confidence(glm::vec3 radiance, bool clips, glm::vec3 shading, float darkest)
{
    const float whole = clips ? ramp(kBurntOut, kSafelyBelow, brightestChannel(radiance)) : 1.0f;
    const float weakest = std::min({shading.r, shading.g, shading.b});
    return whole * ramp(darkest, kWellLit * darkest, weakest);
}

uint8_t confidenceByte(float confidence)
{
    return static_cast<uint8_t>(std::lround(255.0f * confidence));
}

} // namespace relamp
