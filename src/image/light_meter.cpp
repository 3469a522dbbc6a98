#include "image/light_meter.h"

#include "base/half.h"
#include "base/radiometry.shared.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace relamp
{
namespace
{

constexpr double kKey = 0.18;   // that middle grey is shown as
constexpr double kDelta = 1e-5; // luminance; the paper's, so that what is nearly black counts less
constexpr float kMostStops = 32.0f;

} // namespace

void LightMeter::add(const Image& picture)
{
    const std::vector<uint16_t>& half = picture.half();
    assert(half.size() == 3 * picture.pixels());
    for (size_t i = 0; i < picture.pixels(); ++i) {
        const glm::vec3 rgb(floatFromHalf(half[3 * i]), floatFromHalf(half[3 * i + 1]),
                            floatFromHalf(half[3 * i + 2]));
        const float brightness = luminance(rgb);
        if (brightness <= 0.0f) continue;
        logs_ += std::log2(kDelta + brightness);
        ++pixels_;
    }
}

float LightMeter::exposure() const
{
    if (pixels_ == 0) return 0.0f;
    const double stops = std::log2(kKey) - logs_ / static_cast<double>(pixels_);
    return std::clamp(static_cast<float>(stops), -kMostStops, kMostStops);
}

} // namespace relamp
