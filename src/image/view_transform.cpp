#include "image/view_transform.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace relamp
{
namespace
{

// ---- AgX: Sobotka, AgX (github.com/sobotka/AgX-S2O3), 2022

constexpr float kMiddleGrey = 0.18f;
constexpr float kStopsBelow = 10.0f; // of middle grey; what is darker is black
constexpr float kStopsAbove = 6.5f;  // what is brighter is white
constexpr float kInset = 0.2f;       // how far the primaries move out, so that colours move in

/// X + Y + Z of a Rec. 709 primary as a share of white's: with it, mixing a colour with its mean
/// moves it on a straight line towards white in the chromaticity diagram.
const glm::vec3 kShareOfWhite(0.2120f, 0.3922f, 0.3958f);

/// AgX's matrix: primaries 1 / (1 - inset) as far from white are what the curve works on.
glm::vec3 inset(glm::vec3 rgb)
{
    return (1.0f - kInset) * rgb + kInset * glm::dot(kShareOfWhite, rgb);
}

glm::vec3 outset(glm::vec3 rgb)
{
    return (rgb - kInset * glm::dot(kShareOfWhite, rgb)) / (1.0f - kInset);
}

/// One half of a sigmoid: from the pivot, where the slope is `slope`, to (reach, reach in y).
float halfSigmoid(float x, float reachX, float reachY, float power)
{
    constexpr float kSlope = 2.0f;
    const float scale = std::pow(std::pow(kSlope * reachX, -power) *
                                     (std::pow(kSlope * reachX / reachY, power) - 1.0f),
                                 -1.0f / power);
    const float term = kSlope * x / scale;
    return scale * term / std::pow(1.0f + std::pow(term, power), 1.0f / power);
}

/// From the share of the range in stops to the share of a display's range, of exponent 2.2.
float agxCurve(float share)
{
    constexpr float kPivot = kStopsBelow / (kStopsBelow + kStopsAbove);
    constexpr float kToePower = 3.0f;
    constexpr float kShoulderPower = 3.25f;
    return share < kPivot ? 0.5f - halfSigmoid(kPivot - share, kPivot, 0.5f, kToePower)
                          : 0.5f + halfSigmoid(share - kPivot, 1.0f - kPivot, 0.5f, kShoulderPower);
}

/// agxCurve at even steps, for a picture has a million pixels.
class AgxTable
{
public:
    AgxTable()
    {
        for (size_t i = 0; i < values_.size(); ++i)
            values_[i] = agxCurve(static_cast<float>(i) / kSteps);
    }
    float operator()(float share) const
    {
        const float at = share * kSteps;
        const auto below = std::min(static_cast<size_t>(at), values_.size() - 2);
        return glm::mix(values_[below], values_[below + 1], at - static_cast<float>(below));
    }

private:
    static constexpr float kSteps = 2048.0f;
    std::array<float, 2049> values_{};
};

glm::vec3 agx(glm::vec3 rgb)
{
    static const AgxTable curve;
    rgb = inset(rgb);
    for (int c = 0; c < 3; ++c) {
        const float stops = std::log2(std::max(rgb[c], 1e-10f) / kMiddleGrey);
        rgb[c] = curve(glm::clamp((stops + kStopsBelow) / (kStopsBelow + kStopsAbove), 0.0f, 1.0f));
    }
    return glm::pow(glm::clamp(outset(rgb), 0.0f, 1.0f), glm::vec3(2.2f));
}

// ---- ACES: Hill's fit of its reference rendering and sRGB output transforms, 2017
// (github.com/TheRealMJP/BakingLab, ACES.hlsl)

glm::vec3 aces(glm::vec3 rgb)
{
    // Rec. 709 to the rendering primaries, with the saturation that the reference rendering takes.
    const glm::vec3 in(0.59719f * rgb.r + 0.35458f * rgb.g + 0.04823f * rgb.b,
                       0.07600f * rgb.r + 0.90834f * rgb.g + 0.01566f * rgb.b,
                       0.02840f * rgb.r + 0.13383f * rgb.g + 0.83777f * rgb.b);
    const glm::vec3 v =
        (in * (in + 0.0245786f) - 0.000090537f) / (in * (0.983729f * in + 0.4329510f) + 0.238081f);
    return {1.60475f * v.r - 0.53108f * v.g - 0.07367f * v.b,
            -0.10208f * v.r + 1.10813f * v.g - 0.00605f * v.b,
            -0.00327f * v.r - 0.07276f * v.g + 1.07602f * v.b};
}

constexpr float kBrightest = 1e6f; // beyond it every view is white, and squares are still floats

} // namespace

ViewTransform::ViewTransform(const ViewOptions& options)
    : view_(options.view), scale_(std::exp2(options.exposure))
{}

glm::vec3 ViewTransform::displayed(glm::vec3 radiance) const
{
    const glm::vec3 light = glm::min(scale_ * radiance, kBrightest);
    switch (view_) {
    case View::standard:
        return glm::clamp(light, 0.0f, 1.0f);
    case View::agx:
        return agx(light);
    case View::aces:
        return glm::clamp(aces(light), 0.0f, 1.0f);
    }
    return light;
}

} // namespace relamp
