#pragma once

#include "relamp/relight.h"
#include "relight/active_lights.h"
#include "relight/by_radiosity.h"
#include "relight/room_albedo.h"
#include "relight/transport.h"
#include "scan/rays.h"
#include "scan/split_surfels.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace relamp
{

/// What a Relighter knows of its room, and the light that was set.
struct Relighter::State
{
    State(const DelitRoom& of, const RelightOptions& with, Progress& progress);
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    [[nodiscard]] ActiveLights activeUnder(const Relighting& lighting) const;

    const DelitRoom& room;
    RelightOptions options;
    std::vector<std::string> warningsOfRoom;
    RayScene scene;
    Texels texels;
    SurfelRadiance radiance;
    std::vector<float> lit;                          // of surfels: correctionBy
    std::vector<std::vector<ClippedPatch>> surfaces; // of captured fixtures
    Transport transport;
    std::shared_ptr<const TexelMarks> open; // openShares
    std::span<const Image> painted;         // pages that `albedo` is of
    RoomAlbedo albedo;
    std::vector<uint8_t> isOpening; // of captured fixtures: likelyWindowOpenings
    RadiosityLight radiosity;

    ActiveLights active;
    TexelShading shade;                // empty until a light was set
    std::vector<std::string> warnings; // these and those of the light
};

} // namespace relamp
