#pragma once

#include "rooms/room.h"

#include <cstdint>
#include <span>
#include <string>

#include <glm/vec2.hpp>

namespace relamp::rooms
{

/// What makes one room unlike another.
struct Plan
{
    std::string name;
    uint64_t seed = 0;       // of furniture and paints
    glm::vec3 size{0.0f};    // m
    float brightness = 0.7f; // albedo of walls
    glm::ivec2 panels{0};    // ceiling panels along x and z
    int globes = 0;          // that hang from the ceiling
    int domes = 0;           // on the ceiling
    int tableLamps = 0;
    int sconces = 0;         // on the walls
    int panes = 0;           // windows whose panes shine
    int openings = 0;        // windows without a pane: what is outside is not in the scan
    bool isOpenPlan = false; // one wall has a gap to a lit room that is not in the scan
    float kelvin = 3000.0f;  // of the lamps, about
    float daylight = 1.0f;   // radiance of sky and panes
    int furniture = 6;       // pieces
    float burntOut = 0.03f;  // share of surfaces other than lamps
};

/// All rooms; the table is in plans.cpp.
std::span<const Plan> allPlans();

} // namespace relamp::rooms
