#include "scenes/radiosity.h"

#include "base/parallel.h"
#include "base/radiometry.shared.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

namespace relamp::scenes
{
namespace
{

constexpr int kBounces = 12;
constexpr int kCells = 16; // patches along a wall

float inSteps(float linear)
{
    const float clipped = std::clamp(linear, 0.0f, 1.0f);
    const float srgb =
        clipped <= 0.0031308f ? 12.92f * clipped : 1.055f * std::pow(clipped, 1.0f / 2.4f) - 0.055f;
    const float byte = std::round(255.0f * srgb) / 255.0f;
    return byte <= 0.04045f ? byte / 12.92f : std::pow((byte + 0.055f) / 1.055f, 2.4f);
}

bool holds(const Panel& panel, glm::vec3 place, glm::vec3 normal)
{
    const glm::vec3 way = place - panel.corner;
    const glm::vec3 acrossU = glm::cross(panel.normal(), panel.alongU);
    const glm::vec3 acrossV = glm::cross(panel.normal(), panel.alongV);
    const float u = glm::dot(way, acrossV) / glm::dot(panel.alongU, acrossV);
    const float v = glm::dot(way, acrossU) / glm::dot(panel.alongV, acrossU);
    return glm::dot(normal, panel.normal()) > 0.9f &&
           std::abs(glm::dot(way, panel.normal())) < 1e-3f && u >= 0.0f && u <= 1.0f && v >= 0.0f &&
           v <= 1.0f;
}

} // namespace

// Lambert 1760: half the sum over edges of the angle that each is seen under, times the cosine
// between the normal and that of the plane through the edge and the place.
float irradianceFrom(const Panel& panel, glm::vec3 place, glm::vec3 normal)
{
    if (glm::dot(place - panel.corner, panel.normal()) <= 1e-6f) return 0.0f;
    const std::array<glm::vec3, 4> corners{
        glm::normalize(panel.at(0, 0) - place), glm::normalize(panel.at(1, 0) - place),
        glm::normalize(panel.at(1, 1) - place), glm::normalize(panel.at(0, 1) - place)};
    float sum = 0.0f;
    for (size_t i = 0; i < corners.size(); ++i) {
        const glm::vec3 from = corners[i];
        const glm::vec3 to = corners[(i + 1) % corners.size()];
        const glm::vec3 across = glm::cross(to, from);
        const float length = glm::length(across);
        if (length > 1e-9f)
            sum += std::atan2(length, glm::dot(from, to)) * glm::dot(across / length, normal);
    }
    return std::max(0.5f * sum, 0.0f);
}

LitBox::LitBox(glm::vec3 size, std::vector<ShiningPanel> lamps, Paint albedo)
    : walls_(wallsOf(size)), lamps_(std::move(lamps)), albedo_(std::move(albedo))
{
    constexpr float kStep = 1.0f / kCells;
    for (const Panel& wall : walls_)
        for (int v = 0; v < kCells; ++v)
            for (int u = 0; u < kCells; ++u) {
                const Panel panel{
                    wall.at(static_cast<float>(u) * kStep, static_cast<float>(v) * kStep),
                    kStep * wall.alongU, kStep * wall.alongV};
                const glm::vec3 centre = panel.at(0.5f, 0.5f);
                const bool shines = isLamp(centre, panel.normal());
                patches_.push_back(
                    {panel, shines ? glm::vec3(0.0f) : albedo_(centre, panel.normal())});
            }
    solve();
}

void LitBox::solve()
{
    const size_t count = patches_.size();
    std::vector<float> factors(count * count);
    std::vector<glm::vec3> direct(count);
    forEachChunk(count, 16, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const glm::vec3 place = patches_[i].panel.at(0.5f, 0.5f);
            const glm::vec3 normal = patches_[i].panel.normal();
            direct[i] = this->direct(place, normal);
            for (size_t j = 0; j < count; ++j)
                factors[i * count + j] = irradianceFrom(patches_[j].panel, place, normal);
        }
    });
    for (int bounce = 0; bounce < kBounces; ++bounce) {
        std::vector<glm::vec3> radiance(count);
        for (size_t i = 0; i < count; ++i)
            radiance[i] = patches_[i].albedo * (direct[i] + patches_[i].indirect) / kPi;
        forEachChunk(count, 16, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) {
                patches_[i].indirect = glm::vec3(0.0f);
                for (size_t j = 0; j < count; ++j)
                    patches_[i].indirect += factors[i * count + j] * radiance[j];
            }
        });
    }
}

glm::vec3 LitBox::direct(glm::vec3 place, glm::vec3 normal) const
{
    glm::vec3 sum(0.0f);
    for (const ShiningPanel& lamp : lamps_)
        sum += lamp.radiance * irradianceFrom(lamp.panel, place, normal);
    return sum;
}

/// Bilinear between the centres of patches, and on from the last of them.
glm::vec3 LitBox::indirect(glm::vec3 place, glm::vec3 normal) const
{
    const auto wall = static_cast<size_t>(
        std::find_if(walls_.begin(), walls_.end(),
                     [&](const Panel& w) { return glm::dot(w.normal(), normal) > 0.9f; }) -
        walls_.begin());
    const auto along = [&](glm::vec3 axis) {
        return kCells * glm::dot(place - walls_[wall].corner, axis) / glm::dot(axis, axis) - 0.5f;
    };
    const float u = along(walls_[wall].alongU);
    const float v = along(walls_[wall].alongV);
    const int column = std::clamp(static_cast<int>(u), 0, kCells - 2);
    const int row = std::clamp(static_cast<int>(v), 0, kCells - 2);
    const size_t first = wall * kCells * kCells + static_cast<size_t>(row * kCells + column);
    const float right = u - static_cast<float>(column);
    const float down = v - static_cast<float>(row);
    const glm::vec3 upper = glm::mix(patches_[first].indirect, patches_[first + 1].indirect, right);
    const glm::vec3 lower =
        glm::mix(patches_[first + kCells].indirect, patches_[first + kCells + 1].indirect, right);
    return glm::max(glm::mix(upper, lower, down), glm::vec3(0.0f));
}

glm::vec3 LitBox::irradiance(glm::vec3 place, glm::vec3 normal) const
{
    return direct(place, normal) + indirect(place, normal);
}

bool LitBox::isLamp(glm::vec3 place, glm::vec3 normal) const
{
    return std::any_of(lamps_.begin(), lamps_.end(),
                       [&](const ShiningPanel& lamp) { return holds(lamp.panel, place, normal); });
}

glm::vec3 LitBox::photo(glm::vec3 place, glm::vec3 normal) const
{
    glm::vec3 radiance = albedo_(place, normal) * irradiance(place, normal) / kPi;
    for (const ShiningPanel& lamp : lamps_)
        if (holds(lamp.panel, place, normal)) radiance = lamp.radiance;
    return {inSteps(radiance.r), inSteps(radiance.g), inSteps(radiance.b)};
}

} // namespace relamp::scenes
