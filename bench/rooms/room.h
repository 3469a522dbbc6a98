#pragma once

#include "rooms/paint.h"

#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace relamp::rooms
{

/// A rectangle that is seen from where alongU x alongV points; or that, seen from `centre`, drawn
/// onto a sphere.
struct Patch
{
    glm::vec3 corner{0.0f}; // world, m
    glm::vec3 alongU{0.0f};
    glm::vec3 alongV{0.0f};
    int paint = 0;
    int lamp = -1;          // that it is part of
    float radius = 0.0f;    // m; 0: flat
    glm::vec3 centre{0.0f}; // of the sphere

    [[nodiscard]] glm::vec3 at(float u, float v) const
    {
        const glm::vec3 flat = corner + u * alongU + v * alongV;
        return radius > 0.0f ? centre + radius * glm::normalize(flat - centre) : flat;
    }
    [[nodiscard]] glm::vec3 normalAt(float u, float v) const
    {
        return radius > 0.0f ? glm::normalize(at(u, v) - centre)
                             : glm::normalize(glm::cross(alongU, alongV));
    }
};

struct Lamp
{
    std::string kind; // as gt_lights.json calls it
    glm::vec3 radiance{0.0f};
};

/// A rectangle of nothing through which light comes in from outside; its normal, alongU x alongV,
/// points into the room.
struct Opening
{
    glm::vec3 corner{0.0f};
    glm::vec3 alongU{0.0f};
    glm::vec3 alongV{0.0f};
};

/// What is to be seen through openings, the same from everywhere.
struct Outside
{
    glm::vec3 zenith{0.0f}; // radiance, straight up
    glm::vec3 horizon{0.0f};
    glm::vec3 ground{0.0f};

    [[nodiscard]] glm::vec3 radiance(glm::vec3 direction) const
    {
        return direction.y < 0.0f ? ground : horizon + direction.y * (zenith - horizon);
    }
};

/// A room as it is: surfaces, lamps, and where daylight comes in.
struct Room
{
    std::vector<Paint> paints;
    std::vector<Patch> patches;
    std::vector<Lamp> lamps;
    std::vector<Opening> openings;
    Outside outside;
};

} // namespace relamp::rooms
