#include "image/texture_noise.h"

#include <algorithm>
#include <cmath>

namespace relamp
{
namespace
{

constexpr float kOfRounding = 0.2887f / 255.0f; // of a byte: uniform within half a step
constexpr float kOfJpeg = 2.0f / 255.0f;        // in dark places, at a quality of 90 to 95
constexpr float kToeSlope = 12.92f;             // of sRGB
constexpr float kSteepness = 2.4f / 1.055f;     // of its logarithm, above the toe

} // namespace

TextureNoise textureNoiseOf(const Image& image, const Response& response)
{
    if (!image.clipsAtWhite) return {.slope = 1.0f};
    const float deviation = image.wasJpeg ? kOfJpeg : kOfRounding;
    const bool isLinear = image.transfer == Transfer::linear;
    TextureNoise noise{.toe = isLinear ? deviation : deviation / kToeSlope,
                       .steep = isLinear ? 0.0f : kSteepness * deviation,
                       .slope = response.slope.front()};
    const float dark = std::exp2(Response::kAt.front()); // the slope is constant below
    noise.offset = std::log(response(dark)) - noise.slope * std::log(dark);
    // Where the share is just kHardlyHidden.
    const float least = kHueOfPaint * std::sqrt(kHardlyHidden / (1.0f - kHardlyHidden));
    const float visible = std::max(noise.slope * noise.toe / least,
                                   std::pow(noise.slope * noise.steep / least, 2.4f));
    noise.visibleFrom = std::exp(noise.offset + noise.slope * std::log(visible));
    return noise;
}

} // namespace relamp
