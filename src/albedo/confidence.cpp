#include "albedo/confidence.h"

#include "albedo/divide.shared.h"
#include "base/ramp.h"
#include "image/burnt_out.shared.h"

#include <algorithm>
#include <cmath>

namespace relamp
{
namespace
{

constexpr float kWellLit = 4.0f;   // times `darkest`
constexpr float kMuchLacks = 2.0f; // times the shading

} // namespace

uint8_t Confidence::byte() const
{
    return static_cast<uint8_t>(std::lround(255.0f * value));
}

Confidence confidenceOf(glm::vec3 radiance, bool clips, glm::vec3 shading, float darkest,
                        SurfelTrust trust)
{
    struct Factor
    {
        float left;
        Doubt doubt;
    };
    const float lack = lightThatLacks(dividedByShading(radiance, shading, darkest));
    const float weakest = std::min({shading.r, shading.g, shading.b});
    const Factor factors[] = {
        {clips ? ramp(kBurntOut, kSafelyBelow, brightestChannel(radiance)) : 1.0f, Doubt::clipped},
        {ramp(darkest, kWellLit * darkest, weakest), Doubt::unlit},
        {trust.seen, Doubt::unseen},
        {trust.front, Doubt::backFace},
        {trust.edges, Doubt::penumbra},
        {ramp(kMuchLacks, 1.0f, lack), Doubt::whiterThanPaper}};
    Confidence confidence;
    float least = 1.0f;
    for (const Factor& factor : factors) {
        confidence.value *= factor.left;
        if (factor.left >= least) continue;
        least = factor.left;
        confidence.doubt = factor.doubt;
    }
    if (confidence.byte() >= 128) confidence.doubt = Doubt::none;
    return confidence;
}

} // namespace relamp
