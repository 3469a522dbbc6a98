#include "image/view_transform.h"

#include "image/view_transform.shared.h"

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
    rgb = agxInset(rgb);
    for (int c = 0; c < 3; ++c) rgb[c] = curve(agxShare(rgb[c]));
    return glm::pow(glm::clamp(agxOutset(rgb), 0.0f, 1.0f), glm::vec3(2.2f));
}

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
        return glm::clamp(acesOf(light), 0.0f, 1.0f);
    }
    return light;
}

} // namespace relamp
