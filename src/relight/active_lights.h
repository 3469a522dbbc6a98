#pragma once

#include "lights/surfel_radiance.h"
#include "relamp/relight.h"
#include "relight/light_source.h"
#include "scan/texels.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace relamp
{

/// The fixtures of a room with their surfaces, in one order.
struct RoomFixtures
{
    const Lights& captured;
    std::span<const std::vector<ClippedPatch>> surfaces;
};

/// A light that is on.
struct ActiveLight
{
    NewLight light;                    // where it is no fixture
    Fixture fixture;                   // where it is one; with a number: of the room
    std::vector<ClippedPatch> surface; // and what shines of it
    bool isFixture = false;
    glm::vec3 emission{0.0f};
    std::shared_ptr<const LightSource> source; // at emission 1
};

/// Whether what one casts shadows of is what the other does.
bool castSameShadows(const ActiveLight& a, const ActiveLight& b);

/// A relighting as it meets the surfaces of a room.
struct ActiveLights
{
    std::vector<ActiveLight> lights;
    std::vector<glm::vec3> sky;  // of SkyBins
    std::vector<uint8_t> shines; // of surfels; not 0: its burnt-out texels are a lamp that is on
    std::vector<glm::vec3> emission;     // of these texels
    std::vector<uint8_t> windowOpenings; // of surfels; empty: none is a window's
};

/// Gives each fixture its surface, takes the sky through window openings, leaves out what is dark.
ActiveLights activate(const Texels& texels, const RoomFixtures& room, const Relighting& lighting);

} // namespace relamp
