#pragma once

#include "relamp/lights.h"

#include <span>
#include <string>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace relamp
{

/// A point of a lamp's surface that stands for a piece of it.
struct LampPoint
{
    glm::vec3 position{0.0f}; // world, m
    glm::vec3 normal{0.0f};   // unit
    float area = 0.0f;        // m^2, > 0
};

enum class LampShape { rectangle, disc, sphere };

/// A light of a simple shape, as renderers have them, in the place of a lamp.
struct SimpleLamp
{
    std::string name;
    int id = -1; // of the fixture that it stands for; -1: of none
    LampShape shape = LampShape::sphere;
    glm::vec3 position{0.0f}; // of its middle, world, m
    glm::mat3 axes{1.0f};     // unit: along its width, along its height, against its light
    float width = 0.0f;       // m, of a rectangle
    float height = 0.0f;      // m, of a rectangle
    float radius = 0.0f;      // m, of the others
    glm::vec3 emission{0.0f}; // RGB, radiance * m^2: radiance times area, which is flux / pi

    [[nodiscard]] float area() const; // m^2, that shines
};

/// The lights that take the place of a fixture and send what it sends: a rectangle or a disc where
/// it faces one way, with more at its sides if much of it faces there; else a sphere. `points` are
/// of its surface in the scan, which they stand close before or around, so that the surface hides
/// nothing of them; where there are none, it is a disc or sphere of the fixture's area.
std::vector<SimpleLamp> simpleLamps(const Fixture& fixture, const std::vector<LampPoint>& points);

/// A sphere in the place of a light without extent.
SimpleLamp simpleLamp(const PointLight& point);

/// A square that shines along `normal`, upright where it can be.
SimpleLamp squareLamp(glm::vec3 centre, glm::vec3 normal, float area, glm::vec3 radiance);

} // namespace relamp
