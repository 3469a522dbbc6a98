#include "shading/rectangle_direct.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>

namespace relamp
{
namespace
{

constexpr float kInItsPlane = 1e-6f; // m

/// Ways from a place to the corners of what it sees of a rectangle.
struct SeenPolygon
{
    std::array<glm::vec3, 5> ways; // a plane cuts a corner off at most
    size_t count = 0;
};

/// What lies above the horizon of `normal` (Sutherland & Hodgman 1974, for the one plane).
SeenPolygon aboveHorizon(const ShiningRectangle& rectangle, glm::vec3 place, glm::vec3 normal)
{
    SeenPolygon seen;
    const auto& corners = rectangle.corners;
    for (size_t i = 0; i < corners.size(); ++i) {
        const glm::vec3 from = corners[i] - place;
        const glm::vec3 to = corners[(i + 1) % corners.size()] - place;
        const float height = glm::dot(from, normal);
        const float next = glm::dot(to, normal);
        if (height >= 0.0f) seen.ways[seen.count++] = from;
        if ((height < 0.0f && next > 0.0f) || (height > 0.0f && next < 0.0f))
            seen.ways[seen.count++] = from + height / (height - next) * (to - from);
    }
    return seen;
}

} // namespace

float irradianceOf(const ShiningRectangle& rectangle, glm::vec3 place, glm::vec3 normal)
{
    if (glm::dot(place - rectangle.corners[0], rectangle.facing) <= kInItsPlane) return 0.0f;
    const SeenPolygon seen = aboveHorizon(rectangle, place, normal);
    float sum = 0.0f;
    for (size_t i = 0; i < seen.count; ++i) {
        const glm::vec3 from = seen.ways[i];
        const glm::vec3 to = seen.ways[(i + 1) % seen.count];
        const glm::vec3 across = glm::cross(from, to);
        const float length = glm::length(across);
        if (length <= 0.0f) continue; // a corner that lies on the horizon, twice
        sum += std::atan2(length, glm::dot(from, to)) * glm::dot(across, normal) / length;
    }
    return std::max(-0.5f * sum, 0.0f);
}

void irradianceOf(const ShiningRectangle& rectangle, const TexelBlock& block, float* irradiance)
{
    for (size_t i = 0; i < block.count; ++i)
        irradiance[i] = irradianceOf(rectangle, {block.x[i], block.y[i], block.z[i]},
                                     {block.nx[i], block.ny[i], block.nz[i]});
}

} // namespace relamp
