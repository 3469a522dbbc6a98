#include "relight/seen_lamp.h"

#include "lights/shining.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace relamp
{

SeenLamp::SeenLamp(const NewLight& light) : light_(light), frame_(frameOf(light))
{
    const bool isPanel = light.type == LightType::rectangle || light.type == LightType::disc;
    if (!isPanel) bulb_.emplace(light);
}

bool SeenLamp::hasSurface(const NewLight& light)
{
    if (light.type == LightType::sun) return false;
    return !isDark(light.emission) && (light.type == LightType::rectangle || light.radius > 0.0f);
}

std::optional<SeenLamp::Glow> SeenLamp::along(const Ray& ray) const
{
    return bulb_ ? ofBulb(ray) : ofPanel(ray);
}

std::optional<SeenLamp::Glow> SeenLamp::ofBulb(const Ray& ray) const
{
    const glm::vec3 way = light_.position - ray.origin;
    const float ahead = glm::dot(way, ray.direction);
    const glm::vec3 aside = way - ahead * ray.direction;
    const float depth = light_.radius * light_.radius - glm::dot(aside, aside);
    if (depth <= 0.0f || ahead <= light_.radius) return {};
    // A disc of the bulb's size that faces the ray and has its intensity.
    const float area = glm::pi<float>() * light_.radius * light_.radius;
    return Glow{ahead - std::sqrt(depth),
                bulb_->intensityTowards(-ray.direction) / area * light_.emission};
}

std::optional<SeenLamp::Glow> SeenLamp::ofPanel(const Ray& ray) const
{
    const float facing = -glm::dot(ray.direction, frame_[2]);
    const glm::vec3 from = ray.origin - light_.position;
    const float distance = glm::dot(from, frame_[2]) / facing;
    if (facing <= 1e-6f || distance <= 0.0f) return {};
    const glm::vec3 at = from + distance * ray.direction;
    const float u = glm::dot(at, frame_[0]);
    const float v = glm::dot(at, frame_[1]);
    const bool isMet =
        light_.type == LightType::disc
            ? u * u + v * v <= light_.radius * light_.radius
            : 2.0f * std::abs(u) <= light_.size.x && 2.0f * std::abs(v) <= light_.size.y;
    if (!isMet) return {};
    return Glow{distance, light_.emission};
}

std::vector<SeenLamp> seenLamps(std::span<const NewLight> lights)
{
    std::vector<SeenLamp> lamps;
    for (const NewLight& light : lights)
        if (SeenLamp::hasSurface(light)) lamps.emplace_back(light);
    return lamps;
}

} // namespace relamp
