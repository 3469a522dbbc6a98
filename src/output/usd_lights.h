#pragma once

#include "output/simple_lamp.h"
#include "relamp/delight.h"

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// The light of a room as other programs can have it.
struct UsdLights
{
    std::vector<SimpleLamp> lamps;    // of fixtures, and lights without one
    std::vector<SimpleLamp> openings; // what large holes let in beyond `outside`
    glm::vec3 outside{0.0f};          // radiance of all that lies outside
    std::optional<Sun> sun;
};

/// Of all that a room was found to have. What is off has none.
UsdLights usdLightsOf(const Decomposition& room);

/// What the texels of a page send as lamps: linear half RGB a pixel, the radiance of the fixture
/// whose they are; empty where nothing shines.
std::vector<uint16_t> emissionBy(const FixtureMap& map, const Lights& lights);

} // namespace relamp
